// The graphics card: programs, buffers, and the one context of a page.

const VERTEX_HEAD = `
precision highp float;
uniform mat4 toClip; uniform vec4 plain;
vec3 tint(vec3 own) { return plain.a > 0.0 ? plain.rgb : own; }
`;
// CLIP: a few vertices of a skeleton can be far away; what is outside of the box is cut off. Only where it is
// needed, because a shader that discards is slower.
const FRAGMENT_HEAD = `
precision highp float;
uniform vec3 low; uniform vec3 high; out vec4 color;
void keepInside(vec3 p) {
#ifdef CLIP
  if (any(lessThan(p, low)) || any(greaterThan(p, high))) discard;
#endif
}
`;
const SOURCES = {
  // Polygons and the shape. lit: 0 flat colour, 1 lit on both sides, 2 glass, denser where seen at a glancing angle.
  faces: [
    `${VERTEX_HEAD}
    layout(location = 0) in vec3 place; layout(location = 1) in vec3 own;
    out vec3 shade; out vec3 world;
    void main() { shade = tint(own); world = place; gl_Position = toClip * vec4(place, 1.0); }`,
    `${FRAGMENT_HEAD}
    uniform float lit; uniform float alpha; uniform vec3 toLight; uniform vec3 toEye; in vec3 shade; in vec3 world;
    void main() {
      keepInside(world);
      if (lit < 0.5) { color = vec4(shade, alpha); return; }
      vec3 n = normalize(cross(dFdx(world), dFdy(world)));
      float light = abs(dot(n, toLight));
      if (lit < 1.5) { color = vec4(shade * (0.55 + 0.5 * light), 1.0); return; }
      float rim = 1.0 - abs(dot(n, toEye));
      color = vec4(mix(shade, shade * (0.6 + 0.5 * light), alpha),
        mix(alpha * (0.3 + 1.5 * rim * rim * sqrt(rim)), 1.0, alpha * alpha * alpha * alpha));
    }`,
  ],
  // Segments as capsules of a fixed width on the screen.
  lines: [
    `${VERTEX_HEAD}
    layout(location = 0) in vec3 a; layout(location = 1) in vec3 va; layout(location = 2) in vec3 b; layout(location = 3) in vec3 vb;
    uniform vec2 size; uniform float width; uniform float nearer;
    out vec3 shade; out vec2 q; out float span; out vec3 world;
    void main() {
      vec2 corner = vec2(gl_VertexID & 1, (gl_VertexID >> 1) * 2 - 1);
      vec4 A = toClip * vec4(a, 1.0), B = toClip * vec4(b, 1.0);
      float near = 0.02;
      if (A.w < near && B.w < near) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
      if (A.w < near) A = mix(A, B, (near - A.w) / (B.w - A.w));
      if (B.w < near) B = mix(B, A, (near - B.w) / (A.w - B.w));
      vec2 pa = A.xy / A.w * size * 0.5, pb = B.xy / B.w * size * 0.5, d = pb - pa;
      span = length(d);
      vec2 along = span > 1e-4 ? d / span : vec2(1.0, 0.0), across = vec2(-along.y, along.x);
      float reach = width * 0.5 + 1.0;
      q = vec2(corner.x * span + (corner.x * 2.0 - 1.0) * reach, corner.y * reach);
      vec4 end = corner.x < 0.5 ? A : B;
      vec2 p = (pa + along * q.x + across * q.y) / (size * 0.5);
      gl_Position = vec4(p * end.w, end.z - nearer * end.w, end.w);
      shade = tint(corner.x < 0.5 ? va : vb); world = corner.x < 0.5 ? a : b;
    }`,
    `${FRAGMENT_HEAD}
    uniform float width; uniform float tube; uniform float alpha; uniform float hard; in vec3 shade; in vec2 q; in float span; in vec3 world;
    void main() {
      keepInside(world);
      float d = length(vec2(max(max(-q.x, q.x - span), 0.0), q.y));
      float cover = clamp(width * 0.5 - d + 0.5, 0.0, 1.0);
      if (cover < (hard > 0.5 ? 0.5 : 0.02)) discard;
      float h = clamp(2.0 * abs(q.y) / max(width, 1.0), 0.0, 1.0); // shaded across only: no beads at the joints
      color = vec4(shade * mix(1.0, 1.06 - 0.5 * h * h, tube), cover * alpha);
    }`,
  ],
  dots: [
    `${VERTEX_HEAD}
    layout(location = 0) in vec3 place; layout(location = 1) in vec3 own; uniform float width; uniform float nearer;
    out vec3 shade; out vec3 world;
    void main() { gl_Position = toClip * vec4(place, 1.0); gl_Position.z -= nearer * gl_Position.w;
      gl_PointSize = width + 1.0; shade = tint(own); world = place; }`,
    `${FRAGMENT_HEAD}
    uniform float width; uniform float alpha; uniform float hard; in vec3 shade; in vec3 world;
    void main() { keepInside(world);
      float d = length(gl_PointCoord - 0.5) * (width + 1.0), cover = clamp(width * 0.5 - d + 0.5, 0.0, 1.0);
      if (cover < (hard > 0.5 ? 0.5 : 0.05)) discard; color = vec4(shade, cover * alpha); }`,
  ],
};

/** One WebGL context serves all viewers of a page: browsers allow only about sixteen. */
class Renderer {
  constructor() {
    this.canvas = document.createElement("canvas");
    this.gl = this.canvas.getContext("webgl2", { antialias: false });
    if (!this.gl) throw new Error("no WebGL2");
    this.users = new Set();
    const info = this.gl.getExtension("WEBGL_debug_renderer_info");
    this.fast = !/swiftshader|llvmpipe|software/i.test(info ? this.gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : "");
    this.canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    this.canvas.addEventListener("webglcontextrestored", () => { this.start(); this.users.forEach((u) => u.restart()); });
    this.start();
  }

  start() {
    const gl = this.gl;
    this.programs = {};
    for (const key of Object.keys(SOURCES).flatMap((name) => [name, `${name} CLIP`])) {
      const program = gl.createProgram(), [name, clip] = key.split(" ");
      SOURCES[name].forEach((source, k) => {
        const shader = gl.createShader(k ? gl.FRAGMENT_SHADER : gl.VERTEX_SHADER);
        gl.shaderSource(shader, `#version 300 es\n${clip ? "#define CLIP\n" : ""}${source}`);
        gl.compileShader(shader);
        gl.attachShader(program, shader);
      });
      gl.linkProgram(program);
      if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
        throw new Error(gl.getAttachedShaders(program).map((s) => gl.getShaderInfoLog(s)).join(" "));
      }
      const uniforms = {};
      for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
        const info = gl.getActiveUniform(program, i);
        uniforms[info.name] = [gl.getUniformLocation(program, info.name), info.type];
      }
      this.programs[key] = { program, uniforms };
    }
    this.blank = gl.createVertexArray();
    this.smooth = null;
  }

  /** Draw with four samples a pixel, into a buffer of their own, or straight into the canvas. */
  begin(fine, width, height) {
    const gl = this.gl;
    if (fine && (!this.smooth || this.smooth.width < width || this.smooth.height < height)) {
      const old = this.smooth;
      this.smooth = { width: Math.max(width, old?.width ?? 0), height: Math.max(height, old?.height ?? 0) };
      if (old) { gl.deleteFramebuffer(old.frame); gl.deleteRenderbuffer(old.color); gl.deleteRenderbuffer(old.depth); }
      this.smooth.frame = gl.createFramebuffer();
      gl.bindFramebuffer(gl.FRAMEBUFFER, this.smooth.frame);
      const part = (name, format, place) => {
        this.smooth[name] = gl.createRenderbuffer();
        gl.bindRenderbuffer(gl.RENDERBUFFER, this.smooth[name]);
        gl.renderbufferStorageMultisample(gl.RENDERBUFFER, 4, format, this.smooth.width, this.smooth.height);
        gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, this.smooth[name]);
      };
      part("color", gl.RGBA8, gl.COLOR_ATTACHMENT0);
      part("depth", gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT);
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, fine ? this.smooth.frame : null);
  }

  end(fine, width, height) {
    const gl = this.gl;
    if (!fine) return;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.smooth.frame);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  /** Call back with the milliseconds until what was drawn so far is done, without waiting for it. */
  timed(done) {
    const gl = this.gl, start = performance.now(), sync = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (!sync) return;
    gl.flush();
    const look = () => {
      if (gl.isContextLost()) return;
      if (gl.clientWaitSync(sync, 0, 0) === gl.TIMEOUT_EXPIRED) setTimeout(look, 4);
      else { gl.deleteSync(sync); done(performance.now() - start); }
    };
    setTimeout(look, 0);
  }

  resize(width, height) {
    if (this.canvas.width < width || this.canvas.height < height) {
      this.canvas.width = Math.max(this.canvas.width, width);
      this.canvas.height = Math.max(this.canvas.height, height);
    }
  }

  use(name, values) {
    const gl = this.gl, { program, uniforms } = this.programs[name];
    gl.useProgram(program);
    for (const [key, value] of Object.entries(values)) {
      const [place, type] = uniforms[key] ?? uniforms[`${key}[0]`] ?? [];
      if (!place) continue;
      if (type === gl.FLOAT) gl.uniform1f(place, value);
      else if (type === gl.FLOAT_VEC2) gl.uniform2fv(place, value);
      else if (type === gl.FLOAT_VEC3) gl.uniform3fv(place, value);
      else if (type === gl.FLOAT_VEC4) gl.uniform4fv(place, value);
      else gl.uniformMatrix4fv(place, false, value);
    }
  }
}

export function renderer() {
  const key = Symbol.for("polyskel_lite.viewer.1");
  globalThis[key] ??= new Renderer();
  return globalThis[key];
}

/** The buffers of one viewer on the GPU, made when they are first drawn. */
export class Buffers {
  constructor(gl) { this.gl = gl; this.made = new Map(); }

  /** A buffer with this content; made anew only when `stamp` differs from the last one. */
  get(name, stamp, make, target = this.gl.ARRAY_BUFFER) {
    const gl = this.gl;
    let entry = this.made.get(name);
    if (!entry) this.made.set(name, (entry = { buffer: gl.createBuffer(), stamp: null, length: 0 }));
    gl.bindBuffer(target, entry.buffer);
    if (entry.stamp !== stamp) {
      const data = make();
      gl.bufferData(target, data, gl.STATIC_DRAW);
      Object.assign(entry, { stamp, length: data.length });
    }
    return entry;
  }

  free() { this.made.forEach((entry) => this.gl.deleteBuffer(entry.buffer)); this.made.clear(); }
}
