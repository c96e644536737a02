// One thread of the darkroom: reads pictures, fits looks, develops pixels. It is asked one thing at a time.

import { initSync, Files, Form, Look, Moving, Picture, __wbg_reset_state } from "./onelight_web.js";

/** What was made, the last one used at the end; what is too much is freed. */
class Kept extends Map {
  constructor(most) {
    super();
    this.most = most;
  }

  of(key, make) {
    let made = this.get(key);
    if (made) {
      this.delete(key);
    } else {
      made = make();
      if (this.size >= this.most) {
        const [oldest, old] = this.entries().next().value;
        this.delete(oldest);
        old.free();
      }
    }
    this.set(key, made);
    return made;
  }
}

/** Forms that develop pixels, by the keys of their colours: each takes about 60 KB. */
const forms = new Kept(96);
/** Looks with their film, by all their keys. */
const looks = new Kept(4);
/** Films that follow the controls, by their names. */
const moving = new Kept(12);
/** Pixels that were left here to be developed again, by their name. */
const lights = new Map();

const form = ({ key, packed }) => forms.of(key, () => new Form(packed));
const look = ({ all, packed }) => looks.of(all, () => new Look(all, packed));

const tasks = {
  start({ module }) {
    initSync({ module });
  },

  /** Takes a file apart: all of its light, two smaller copies, and what is said of it. */
  open({ file, name, space, behind }) {
    const picture = new Picture(new Uint8Array(file), name, space, behind);
    try {
      const described = JSON.parse(picture.described());
      const light = new Uint16Array(described.width * described.height * 4);
      let filled = 0;
      for (let rows = picture.nextRows(); rows; rows = picture.nextRows()) {
        light.set(rows, filled);
        filled += rows.length;
        say({ done: filled / light.length });
      }
      const [preview, thumbnail] = [picture.preview(), picture.thumbnail()];
      const answer = { described, seen: JSON.parse(picture.seen()), light, preview, thumbnail };
      return [answer, [light.buffer, preview.buffer, thumbnail.buffer]];
    } finally {
      picture.free();
    }
  },

  /** The packed form of a look; `usual` is that of its films' usual look, if the page has it. */
  fit({ keys, films, usual }) {
    const packed = moving.of(films, () => new Moving(keys, usual)).form(keys);
    return [packed, [packed.buffer]];
  },

  /** Keeps pixels under a name. */
  keep({ name, light }) {
    lights.set(name, light);
  },

  /** Display codes of pixels that were kept. */
  develop(asked) {
    const light = lights.get(asked.name);
    const codes = light ? form(asked).develop(light, asked.ev) : new Uint8Array();
    return [codes, [codes.buffer]];
  },

  /** Where a colour comes from. */
  way(asked) {
    return JSON.parse(look(asked).way(...asked.rgb));
  },

  /** A rectangle of light with sharpness, halation and grain, and why each is run or not. */
  onFilm(asked) {
    const { light, size, at, frameWidth, aspect, ev } = asked;
    const found = look(asked).onFilm(light, ...size, ...at, frameWidth, aspect, ev);
    const [codes, reasons] = [found.bytes(), found.reasons()];
    found.free();
    return [{ codes, reasons }, codes ? [codes.buffer] : []];
  },

  /** The picture in a file, developed into another file. */
  developFile(asked) {
    const { file, name, behind, ev, kind } = asked;
    const found = look(asked).developFile(new Uint8Array(file), name, behind, ev, kind, (done) => say({ done }));
    const [bytes, reasons] = [found.bytes(), found.reasons()];
    found.free();
    return [{ bytes, reasons }, [bytes.buffer]];
  },

  /** The look as files for a program. */
  bake({ keys, program }) {
    const files = new Files(keys, program, (done) => say({ done }));
    const all = [];
    for (let i = 0; i < files.count(); i++) all.push({ name: files.name(i), bytes: files.bytes(i) });
    const answer = { load: files.load(), files: all };
    files.free();
    return [answer, all.map((file) => file.bytes.buffer)];
  },
};

let asked = 0;

function say(what) {
  postMessage({ id: asked, ...what });
}

onmessage = ({ data }) => {
  asked = data.id;
  try {
    const answer = tasks[data.task](data);
    const [value, transfer] = Array.isArray(answer) ? answer : [answer, []];
    postMessage({ id: asked, value }, transfer);
  } catch (error) {
    // A trap leaves the memory as it was in the middle of something: it is given up for a new one. Pixels lie outside of it.
    const trapped = error instanceof WebAssembly.RuntimeError || error instanceof RangeError;
    if (trapped) {
      for (const kept of [forms, looks, moving]) kept.clear();
      __wbg_reset_state();
    }
    postMessage({ id: asked, error: trapped ? sentence(data) : error.message ?? String(error), trapped });
  }
};

function sentence({ task, name }) {
  const what = { open: `${name}: cannot be read`, developFile: `${name}: cannot be written` }[task] ?? "this look cannot be computed";
  return `${what} (the file may be damaged, or the browser has too little memory); everything else stays as it was`;
}
