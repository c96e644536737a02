// The page in Chromium: what the tests and the measurements share.
//
// Serves target/onelight/darkroom on a free port. CHROMIUM names another browser than Debian's; `--draw cpu`, `webgl2` or `webgpu` says
// what draws.

import { existsSync, mkdirSync, readdirSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

export const top = join(dirname(fileURLToPath(import.meta.url)), "../../..");
export const folder = join(top, "target/onelight/darkroom");
export const out = join(top, "target/onelight/darkroom-test");
const { chromium } = createRequire(join(top, "target/browser/"))("playwright-core");
export const options = process.argv.slice(2);
export const draw = options.includes("--draw") ? options[options.indexOf("--draw") + 1] : "";
mkdirSync(out, { recursive: true });

/** What each way of drawing needs of a browser without a graphics card. */
const FLAGS = {
  cpu: [],
  webgl2: ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  webgpu: ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan", "--use-vulkan=swiftshader", "--use-angle=vulkan", "--ignore-gpu-blocklist"],
};
const TYPES = { html: "text/html", css: "text/css", js: "text/javascript", json: "application/json", wasm: "application/wasm", svg: "image/svg+xml" };

export const requests = [];
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
export const browser = await chromium.launch({ executablePath, args, ignoreDefaultArgs: ["--headless"] });
export async function opened(context, hash = "") {
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
export const keep = (page, name, canvas = "film") =>
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
export const keepFile = (page, name, bytes) =>
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
export const difference = (page, a, b) =>
  page.evaluate(
    ([a, b]) => {
      [a, b] = [globalThis.kept[a], globalThis.kept[b]];
      if (a.length !== b.length) return `${a.length} bytes for ${b.length}`;
      return a.reduce((most, v, i) => Math.max(most, Math.abs(v - b[i])), 0);
    },
    [a, b],
  );

/** Waits until nothing is fitted and drawn any more. */
export async function settled(page) {
  await page.waitForFunction(async () => {
    const frames = document.getElementById("film").dataset.frames;
    await new Promise((resolve) => setTimeout(resolve, 150));
    return document.getElementById("film").dataset.frames === frames;
  });
}

/** Turns something, and waits for the frame that shows it. */
export async function turned(page, turn) {
  const before = await page.evaluate(() => document.getElementById("film").dataset.frames);
  await turn();
  await page.waitForFunction((before) => document.getElementById("film").dataset.frames !== before, before);
  await settled(page);
}

export const set = (page, id, value) =>
  page.evaluate(
    ([id, value]) => {
      const control = document.getElementById(id);
      control.value = value;
      control.dispatchEvent(new Event(control.matches("select") ? "change" : "input", { bubbles: true }));
    },
    [id, value],
  );

/** Drops a file on the page. */
export const drop = (page, bytes, name) =>
  page.evaluate(
    ([text, name]) => {
      const dataTransfer = new DataTransfer();
      dataTransfer.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], name));
      document.getElementById("stage").dispatchEvent(new DragEvent("drop", { bubbles: true, cancelable: true, dataTransfer }));
    },
    [bytes.toString("base64"), name],
  );
/** Memory in MB that the browser's processes hold, children of this one: what `ps` calls RSS, with shared pages counted in each. */
export function megabytes() {
  const processes = new Map();
  for (const pid of readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
    try {
      const stat = readFileSync(`/proc/${pid}/stat`, "utf8");
      const [, parent] = stat.slice(stat.lastIndexOf(")") + 2).split(" ");
      const rss = /^VmRSS:\s+(\d+)/m.exec(readFileSync(`/proc/${pid}/status`, "utf8"))?.[1] ?? 0;
      processes.set(pid, { parent, kb: Number(rss) });
    } catch {
      // It has ended.
    }
  }
  const isOurs = (pid) => pid === String(process.pid) || (processes.has(pid) && isOurs(processes.get(pid).parent));
  return Math.round([...processes].filter(([pid, { parent }]) => isOurs(parent)).reduce((sum, [, { kb }]) => sum + kb, 0) / 1000);
}

/** Ends browser and server. */
export async function end() {
  await browser.close();
  server.close();
}
