// The darkroom in a real browser: `cargo xtask darkroom`, then
//
//   npm install --prefix target/browser --no-save playwright-core@1.65.1 axe-core@4.14.1
//   node crates/web/tests/browser.mjs [--draw cpu] [--screenshots]
//
// Serves target/onelight/darkroom, turns every control, and holds the picture on the page against `develop`, by the runner in
// target/release or where XTASK says. CHROMIUM names another browser than Debian's, ONELIGHT_PYTHON a Python with OpenColorIO.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";

const top = join(dirname(fileURLToPath(import.meta.url)), "../../..");
const folder = join(top, "target/onelight/darkroom");
const out = join(top, "target/onelight/darkroom-test");
const { chromium } = createRequire(join(top, "target/browser/"))("playwright-core");
const options = process.argv.slice(2);
const draw = options.includes("--draw") ? options[options.indexOf("--draw") + 1] : "";
mkdirSync(out, { recursive: true });

/** What each way of drawing needs of a browser without a graphics card. */
const FLAGS = {
  cpu: [],
  webgl2: ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  webgpu: ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan", "--use-vulkan=swiftshader", "--use-angle=vulkan", "--ignore-gpu-blocklist"],
};
const TYPES = { html: "text/html", css: "text/css", js: "text/javascript", json: "application/json", wasm: "application/wasm", svg: "image/svg+xml" };

const requests = [];
const server = createServer((request, answer) => {
  requests.push(request.url);
  const name = new URL(request.url, "http://a").pathname.slice(1) || "index.html";
  const file = join(folder, name);
  if (!/^[\w.-]+$/.test(name) || !existsSync(file)) return answer.writeHead(404).end();
  answer.writeHead(200, { "Content-Type": TYPES[name.split(".").pop()] ?? "application/octet-stream" }).end(readFileSync(file));
});
await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
const address = `http://127.0.0.1:${server.address().port}/${draw ? `?draw=${draw}` : ""}`;

const executablePath = process.env.CHROMIUM ?? "/usr/bin/chromium";
const args = ["--headless=new", "--no-sandbox", "--disable-background-networking", ...(FLAGS[draw || "cpu"] ?? [])];
const browser = await chromium.launch({ executablePath, args, ignoreDefaultArgs: ["--headless"] });
const faults = [];
let passed = 0;

async function test(name, run) {
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

async function opened(context, hash = "") {
  const page = await context.newPage();
  page.problems = [];
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && page.problems.push(message.text()));
  page.on("pageerror", (error) => page.problems.push(String(error)));
  page.setDefaultTimeout(60_000);
  await page.goto(address + hash);
  await page.waitForSelector("html[data-ready]", { timeout: 120_000 });
  return page;
}

/** Keeps the codes of a canvas of the page under a name, within the page; its width and height. */
const keep = (page, name, canvas = "film") =>
  page.evaluate(
    async ([name, canvas]) => {
      const { width, height, readBack } = document.getElementById(canvas);
      globalThis.kept ??= {};
      if (readBack) {
        globalThis.kept[name] = await readBack();
        return { width, height };
      }
      const copy = new OffscreenCanvas(width, height).getContext("2d");
      copy.drawImage(document.getElementById(canvas), 0, 0);
      globalThis.kept[name] = copy.getImageData(0, 0, width, height).data;
      return { width, height };
    },
    [name, canvas],
  );

/** The same for a picture file that browsers read. */
const keepFile = (page, name, bytes) =>
  page.evaluate(
    async ([name, text]) => {
      const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
      const picture = await createImageBitmap(new Blob([bytes]), { colorSpaceConversion: "none" });
      const copy = new OffscreenCanvas(picture.width, picture.height).getContext("2d");
      copy.drawImage(picture, 0, 0);
      (globalThis.kept ??= {})[name] = copy.getImageData(0, 0, picture.width, picture.height).data;
    },
    [name, bytes.toString("base64")],
  );

/** The largest difference of codes between two that were kept. */
const difference = (page, a, b) =>
  page.evaluate(
    ([a, b]) => {
      [a, b] = [globalThis.kept[a], globalThis.kept[b]];
      if (a.length !== b.length) return `${a.length} bytes for ${b.length}`;
      return a.reduce((most, v, i) => Math.max(most, Math.abs(v - b[i])), 0);
    },
    [a, b],
  );

/** Waits until nothing is fitted and drawn any more. */
async function settled(page) {
  await page.waitForFunction(async () => {
    const frames = document.getElementById("film").dataset.frames;
    await new Promise((resolve) => setTimeout(resolve, 150));
    return document.getElementById("film").dataset.frames === frames;
  });
}

/** Turns something, and waits for the frame that shows it. */
async function turned(page, turn) {
  const before = await page.evaluate(() => document.getElementById("film").dataset.frames);
  await turn();
  await page.waitForFunction((before) => document.getElementById("film").dataset.frames !== before, before);
  await settled(page);
}

/** The scene as `develop` writes it. */
async function develop(...look) {
  const to = join(out, "developed.png");
  const xtask = process.env.XTASK ?? join(top, "target/release/xtask");
  await promisify(execFile)(xtask, ["develop", join(folder, "scene.exr"), to, "--dither", "none", ...look], { cwd: top });
  return readFileSync(to);
}

const set = (page, id, value) =>
  page.evaluate(
    ([id, value]) => {
      const control = document.getElementById(id);
      control.value = value;
      control.dispatchEvent(new Event(control.matches("select") ? "change" : "input", { bubbles: true }));
    },
    [id, value],
  );

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

/** Drops a file on the page. */
const drop = (page, bytes, name) =>
  page.evaluate(
    ([text, name]) => {
      const dataTransfer = new DataTransfer();
      dataTransfer.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], name));
      document.getElementById("stage").dispatchEvent(new DragEvent("drop", { bubbles: true, cancelable: true, dataTransfer }));
    },
    [bytes.toString("base64"), name],
  );
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
  }
  const toml = readFileSync(await saved(page, () => page.click("#save-toml")), "utf8");
  assert.match(toml, /camera = "kodak-5207"/);
  writeFileSync(join(out, "look.toml"), toml);
  await keepFile(page, "by-look", await develop("--look", join(out, "look.toml")));
  assert.equal(await difference(page, "by-look", "expected"), 0);
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
  const digest = (page) => page.evaluate(async () => Array.from(new Uint32Array(await crypto.subtle.digest("SHA-256", globalThis.kept.film))));
  await Promise.all([keep(page, "film"), keep(other, "film")]);
  assert.deepEqual(await digest(other), await digest(page));
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

await browser.close();
server.close();
console.log(`${passed} passed, ${faults.length} failed`);
process.exitCode = faults.length ? 1 : 0;
