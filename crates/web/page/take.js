// What is taken away: pictures, looks for other programs, look.toml, a link.

import { element } from "./controls.js";
import { Cancelled } from "./pool.js";

export class Take {
  constructor(state, looks, pool, choices, say) {
    Object.assign(this, { state, looks, pool, say });
    this.work = document.getElementById("work");
    this.saved = document.getElementById("saved");
    const program = document.getElementById("program");
    for (const { word, help } of choices) program.append(element("option", { value: word, textContent: help.split(":")[0].replace(/^./, (c) => c.toUpperCase()) }));
    const hint = () => (document.getElementById("program-hint").textContent = choices.find(({ word }) => word === program.value)?.help ?? "");
    program.addEventListener("change", hint);
    hint();
    on("save-picture", () => this.picture(document.getElementById("kind").value));
    on("save-look", () => this.look(program.value));
    on("save-toml", () => this.offer([{ name: "look.toml", bytes: new TextEncoder().encode(state.toml) }], true));
    on("copy-link", () => this.link());
    on("cancel", () => pool.cancel());
  }

  async picture(kind) {
    const { file, name, behind } = this.opened ?? {};
    if (!file) return;
    const ending = { png8: "png", png16: "png", tiff16: "tif", jpeg: "jpg", exr: "exr" }[kind];
    const { keys, ev } = this.state.now;
    await this.long("The picture is developed ...", async (progress) => {
      const look = await this.looks.live(this.looks.of(keys));
      const bytes = await file.arrayBuffer();
      const asked = { file: bytes, name, behind, ev, kind };
      const found = await this.pool.long.withFilm("developFile", look, JSON.stringify(keys), asked, [bytes], progress);
      this.offer([{ name: `${name.replace(/\.[^.]*$/, "")}.${keys.camera.replace("@", "-")}.${ending}`, bytes: found.bytes }], true, found.reasons);
    });
  }

  async look(program) {
    const keys = this.state.exposedKeys;
    await this.long("The look is baked and measured ...", async (progress) => {
      const { files, load } = await this.pool.long.ask("bake", { keys, program }, [], progress);
      this.offer(files, false, load);
    });
  }

  /** Runs what takes a while, with progress and a way to end it. */
  async long(sentence, task) {
    if (!this.work.hidden) return;
    const bar = document.getElementById("progress");
    bar.removeAttribute("value");
    this.work.hidden = false;
    this.say(sentence);
    try {
      await task((done) => (bar.value = done));
    } catch (error) {
      if (error instanceof Cancelled) this.say("Cancelled.");
      else this.say(error.message, true);
    } finally {
      this.work.hidden = true;
    }
  }

  /** Lists files to save; one alone is saved at once. */
  offer(files, atOnce, load = "") {
    for (const link of this.saved.querySelectorAll("a")) URL.revokeObjectURL(link.href);
    const items = files.map(({ name, bytes }) => {
      const item = element("li");
      const link = element("a", { href: URL.createObjectURL(new Blob([bytes])), download: name, textContent: name });
      item.append(link, ` (${size(bytes.length)})`);
      return item;
    });
    this.saved.replaceChildren(...items);
    for (const line of load.split("\n").filter(Boolean)) this.saved.append(element("li", { textContent: line }));
    this.say(files.length === 1 ? `${files[0].name} is ready.` : `${files.length} files are ready to save.`);
    if (atOnce) this.saved.querySelector("a").click();
  }

  async link() {
    const link = new URL(`#${this.state.hash}`, location.href).href;
    try {
      await navigator.clipboard.writeText(link);
      this.say("The link is copied. It holds the look and the exposure, not the picture.");
    } catch {
      this.say("The browser does not let this page copy: the address above holds the look.");
    }
  }
}

function on(id, act) {
  document.getElementById(id).addEventListener("click", act);
}

function size(bytes) {
  return bytes < 1e6 ? `${Math.max(1, Math.round(bytes / 1000))} KB` : `${(bytes / 1e6).toFixed(1)} MB`;
}
