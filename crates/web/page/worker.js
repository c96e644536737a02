// One thread of the darkroom: reads pictures, fits looks, develops pixels. It is asked one thing at a time.

import { initSync, Files, Look, Picture, __wbg_reset_state } from "./onelight_web.js";

/** Looks that were made, the last one used at the end. */
const looks = new Map();
/** Most looks that are kept: each takes about 60 KB. */
const MOST_LOOKS = 96;
/** Pixels that were left here to be developed again, by their name. */
const lights = new Map();

/** The look of these keys, with its direct form where the page knows it. */
function look({ key, keys, direct }) {
  let made = looks.get(key);
  if (made) {
    looks.delete(key);
  } else {
    made = new Look(keys, direct ?? undefined);
    if (looks.size >= MOST_LOOKS) {
      const [oldest, old] = looks.entries().next().value;
      looks.delete(oldest);
      old.free();
    }
  }
  looks.set(key, made);
  return made;
}

const tasks = {
  start({ module }) {
    initSync({ module });
  },

  /** Takes a file apart: all of its light, two smaller copies, and what is said of it. */
  open({ file, name, space }) {
    const picture = new Picture(new Uint8Array(file), name, space);
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

  /** Fits a look, and gives its direct form to be handed to others. */
  fit({ keys }) {
    const made = new Look(keys);
    try {
      return made.directJson();
    } finally {
      made.free();
    }
  },

  /** Keeps pixels under a name. */
  keep({ name, light }) {
    lights.set(name, light);
  },

  /** Display codes of pixels that were kept. */
  develop(asked) {
    const light = lights.get(asked.name);
    const codes = light ? look(asked).develop(light, asked.ev) : new Uint8Array();
    return [codes, [codes.buffer]];
  },

  /** Where a colour comes from. */
  way(asked) {
    return JSON.parse(look(asked).way(...asked.rgb));
  },

  /** The picture in a file, developed into another file. */
  developFile(asked) {
    const bytes = look(asked).developFile(new Uint8Array(asked.file), asked.name, asked.ev, asked.kind);
    return [bytes, [bytes.buffer]];
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
      looks.clear();
      __wbg_reset_state();
    }
    postMessage({ id: asked, error: trapped ? sentence(data) : error.message ?? String(error), trapped });
  }
};

function sentence({ task, name }) {
  const what = { open: `${name}: cannot be read`, developFile: `${name}: cannot be written` }[task] ?? "this look cannot be computed";
  return `${what} (the file may be damaged, or the browser has too little memory); everything else stays as it was`;
}
