// Half floats, in which the page holds light.

/** The value of each half float, by its 16 bits. */
export const values = new Float32Array(65536);
for (let bits = 0; bits < 65536; bits++) {
  const exponent = (bits >> 10) & 31;
  const mantissa = bits & 1023;
  const size = exponent === 0 ? mantissa * 2 ** -24 : exponent === 31 ? 65504 : (1 + mantissa / 1024) * 2 ** (exponent - 15);
  values[bits] = bits & 0x8000 ? -size : size;
}

/** Display codes of light as it is, without film: sRGB, cut at white. `ev` is the exposure in stops. */
export function withoutFilm(light, ev, codes) {
  const table = new Uint8Array(65536);
  const gain = 2 ** ev;
  for (let bits = 0; bits < 65536; bits++) {
    const v = Math.min(Math.max(values[bits] * gain, 0), 1);
    table[bits] = Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));
  }
  for (let i = 0; i < light.length; i += 4) {
    codes[i] = table[light[i]];
    codes[i + 1] = table[light[i + 1]];
    codes[i + 2] = table[light[i + 2]];
    codes[i + 3] = 255;
  }
}
