// The picture area: the film, what is beside it, zoom, pan, the point that is looked at.

import { CpuRenderer } from "./draw_cpu.js";
import { values, withoutFilm } from "./half.js";

/** Pixels around what is shown whose light reaches into it by scatter and halation. */
const AROUND = 128;
/** Sizes that are chosen from: the whole picture, and pixels of the screen for one of its own. */
const SIZES = [0, 1, 2, 4];

/** A rectangle of light in rows of `width` pixels. */
function cut(light, width, [left, top], size) {
  const rows = new Uint16Array(size[0] * size[1] * 4);
  for (let y = 0; y < size[1]; y++) {
    const from = ((top + y) * width + left) * 4;
    rows.set(light.subarray(from, from + size[0] * 4), y * size[0] * 4);
  }
  return rows;
}

export class View extends EventTarget {
  constructor(elements, pool) {
    super();
    Object.assign(this, elements);
    this.pool = pool;
    this.zoom = 0;
    this.at = [0, 0];
    this.split = 0.5;
    this.watch();
    new ResizeObserver(() => this.fit()).observe(this.stage);
  }

  async start(kinds) {
    for (const Renderer of kinds) {
      try {
        this.renderer = await Renderer.make(this.film, this.pool, "view");
        this.drawnBy = Renderer.name;
        this.renderer.lost?.then(() => this.replace());
        break;
      } catch (error) {
        // The next kind takes its place; a canvas that has begun with one cannot go on with another.
        console.info(`${Renderer.name}: ${error.message}`);
        const fresh = this.film.cloneNode();
        this.film.replaceWith(fresh);
        this.film = fresh;
      }
    }
    this.otherRenderer ??= await CpuRenderer.make(this.other, this.pool, "other");
  }

  /** The graphics card went away: the processor goes on. */
  async replace() {
    const fresh = this.film.cloneNode();
    this.film.replaceWith(fresh);
    this.film = fresh;
    await this.start([CpuRenderer]);
    this.dispatchEvent(new Event("drawn-by"));
    if (this.picture) await this.look();
    this.dispatchEvent(new Event("moved"));
  }

  /** Shows another picture. */
  async open(picture) {
    this.picture = picture;
    this.zoom = 0;
    this.point = undefined;
    this.mark.hidden = true;
    await this.look();
  }

  /** Cuts out what is to be seen, and gives it to what draws. */
  async look() {
    const { described, preview, light } = this.picture;
    if (this.zoom === 0) {
      [this.shown, this.shownSize, this.corner, this.scale] = [preview, described.preview, [0, 0], described.width / described.preview[0]];
    } else {
      const across = (side, all) => Math.min(all, Math.max(1, Math.ceil((side * devicePixelRatio) / this.zoom)));
      const size = [across(this.stage.clientWidth, described.width), across(this.stage.clientHeight, described.height)];
      const most = [described.width - size[0], described.height - size[1]];
      this.at = this.at.map((v, i) => Math.round(Math.min(Math.max(v, 0), most[i])));
      [this.shown, this.shownSize, this.corner, this.scale] = [cut(light, described.width, this.at, size), size, [...this.at], 1];
    }
    this.stage.classList.toggle("near", this.zoom > 0);
    await this.renderer.show(this.shown, ...this.shownSize);
    if (this.besideLook) await this.otherRenderer.show(this.shown, ...this.shownSize);
    this.fit();
  }

  /** What is shown, with light from around it that its film sees too; and where it lies in the frame. */
  part() {
    const { described, light } = this.picture;
    const { frame_width, at, pixel_aspect: aspect } = described;
    if (this.zoom === 0) {
      const near = at.map((v) => Math.round(v / this.scale));
      return { light: this.shown.slice(), size: this.shownSize, at: near, frameWidth: Math.max(1, Math.round(frame_width / this.scale)), aspect, inner: [0, 0] };
    }
    const first = this.corner.map((v) => Math.max(0, v - AROUND));
    const end = [described.width, described.height].map((side, i) => Math.min(side, this.corner[i] + this.shownSize[i] + AROUND));
    const size = end.map((v, i) => v - first[i]);
    return { light: cut(light, described.width, first, size), size, at: at.map((v, i) => v + first[i]), frameWidth: frame_width, aspect, inner: this.corner.map((v, i) => v - first[i]) };
  }

  withoutEffects() {
    this.grain.hidden = true;
  }

  /** Draws the film's effects over its colours, if any is run and nothing came meanwhile; why each is or is not. */
  async effects(look, all, ev, still) {
    const { inner, ...part } = this.part();
    const [shown, scale] = [this.shownSize, this.scale];
    const { codes, reasons } = await this.pool.reader.withFilm("onFilm", look, all, { ...part, ev }, [part.light.buffer]);
    if (codes && still()) {
      const pixels = new ImageData(new Uint8ClampedArray(codes.buffer, codes.byteOffset, codes.length), ...part.size);
      Object.assign(this.grain, { width: shown[0], height: shown[1] });
      this.grain.getContext("2d").putImageData(pixels, -inner[0], -inner[1]);
      this.grain.hidden = false;
    }
    return { reasons, size: scale };
  }

  /** Draws; true once the newest frame is on the screen. */
  async draw(look, ev) {
    if (!this.shown) return false;
    const drawn = this.renderer.draw(look, ev);
    await this.drawBeside(ev);
    const newest = await drawn;
    this.fit();
    return newest;
  }

  async drawBeside(ev) {
    if (this.beside === "none") {
      const [width, height] = this.shownSize;
      const codes = new Uint8ClampedArray(this.shown.length);
      withoutFilm(this.shown, ev, codes);
      Object.assign(this.other, { width, height });
      this.other.getContext("2d").putImageData(new ImageData(codes, width, height), 0, 0);
    } else if (this.besideLook?.packed) {
      await this.otherRenderer.draw(this.besideLook, ev);
    }
  }

  /** What is beside the film: nothing, `none` for the picture without film, or a look. */
  async compare(beside, look) {
    [this.beside, this.besideLook] = [beside, look];
    if (look && this.shown) await this.otherRenderer.show(this.shown, ...this.shownSize);
    const shown = Boolean(beside);
    this.other.hidden = !shown;
    this.splitter.hidden = !shown;
    this.divide();
  }

  divide() {
    const part = `${100 * this.split}%`;
    this.splitter.style.left = part;
    this.splitter.setAttribute("aria-valuenow", Math.round(100 * this.split));
    this.other.style.clipPath = `inset(0 0 0 ${part})`;
  }

  /** Gives the canvas its size on the page. */
  fit() {
    if (!this.shownSize) return;
    const [width, height] = this.shownSize;
    const room = [this.stage.clientWidth, this.stage.clientHeight];
    const scale = this.zoom > 0 ? this.zoom / devicePixelRatio : Math.min(room[0] / width, room[1] / height);
    this.film.style.width = `${width * scale}px`;
    this.film.style.height = `${height * scale}px`;
    this.cssScale = scale;
    this.divide();
    this.place();
  }

  place() {
    this.mark.hidden = !this.point;
    if (!this.point) return;
    const [x, y] = this.point.map((v, i) => ((v + 0.5 - this.corner[i]) / this.scale) * this.cssScale);
    this.mark.hidden = x < 0 || y < 0 || x > this.film.clientWidth || y > this.film.clientHeight;
    this.mark.style.left = `${x}px`;
    this.mark.style.top = `${y}px`;
  }

  /** Scene-linear light of the picture at a pixel, red, green and blue. */
  lightAt([x, y]) {
    const { described, light } = this.picture;
    const from = (y * described.width + x) * 4;
    return [0, 1, 2].map((i) => values[light[from + i]]);
  }

  pick(point) {
    const { width, height } = this.picture.described;
    this.point = [width, height].map((side, i) => Math.min(Math.max(Math.floor(point[i]), 0), side - 1));
    this.place();
    this.dispatchEvent(new CustomEvent("pick", { detail: this.point }));
  }

  pixelOf(event) {
    const box = this.film.getBoundingClientRect();
    const on = [event.clientX - box.left, event.clientY - box.top];
    return on.map((v, i) => this.corner[i] + (v / this.cssScale) * this.scale);
  }

  /** The next size up or down, about a pixel. */
  step(by, around) {
    const next = SIZES[SIZES.indexOf(this.zoom) + by];
    if (next !== undefined) this.zoomTo(next, around);
  }

  async zoomTo(zoom, around) {
    if (!this.picture) return;
    const { width, height } = this.picture.described;
    const centre = around ?? this.point ?? [width / 2, height / 2];
    this.zoom = zoom;
    if (zoom > 0) {
      const sides = [this.stage.clientWidth, this.stage.clientHeight];
      this.at = centre.map((v, i) => v - (sides[i] * devicePixelRatio) / zoom / 2);
    }
    await this.look();
    this.dispatchEvent(new Event("moved"));
  }

  watch() {
    let drag;
    const fingers = new Map();
    let pinch;
    const apart = () => {
      const [a, b] = [...fingers.values()];
      return Math.hypot(a[0] - b[0], a[1] - b[1]);
    };
    this.stage.addEventListener("pointerdown", (event) => {
      if (event.pointerType === "touch") fingers.set(event.pointerId, [event.clientX, event.clientY]);
      if (fingers.size === 2 && this.picture) {
        [pinch, drag] = [apart(), undefined];
        return;
      }
      if (!this.picture || this.splitter.contains(event.target) || event.button !== 0) return;
      drag = { from: [event.clientX, event.clientY], at: [...this.at], moved: false };
      this.stage.setPointerCapture(event.pointerId);
    });
    this.stage.addEventListener("pointermove", async (event) => {
      if (fingers.has(event.pointerId)) fingers.set(event.pointerId, [event.clientX, event.clientY]);
      if (pinch && fingers.size === 2) {
        const ratio = apart() / pinch;
        if (ratio > 1.4 || ratio < 0.7) {
          pinch = apart();
          const [a, b] = [...fingers.values()];
          this.step(ratio > 1 ? 1 : -1, this.pixelOf({ clientX: (a[0] + b[0]) / 2, clientY: (a[1] + b[1]) / 2 }));
        }
        return;
      }
      if (!drag) return;
      const by = [event.clientX - drag.from[0], event.clientY - drag.from[1]];
      drag.moved ||= Math.hypot(...by) > 4;
      if (drag.moved && this.zoom > 0) {
        this.at = drag.at.map((v, i) => v - (by[i] * devicePixelRatio) / this.zoom);
        await this.look();
        this.dispatchEvent(new Event("moved"));
      }
    });
    const lifted = (event) => {
      fingers.delete(event.pointerId);
      if (fingers.size < 2) pinch = undefined;
    };
    this.stage.addEventListener("pointerup", (event) => {
      lifted(event);
      const clicked = drag && !drag.moved;
      drag = undefined;
      if (!clicked) return;
      const box = this.film.getBoundingClientRect();
      const inside = event.clientX >= box.left && event.clientX < box.right && event.clientY >= box.top && event.clientY < box.bottom;
      if (inside) this.pick(this.pixelOf(event));
    });
    this.stage.addEventListener("pointercancel", (event) => {
      lifted(event);
      drag = undefined;
    });
    this.stage.addEventListener("dblclick", (event) => this.zoomTo(this.zoom ? 0 : 1, this.pixelOf(event)));
    this.stage.addEventListener(
      "wheel",
      (event) => {
        if (!this.picture || !event.ctrlKey) return;
        event.preventDefault();
        this.step(event.deltaY < 0 ? 1 : -1, this.pixelOf(event));
      },
      { passive: false },
    );
    this.stage.addEventListener("keydown", (event) => this.key(event));
    let splitting = false;
    const move = (event) => {
      const box = this.film.getBoundingClientRect();
      this.split = Math.min(Math.max((event.clientX - box.left) / box.width, 0), 1);
      this.divide();
    };
    this.splitter.addEventListener("pointerdown", (event) => {
      splitting = true;
      this.splitter.setPointerCapture(event.pointerId);
    });
    this.splitter.addEventListener("pointermove", (event) => splitting && move(event));
    this.splitter.addEventListener("pointerup", () => (splitting = false));
    this.splitter.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: -0.02, ArrowRight: 0.02, Home: -1, End: 1 }[event.key];
      if (!step) return;
      event.preventDefault();
      event.stopPropagation();
      this.split = Math.min(Math.max(this.split + step, 0), 1);
      this.divide();
    });
  }

  key(event) {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!this.picture || event.target !== this.stage || event.ctrlKey || event.metaKey) return;
    const { width, height } = this.picture.described;
    if (step) {
      event.preventDefault();
      const size = event.shiftKey ? 1 : Math.max(1, Math.round(this.shownSize[0] * this.scale * 0.02));
      const from = this.point ?? [width / 2, height / 2];
      this.point = [width, height].map((side, i) => Math.min(Math.max(Math.round(from[i] + step[i] * size), 0), side - 1));
      this.place();
    } else if (event.key === "+" || event.key === "-") {
      this.step(event.key === "+" ? 1 : -1, this.point ?? [width / 2, height / 2]);
    } else if (event.key === "Enter") {
      this.pick(this.point ?? [width / 2, height / 2]);
    }
  }
}
