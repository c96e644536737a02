document.querySelectorAll("table.sortable").forEach(function (table) {
  var heads = Array.from(table.querySelectorAll("th"));
  var body = table.tBodies[0];
  var key = function (row, column) {
    var cell = row.cells[column];
    return cell.dataset.v === undefined ? cell.textContent : Number(cell.dataset.v);
  };
  var compare = function (a, b) {
    if (typeof a === "number") { return typeof b === "number" ? a - b : -1; }
    return typeof b === "number" ? 1 : a.localeCompare(b);
  };
  table.classList.add("sorts");
  heads.forEach(function (head, column) {
    head.addEventListener("click", function () {
      var down = head.getAttribute("aria-sort") === "ascending";
      heads.forEach(function (other) { other.removeAttribute("aria-sort"); });
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
      Array.from(body.rows)
        .sort(function (a, b) { return (down ? -1 : 1) * compare(key(a, column), key(b, column)); })
        .forEach(function (row) { body.appendChild(row); });
    });
  });
});
