// What the darkroom takes, in time and memory: the figures of docs/darkroom.md. Nothing is asserted.
//
//   node crates/web/tests/measure.mjs [--draw cpu]
//
// It needs what browser.mjs needs.

import { browser, draw, end, megabytes, opened, set } from "./chromium.mjs";

const context = await browser.newContext({ viewport: { width: 1360, height: 900 }, acceptDownloads: true });
const page = await opened(context);
await page.waitForSelector("html[data-whole-strip]");
const seen = () => page.evaluate(() => ({ ...document.documentElement.dataset, by: document.getElementById("drawn-by").textContent }));
const start = await seen();
console.log(`${start.by}${draw ? ` (asked for ${draw})` : ""}, ${await page.evaluate(() => navigator.hardwareConcurrency)} cores`);
console.log(`the scene to begin with: first film ${start.firstFilm} ms, strip ${start.wholeStrip} ms after, ${megabytes()} MB`);

/** Milliseconds from each of several turns of a control to the frame that shows it: the least and the middle. */
async function turns(id, values) {
  const times = [];
  for (const value of values) {
    const time = await page.evaluate(
      ([id, value]) =>
        new Promise((resolve) => {
          const film = document.getElementById("film");
          const began = performance.now();
          const watch = new MutationObserver(() => {
            watch.disconnect();
            resolve(performance.now() - began);
          });
          watch.observe(film, { attributes: true, attributeFilter: ["data-frames"] });
          const control = document.getElementById(id);
          control.value = value;
          control.dispatchEvent(new Event(control.matches("select") ? "change" : "input", { bubbles: true }));
        }),
      [id, value],
    );
    times.push(time);
    await page.waitForTimeout(700);
  }
  times.sort((a, b) => a - b);
  return `${times[0].toFixed(0)} ms at least, ${times[times.length >> 1].toFixed(0)} in the middle`;
}

const steps = (from, by) => Array.from({ length: 7 }, (_, i) => String(+(from + i * by).toFixed(2)));
for (const [id, values] of [["ev", steps(0.1, 0.1)], ["scene_white", steps(5000, 100)], ["points-0", steps(1, 1)], ["neutral_density", steps(0.75, 0.05)], ["aim", ["sheet", "neutral", "sheet", "neutral"]], ["white", ["lamp", "film", "lamp", "film"]], ["projector", ["theatre", "display"]]]) {
  console.log(`  ${id}: ${await turns(id, values)}`);
  await page.click("#reset");
  await page.waitForTimeout(1500);
}

for (const [width, height] of [[1920, 1080], [6000, 4000], [8660, 5774]]) {
  const before = megabytes();
  let most = before;
  const watch = setInterval(() => (most = Math.max(most, megabytes())), 100);
  const name = `${width}.jpg`;
  await page.evaluate(
    async ([width, height, name]) => {
      const canvas = new OffscreenCanvas(width, height);
      const context = canvas.getContext("2d");
      const colours = context.createLinearGradient(0, 0, width, height);
      ["#102040", "#d08040", "#f0f0e0"].forEach((colour, i) => colours.addColorStop(i / 2, colour));
      context.fillStyle = colours;
      context.fillRect(0, 0, width, height);
      for (let i = 0; i < 4000; i++) {
        context.fillStyle = `hsl(${(i * 137) % 360} 60% ${(i * 29) % 100}%)`;
        context.fillRect(((i * 7919) % 1000) * width / 1000, ((i * 104729) % 1000) * height / 1000, width / 40, height / 60);
      }
      const file = new File([await canvas.convertToBlob({ type: "image/jpeg", quality: 0.92 })], name);
      canvas.width = 1;
      const dataTransfer = new DataTransfer();
      dataTransfer.items.add(file);
      delete document.documentElement.dataset.wholeStrip;
      document.getElementById("stage").dispatchEvent(new DragEvent("drop", { bubbles: true, cancelable: true, dataTransfer }));
    },
    [width, height, name],
  );
  await page.waitForSelector("html[data-whole-strip]", { timeout: 300_000 });
  const { firstFilm, wholeStrip } = await seen();
  await page.waitForTimeout(1000);
  console.log(`${((width * height) / 1e6).toFixed(0)} megapixels: first film ${firstFilm} ms after the drop, strip ${wholeStrip} ms, ${most} MB at most, ${megabytes()} MB after`);
  await set(page, "kind", "png8");
  const began = Date.now();
  const [download] = await Promise.all([page.waitForEvent("download", { timeout: 300_000 }), page.click("#save-picture")]);
  await download.path();
  console.log(`  developed and saved as PNG in ${Date.now() - began} ms, ${most} MB at most`);
  clearInterval(watch);
}
await end();
