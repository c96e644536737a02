// The darkroom in a real browser: `cargo xtask darkroom`, then
//
//   npm install --prefix target/browser --no-save playwright-core@1.65.1 axe-core@4.14.1
//   node crates/web/tests/browser.mjs [--draw cpu] [--screenshots] [--only WORDS]
//
// Serves target/onelight/darkroom, turns every control, and holds the picture on the page against `develop`, by the runner in
// target/release or where XTASK says. CHROMIUM names another browser than Debian's, ONELIGHT_PYTHON a Python with OpenColorIO.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { promisify } from "node:util";
import { browser, difference, draw, drop, end, folder, keep, keepFile, megabytes, opened, options, out, requests, set, settled, top, turned } from "./chromium.mjs";

const faults = [];
let passed = 0;

/** `--only WORDS` runs the tests whose names hold these words. */
const only = options.includes("--only") ? options[options.indexOf("--only") + 1] : "";

async function test(name, run) {
  if (!name.includes(only)) return;
  const began = Date.now();
  try {
    await run();
    passed++;
    console.log(`ok    ${name} (${Date.now() - began} ms)`);
  } catch (error) {
    faults.push(name);
    console.log(`FAILED ${name}\n${error.stack}`);
  }
}

/** A picture as `develop` writes it. */
async function developed(from, ...options) {
  const to = join(out, "developed.png");
  const xtask = process.env.XTASK ?? join(top, "target/release/xtask");
  await promisify(execFile)(xtask, ["develop", from, to, "--dither", "none", ...options], { cwd: top });
  return readFileSync(to);
}

/** The scene to begin with as `develop` writes it. */
const develop = (...look) => developed(join(folder, "scene.exr"), ...look);

const context = await browser.newContext({ viewport: { width: 1360, height: 900 }, acceptDownloads: true });
const page = await opened(context);
const afterLoad = requests.length;
await page.waitForSelector("html[data-whole-strip]");
const times = await page.evaluate(() => ({ ...document.documentElement.dataset, ms: document.getElementById("film").dataset.ms, by: document.getElementById("drawn-by").textContent }));
console.log(`${times.by}; first film after ${times.firstFilm} ms, the whole strip after ${times.wholeStrip} ms, a frame ${times.ms} ms`);

const LOOKS = [
  ["kodak-5207", "kodak-2383", 0],
  ["kodak-5219", "kodak-2383", 1.5],
  ["fuji-velvia-50", "none", -1],
  ["kodak-portra-400", "kodak-2383", 0],
  ["kodak-tri-x-400", "kodak-2302", 0.5],
];
await test("the page shows what develop writes, for five looks", async () => {
  if (draw) assert.match(times.by, { cpu: /processor/, webgl2: /WebGL2/, webgpu: /WebGPU/ }[draw]);
  for (const [camera, print, ev] of LOOKS) {
    await page.evaluate(([camera, print, ev]) => (location.hash = encodeURIComponent(`version = 2\ncamera = "${camera}"\nprint = "${print}"\nev = ${ev}`)), [camera, print, ev]);
    await page.waitForTimeout(100);
    await settled(page);
    await keep(page, "shown");
    await keepFile(page, "expected", await develop("--camera", camera, "--print", print, "--ev", String(ev)));
    const most = await difference(page, "shown", "expected");
    console.log(`      ${camera} on ${print}, ${ev} stops: at most ${most} codes`);
    assert.ok(most <= 1, `${camera}: ${most} codes`);
  }
});

await test("every control changes the picture, and undo takes it back", async () => {
  await page.click("#reset");
  await settled(page);
  await keep(page, "usual");
  const changed = async () => {
    await keep(page, "now");
    return difference(page, "now", "usual");
  };
  await page.evaluate(() => (document.getElementById("more").open = true));
  const controls = { ev: "1", scene_white: "4000", "points-0": "6", "points-1": "-5", "points-2": "4", neutral_density: "0.9", overexposure: "2", aim: "sheet", white: "lamp", interimage: "none", projector: "theatre", dyes: "literal" };
  for (const [id, value] of Object.entries(controls)) {
    await turned(page, () => set(page, id, value));
    assert.ok((await changed()) > 2, `${id} changes nothing`);
    await turned(page, () => page.click("#undo"));
    assert.equal(await changed(), 0, `${id} is not undone`);
  }
  await turned(page, () => page.click("#redo"));
  await turned(page, () => page.click("#reset"));
  assert.equal(await changed(), 0, "reset");
});

await test("a film is chosen from the strip, and its prints follow", async () => {
  await turned(page, () => page.click("#cameras button:has-text('Velvia')"));
  assert.match(page.url(), /fuji-velvia-50/);
  assert.equal(await page.locator("#points-0").isDisabled(), true);
  await turned(page, () => page.click("#cameras button:has-text('Portra 400')"));
  assert.ok((await page.locator("#prints button").count()) > 5);
  await turned(page, () => page.click("#prints button:has-text('2393')"));
  assert.match(decodeURIComponent(page.url()), /print = "kodak-2393"/);
  await turned(page, () => page.click("#prints button:has-text('A scan')"));
  assert.match(decodeURIComponent(page.url()), /print = "scan"/);
  assert.equal(await page.locator("#points-0").isDisabled(), true);
  await keep(page, "shown");
  await keepFile(page, "expected", await develop("--camera", "kodak-portra-400", "--print", "scan"));
  assert.ok((await difference(page, "shown", "expected")) <= 1, "a scan");
  await turned(page, () => page.click("#reset"));
});

await test("a click says where a colour comes from", async () => {
  const box = await page.locator("#film").boundingBox();
  await page.mouse.click(box.x + box.width * 0.4, box.y + box.height * 0.6);
  await page.waitForSelector("#way-list figure:nth-child(4)");
  const text = await page.locator("#way-list").innerText();
  assert.match(text, /cyan, magenta and yellow/);
  assert.equal(await page.locator("#way-list svg").count(), 4);
  assert.equal(await page.locator("#histogram svg").count(), 1);
});

await test("the comparison shows the picture without film and another film", async () => {
  for (const beside of ["none", "fuji-velvia-50"]) {
    await set(page, "beside", beside);
    await page.waitForFunction(() => !document.getElementById("other").hidden && document.getElementById("other").width > 1);
    await settled(page);
  }
  await keep(page, "beside", "other");
  await keepFile(page, "expected", await develop("--camera", "fuji-velvia-50"));
  assert.ok((await difference(page, "beside", "expected")) <= 1);
  await page.locator("#split").press("ArrowLeft");
  assert.equal(await page.locator("#split").getAttribute("aria-valuenow"), "48");
  await set(page, "beside", "");
});

const message = (page) => page.locator("#message").innerText();

await test("bad files give one sentence and change nothing", async () => {
  await keep(page, "before");
  const scene = readFileSync(join(folder, "scene.exr"));
  for (const [name, bytes] of [
    ["notes.txt", Buffer.from("no picture")],
    ["empty.png", Buffer.alloc(0)],
    ["cut.exr", scene.subarray(0, scene.length / 2)],
  ]) {
    await drop(page, bytes, name);
    await page.waitForFunction((name) => document.querySelector("#message.error")?.textContent.startsWith(name), name);
    assert.ok((await message(page)).length < 300);
    await keep(page, "after");
    assert.equal(await difference(page, "before", "after"), 0);
  }
});

await test("pictures are dropped, chosen and zoomed", async () => {
  const png = await page.evaluate(async () => {
    const canvas = new OffscreenCanvas(2200, 1500);
    const context = canvas.getContext("2d");
    const colours = context.createLinearGradient(0, 0, 2200, 1500);
    ["#102040", "#d08040", "#f0f0e0"].forEach((colour, i) => colours.addColorStop(i / 2, colour));
    context.fillStyle = colours;
    context.fillRect(0, 0, 2200, 1500);
    const bytes = new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
    let text = "";
    for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
    return btoa(text);
  });
  await drop(page, Buffer.from(png, "base64"), "ramp.png");
  await page.waitForFunction(() => document.getElementById("size").textContent.startsWith("ramp.png, 2200 x 1500"));
  await settled(page);
  assert.equal((await keep(page, "whole")).width, 1100);
  await turned(page, () => set(page, "zoom", "1"));
  const near = await keep(page, "near");
  assert.ok(near.width < 1400 && near.height < 1000, `${near.width} x ${near.height}`);
  await page.setInputFiles("#file", join(folder, "scene.exr"));
  await page.waitForFunction(() => document.getElementById("size").textContent.startsWith("scene.exr"));
  await page.waitForFunction(() => document.getElementById("message").textContent.includes("on film"));
  await settled(page);
});

const saved = async (page, act) => {
  const [download] = await Promise.all([page.waitForEvent("download"), act()]);
  const path = join(out, download.suggestedFilename());
  await download.saveAs(path);
  return path;
};

await test("what is taken away is what develop writes", async () => {
  await page.click("#reset");
  await settled(page);
  const path = await saved(page, () => page.click("#save-picture"));
  assert.match(path, /scene\.kodak-5207\.png$/);
  await keepFile(page, "saved", readFileSync(path));
  await keepFile(page, "expected", await develop());
  assert.ok((await difference(page, "saved", "expected")) <= 1);
  for (const [kind, start] of [["png16", "89504e47"], ["tiff16", "4d4d002a"], ["jpeg", "ffd8ff"], ["exr", "762f3101"]]) {
    await set(page, "kind", kind);
    const path = await saved(page, () => page.click("#save-picture"));
    assert.equal(readFileSync(path).subarray(0, start.length / 2).toString("hex"), start);
    // Our own readers take it for what it is: codes, or light that is coded again.
    await keepFile(page, "read", await developed(path, "--approach", "clip"));
    const most = await difference(page, "read", "expected");
    // A JPEG loses what it loses; the others hold every code.
    assert.ok(kind === "jpeg" ? typeof most === "number" : most <= 1, `${kind}: ${most} codes`);
  }
  const toml = readFileSync(await saved(page, () => page.click("#save-toml")), "utf8");
  assert.match(toml, /camera = "kodak-5207"/);
  writeFileSync(join(out, "look.toml"), toml);
  await keepFile(page, "by-look", await develop("--look", join(out, "look.toml")));
  assert.equal(await difference(page, "by-look", "expected"), 0);
});

/** Waits for the effects of the newest frame. */
const effects = (page) => page.waitForFunction(() => document.documentElement.dataset.effects === document.getElementById("film").dataset.frames);

await test("a film format brings grain as develop has it, and says why", async () => {
  await page.evaluate(() => (document.getElementById("on-film").open = true));
  assert.equal(await page.locator("#grain").isDisabled(), true);
  const chosen = { film_format: "super8", grain: "on", sharpness: "on", halation: "on", antihalation: "0.5", seed: "3" };
  for (const [id, value] of Object.entries(chosen)) await set(page, id, value);
  await settled(page);
  await effects(page);
  assert.equal(await page.locator("#grained").isHidden(), false);
  await keep(page, "film");
  await keep(page, "grained", "grained");
  assert.ok((await difference(page, "film", "grained")) > 5);
  const options = Object.entries(chosen).flatMap(([key, value]) => [`--${key.replace("_", "-")}`, value]);
  await keepFile(page, "expected", await develop(...options));
  assert.ok((await difference(page, "grained", "expected")) <= 1);
  const reasons = await page.locator("#effects").innerText();
  for (const effect of ["Grain: ", "Sharpness: ", "Halation: "]) assert.ok(reasons.includes(effect), reasons);
  await set(page, "kind", "png8");
  const path = await saved(page, () => page.click("#save-picture"));
  await keepFile(page, "saved", readFileSync(path));
  assert.ok((await difference(page, "saved", "expected")) <= 1);
  await turned(page, () => page.click("#reset"));
  assert.equal(await page.locator("#grained").isHidden(), true);
});

await test("films with development times offer them", async () => {
  assert.equal(await page.locator("#camera-variant").isHidden(), true);
  await turned(page, () => page.click("#cameras button:has-text('5222')"));
  await keep(page, "usual-time");
  const times = await page.locator("#camera-variant option").evaluateAll((options) => options.map(({ value }) => value));
  assert.ok(times.length > 2, String(times));
  await turned(page, () => set(page, "camera-variant", times.at(-1)));
  await keep(page, "long");
  assert.ok((await difference(page, "usual-time", "long")) > 2);
  await turned(page, () => page.click("#reset"));
});

await test("a picture with alpha is laid over what is chosen", async () => {
  assert.equal(await page.locator("#behind").isHidden(), true);
  const png = await page.evaluate(async () => {
    const canvas = new OffscreenCanvas(40, 30);
    const context = canvas.getContext("2d");
    context.fillStyle = "rgb(200 120 80 / 0.5)";
    context.fillRect(0, 0, 40, 30);
    return btoa(String.fromCharCode(...new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer())));
  });
  await drop(page, Buffer.from(png, "base64"), "half.png");
  await page.waitForFunction(() => document.getElementById("message").textContent === "half.png is on film.");
  await settled(page);
  await keep(page, "straight");
  await turned(page, () => set(page, "behind", "black"));
  await page.waitForFunction(() => document.getElementById("message").textContent === "half.png is on film.");
  await keep(page, "over");
  assert.ok((await difference(page, "straight", "over")) > 20);
});

await test("a picture is pasted", async () => {
  const bytes = readFileSync(join(folder, "scene.exr")).toString("base64");
  await page.evaluate((text) => {
    const clipboardData = new DataTransfer();
    clipboardData.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], "pasted.exr"));
    dispatchEvent(new ClipboardEvent("paste", { clipboardData }));
  }, bytes);
  await page.waitForFunction(() => document.getElementById("message").textContent === "pasted.exr is on film.");
  await settled(page);
});

await test("a thread that traps says one sentence and begins anew", async () => {
  await Promise.all(
    page.workers().map((worker) =>
      worker.evaluate(() => {
        const { parse } = JSON;
        JSON.parse = () => {
          JSON.parse = parse;
          throw new WebAssembly.RuntimeError("unreachable");
        };
      }),
    ),
  );
  const box = await page.locator("#film").boundingBox();
  const pick = () => page.mouse.click(box.x + box.width * 0.3, box.y + box.height * 0.5);
  await pick();
  await page.waitForFunction(() => document.querySelector("#message.error")?.textContent.includes("everything else stays as it was"));
  for (let again = 0; again < page.workers().length; again++) {
    await pick();
    await page.waitForTimeout(200);
  }
  await page.waitForSelector("#way-list figure:nth-child(4)");
  await keep(page, "before-turn");
  await turned(page, () => set(page, "points-1", "5"));
  await keep(page, "after-turn");
  assert.ok((await difference(page, "before-turn", "after-turn")) > 2);
  await turned(page, () => page.click("#reset"));
});

await test("sixty looks in a row take no more memory", async () => {
  const looks = async (count, from) => {
    for (let i = 0; i < count; i++) await turned(page, () => set(page, "neutral_density", String(from + 0.05 * (i % 10))));
  };
  const kinds = ["kodak-5207", "fuji-velvia-50", "kodak-tri-x-400"];
  for (const kind of kinds) {
    await page.evaluate((kind) => (location.hash = encodeURIComponent(`version = 2\ncamera = "${kind}"\nprint = "${kind.startsWith("fuji") ? "none" : kind.includes("tri") ? "kodak-2302" : "kodak-2383"}"`)), kind);
    await page.waitForTimeout(100);
    await looks(4, 0.35);
  }
  const before = megabytes();
  // Drivers that compute on the processor take a second for a frame.
  await looks(draw === "cpu" ? 60 : 20, 0.55);
  const after = megabytes();
  console.log(`      ${before} MB before, ${after} MB after`);
  // What a garbage collector has not yet taken back; a frame is 1 MB, a thread's memory 30.
  assert.ok(after - before < 60, `${before} MB, ${after} MB`);
  await turned(page, () => page.click("#reset"));
});

await test("nothing was asked of the server after the page was there", async () => {
  assert.deepEqual(requests.slice(afterLoad), []);
});

await test("a look is baked, certified and cancelled", async () => {
  await set(page, "program", "ffmpeg");
  await page.click("#save-look");
  await page.waitForSelector("#saved a >> text=certificate.txt", { timeout: 180_000 });
  const path = await saved(page, () => page.click("#saved a >> text=look.srgb.cube"));
  const cube = readFileSync(path, "utf8");
  assert.match(cube, /LUT_3D_SIZE 65/);
  assert.equal(cube.trim().split("\n").filter((line) => /^-?[\d.]+ /.test(line)).length, 65 ** 3);
  const python = process.env.ONELIGHT_PYTHON;
  if (python) {
    const script = "import sys, PyOpenColorIO as o; t = o.FileTransform(sys.argv[1], interpolation=o.INTERP_TETRAHEDRAL); c = o.Config.CreateRaw(); print(*c.getProcessor(t).getDefaultCPUProcessor().applyRGB([0.461, 0.461, 0.461]))";
    const { stdout } = await promisify(execFile)(python, ["-c", script, path]);
    const grey = stdout.trim().split(" ").map(Number);
    assert.ok(grey.every((v) => Math.abs(v - 0.4845) < 0.01), `OpenColorIO: ${grey}`);
  }
  await page.click("#save-look");
  await page.click("#cancel");
  await page.waitForFunction(() => document.getElementById("message").textContent === "Cancelled.");
  await page.waitForSelector("#work", { state: "hidden" });
});

await test("a link holds the look", async () => {
  await turned(page, () => set(page, "points-0", "3"));
  const other = await opened(context, new URL(page.url()).hash);
  await settled(other);
  const codes = async (page) => {
    await keep(page, "film");
    const text = await page.evaluate(() => {
      let text = "";
      for (let i = 0; i < globalThis.kept.film.length; i += 8192) text += String.fromCharCode(...globalThis.kept.film.subarray(i, i + 8192));
      return btoa(text);
    });
    return Buffer.from(text, "base64");
  };
  const [here, there] = [await codes(page), await codes(other)];
  assert.equal(here.length, there.length);
  assert.ok(here.equals(there));
  assert.deepEqual(other.problems, []);
  await other.close();
});

await test("no problem was reported", async () => {
  assert.deepEqual(page.problems, []);
});

await test("axe finds nothing, light and dark, on a desktop and on a phone", async () => {
  const axe = readFileSync(join(top, "target/browser/node_modules/axe-core/axe.min.js"), "utf8");
  for (const [name, viewport, colorScheme] of [["desktop", { width: 1360, height: 900 }, "light"], ["phone", { width: 390, height: 844 }, "dark"]]) {
    const context = await browser.newContext({ viewport, colorScheme, bypassCSP: true, hasTouch: name === "phone", deviceScaleFactor: name === "phone" ? 2 : 1 });
    const page = await opened(context);
    await page.waitForSelector("html[data-whole-strip]");
    await page.evaluate(() => document.getElementById("stage").focus());
    await page.keyboard.press("Enter");
    await page.waitForSelector("#way-list figure:nth-child(4)");
    await settled(page);
    await page.evaluate(axe);
    if (name === "phone") {
      const touch = await context.newCDPSession(page);
      const { x, y, width, height } = await page.locator("#stage").boundingBox();
      const fingers = (apart) => [-apart, apart].map((dx, id) => ({ x: x + width / 2 + dx, y: y + height / 2, id }));
      await touch.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: fingers(30) });
      await touch.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: fingers(60) });
      await touch.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
      await page.waitForFunction(() => document.getElementById("zoom").value === "1");
      await turned(page, () => set(page, "zoom", "0"));
    }
    const { violations } = await page.evaluate(() => globalThis.axe.run());
    const found = violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target).join(", ")}`);
    if (options.includes("--screenshots")) await page.screenshot({ path: join(out, `${name}.png`), fullPage: true });
    if (options.includes("--screenshots") && name === "desktop") await page.screenshot({ path: join(out, "first.png") });
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
    assert.ok(wide <= 0, `${name}: ${wide} pixels too wide`);
    assert.deepEqual(found, [], name);
    await context.close();
  }
});

await end();
console.log(`${passed} passed, ${faults.length} failed`);
process.exitCode = faults.length ? 1 : 0;
