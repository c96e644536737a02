// Drawing by workers, where the browser has no graphics card to draw with.

/** Develops pixels in bands, one for each thread, and puts them on a canvas. */
export class CpuRenderer {
  static name = "processor";

  constructor(canvas, pool, name) {
    Object.assign(this, { canvas, pool, name });
    this.context = canvas.getContext("2d", { alpha: true });
    this.drawn = 0;
  }

  static async make(canvas, pool, name) {
    return new CpuRenderer(canvas, pool, name);
  }

  /** Other pixels: light in half floats. */
  async show(light, width, height) {
    const rows = Math.ceil(height / this.pool.threads.length);
    this.bands = [];
    this.size = [width, height];
    for (const [i, thread] of this.pool.threads.entries()) {
      const top = i * rows;
      const count = Math.min(rows, height - top);
      if (count <= 0) break;
      const band = light.slice(top * width * 4, (top + count) * width * 4);
      thread.ask("keep", { name: this.name, light: band }, [band.buffer]).catch(() => {});
      this.bands.push({ thread, top, count });
    }
  }

  /** Draws with a look; false where a newer frame came first. */
  async draw(look, ev) {
    const [turn, [width, height], bands] = [++this.drawn, this.size, this.bands];
    const parts = bands.map(({ thread }) => thread.develop(look, { name: this.name, ev }));
    const codes = await Promise.all(parts);
    if (turn !== this.drawn) return false;
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    for (const [i, { top, count }] of bands.entries()) {
      if (codes[i].length !== width * count * 4) continue;
      const pixels = new Uint8ClampedArray(codes[i].buffer, codes[i].byteOffset, codes[i].length);
      for (let a = 3; a < pixels.length; a += 4) pixels[a] = 255;
      this.context.putImageData(new ImageData(pixels, width, count), 0, top);
    }
    return true;
  }
}
