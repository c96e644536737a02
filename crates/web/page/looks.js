// Looks by the keys of their colours, each with the packed form that develops pictures.

import { colourKeys } from "./onelight_web.js";

/** Most looks that are kept: each takes about 30 KB. */
const MOST = 400;

export class Looks {
  /** `shipped`: the usual looks of all films, from which those with another light or other points follow at once. */
  constructor(pool, shipped) {
    Object.assign(this, { pool, shipped });
    this.all = new Map();
    /** Looks by keys that were not yet made to fit, which takes a millisecond. */
    this.asked = new Map();
  }

  /** The look of some keys, made to fit. */
  of(keys) {
    const text = JSON.stringify(keys);
    const known = this.asked.get(text);
    if (known) return known;
    const key = colourKeys(text);
    let look = this.all.get(key);
    if (!look) {
      look = { key };
      const { camera, print, points } = JSON.parse(key);
      look.films = `${camera} ${print}`;
      // Points act on neighbouring layers too, which quick forms leave out.
      if (points.every((points) => points === 0)) look.packed = this.shipped.quick(key);
      this.all.set(key, look);
      if (this.all.size > MOST) {
        const old = this.all.keys().next().value;
        this.all.delete(old);
        for (const [text, look] of this.asked) if (look.key === old) this.asked.delete(text);
      }
    }
    this.asked.set(text, look);
    if (this.asked.size > 4 * MOST) this.asked.delete(this.asked.keys().next().value);
    return look;
  }

  /** The same for a small picture, at once where numbers suffice; else `undefined`. */
  quick(look) {
    if (look.packed) return look;
    look.quick ??= { key: `quick ${look.key}`, packed: this.shipped.quick(look.key) };
    return look.quick.packed && look.quick;
  }

  request(look) {
    return { keys: look.key, films: look.films, usual: this.shipped.usual(look.key) };
  }

  /** The look that is shown, made by the thread that holds its films. */
  async live(look) {
    look.packed ??= await this.pool.live.ask("fit", this.request(look));
    return look;
  }

  /** Any other look, once its turn comes. One that several wait for is fitted once. */
  async ready(look, still = () => true) {
    if (look.packed) return look;
    look.waiting ??= [];
    look.waiting.push(still);
    const wanted = () => !look.packed && look.waiting.some((still) => still());
    look.fitting ??= this.pool.fit(this.request(look), wanted).finally(() => {
      look.fitting = undefined;
      look.waiting = undefined;
    });
    const packed = await look.fitting;
    look.packed ??= packed;
    return look;
  }
}
