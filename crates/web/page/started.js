// Runs where modules do not: a page that is opened as a file says what it needs.
addEventListener("DOMContentLoaded", () => {
  if (location.protocol === "file:") {
    document.getElementById("message").textContent =
      "This page is opened as a file, and browsers start no workers from files: serve its folder with any web server, such as `cargo xtask darkroom --serve`.";
  }
});
