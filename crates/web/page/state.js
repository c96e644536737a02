// What the user has set: the look's keys and the exposure, with undo, and as a link.

import { fittingKeys, keysOfToml, tomlOfKeys } from "./onelight_web.js";

/** Most steps that are undone. */
const MOST_STEPS = 200;
/** Changes of one control that follow each other within so many milliseconds are one step. */
const ONE_STEP_MS = 700;

export class State extends EventTarget {
  constructor() {
    super();
    this.usual = JSON.parse(fittingKeys("{}"));
    this.now = { keys: this.usual, ev: 0 };
    this.past = [];
    this.future = [];
    this.last = { what: "", when: 0 };
  }

  get keys() {
    return this.now.keys;
  }

  get ev() {
    return this.now.ev;
  }

  /** Turns controls: keys of the look, `ev`, or both. What does not go together with the rest is made to fit. */
  set({ ev = this.now.ev, ...keys }, what = Object.keys(keys)[0] ?? "ev") {
    // Pictures are exposed while they are developed, so that a look serves all exposures.
    const turned = Object.keys(keys).length ? JSON.parse(fittingKeys(JSON.stringify({ ...this.now.keys, ...keys }))) : this.now.keys;
    const next = { keys: { ...turned, ev: 0 }, ev: Math.min(Math.max(+ev.toFixed(4), -20), 20) };
    if (JSON.stringify(next) === JSON.stringify(this.now)) return;
    const now = performance.now();
    if (this.last.what !== what || now - this.last.when > ONE_STEP_MS) {
      this.past.push(this.now);
      if (this.past.length > MOST_STEPS) this.past.shift();
    }
    this.last = { what, when: now };
    this.future = [];
    this.become(next);
  }

  become(next) {
    const keys = JSON.stringify(next.keys) !== JSON.stringify(this.now.keys);
    this.now = next;
    this.dispatchEvent(new CustomEvent("change", { detail: { keys } }));
  }

  undo() {
    if (this.past.length === 0) return;
    this.future.push(this.now);
    this.last.what = "";
    this.become(this.past.pop());
  }

  redo() {
    if (this.future.length === 0) return;
    this.past.push(this.now);
    this.last.what = "";
    this.become(this.future.pop());
  }

  reset() {
    this.set({ ...this.usual, ev: 0 }, "reset");
  }

  /** All keys, the exposure among them. */
  get exposedKeys() {
    return JSON.stringify({ ...this.keys, ev: this.ev });
  }

  get toml() {
    return tomlOfKeys(this.exposedKeys);
  }

  set toml(text) {
    this.set({ ...JSON.parse(keysOfToml(text)) }, "toml");
  }

  /** What follows `#` in a link: a look.toml of what differs from the usual. */
  get hash() {
    const lines = Object.entries(JSON.parse(this.exposedKeys))
      .filter(([key, value]) => key !== "first" && (key === "print" || JSON.stringify(value) !== JSON.stringify(this.usual[key])))
      .map(([key, value]) => `${key} = ${JSON.stringify(value)}`);
    return encodeURIComponent(["version = 2", ...lines].join("\n"));
  }

  /** Takes a link's settings; an error is for the user to read. */
  follow(hash) {
    this.toml = decodeURIComponent(hash.replace(/^#/, ""));
  }
}
