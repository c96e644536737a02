// Drawing by WebGPU.

import { lookBytes } from "./onelight_web.js";

/** Bytes of a look's uniform buffer, and the size of its texture of points: as `look_bytes` gives them. */
const [UNIFORM, POINTS] = [6432, [2048, 9]];
/** Looks that are kept on the card: each takes 150 KB. */
const MOST_LOOKS = 40;

export class WebGpuRenderer {
  static name = "graphics card (WebGPU)";

  static async make(canvas) {
    if (!navigator.gpu) throw new Error("this browser has none");
    const adapter = await navigator.gpu.requestAdapter();
    if (!adapter) throw new Error("no graphics card is found");
    const device = await adapter.requestDevice();
    const answer = await fetch("film.wgsl");
    const code = await answer.text();
    device.pushErrorScope("validation");
    const made = new WebGpuRenderer(canvas, device, code);
    await made.pipeline;
    const error = await device.popErrorScope();
    if (error) throw new Error(error.message);
    made.pipeline = await made.pipeline;
    return made;
  }

  constructor(canvas, device, code) {
    Object.assign(this, { canvas, device });
    // Browsers do not let others copy such a canvas once it was shown.
    canvas.readBack = () => this.readBack();
    this.context = canvas.getContext("webgpu");
    if (!this.context) throw new Error("the canvas cannot be drawn to");
    // Eight bits in any case: what is shown is what develop writes.
    this.format = "rgba8unorm";
    this.context.configure({ device, format: this.format, alphaMode: "opaque" });
    this.looks = new Map();
    this.lost = device.lost;
    const visibility = GPUShaderStage.FRAGMENT;
    const buffer = (binding) => ({ binding, visibility, buffer: { type: "uniform" } });
    const texture = (binding) => ({ binding, visibility, texture: { sampleType: "unfilterable-float" } });
    this.layouts = [[buffer(0), texture(2)], [texture(0), buffer(1)]].map((entries) => device.createBindGroupLayout({ entries }));
    this.frame = device.createBuffer({ size: 16, usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST });
    const module = device.createShaderModule({ code });
    this.pipeline = device.createRenderPipelineAsync({
      layout: device.createPipelineLayout({ bindGroupLayouts: this.layouts }),
      vertex: { module, entryPoint: "draw_vertex" },
      fragment: { module, entryPoint: "draw_fragment", targets: [{ format: this.format }] },
    });
  }

  async show(light, width, height) {
    this.light?.destroy();
    const usage = GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST;
    this.light = this.device.createTexture({ size: [width, height], format: "rgba16float", usage });
    this.device.queue.writeTexture({ texture: this.light }, light, { bytesPerRow: 8 * width }, [width, height]);
    const entries = [
      { binding: 0, resource: this.light.createView() },
      { binding: 1, resource: { buffer: this.frame } },
    ];
    this.picture = this.device.createBindGroup({ layout: this.layouts[1], entries });
    this.size = [width, height];
  }

  /** The look on the card. */
  look({ key, packed }) {
    let made = this.looks.get(key);
    if (made) return made.group;
    const bytes = lookBytes(packed);
    const { device } = this;
    const buffer = device.createBuffer({ size: UNIFORM, usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST });
    device.queue.writeBuffer(buffer, 0, bytes, 0, UNIFORM);
    const usage = GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST;
    const points = device.createTexture({ size: POINTS, format: "rg32float", usage });
    device.queue.writeTexture({ texture: points }, bytes.subarray(UNIFORM), { bytesPerRow: 8 * POINTS[0] }, POINTS);
    const entries = [
      { binding: 0, resource: { buffer } },
      { binding: 2, resource: points.createView() },
    ];
    made = { group: device.createBindGroup({ layout: this.layouts[0], entries }), buffer, points };
    if (this.looks.size >= MOST_LOOKS) {
      const [oldest, old] = this.looks.entries().next().value;
      this.looks.delete(oldest);
      old.buffer.destroy();
      old.points.destroy();
    }
    this.looks.set(key, made);
    return made.group;
  }

  async draw(look, ev) {
    const { device, size, canvas } = this;
    if (canvas.width !== size[0] || canvas.height !== size[1]) Object.assign(canvas, { width: size[0], height: size[1] });
    device.queue.writeBuffer(this.frame, 0, new Float32Array([2 ** ev, 0, 0, 0]));
    this.drawn = this.look(look);
    const encoder = device.createCommandEncoder();
    this.encode(encoder, this.context.getCurrentTexture());
    device.queue.submit([encoder.finish()]);
    await device.queue.onSubmittedWorkDone();
    return true;
  }

  encode(encoder, target) {
    const view = target.createView();
    const pass = encoder.beginRenderPass({ colorAttachments: [{ view, loadOp: "clear", storeOp: "store" }] });
    pass.setPipeline(this.pipeline);
    pass.setBindGroup(0, this.drawn);
    pass.setBindGroup(1, this.picture);
    pass.draw(3);
    pass.end();
  }

  /** The frame that was drawn last, as codes of red, green, blue and alpha. */
  async readBack() {
    const { device, size: [width, height], format } = this;
    const usage = GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC;
    const target = device.createTexture({ size: [width, height], format, usage });
    const bytesPerRow = Math.ceil(width / 64) * 256;
    const buffer = device.createBuffer({ size: bytesPerRow * height, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ });
    const encoder = device.createCommandEncoder();
    this.encode(encoder, target);
    encoder.copyTextureToBuffer({ texture: target }, { buffer, bytesPerRow }, [width, height]);
    device.queue.submit([encoder.finish()]);
    await buffer.mapAsync(GPUMapMode.READ);
    const rows = new Uint8Array(buffer.getMappedRange());
    const codes = new Uint8ClampedArray(width * height * 4);
    for (let y = 0; y < height; y++) codes.set(rows.subarray(y * bytesPerRow, y * bytesPerRow + width * 4), y * width * 4);
    buffer.destroy();
    target.destroy();
    return codes;
  }
}
