// Drawing by WebGL2.

import { lookBytes } from "./onelight_web.js";

/** Bytes of a look's uniform buffer, and the size of its texture of points: as `look_bytes` gives them. */
const [UNIFORM, POINTS] = [6432, [2048, 9]];

const VERTEX = `#version 300 es
void main() {
  gl_Position = vec4(vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)) * 4.0 - 1.0, 0.0, 1.0);
}`;

export class WebGl2Renderer {
  static name = "graphics card (WebGL2)";

  static async make(canvas) {
    const gl = canvas.getContext("webgl2", { alpha: false, antialias: false, depth: false, preserveDrawingBuffer: true });
    if (!gl) throw new Error("this browser has none");
    const answer = await fetch("film.glsl.json");
    return new WebGl2Renderer(canvas, gl, await answer.json());
  }

  constructor(canvas, gl, { fragment, uniforms, textures }) {
    Object.assign(this, { canvas, gl });
    this.lost = new Promise((resolve) => canvas.addEventListener("webglcontextlost", resolve));
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader) || "the film's shader does not compile");
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program) || "the film's shader does not link");
    gl.useProgram(program);
    const block = (name, size, place) => {
      gl.uniformBlockBinding(program, gl.getUniformBlockIndex(program, name), place);
      const buffer = gl.createBuffer();
      gl.bindBufferBase(gl.UNIFORM_BUFFER, place, buffer);
      gl.bufferData(gl.UNIFORM_BUFFER, size, gl.DYNAMIC_DRAW);
      return buffer;
    };
    this.look = block(uniforms.onelight_look, UNIFORM, 0);
    this.frame = block(uniforms.frame, 16, 1);
    const texture = (name, unit) => {
      gl.uniform1i(gl.getUniformLocation(program, name), unit);
      gl.activeTexture(gl.TEXTURE0 + unit);
      const made = gl.createTexture();
      gl.bindTexture(gl.TEXTURE_2D, made);
      for (const which of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, which, gl.NEAREST);
      for (const which of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, which, gl.CLAMP_TO_EDGE);
    };
    texture(textures.onelight_points, 0);
    texture(textures.light, 1);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  }

  async show(light, width, height) {
    const { gl } = this;
    gl.activeTexture(gl.TEXTURE1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA16F, width, height, 0, gl.RGBA, gl.HALF_FLOAT, light);
    this.size = [width, height];
  }

  async draw({ key, packed }, ev) {
    const { gl, canvas, size } = this;
    const [width, height] = size;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    gl.viewport(0, 0, width, height);
    if (this.shown !== key) {
      const bytes = lookBytes(packed);
      gl.bindBuffer(gl.UNIFORM_BUFFER, this.look);
      gl.bufferSubData(gl.UNIFORM_BUFFER, 0, bytes, 0, UNIFORM);
      gl.activeTexture(gl.TEXTURE0);
      const points = new Float32Array(bytes.slice(UNIFORM).buffer);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RG32F, ...POINTS, 0, gl.RG, gl.FLOAT, points);
      this.shown = key;
    }
    gl.bindBuffer(gl.UNIFORM_BUFFER, this.frame);
    gl.bufferSubData(gl.UNIFORM_BUFFER, 0, new Float32Array([2 ** ev, height, 0, 0]));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    // Waits for the card, so that frames do not pile up.
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    return true;
  }
}
