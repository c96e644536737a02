// Curves and spectra as SVG.

const SPACE = "http://www.w3.org/2000/svg";

export function svg(tag, attributes = {}, text = undefined) {
  const made = document.createElementNS(SPACE, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  if (text !== undefined) made.textContent = text;
  return made;
}

/** A plot of lines over one axis: `lines` of { x, y, kind }, `points` of { x, y, kind }, `marks` of { x, text }. */
export function plot({ lines = [], points = [], marks = [], label, across, range, up }) {
  const [width, height, left, bottom] = [320, 170, 42, 26];
  const all = (axis) => lines.flatMap((line) => line[axis]);
  const [x0, x1] = range ?? [Math.min(...all("x")), Math.max(...all("x"))];
  const [y0, y1] = up ?? [Math.min(0, ...all("y")), Math.max(...all("y"), 1e-9) * 1.05];
  const px = (x) => left + ((Math.min(Math.max(x, x0), x1) - x0) / (x1 - x0)) * (width - left - 8);
  const py = (y) => height - bottom - ((Math.min(Math.max(y, y0), y1) - y0) / (y1 - y0)) * (height - bottom - 10);
  const made = svg("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": label });
  made.append(svg("path", { class: "axis", d: `M${left} 10V${height - bottom}H${width - 8}` }));
  made.append(svg("text", { x: width - 8, y: height - 6, "text-anchor": "end" }, across));
  made.append(svg("text", { x: left, y: height - 6 }, short(x0)), svg("text", { x: left - 4, y: 16, "text-anchor": "end" }, short(y1)));
  for (const { x, text } of marks) {
    made.append(svg("path", { class: "axis", d: `M${px(x)} 10V${height - bottom}`, "stroke-dasharray": "3 3" }));
    made.append(svg("text", { x: px(x) + 3, y: 20 }, text));
  }
  for (const { x, y, kind } of lines) {
    const d = x.map((x, i) => `${i ? "L" : "M"}${px(x).toFixed(1)} ${py(y[i]).toFixed(1)}`).join("");
    made.append(svg("path", { class: kind, d }));
  }
  for (const { x, y, kind } of points) made.append(svg("circle", { class: kind, cx: px(x), cy: py(y), r: 5 }));
  return made;
}

const short = (v) => String(+v.toPrecision(2));
