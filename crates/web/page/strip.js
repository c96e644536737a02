// The film strip: the picture on every film, small.

import { element } from "./controls.js";
import { Cancelled } from "./pool.js";

/** Films are fitted anew so long after the last turn of a control. */
const PAUSE_MS = 120;

/** What a negative is seen on without a film to print on. */
const SCAN = { id: "scan", name: "A scan, inverted", kind_name: "no print", note: "light of the negative, gamma 0.6", about: "The negative's densities, inverted by the rule of the Cineon system" };

export class Strip {
  constructor(films, state, looks, pool) {
    Object.assign(this, { films, state, looks, pool });
    this.tiles = [];
    this.turn = 0;
    this.seen = new Set();
    this.watcher = new IntersectionObserver((entries) => {
      for (const { target, isIntersecting } of entries) isIntersecting ? this.seen.add(target) : this.seen.delete(target);
    });
    this.cameras = this.group(document.getElementById("cameras"), films.filter((film) => film.is_camera), (film) => ({ camera: film.id }));
    state.addEventListener("change", ({ detail }) => this.changed(detail.keys));
    this.listPrints();
  }

  /** Films of one kind after the other, each a button with a small picture. */
  group(place, films, keys) {
    place.replaceChildren();
    const tiles = [];
    const kinds = new Map();
    for (const film of films) {
      const kind = `${film.kind_name}${film.is_silver ? ", black and white" : ""}`;
      kinds.set(kind, [...(kinds.get(kind) ?? []), film]);
    }
    for (const [kind, members] of kinds) {
      const box = element("div", { className: "group" });
      const list = element("div", { className: "films" });
      const name = kind.replace(/^./, (first) => first.toUpperCase());
      list.setAttribute("role", "group");
      list.setAttribute("aria-label", name);
      box.append(element("h3", { textContent: name }), list);
      for (const film of members) {
        const button = element("button", { type: "button", className: "film", title: film.about ?? about(film) });
        const canvas = element("canvas", { width: 1, height: 1 });
        canvas.setAttribute("aria-hidden", "true");
        button.append(canvas, film.name, element("small", { textContent: film.note ?? note(film) }));
        button.addEventListener("click", () => this.choose(keys(film)));
        list.append(button);
        this.watcher.observe(button);
        tiles.push({ film, button, canvas, keys: keys(film) });
      }
      place.append(box);
    }
    return tiles;
  }

  choose(keys) {
    try {
      this.state.set(keys);
    } catch (error) {
      this.failed?.(error);
    }
  }

  listPrints() {
    const camera = this.films.find((film) => film.id === this.state.keys.camera.split("@")[0]);
    const offered = [...this.films, SCAN].filter((film) => camera?.prints.includes(film.id));
    document.getElementById("prints-title").hidden = offered.length === 0;
    document.getElementById("prints-title").textContent = `${camera?.name ?? "The film"} on other prints`;
    if (this.printsOf !== camera?.id) {
      this.printsOf = camera?.id;
      this.prints = this.group(document.getElementById("prints"), offered, (film) => ({ print: film.id }));
    }
    this.mark();
  }

  mark() {
    const { camera, print } = this.state.keys;
    for (const { film, button } of this.cameras) button.setAttribute("aria-pressed", film.id === camera.split("@")[0]);
    for (const { film, button } of this.prints) button.setAttribute("aria-pressed", film.id === print.split("@")[0]);
  }

  /** Another picture: every thread gets the small copy. */
  async show({ thumbnail, described }) {
    this.size = described.thumbnail;
    await Promise.all(this.pool.threads.map((thread) => thread.ask("keep", { name: "thumbnail", light: thumbnail })));
    return this.draw();
  }

  changed(keys) {
    if (keys) this.listPrints();
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.draw().catch((error) => this.failed?.(error)), keys ? PAUSE_MS : 0);
  }

  usualPrint(film) {
    return film.usual_print ?? "none";
  }

  /** Draws every tile with the settings of now; visible ones first. Resolves when all are drawn, or newer settings came. */
  async draw() {
    if (!this.size) return;
    const turn = ++this.turn;
    const still = () => turn === this.turn;
    const { keys, ev } = this.state.now;
    const tiles = [
      ...this.cameras.map((tile) => ({ ...tile, keys: { ...keys, camera: tile.film.id, print: this.usualPrint(tile.film) } })),
      ...this.prints.map((tile) => ({ ...tile, keys: { ...keys, print: tile.film.id } })),
    ];
    tiles.sort((a, b) => this.seen.has(b.button) - this.seen.has(a.button));
    const draw = async (tile) => {
      const exact = this.looks.of(tile.keys);
      const look = this.looks.quick(exact) ?? (await this.looks.ready(exact, still));
      if (still()) await this.drawTile(tile, look, ev);
    };
    const failed = (tile, error) => {
      if (!(error instanceof Cancelled)) tile.button.title = error.message;
    };
    await Promise.all(tiles.map((tile) => draw(tile).catch((error) => failed(tile, error))));
    if (still()) document.getElementById("strip").dataset.drawn = String(turn);
  }

  async drawTile({ canvas }, look, ev) {
    const [width, height] = this.size;
    const codes = await this.pool.idlest.develop(look, { name: "thumbnail", ev });
    if (codes.length !== width * height * 4) return;
    for (let a = 3; a < codes.length; a += 4) codes[a] = 255;
    Object.assign(canvas, { width, height });
    canvas.getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(codes.buffer, codes.byteOffset, codes.length), width, height), 0, 0);
  }
}

/** Year, speed, and what of its figures is not published. */
function note(film) {
  const speed = film.exposure_index ? `, EI ${film.exposure_index}` : "";
  const gaps = film.derived.length ? `stands in: ${film.derived.join(", ")}` : "all published";
  return `${film.year}${speed}; ${gaps}`;
}

/** What its data sheet says of a film, in lines. */
function about(film) {
  const lines = [`${film.name}, ${film.maker}, ${film.year}`, `${film.kind_name}, ${film.process}${film.balance ? `, ${film.balance}` : ""}`, film.sheet];
  if (film.derived.length) lines.push(`Not published, something stands in: ${film.derived.join(", ")}`);
  if (film.inter_image) lines.push(`Effect between layers: ${film.inter_image}`);
  return lines.join("\n");
}
