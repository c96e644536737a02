// The darkroom: puts the parts together.

import { initSync, offered, Shipped } from "./onelight_web.js";
import { Controls, element } from "./controls.js";
import { CpuRenderer } from "./draw_cpu.js";
import { WebGl2Renderer } from "./draw_webgl2.js";
import { WebGpuRenderer } from "./draw_webgpu.js";
import { Looks } from "./looks.js";
import { Cancelled, Pool } from "./pool.js";
import { State } from "./state.js";
import { Strip } from "./strip.js";
import { Take } from "./take.js";
import { View } from "./view.js";
import { showHistogram, showWay } from "./way.js";

const $ = (id) => document.getElementById(id);

function say(text, isError = false) {
  $("message").textContent = text;
  $("message").classList.toggle("error", isError);
}

async function fetched(name) {
  const answer = await fetch(name);
  if (!answer.ok) throw new Error(`${name}: the server answers ${answer.status}, expected the file: the folder is not whole`);
  return answer;
}

class Darkroom {
  async start() {
    const [wasm, shipped, scene] = await Promise.all([
      fetched("onelight_web_bg.wasm").then((answer) => answer.arrayBuffer()),
      fetched("looks.bin").then((answer) => answer.arrayBuffer()),
      fetched("scene.exr").then((answer) => answer.blob()),
    ]);
    const module = await WebAssembly.compile(wasm);
    initSync({ module });
    this.pool = new Pool(module);
    await this.pool.ready;
    const { films, choices } = JSON.parse(offered());
    this.films = films;
    this.state = new State();
    this.looks = new Looks(this.pool, new Shipped(new Uint8Array(shipped)));
    try {
      if (location.hash.length > 1) this.state.follow(location.hash);
    } catch (error) {
      this.late = `The link's look cannot be read: ${error.message}`;
    }
    this.controls = new Controls(this.state, choices, films, { list: $("control-list"), film: $("film-list"), more: $("more-list") });
    this.controls.auto = () => this.picture?.seen.auto_ev ?? 0;
    this.strip = new Strip(films, this.state, this.looks, this.pool);
    this.take = new Take(this.state, this.looks, this.pool, choices.for, say);
    this.controls.failed = this.strip.failed = (error) => say(error.message, true);
    const elements = { stage: $("stage"), film: $("film"), grain: $("grained"), other: $("other"), mark: $("mark"), splitter: $("split") };
    this.view = new View(elements, this.pool);
    await this.view.start(renderers());
    for (const film of films.filter((film) => film.is_camera)) $("beside").append(element("option", { value: film.id, textContent: film.name }));
    this.listen();
    await this.compare("");
    await this.open(new File([scene], "scene.exr"), true);
    if (this.late) say(this.late, true);
    document.documentElement.dataset.ready = "";
  }

  listen() {
    this.state.addEventListener("change", ({ detail }) => this.changed(detail));
    this.view.addEventListener("moved", () => {
      $("zoom").value = String(this.view.zoom);
      this.redraw();
    });
    this.view.addEventListener("drawn-by", () => this.drawnBy());
    this.view.addEventListener("pick", () => this.showWay());
    $("choose").addEventListener("click", () => $("file").click());
    $("file").addEventListener("change", ({ target }) => {
      if (target.files[0]) this.open(target.files[0]);
      target.value = "";
    });
    $("load-toml").addEventListener("click", () => $("toml").click());
    $("toml").addEventListener("change", async ({ target }) => {
      const [file] = target.files;
      target.value = "";
      if (file) await this.openToml(file);
    });
    $("undo").addEventListener("click", () => this.state.undo());
    $("redo").addEventListener("click", () => this.state.redo());
    $("reset").addEventListener("click", () => this.state.reset());
    $("to-take").addEventListener("click", () => {
      $("take").scrollIntoView();
      $("kind").focus({ preventScroll: true });
    });
    $("zoom").addEventListener("change", ({ target }) => this.view.zoomTo(Number(target.value)));
    $("behind").addEventListener("change", ({ target }) => this.opened && this.open(this.opened, false, target.value));
    $("beside").addEventListener("change", ({ target }) => this.compare(target.value));
    addEventListener("dragover", (event) => {
      event.preventDefault();
      $("stage").classList.add("over");
    });
    addEventListener("dragleave", (event) => event.relatedTarget ?? $("stage").classList.remove("over"));
    addEventListener("drop", (event) => {
      event.preventDefault();
      $("stage").classList.remove("over");
      const [file] = event.dataTransfer.files;
      if (file) file.name.endsWith(".toml") ? this.openToml(file) : this.open(file);
    });
    addEventListener("paste", ({ clipboardData }) => {
      const [file] = clipboardData.files;
      if (file) this.open(file);
    });
    addEventListener("keydown", (event) => this.key(event));
    addEventListener("hashchange", () => {
      if (location.hash.slice(1) === this.state.hash) return;
      try {
        this.state.follow(location.hash);
      } catch (error) {
        say(`The link's look cannot be read: ${error.message}`, true);
      }
    });
    this.drawnBy();
    this.changed({ keys: false });
  }

  /** What is in the camera, and what it is printed on. */
  filmName() {
    const { camera, print } = this.state.keys;
    const name = (id) => {
      const film = this.films.find((film) => film.id === id.split("@")[0]);
      return film?.name ?? id;
    };
    return { none: name(camera), scan: `${name(camera)}, scanned` }[print] ?? `${name(camera)} on ${name(print)}`;
  }

  drawnBy() {
    $("drawn-by").textContent = `drawn by the ${this.view.drawnBy}`;
  }

  key(event) {
    const typing = event.target.matches("input[type=number], input[type=text], textarea");
    if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "z" && !typing) {
      event.preventDefault();
      event.shiftKey ? this.state.redo() : this.state.undo();
    } else if (!typing && !event.ctrlKey && !event.metaKey && !event.altKey && (event.key === "[" || event.key === "]")) {
      this.state.set({ ev: +(this.state.ev + (event.key === "]" ? 0.1 : -0.1)).toFixed(3) });
    }
  }

  async openToml(file) {
    try {
      this.state.toml = (await file.text()).slice(0, 70_000);
      say(`The look of ${file.name} is set.`);
    } catch (error) {
      say(error.message, true);
    }
  }

  /** Opens a picture; what was there stays until the new one is whole. */
  async open(file, first = false, behind = "") {
    const turn = (this.opening = (this.opening ?? 0) + 1);
    say(`${file.name} is read ...`);
    const began = performance.now();
    try {
      const bytes = await file.arrayBuffer();
      const asked = { file: bytes, name: file.name, space: this.state.keys.input_space, behind };
      const progress = (done) => turn === this.opening && say(`${file.name} is read: ${Math.round(100 * done)} % ...`);
      const picture = await this.pool.reader.ask("open", asked, [bytes], progress);
      if (turn !== this.opening) return;
      const again = this.opened === file;
      this.picture = picture;
      this.opened = file;
      this.take.opened = { file, name: file.name, behind };
      await this.view.open(picture);
      $("zoom").value = "0";
      // A finished picture has its exposure; a scene's light may lie anywhere.
      if (!first && !again && Math.abs(picture.seen.auto_ev) > 4) this.state.set({ ev: +picture.seen.auto_ev.toFixed(2) }, "auto");
      await this.updateLook();
      const { width, height, notes, has_alpha } = picture.described;
      if (picture.seen.hard) notes.push(`${picture.seen.hard} pixels hold NaN or infinity: NaN counts as 0, infinity as very bright.`);
      $("behind-label").hidden = !has_alpha;
      $("behind").value = behind;
      $("size").textContent = `${file.name}, ${width} x ${height}`;
      $("notes").replaceChildren(...notes.map((note) => element("li", { textContent: note })));
      $("way-list").replaceChildren();
      $("drop").hidden = !first;
      document.documentElement.dataset.firstFilm = String(Math.round(performance.now() - began));
      say(first ? "Ready. This is the scene to begin with." : `${file.name} is on film.`);
      await this.strip.show(picture);
      document.documentElement.dataset.wholeStrip = String(Math.round(performance.now() - began));
    } catch (error) {
      if (turn === this.opening && !(error instanceof Cancelled)) say(error.message, true);
    }
  }

  changed({ keys }) {
    $("undo").disabled = this.state.past.length === 0;
    $("redo").disabled = this.state.future.length === 0;
    $("film-name").textContent = this.filmName();
    history.replaceState(null, "", `#${this.state.hash}`);
    if (keys) {
      this.updateLook();
      if (this.beside && this.beside !== "none") this.compare(this.beside);
    } else this.redraw();
  }

  /** Makes the look of the settings, one at a time, the newest last. */
  async updateLook() {
    this.lookWanted = true;
    if (this.lookComing) return this.lookComing;
    const make = async () => {
      while (this.lookWanted) {
        this.lookWanted = false;
        try {
          this.look = await this.looks.live(this.looks.of(this.state.keys));
        } catch (error) {
          if (!this.lookWanted) say(error.message, true);
          continue;
        }
        await this.redraw();
      }
    };
    this.lookComing = make().finally(() => (this.lookComing = undefined));
    return this.lookComing;
  }

  /** Draws the newest settings; frames that came too fast are left out. */
  async redraw() {
    this.frameWanted = true;
    if (this.frameComing) return this.frameComing;
    const draw = async () => {
      while (this.frameWanted && this.look && this.picture) {
        this.frameWanted = false;
        const began = performance.now();
        try {
          this.view.withoutEffects();
          await this.view.draw(this.look, this.state.ev);
        } catch (error) {
          if (!(error instanceof Cancelled)) say(error.message, true);
        }
        const frames = (this.frames = (this.frames ?? 0) + 1);
        Object.assign($("film").dataset, { frames, ms: (performance.now() - began).toFixed(1) });
      }
      this.beginSlow();
    };
    this.frameComing = draw().finally(() => (this.frameComing = undefined));
    return this.frameComing;
  }

  /** What may come a moment later than the picture. */
  beginSlow() {
    clearTimeout(this.slow);
    this.slow = setTimeout(() => {
      if (this.view.point) this.showWay();
      this.showHistogram();
      this.showEffects();
    }, 120);
  }

  /** Sharpness, halation and grain of the film format, over the colours that are there. */
  async showEffects() {
    const { keys, ev } = this.state.now;
    const list = $("effects");
    if ((keys.film_format ?? "none") === "none" || !this.look || !this.picture) {
      list.replaceChildren();
      return;
    }
    const frame = this.frames;
    if (!list.childElementCount) list.replaceChildren(element("li", { textContent: "Grain, sharpness and halation are looked for ..." }));
    try {
      const { reasons, size } = await this.view.effects(this.look, JSON.stringify(keys), ev, () => frame === this.frames);
      if (frame !== this.frames) return;
      const lines = reasons.split("\n").filter(Boolean).map((line) => `${line.replace(/^./, (c) => c.toUpperCase())}.`);
      if (size !== 1) lines.unshift(`The whole picture is shown ${size.toFixed(1)} times smaller: its pixels stand for larger pieces of film, whose grain is finer. 1 : 1 shows what is saved.`);
      list.replaceChildren(...lines.map((line) => element("li", { textContent: line })));
      document.documentElement.dataset.effects = String(frame);
    } catch (error) {
      if (!(error instanceof Cancelled)) say(error.message, true);
    }
  }

  async showHistogram() {
    const [look, seen] = [this.look, this.picture?.seen];
    if (!look || !seen) return;
    try {
      look.grey ??= await this.pool.reader.withFilm("way", look, look.key, { rgb: [0.18, 0.18, 0.18] });
      if (look === this.look) showHistogram($("histogram"), seen, look.grey, this.state.ev);
    } catch (error) {
      say(error.message, true);
    }
  }

  async showWay() {
    const ev = this.state.ev;
    const rgb = this.view.lightAt(this.view.point).map((v) => v * 2 ** ev);
    try {
      const way = await this.pool.reader.withFilm("way", this.look, this.look.key, { rgb });
      showWay($("way-list"), way, ev);
      $("way-hint").textContent = `The pixel at ${this.view.point.join(", ")}. Click on another, or move with the arrow keys and press Enter.`;
    } catch (error) {
      say(error.message, true);
    }
  }

  async compare(beside) {
    this.beside = beside;
    const turn = (this.comparing = (this.comparing ?? 0) + 1);
    let look;
    try {
      if (beside && beside !== "none") {
        const film = this.films.find((film) => film.id === beside);
        look = await this.looks.ready(this.looks.of({ ...this.state.keys, camera: film.id, print: film.usual_print ?? "none" }));
      }
      if (turn !== this.comparing) return;
      await this.view.compare(beside, look);
      await this.redraw();
    } catch (error) {
      if (!(error instanceof Cancelled)) say(error.message, true);
    }
  }
}

/** What may draw, the best first: `?draw=cpu` and the like choose one, for tests. */
function renderers() {
  const asked = new URLSearchParams(location.search).get("draw");
  const all = [["webgpu", WebGpuRenderer], ["webgl2", WebGl2Renderer], ["cpu", CpuRenderer]];
  return all.filter(([word]) => word === "cpu" || !asked || asked === word).map(([, Renderer]) => Renderer);
}

new Darkroom().start().catch((error) => say(error.message, true));
