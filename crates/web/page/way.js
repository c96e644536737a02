// Where a colour comes from, and what a film can hold.

import { element } from "./controls.js";
import { plot, svg } from "./plot.js";

const LAYERS = ["red", "green", "blue"];
const few = (v) => (Math.abs(v) >= 100 ? v.toFixed(0) : Math.abs(v) >= 10 ? v.toFixed(1) : v.toFixed(3));
const triple = (values) => values.map(few).join(", ");

/** Shows the way of one colour in steps, each with a figure where it has one. */
export function showWay(place, way, ev) {
  const steps = [
    step("Scene light", `Red, green and blue: ${triple(way.scene)}${ev ? `, after ${ev > 0 ? "+" : ""}${+ev.toFixed(2)} stops` : ""}. Of the many spectra that look so, the smoothest is taken.`, spectrum(way.light, "Spectrum of the light")),
    step("The film's three layers", layersText(way.camera), curves(way.camera, "The camera film's curves with the three exposures")),
  ];
  if (way.print) steps.push(step("The print", `The printer's lights shine through the negative. ${layersText(way.print)}`, curves(way.print, "The print's curves with the three exposures")));
  const colour = element("span", { className: "swatch" });
  colour.style.background = `rgb(${way.codes.join(" ")})`;
  const seen = step("What is seen", `Lamp light through the dyes gives XYZ ${triple(way.xyz)}, in display light ${triple(way.linear)}, as codes ${way.codes.join(", ")} `, spectrum(way.projected, "Spectrum of the light from the screen"));
  seen.querySelector("p").append(colour);
  place.replaceChildren(...steps, seen);
}

function layersText({ layers, exposure, effective, amounts }) {
  if (layers === 1) return `Log exposure ${few(exposure[0])} makes ${few(amounts[0])} of silver.`;
  const moved = exposure.some((v, i) => Math.abs(v - effective[i]) > 5e-4);
  const neighbours = moved ? `; the other layers move them to ${triple(effective)}` : "";
  return `Log exposures of the red, green and blue layer are ${triple(exposure)}${neighbours}. They make ${triple(amounts)} of cyan, magenta and yellow dye.`;
}

function step(name, text, figure) {
  const made = element("figure");
  made.append(element("figcaption", { textContent: name }), figure, element("p", { textContent: text }));
  return made;
}

function spectrum({ first_nm, step_nm, values }, label) {
  const x = values.map((_, i) => first_nm + i * step_nm);
  return plot({ lines: [{ x, y: values, kind: "none" }], label, across: "nm" });
}

function curves({ layers, curves, effective, amounts, grey }, label) {
  const kinds = layers === 1 ? ["silver"] : LAYERS;
  const lines = kinds.map((kind, i) => ({ ...curves[i], kind }));
  const points = kinds.map((kind, i) => ({ x: effective[i], y: amounts[i], kind }));
  return plot({ lines, points, marks: [{ x: grey[layers === 1 ? 0 : 1], text: "grey" }], label, across: "log exposure" });
}

/** The scene's light in stops behind the film's curve. `grey` is the way of a grey card. */
export function showHistogram(place, seen, grey, ev) {
  const [low, high] = [-10, 10];
  const { layers, curves, grey: at } = grey.camera;
  const kinds = layers === 1 ? ["silver"] : LAYERS;
  const most = Math.max(...curves.slice(0, layers).flatMap(({ y }) => y));
  const lines = kinds.map((kind, i) => ({ x: curves[i].x.map((x) => (x - at[i]) / Math.log10(2)), y: curves[i].y.map((y) => y / most), kind }));
  const label = "How much of the picture lies at each exposure, in stops about a grey card, and the film's curves over it";
  const figure = plot({ lines, label, across: "stops about grey", range: [low, high], up: [0, 1.05], marks: [{ x: 0, text: "grey" }] });
  const count = seen.histogram.length;
  const width = (seen.stops[1] - seen.stops[0]) / count;
  const largest = Math.max(...seen.histogram.slice(1, -1), 1);
  let d = "";
  let outside = 0;
  let all = 0;
  const ends = [Math.min(...lines.flatMap(({ x }) => x[4])), Math.max(...lines.flatMap(({ x }) => x.at(-5)))];
  for (const [i, pixels] of seen.histogram.entries()) {
    const stops = seen.stops[0] + i * width + ev;
    all += pixels;
    if (stops + width / 2 < ends[0] || stops + width / 2 > ends[1]) outside += pixels;
    if (stops < low || stops + width > high || !pixels) continue;
    const px = (s) => 42 + ((s - low) / (high - low)) * 270;
    const tall = Math.min(pixels / largest, 1) * 128;
    d += `M${px(stops).toFixed(1)} 144v${(-tall).toFixed(1)}h${(px(stops + width) - px(stops) - 0.5).toFixed(1)}V144Z`;
  }
  figure.prepend(svg("path", { class: "bars", d }));
  const share = all ? (100 * outside) / all : 0;
  const text = share < 0.05 ? "All of the picture lies on the film's curves." : `${share < 1 ? share.toFixed(1) : share.toFixed(0)} % of the picture lies where the film's curves are flat.`;
  place.replaceChildren(figure, element("p", { className: "hint", textContent: `Bars: the picture's light in stops about a grey card, after exposure. Lines: dye in the camera film. ${text}` }));
}
