// Looks by their keys, each with the direct form that develops pictures.

import { fittingKeys } from "./onelight_web.js";

/** Most looks that are kept: each is about 40 KB of text. */
const MOST = 400;

export class Looks {
  /** `shipped`: direct forms of the usual looks, by the id of their camera film. */
  constructor(pool, shipped) {
    this.pool = pool;
    this.all = new Map();
    /** Looks by keys that were not yet made to fit, which takes a millisecond. */
    this.asked = new Map();
    for (const [camera, direct] of Object.entries(shipped)) Object.assign(this.of({ camera }), { direct, shipped: true });
  }

  /** The look of some keys, made to fit. */
  of(keys) {
    const text = JSON.stringify(keys);
    const known = this.asked.get(text);
    if (known) return known;
    const key = fittingKeys(text);
    let look = this.all.get(key);
    if (!look) {
      look = { key, keys: key };
      this.all.set(key, look);
      if (this.all.size > MOST) {
        const old = [...this.all.values()].find((other) => other !== look && !other.shipped && !other.fitting && other.direct);
        if (old) this.all.delete(old.key);
      }
    }
    if (this.asked.size >= 4 * MOST) this.asked.clear();
    this.asked.set(text, look);
    return look;
  }

  /** The same, once it can develop. A look that several wait for is fitted once. */
  async ready(look, urgent = false, still = () => true) {
    if (look.direct) return look;
    look.fitting ??= this.pool.fit(look).finally(() => (look.fitting = undefined));
    this.pool.want(look, urgent, still);
    look.direct = await look.fitting;
    return look;
  }
}
