// The skeleton viewer: one module for JupyterLab (an anywidget) and for pages without a kernel.
//
// What is shown follows from one number, the cut: how many simplices the threshold removes. Python sends the
// removal order of each hierarchy (rank) and the levels in that order, so the browser finds the cut by
// bisection in double precision and shows exactly what Hierarchy.skeleton(threshold) has. Polygons and edges
// are sorted by rank once; a threshold is then the length of a prefix, and nothing is sent to the GPU again
// but the few wires and facets that appear.

const PI = Math.PI;
const STEPS = 400; // of the threshold slider
const BAR = 46; // height of the scale of colours
// Without a graphics card a picture of many polygons takes long; while it moves it may be a coarser one.
const LEVELS = [
  { name: "smooth", scale: 1, samples: 4 },
  { name: "plain", scale: 1, samples: 1 },
  { name: "half", scale: 0.5, samples: 1 },
  { name: "third", scale: 0.34, samples: 1 },
];
const STYLE = `
.psl { --psl-line: color-mix(in srgb, currentColor 28%, transparent);
  color: var(--pst-color-text-base, var(--jp-content-font-color1, inherit));
  font-family: inherit; font-size: 0.9rem; line-height: 1.4; margin: 0.6rem 0; }
html[data-theme="dark"] .bd-content div.cell_output .text_html:has(.psl) { background: transparent !important; }
.psl * { box-sizing: border-box; }
.psl p { margin: 0.35rem 0; }
.psl-look { font-weight: 600; }
.psl-stage { position: relative; width: 100%; background: #fff; border: 1px solid var(--psl-line);
  border-radius: 6px; overflow: hidden; }
.psl-stage canvas { display: block; width: 100%; height: 100%; touch-action: pan-y; cursor: grab; outline: none; }
.psl-stage canvas:focus { touch-action: none; }
.psl-stage canvas:active { cursor: grabbing; }
.psl-stage:focus-within, .psl input:focus-visible, .psl select:focus-visible, .psl button:focus-visible {
  outline: 3px solid #0072b2; outline-offset: 2px; }
html[data-theme="dark"] .psl :focus-visible, html[data-theme="dark"] .psl-stage:focus-within,
[data-jp-theme-light="false"] .psl :focus-visible { outline-color: #8fd0ff; }
.psl-status { font-variant-numeric: tabular-nums; min-height: 2.8em; }
.psl-controls { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 19rem), 1fr));
  gap: 0.35rem 1.6rem; align-items: center; }
.psl-row { display: grid; grid-template-columns: 7.5rem 1fr auto; gap: 0.6rem; align-items: center; min-height: 2rem; }
.psl-wide { grid-column: 1 / -1; }
.psl-row input[type="range"] { width: 100%; min-width: 0; margin: 0; accent-color: #0072b2; height: 1.5rem; }
.psl-row output { min-width: 4.6rem; text-align: right; font-variant-numeric: tabular-nums; }
.psl-row input[type="number"] { width: 5.6rem; }
.psl input[type="number"], .psl select, .psl button { font: inherit; color: inherit; background: transparent;
  border: 1px solid color-mix(in srgb, currentColor 55%, transparent); border-radius: 4px; padding: 0.15rem 0.45rem; }
.psl select option { color: #000; background: #fff; }
.psl button { cursor: pointer; min-height: 2rem; padding: 0.15rem 0.7rem; }
.psl button:hover { background: color-mix(in srgb, currentColor 12%, transparent); }
.psl fieldset { border: 0; margin: 0; padding: 0; display: flex; flex-wrap: wrap; gap: 0.2rem 1rem;
  align-items: center; min-height: 2rem; min-inline-size: 0; }
.psl legend { float: left; padding: 0; margin: 0 0.6rem 0 0; font-size: inherit; width: 7.5rem; }
.psl fieldset label { display: inline-flex; gap: 0.35rem; align-items: center; margin: 0; min-height: 1.6rem; }
.psl-bar { display: flex; flex-wrap: wrap; gap: 0.4rem 0.5rem; align-items: center; }
.psl-hint { font-size: 0.8rem; opacity: 0.85; }
.psl-only-heard { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%);
  white-space: nowrap; }
@media (max-width: 30rem) { .psl-row { grid-template-columns: 1fr auto; } .psl-row > label { grid-column: 1 / -1; }
  .psl legend { width: 100%; float: none; } }
@media print { .psl-controls, .psl-hint { display: none; } }
`;

// ---------------------------------------------------------------- data

const TYPES = {
  i2: Int16Array, u1: Uint8Array, u2: Uint16Array, u4: Uint32Array, i4: Int32Array, f4: Float32Array, f8: Float64Array,
};

async function unpacked(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

function bytesOf(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** Read one array; numbers stored as differences are summed up again. */
function read(buffer, ref) {
  if (!ref) return null;
  const array = new TYPES[ref.type](buffer, ref.at, ref.size).slice();
  if (ref.delta) for (let i = ref.delta; i < array.length; i++) array[i] += array[i - ref.delta];
  return array;
}

/** Positions as floats, three a point, in the units of the data; far ones are stored apart, unrounded. */
function positions(buffer, ref, dimension) {
  const whole = read(buffer, ref.grid);
  const n = whole.length / dimension;
  const out = new Float32Array(3 * n);
  const size = ref.high.map((h, k) => h - ref.low[k]);
  for (let i = 0; i < n; i++) {
    for (let k = 0; k < dimension; k++) out[3 * i + k] = ref.low[k] + (size[k] * whole[dimension * i + k]) / 65535;
  }
  const far = read(buffer, ref.far);
  const places = read(buffer, ref.far_places);
  if (far) far.forEach((i, j) => { for (let k = 0; k < dimension; k++) out[3 * i + k] = places[dimension * j + k]; });
  return out;
}

/** One state of the data: its geometry and its hierarchies. */
class Scene {
  constructor(buffer, header, dimension) {
    Object.assign(this, { header, dimension, label: header.label });
    const get = (name) => read(buffer, header[name]);
    this.vertices = positions(buffer, header.vertices, dimension);
    this.count = this.vertices.length / 3;
    this.radius = get("radius");
    this.edges = get("edges");
    this.sizes = get("sizes") ?? new Uint8Array(0);
    this.corners = get("corners") ?? new Uint16Array(0);
    this.rays = get("rays");
    this.points = header.points ? positions(buffer, header.points, dimension) : new Float32Array(0);
    const index = (name) => (header[name] ? Uint32Array.from(get(name)) : null);
    this.samples = index("samples");
    this.simplices = index("simplices");
    this.surface = index("surface"); // of a polyball: its boundary and, in the plane, triangles that fill its discs
    this.fill = index("fill");
    this.shaped = Boolean(this.simplices || this.surface);
    this.starts = new Uint32Array(this.sizes.length + 1);
    for (let p = 0; p < this.sizes.length; p++) this.starts[p + 1] = this.starts[p] + this.sizes[p];
    this.findSides();
    this.findFacets();
    this.hierarchies = header.hierarchies.map((h) => new Filter(this, h, read(buffer, h.rank), read(buffer, h.level)));
  }

  /** The edge under each side of each polygon. */
  findSides() {
    const { edges, corners, starts, sizes, count } = this;
    this.sides = new Int32Array(corners.length).fill(-1);
    if (!corners.length) return;
    const number = new Map();
    for (let e = 0; e < edges.length / 2; e++) {
      const a = edges[2 * e], b = edges[2 * e + 1];
      number.set(a < b ? a * count + b : b * count + a, e);
    }
    for (let p = 0; p < sizes.length; p++) {
      for (let i = starts[p]; i < starts[p + 1]; i++) {
        const a = corners[i], b = corners[i + 1 < starts[p + 1] ? i + 1 : starts[p]];
        this.sides[i] = number.get(a < b ? a * count + b : b * count + a) ?? -1;
      }
    }
  }

  /** The facets of the simplices: corners, outward from the first of the simplices on both sides (-1: none). */
  findFacets() {
    const N = this.dimension, M = N + 1, s = this.simplices;
    this.facets = new Uint32Array(0);
    this.owners = new Int32Array(0);
    if (!s) return;
    const n = this.points.length / 3, seen = new Map(), facets = [], owners = [], f = [0, 0, 0];
    const others = N === 2 ? [[1, 2], [2, 0], [0, 1]] : [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];
    for (let t = 0; t < s.length / M; t++) {
      for (let i = 0; i < M; i++) {
        for (let k = 0; k < N; k++) f[k] = s[M * t + others[i][k]];
        const a = Math.min(f[0], f[1]), b = Math.max(f[0], f[1]), c = f[2];
        const key = N === 2 ? a * n + b : c < a ? (c * n + a) * n + b : c < b ? (a * n + c) * n + b : (a * n + b) * n + c;
        const found = seen.get(key);
        if (found !== undefined) owners[2 * found + 1] = t;
        else {
          seen.set(key, facets.length / N);
          for (let k = 0; k < N; k++) facets.push(f[k]);
          owners.push(t, -1);
        }
      }
    }
    this.facets = Uint32Array.from(facets);
    this.owners = Int32Array.from(owners);
  }
}

/** First position in a sorted array whose value is at least x. */
function bisect(sorted, x) {
  let low = 0, high = sorted.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] < x) low = middle + 1; else high = middle;
  }
  return low;
}

/** Numbers 0..n-1 sorted by a whole number each, largest first. */
function sortedDown(keys, largest) {
  const start = new Uint32Array(largest + 2), order = new Uint32Array(keys.length);
  for (const k of keys) start[largest - k + 1]++;
  for (let k = 0; k <= largest; k++) start[k + 1] += start[k];
  keys.forEach((k, i) => { order[start[largest - k]++] = i; });
  return order;
}

/** Which elements of a scene a hierarchy keeps. */
class Filter {
  constructor(scene, header, rank, levels) {
    Object.assign(this, { scene, header, label: header.label, levels: levels ?? new Float64Array(0) });
    const { edges, corners, starts, sizes, sides, count } = scene;
    const last = this.levels.length; // the rank of what never goes
    this.rank = rank ?? new Uint8Array(count).fill(0);
    const E = edges.length / 2, P = sizes.length;
    this.edgeRank = new Uint32Array(E);
    for (let e = 0; e < E; e++) this.edgeRank[e] = Math.min(this.rank[edges[2 * e]], this.rank[edges[2 * e + 1]]);
    const polygonRank = new Uint32Array(P).fill(last);
    this.edgeCover = new Int32Array(E).fill(-1); // the rank of the longest-lived polygon on it
    this.vertexCover = new Int32Array(count).fill(-1);
    for (let p = 0; p < P; p++) {
      for (let i = starts[p]; i < starts[p + 1]; i++) polygonRank[p] = Math.min(polygonRank[p], this.rank[corners[i]]);
      for (let i = starts[p]; i < starts[p + 1]; i++) {
        const v = corners[i], e = sides[i], r = polygonRank[p];
        if (r > this.vertexCover[v]) this.vertexCover[v] = r;
        if (e >= 0 && r > this.edgeCover[e]) this.edgeCover[e] = r;
      }
    }
    this.polygonOrder = sortedDown(polygonRank, last);
    this.edgeOrder = sortedDown(this.edgeRank, last);
    const ascending = (order, ranks) => Uint32Array.from(order, (i) => ranks[i]).reverse();
    this.polygonSorted = ascending(this.polygonOrder, polygonRank);
    this.edgeSorted = ascending(this.edgeOrder, this.edgeRank);
    this.vertexSorted = Uint32Array.from(this.rank).sort();
    this.fans = null;
  }

  /** How many simplices a threshold removes. */
  cut(threshold) { return bisect(this.levels, threshold); }

  kept(sorted, cut) { return sorted.length - bisect(sorted, cut); }

  counts(cut) {
    const { edges, count } = this.scene;
    const E = this.kept(this.edgeSorted, cut), degree = new Uint8Array(count);
    for (let k = 0; k < E; k++) {
      const e = this.edgeOrder[k], a = edges[2 * e], b = edges[2 * e + 1];
      if (degree[a] < 3) degree[a]++;
      if (degree[b] < 3) degree[b]++;
    }
    let ends = 0, lone = 0;
    for (let v = 0; v < count; v++) {
      if (degree[v] > 1 || this.rank[v] < cut) continue;
      if (degree[v] === 0) lone++;
      else if (this.vertexCover[v] < cut) ends++;
    }
    return {
      vertices: this.kept(this.vertexSorted, cut), edges: E, polygons: this.kept(this.polygonSorted, cut), branches: ends, lone,
    };
  }

  /** Triangles of all polygons, the longest-lived first, and how many belong to the first k polygons. */
  triangles() {
    if (this.fans) return this.fans;
    const { corners, starts, sizes } = this.scene;
    let total = 0;
    for (const size of sizes) total += Math.max(size - 2, 0);
    const index = new Uint32Array(3 * total), upTo = new Uint32Array(sizes.length + 1);
    let at = 0;
    this.polygonOrder.forEach((p, k) => {
      for (let i = starts[p] + 1; i + 1 < starts[p + 1]; i++) {
        index[at++] = corners[starts[p]]; index[at++] = corners[i]; index[at++] = corners[i + 1];
      }
      upTo[k + 1] = at;
    });
    return (this.fans = { index, upTo });
  }

  /** Edges that are kept and bound no kept polygon. */
  wires(cut) {
    const out = [], E = this.kept(this.edgeSorted, cut);
    for (let k = 0; k < E; k++) {
      const e = this.edgeOrder[k];
      if (this.edgeCover[e] < cut) out.push(e);
    }
    return out;
  }

  /** Vertices that are kept without an edge; they would not be seen otherwise. */
  lone(cut) {
    const { edges, count } = this.scene, joined = new Uint8Array(count), E = this.kept(this.edgeSorted, cut);
    for (let k = 0; k < E; k++) { const e = this.edgeOrder[k]; joined[edges[2 * e]] = joined[edges[2 * e + 1]] = 1; }
    return Uint32Array.from({ length: count }, (_, v) => v).filter((v) => this.rank[v] >= cut && !joined[v]);
  }

  keptVertices(cut) {
    return Uint32Array.from({ length: this.scene.count }, (_, v) => v).filter((v) => this.rank[v] >= cut);
  }

  /** The ends of all edges, the longest-lived first. */
  sides() {
    const { edges } = this.scene, out = new Uint32Array(edges.length);
    this.edgeOrder.forEach((e, i) => { out[2 * i] = edges[2 * e]; out[2 * i + 1] = edges[2 * e + 1]; });
    return out;
  }

  /** Whether a simplex is in the simplified shape: always if it has no vertex, as the skeleton is not the shape's dual. */
  remains(simplex, cut) { return (this.rank[simplex] ?? Infinity) >= cut; }

  /** In the plane, the triangles of the simplified shape. */
  region(cut) {
    if (this.scene.fill) return this.scene.fill;
    return this.scene.simplices.filter((_, i) => this.remains(Math.floor(i / 3), cut));
  }

  /** Facets of the boundary of the simplified shape, flat, turned outward. */
  boundary(cut) {
    const { facets, owners, dimension: N, surface } = this.scene, out = [];
    if (surface) return surface;
    for (let f = 0; f < owners.length / 2; f++) {
      const a = owners[2 * f], b = owners[2 * f + 1];
      const first = this.remains(a, cut), second = b >= 0 && this.remains(b, cut);
      if (first === second) continue;
      for (let k = 0; k < N; k++) out.push(facets[N * f + (second && k < 2 ? 1 - k : k)]);
    }
    return Uint32Array.from(out);
  }
}

// ---------------------------------------------------------------- drawing

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

function renderer() {
  const key = Symbol.for("polyskel_lite.viewer.1");
  globalThis[key] ??= new Renderer();
  return globalThis[key];
}

/** The buffers of one viewer on the GPU, made when they are first drawn. */
class Buffers {
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

const product = (a, b) => {
  const out = new Float32Array(16);
  for (let c = 0; c < 4; c++) for (let r = 0; r < 4; r++) {
    for (let k = 0; k < 4; k++) out[4 * c + r] += a[4 * k + r] * b[4 * c + k];
  }
  return out;
};
const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

/** Where the reader looks from. */
class Camera {
  constructor(dimension, low, high, view) {
    this.flat = dimension === 2;
    this.view = view;
    this.center = low.map((l, k) => (l + high[k]) / 2);
    this.radius = Math.hypot(...low.map((l, k) => high[k] - l)) / 2 || 1;
    this.half = low.map((l, k) => (high[k] - l) / 2);
    if (this.flat) { this.center.push(0); this.half.push(0); }
    this.reset();
  }

  reset() { this.azimuth = this.view.azim; this.elevation = this.view.elev; this.zoom = 1; this.x = 0; this.y = 0; }

  turn(dx, dy) { this.azimuth -= dx; this.elevation = clamp(this.elevation + dy, -89.9, 89.9); }

  /** Zoom so that the place (px, py), from -1 to 1, stays under the pointer. */
  scale(factor, px = 0, py = 0) {
    const before = this.zoom;
    this.zoom = clamp(this.zoom * factor, 0.3, 60);
    factor = this.zoom / before;
    this.x = px + (this.x - px) * factor;
    this.y = py + (this.y - py) * factor;
  }

  eye(azimuth = this.azimuth, elevation = this.elevation) {
    const [cx, cy, cz] = this.center, s = 1 / this.radius;
    if (this.flat) return new Float32Array([s, 0, 0, 0, 0, s, 0, 0, 0, 0, s, 0, -s * cx, -s * cy, -s * cz - 3.6, 1]);
    const a = (azimuth * PI) / 180, e = (elevation * PI) / 180;
    const toward = [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)];
    const right = [-Math.sin(a), Math.cos(a), 0];
    const up = [-Math.sin(e) * Math.cos(a), -Math.sin(e) * Math.sin(a), Math.cos(e)];
    const move = [right, up, toward].map((v) => -s * (v[0] * cx + v[1] * cy + v[2] * cz));
    return new Float32Array([
      s * right[0], s * up[0], s * toward[0], 0, s * right[1], s * up[1], s * toward[1], 0,
      s * right[2], s * up[2], s * toward[2], 0, move[0], move[1], move[2] - 3.6, 1,
    ]);
  }

  /** How strong the lens must be for what is shown, seen from the first place, to fill the stage, and its middle. */
  fit(aspect, places, free) {
    if (this.lens?.aspect === aspect && this.lens.places === places && this.lens.free === free) return this.lens;
    const m = this.eye(this.view.azim, this.view.elev), low = [Infinity, Infinity], high = [-Infinity, -Infinity];
    for (let i = 0; i < places.length; i += 3) {
      const [x, y, z] = [places[i], places[i + 1], places[i + 2]];
      const w = this.flat ? 1 : -(m[2] * x + m[6] * y + m[10] * z + m[14]);
      for (const k of [0, 1]) {
        const at = (m[k] * x + m[4 + k] * y + m[8 + k] * z + m[12 + k]) / w;
        low[k] = Math.min(low[k], at);
        high[k] = Math.max(high[k], at);
      }
    }
    const size = Math.max((high[0] - low[0]) / aspect, (high[1] - low[1]) / free, 1e-9);
    this.lens = { aspect, places, free, f: 1.9 / size, x: (low[0] + high[0]) / 2 / aspect, y: (low[1] + high[1]) / 2 };
    return this.lens;
  }

  /** `free` is the share of the height that is not under the scale of colours. */
  matrices(aspect, places, free) {
    const eye = this.eye(), lens = this.fit(aspect, places, free), f = lens.f * this.zoom;
    const x = this.x - lens.x * f, y = this.y + 1 - free - lens.y * f;
    // Looking along -z: in space w = -z, in the plane w = 1. The pan is a shift of the picture.
    const out = this.flat
      ? [f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, -0.25, 0, x, y, -0.9, 1]
      : [f / aspect, 0, 0, 0, 0, f, 0, 0, -x, -y, -1.947, -1, 0, 0, -5.305, 0];
    return { toClip: product(new Float32Array(out), eye) };
  }

  /** Unit vectors to the light, which is over the reader's left shoulder, and to the reader. */
  lights() {
    const m = this.eye(), s = 1 / this.radius;
    const back = (x, y, z) => [0, 4, 8].map((c) => (m[c] * x + m[c + 1] * y + m[c + 2] * z) / s);
    const norm = Math.hypot(0.35, 0.55, 0.85);
    return { toLight: back(-0.35 / norm, 0.55 / norm, 0.85 / norm), toEye: back(0, 0, 1) };
  }
}

/** One picture: everything drawn in its order, with what all steps share. */
class Picture {
  constructor(viewer, width, height, ratio, level) {
    const { view, buffers, camera, header, cut, shapeCut, counted, filter, sceneNow: scene } = viewer;
    const gl = view.gl, colors = header.colors, color = viewer.get("color");
    Object.assign(this, { viewer, view, gl, buffers, header, colors, color, cut, shapeCut, counted, filter, scene, ratio });
    this.solid = viewer.dimension === 3;
    this.coarse = LEVELS[level].scale < 1;
    this.fine = LEVELS[level].samples > 1;
    this.opacity = viewer.get("opacity");
    this.clip = this.solid && scene.header.vertices.far ? " CLIP" : "";
    this.grow = ratio * clamp(camera.zoom ** 0.35, 0.8, 2.2); // of lines and dots
    this.skeleton = color === "none" ? this.paint(colors.skeleton) : {};
    // Buffers are made anew when these change.
    this.label = `${scene.label}|${filter.label}`;
    this.stamp = `${this.label}|${color}`;
    const reach = camera.half.map((half) => half + 0.3 * camera.radius);
    this.base = {
      ...camera.matrices(width / height, viewer.outline(), 1 - (BAR * ratio) / height),
      ...camera.lights(),
      low: camera.center.map((c, k) => c - reach[k]),
      high: camera.center.map((c, k) => c + reach[k]),
      size: [width, height], plain: [0, 0, 0, 0], alpha: 1, lit: 0, tube: 0, nearer: 0, hard: this.solid && !this.fine ? 1 : 0,
    };
    gl.viewport(0, 0, width, height);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(0, 0, width, height);
    gl.clearColor(1, 1, 1, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.depthFunc(gl.LEQUAL);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.bindVertexArray(view.blank);
    this.release();
  }

  draw() {
    const { gl, solid, viewer, scene, shapeCut, colors, opacity } = this;
    const shown = (name) => viewer.get(name);
    gl.disable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    if (!solid && scene.shaped) this.region();
    if (solid) gl.enable(gl.DEPTH_TEST);
    if (solid && scene.sizes.length) {
      if (shown("polygons")) this.polygons();
      if (shown("edges") && !this.coarse) this.sides(shown("polygons") ? 0.3 * clamp(15000 / this.counted.edges, 0.3, 1) : 0.75);
    }
    // Soft rims of wires and dots would hide what lies behind them in space: samples of a pixel instead, or hard rims.
    if (solid) gl.disable(gl.BLEND);
    if (solid && this.fine) gl.enable(gl.SAMPLE_ALPHA_TO_COVERAGE);
    if (shown("edges")) this.wires();
    if (shown("vertices")) this.vertices("dots", () => this.filter.keptVertices(this.cut), this.paint(colors.vertices), solid ? 4 : 4.5);
    else if (shown("edges") && this.counted.lone) this.vertices("lone", () => this.filter.lone(this.cut), this.skeleton, 7);
    if (shown("samples") && scene.samples) this.samples();
    gl.disable(gl.SAMPLE_ALPHA_TO_COVERAGE);
    gl.enable(gl.BLEND);
    if (solid && scene.shaped && opacity > 0.004) {
      if (shapeCut) this.glass("glass-all", 0, colors.ghost, opacity * 0.35); // the whole shape, a ghost around it
      this.glass("glass", shapeCut, colors.glass, opacity);
    }
  }

  paint(hex) { return { plain: [...rgb(hex), 1] }; }

  use(program, uniforms) { this.view.use(program + this.clip, { ...this.base, ...uniforms }); }

  /** Three numbers a vertex: floats, or bytes that stand for 0 to 1. */
  attribute(place, bytes, stride = 0, offset = 0, divisor = 0) {
    const gl = this.gl;
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, 3, bytes ? gl.UNSIGNED_BYTE : gl.FLOAT, bytes, stride, offset);
    gl.vertexAttribDivisor(place, divisor);
  }

  release() {
    for (let k = 0; k < 4; k++) { this.gl.disableVertexAttribArray(k); this.gl.vertexAttribDivisor(k, 0); }
  }

  indices(name, stamp, make) { return this.buffers.get(name, stamp, make, this.gl.ELEMENT_ARRAY_BUFFER).length; }

  elements(mode, count) { this.gl.drawElements(mode, count, this.gl.UNSIGNED_INT, 0); }

  bindSkeleton() {
    this.buffers.get("vertices", this.scene.label, () => this.scene.vertices);
    this.attribute(0, false);
    this.buffers.get("values", this.stamp, () => this.values());
    this.attribute(1, true, 4);
  }

  bindPoints() {
    this.buffers.get("points", this.scene.label, () => this.scene.points);
    this.attribute(0, false);
    this.gl.disableVertexAttribArray(1);
  }

  /** The colour of each vertex, four bytes each (the fourth only fills up). */
  values() {
    const { scene, filter, color } = this, out = new Uint8Array(4 * scene.count), ramp = this.header.ramp.map(rgb);
    const { largest, power } = filter.header, { levels, rank } = filter, last = ramp.length - 1;
    for (let v = 0; v < scene.count; v++) {
      const level = rank[v] < levels.length ? levels[rank[v]] : Infinity;
      const x = color === "level" ? clamp(Math.max(level, 0) / largest, 0, 1) ** (1 / power) : scene.radius[v] / 65535;
      const k = Math.min(Math.floor(x * last), last - 1), part = x * last - k;
      for (let c = 0; c < 3; c++) out[4 * v + c] = Math.round(255 * (ramp[k][c] * (1 - part) + ramp[k + 1][c] * part));
    }
    return out;
  }

  /** In the plane: the filled shape and its outline; where it is simplified, the whole shape paler under it. */
  region() {
    const { gl, colors, shapeCut, opacity } = this;
    this.bindPoints();
    // Discs of a polyball overlap; equal depths let each pixel be filled once.
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LESS);
    const fill = (name, cut, hex, alpha) => {
      gl.clear(gl.DEPTH_BUFFER_BIT);
      const count = this.indices(name, `${this.label}|${cut}`, () => this.filter.region(cut));
      this.use("faces", { ...this.paint(hex), alpha });
      this.elements(gl.TRIANGLES, count);
    };
    if (shapeCut) fill("region-all", 0, colors.removed, opacity * 0.6);
    fill("region", shapeCut, colors.fill, opacity);
    gl.disable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    const line = (name, cut, hex, width) => this.segments(name, `${this.label}|${cut}`, () => this.outlineEnds(cut),
      { ...this.paint(hex), width: width * this.ratio, alpha: Math.min(1, 2 * opacity) });
    if (shapeCut) line("outline-all", 0, colors.ghost, 1);
    line("outline", shapeCut, colors.shape, shapeCut ? 1.6 : 1.2);
  }

  polygons() {
    const { index, upTo } = this.filter.triangles();
    this.gl.disable(this.gl.BLEND);
    this.bindSkeleton();
    this.indices("fans", this.label, () => index);
    this.use("faces", { ...this.skeleton, lit: 1 });
    this.elements(this.gl.TRIANGLES, upTo[this.counted.polygons]);
    this.gl.enable(this.gl.BLEND);
  }

  /** All edges as thin dark lines, which tell the polygons apart. */
  sides(alpha) {
    this.bindSkeleton();
    this.gl.disableVertexAttribArray(1);
    this.indices("sides", this.label, () => this.filter.sides());
    this.use("faces", { plain: [0.05, 0.07, 0.12, 1], alpha });
    this.gl.depthMask(false);
    this.elements(this.gl.LINES, 2 * this.counted.edges);
    this.gl.depthMask(true);
  }

  /** Edges on no polygon, and rays. */
  wires() {
    const { solid, cut, label, scene } = this, width = (solid ? 4 : 2.4) * this.grow;
    const look = { width, tube: solid ? 1 : 0, nearer: solid ? 0.001 : 0 };
    this.segments("wires", `${this.stamp}|${cut}`, () => this.wireEnds(), { ...look, ...this.skeleton });
    if (scene.rays) this.segments("rays", label, () => scene.rays, { ...look, ...this.paint(this.colors.skeleton) });
  }

  wireEnds() {
    const { scene } = this, rows = this.filter.wires(this.cut), p = scene.vertices, own = this.values();
    const out = new Float32Array(8 * rows.length), bytes = new Uint8Array(out.buffer);
    rows.forEach((e, i) => [0, 1].forEach((side) => {
      const v = scene.edges[2 * e + side], at = 8 * i + 4 * side;
      for (let k = 0; k < 3; k++) out[at + k] = p[3 * v + k];
      for (let k = 0; k < 4; k++) bytes[4 * at + 12 + k] = own[4 * v + k];
    }));
    return out;
  }

  outlineEnds(cut) {
    const flat = this.filter.boundary(cut), out = new Float32Array(4 * flat.length), p = this.scene.points;
    flat.forEach((v, i) => { for (let k = 0; k < 3; k++) out[4 * i + k] = p[3 * v + k]; });
    return out;
  }

  /** Segments as instances: of each end three floats and four bytes of colour. */
  segments(name, stamp, ends, uniforms) {
    this.release();
    const count = this.buffers.get(name, stamp, ends).length / 8;
    if (!count) return;
    this.use("lines", uniforms);
    [0, 12, 16, 28].forEach((offset, place) => this.attribute(place, place % 2 === 1, 32, offset, 1));
    this.gl.drawArraysInstanced(this.gl.TRIANGLE_STRIP, 0, 4, count);
    this.release();
  }

  vertices(name, rows, look, width) {
    this.bindSkeleton();
    const count = this.indices(name, `${this.label}|${this.cut}`, rows);
    this.use("dots", { ...look, width: width * this.grow, nearer: this.solid ? 0.002 : 0 });
    this.elements(this.gl.POINTS, count);
  }

  samples() {
    this.bindPoints();
    const count = this.indices("samples", this.scene.label, () => this.scene.samples);
    const width = (this.solid ? 3.2 : 3.6) * this.grow;
    this.use("dots", { ...this.paint(this.colors.samples), width, nearer: this.solid ? 0.002 : 0 });
    this.elements(this.gl.POINTS, count);
  }

  /** In space: the shape as glass, what faces away from the reader first. */
  glass(name, cut, hex, alpha) {
    const gl = this.gl;
    this.bindPoints();
    const count = this.indices(name, `${this.label}|${cut}`, () => this.filter.boundary(cut));
    this.use("faces", { ...this.paint(hex), alpha, lit: 2 });
    gl.depthMask(alpha > 0.97);
    gl.enable(gl.CULL_FACE);
    for (const hidden of this.coarse ? [gl.BACK] : [gl.FRONT, gl.BACK]) {
      gl.cullFace(hidden);
      this.elements(gl.TRIANGLES, count);
    }
    gl.disable(gl.CULL_FACE);
    gl.depthMask(true);
  }
}

// ---------------------------------------------------------------- the viewer

/** A name that no other element of the page has: in JupyterLab each viewer brings its own copy of this module. */
function ownName() {
  const key = Symbol.for("polyskel_lite.viewer.count");
  globalThis[key] = (globalThis[key] ?? 0) + 1;
  return `psl-${globalThis[key]}`;
}

function make(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) node.addEventListener(key.slice(2), value);
    else if (key in node && typeof value !== "string") node[key] = value;
    else if (value !== null && value !== undefined) node.setAttribute(key, value);
  }
  node.append(...children);
  return node;
}

const PLURALS = { vertex: "vertices", branch: "branches", cavity: "cavities" };
const many = (n, word) => `${n.toLocaleString("en")} ${n === 1 ? word : PLURALS[word] ?? `${word}s`}`;
const multiple = (t) => (t === -Infinity ? "none" : `${Number((t / PI).toFixed(3))} π`);

class Viewer {
  constructor(model, element, scenes) {
    Object.assign(this, { model, element, scenes });
    this.header = model.get("scene");
    this.dimension = this.header.dimension;
    this.id = ownName();
    this.camera = new Camera(this.dimension, this.header.low, this.header.high, this.header.view);
    this.frames = 0;
    this.cost = []; // milliseconds of the last picture of each level
    this.gone = [];
    this.build();
    this.follow();
    this.update();
  }

  get(name) { const value = this.model.get(name); return name === "threshold" && value === null ? -Infinity : value; }

  set(name, value) {
    if (this.get(name) === value) return;
    this.model.set(name, value === -Infinity ? null : value);
    clearTimeout(this.saving);
    this.saving = setTimeout(() => this.model.save_changes(), 40);
  }

  get sceneNow() { return this.scenes.find((s) => s.label === this.get("variant")) ?? this.scenes[0]; }

  get filter() {
    const { hierarchies } = this.sceneNow;
    return hierarchies.find((h) => h.label === this.get("strategy")) ?? hierarchies[0];
  }

  // ------------------------------------------------------------ controls

  build() {
    const { header, id, dimension } = this;
    const solid = dimension === 3;
    this.canvas = make("canvas", {
      tabindex: "0", role: "application", "aria-roledescription": "interactive picture", "aria-label": header.alt,
      "aria-describedby": `${id}-hint`,
    });
    this.stage = make("div", { class: "psl-stage", style: `height:${header.height}px` }, this.canvas);
    this.status = make("p", { class: "psl-status", "aria-hidden": "true" });
    this.heard = make("p", { class: "psl-only-heard", role: "status", "aria-live": "polite" });
    this.controls = make("div", { class: "psl-controls" });
    const hint = make("p", { class: "psl-hint", id: `${id}-hint` },
      `${solid ? "Drag to turn, Shift and drag to move" : "Drag to move"}; after a click the wheel zooms. `
      + `Keys: arrows ${solid ? "turn, Shift and arrows move" : "move"}, + and − zoom, Home resets.`);
    this.rows();
    this.element.classList.add("psl");
    this.element.setAttribute("role", "group");
    this.element.setAttribute("aria-label", header.name);
    if (header.look) this.element.append(make("p", { class: "psl-look" }, header.look));
    this.element.append(this.stage, this.status, this.heard, this.controls, hint);
    // JupyterLab's shortcuts would keep arrow keys and letters from the part that has the focus.
    for (const part of this.element.querySelectorAll("canvas, input, select, button")) part.dataset.lmSuppressShortcuts = "true";
    this.pointer();
    const sizes = new ResizeObserver(() => this.draw());
    sizes.observe(this.stage);
    const inSight = new IntersectionObserver((entries) => {
      this.seen = entries[entries.length - 1].isIntersecting;
      if (this.seen) this.draw(); else this.rest();
    }, { rootMargin: "300px" });
    inSight.observe(this.stage);
    this.gone.push(() => sizes.disconnect(), () => inSight.disconnect());
  }

  row(text, control, output = "", wide = false) {
    const label = make("label", { for: control.id }, text);
    this.controls.append(make("div", { class: wide ? "psl-row psl-wide" : "psl-row" }, label, control, output));
  }

  slider(key, name, text, options, { shown, value, wide }) {
    const input = make("input", { type: "range", id: `${this.id}-${key}`, "data-control": key, "aria-label": text, ...options });
    const output = make("output", { for: input.id });
    input.addEventListener("input", () => { this.set(name, value(Number(input.value))); this.update(); });
    this.row(text, input, output, wide);
    this.refreshers.push(() => {
      const now = this.get(name), words = shown(now);
      if (output.textContent !== words) { output.textContent = words; input.setAttribute("aria-valuetext", words); }
    });
    return input;
  }

  rows() {
    const { header, id } = this;
    const first = this.scenes[0], solid = this.dimension === 3;
    this.refreshers = [];
    if (header.filters) this.thresholdRow();
    if (this.scenes.length > 1) {
      const labels = this.scenes.map((s) => s.label);
      const input = this.slider("variant", "variant", header.variant, { min: "0", max: String(labels.length - 1), step: "1" },
        { shown: (v) => v, value: (i) => labels[i], wide: true });
      this.refreshers.push(() => { input.value = String(Math.max(labels.indexOf(this.get("variant")), 0)); });
    }
    const strategies = first.hierarchies.map((h) => h.label);
    if (strategies.length > 1) {
      const set = make("fieldset", { class: "psl-wide" }, make("legend", {}, header.strategy));
      for (const name of strategies) {
        const input = make("input", { type: "radio", name: `${id}-strategy`, value: name, "data-control": "strategy",
          onchange: () => { this.set("strategy", name); this.update(); } });
        set.append(make("label", {}, input, name));
        this.refreshers.push(() => { input.checked = this.filter.label === name; });
      }
      this.controls.append(set);
    }
    const share = { min: "0", max: "100", step: "1" };
    const percent = { shown: (v) => `${Math.round(100 * v)} %`, value: (v) => v / 100 };
    if (header.shape) {
      if (header.filters) {
        const ends = { ...percent, shown: (v) => (v <= 0 ? "whole" : v >= 1 ? "simplified" : percent.shown(v)) };
        const input = this.slider("simplified", "simplified", "Simplify shape", share, ends);
        this.refreshers.push(() => { input.value = String(Math.round(100 * this.get("simplified"))); });
      }
      const input = this.slider("opacity", "opacity", "Shape opacity", share, percent);
      this.refreshers.push(() => { input.value = String(Math.round(100 * this.get("opacity"))); });
    }
    const names = { radius: "radius", level: "level", none: "one colour" };
    const colors = Object.keys(names).filter((c) => c !== "level" || header.filters);
    const select = make("select", { id: `${id}-color`, "data-control": "color",
      onchange: () => { this.set("color", select.value); this.update(); } },
    ...colors.map((c) => make("option", { value: c }, names[c])));
    this.row("Colour", select);
    this.refreshers.push(() => { select.value = this.get("color"); });
    const set = make("fieldset", { class: "psl-wide" }, make("legend", {}, "Show"));
    for (const key of ["samples", "vertices", "edges", ...(solid ? ["polygons"] : [])]) {
      if (key === "samples" && !header.samples) continue;
      const input = make("input", { type: "checkbox", "data-control": key,
        onchange: () => { this.set(key, input.checked); this.update(); } });
      set.append(make("label", {}, input, key));
      this.refreshers.push(() => { input.checked = this.get(key); });
    }
    const button = (text, label, act, key) => make("button", { type: "button", "aria-label": label, "data-control": key, onclick: act }, text);
    this.controls.append(set, make("div", { class: "psl-bar" },
      button("+", "Zoom in", () => { this.camera.scale(1.25); this.draw(); }, "in"),
      button("−", "Zoom out", () => { this.camera.scale(0.8); this.draw(); }, "out"),
      button("Reset view", "Reset view", () => { this.camera.reset(); this.draw(); }, "reset"),
      button("Save picture", "Save picture as PNG", () => this.save(), "save")));
  }

  /** The slider is finer where most elements go; the field takes any number. Its first step can be "none". */
  thresholdRow() {
    const input = make("input", { type: "range", id: `${this.id}-threshold`, "data-control": "threshold", min: "0",
      max: String(STEPS), step: "1" });
    const field = make("input", { type: "number", min: "0", step: "0.05", "data-control": "threshold-number",
      "aria-label": "Threshold as a multiple of π", placeholder: "none" });
    const scale = () => this.filter.header;
    const first = () => (scale().systematic ? 1 : 0);
    const valueAt = (k) => {
      const share = (k - first()) / (STEPS - first());
      return share < 0 ? -Infinity : (Math.round(1000 * ((scale().largest / PI) * share ** scale().power)) / 1000) * PI;
    };
    const placeOf = (t) => (t === -Infinity ? 0
      : first() + Math.round((STEPS - first()) * clamp(t / scale().largest, 0, 1) ** (1 / scale().power)));
    input.addEventListener("input", () => {
      // Steps that round to the same multiple of π / 1000 would be steps that do nothing.
      let k = Number(input.value), t = valueAt(k);
      const now = this.get("threshold"), up = k > this.place;
      while (t === now && k !== this.place && k > 0 && k < STEPS) { k += up ? 1 : -1; t = valueAt(k); }
      input.value = String(k);
      this.place = k;
      this.set("threshold", t);
      this.update();
    });
    const typed = () => {
      const t = field.value === "" ? -Infinity : Number(field.value) * PI;
      if (Number.isFinite(t) || field.value === "") { this.set("threshold", t); this.update(); }
    };
    field.addEventListener("change", typed);
    this.row("Threshold", input, make("span", {}, field, " π"), true);
    this.refreshers.push(() => {
      const t = this.get("threshold");
      if (valueAt(Number(input.value)) !== t) input.value = String(placeOf(t));
      this.place = Number(input.value);
      input.setAttribute("aria-valuetext", t === -Infinity ? "nothing removed" : multiple(t));
      if (document.activeElement !== field || Number(field.value) * PI !== t) {
        field.value = t === -Infinity ? "" : String(Number((t / PI).toFixed(3)));
      }
    });
  }

  pointer() {
    const canvas = this.canvas, held = new Map();
    const at = (event) => { const r = canvas.getBoundingClientRect(); return [event.clientX - r.left, event.clientY - r.top]; };
    const relative = (x, y) => [(2 * x) / canvas.clientWidth - 1, 1 - (2 * y) / canvas.clientHeight];
    const pan = (dx, dy) => { this.camera.x += (2 * dx) / canvas.clientWidth; this.camera.y -= (2 * dy) / canvas.clientHeight; };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      held.set(event.pointerId, at(event));
      canvas.focus({ preventScroll: true });
    });
    canvas.addEventListener("pointermove", (event) => {
      const before = held.get(event.pointerId);
      if (!before) return;
      const now = at(event), dx = now[0] - before[0], dy = now[1] - before[1];
      if (held.size === 2) {
        const [, other] = [...held].find(([key]) => key !== event.pointerId);
        const distance = (p) => Math.max(Math.hypot(p[0] - other[0], p[1] - other[1]), 1);
        pan(dx / 2, dy / 2);
        this.camera.scale(distance(now) / distance(before), ...relative((now[0] + other[0]) / 2, (now[1] + other[1]) / 2));
      } else if (this.dimension === 2 || event.shiftKey || event.buttons & 6) pan(dx, dy);
      else this.camera.turn(dx * 0.45, dy * 0.45);
      held.set(event.pointerId, now);
      this.draw();
    });
    for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, (event) => held.delete(event.pointerId));
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => {
      if (document.activeElement !== canvas && !event.ctrlKey) return; // the page scrolls on
      event.preventDefault();
      this.camera.scale(Math.exp(-clamp(event.deltaY * (event.deltaMode ? 20 : 1), -120, 120) * 0.0025), ...relative(...at(event)));
      this.draw();
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (step && (this.dimension === 2 || event.shiftKey)) pan(24 * step[0], 24 * step[1]);
      else if (step) this.camera.turn(6 * step[0], 6 * step[1]);
      else if (event.key === "+" || event.key === "=") this.camera.scale(1.15);
      else if (event.key === "-" || event.key === "_") this.camera.scale(1 / 1.15);
      else if (event.key === "Home" || event.key === "0") this.camera.reset();
      else return;
      event.preventDefault();
      event.stopPropagation();
      this.draw();
    });
  }

  follow() {
    const names = ["threshold", "strategy", "variant", "opacity", "simplified", "color", "samples", "vertices", "edges", "polygons"];
    const changed = () => this.update();
    for (const name of names) {
      this.model.on(`change:${name}`, changed);
      this.gone.push(() => this.model.off(`change:${name}`, changed));
    }
  }

  // ------------------------------------------------------------ state

  update() {
    const { filter } = this, threshold = this.get("threshold");
    this.cut = filter.cut(threshold);
    this.shapeCut = Math.round(this.get("simplified") * this.cut);
    if (this.counted?.filter !== filter || this.counted.cut !== this.cut) {
      this.counted = { filter, cut: this.cut, ...filter.counts(this.cut) };
    }
    this.refreshers.forEach((refresh) => refresh());
    const { vertices, edges, polygons, branches } = this.counted, { betti } = filter.header;
    const data = { threshold, strategy: filter.label, variant: this.sceneNow.label, vertices, edges, polygons, branches,
      betti: betti ? betti.join(",") : "", ready: true };
    for (const [key, value] of Object.entries(data)) this.element.dataset[key] = String(value);
    this.tell();
    this.draw();
  }

  /** The line of numbers: seen at once, read aloud when the hand rests. */
  tell() {
    const { betti } = this.filter.header, threshold = this.get("threshold"), filters = this.header.filters;
    const kinds = { vertex: "vertices", edge: "edges", ...(this.dimension === 3 && { polygon: "polygons" }), branch: "branches" };
    const parts = Object.entries(kinds).map(([word, name]) => many(this.counted[name], word));
    const head = !filters ? "" : threshold === -Infinity ? "Nothing removed: " : `Threshold ${multiple(threshold)}: `;
    let text = `${head}${parts.join(", ")}.`;
    if (betti) {
      const words = betti.map((b, k) => many(b, ["piece", "loop", "cavity"][k])).join(", ");
      text += ` Betti numbers ${betti.join(", ")}: ${words}${filters ? ", whatever the threshold" : ""}.`;
    }
    this.status.textContent = text;
    clearTimeout(this.telling);
    this.telling = setTimeout(() => { this.heard.textContent = text; }, 500);
  }

  // ------------------------------------------------------------ picture

  /** Ask for a picture. While pictures follow each other they may be coarser; a fine one follows at rest. */
  draw() {
    this.resting = false;
    clearTimeout(this.rested);
    this.ask();
  }

  ask() {
    if (this.waiting) return;
    this.waiting = requestAnimationFrame(() => { this.waiting = null; if (this.seen) this.paint(); });
  }

  /** The best of LEVELS that takes 40 ms; at rest a better one may take longer. */
  level() {
    const { cost } = this;
    if (this.resting) return cost[0] > 500 ? 1 : 0;
    // Before anything is known, many polygons are tried at a coarse level first.
    const untried = this.counted.polygons > 12000 ? (this.view.fast ? 1 : 2) : 0;
    const fits = LEVELS.findIndex((_, k) => (cost[k] === undefined ? k >= untried : cost[k] <= 40));
    return fits < 0 ? LEVELS.length - 1 : fits;
  }

  paint() {
    const shown = this.canvas, ratio = Math.min(globalThis.devicePixelRatio || 1, 2);
    const width = Math.round(shown.clientWidth * ratio), height = Math.round(shown.clientHeight * ratio);
    if (!width || !height) return;
    const view = (this.view = renderer());
    view.users.add(this);
    if (view.gl.isContextLost()) return;
    if (shown.width !== width || shown.height !== height) Object.assign(shown, { width, height });
    this.buffers ??= new Buffers(view.gl);
    const level = this.level(), { name, scale, samples } = LEVELS[level];
    const w = Math.round(width * scale), h = Math.round(height * scale);
    view.resize(w, h);
    view.begin(samples > 1, w, h);
    new Picture(this, w, h, ratio * scale, level).draw();
    view.end(samples > 1, w, h);
    const context = shown.getContext("2d", { willReadFrequently: !view.fast });
    context.drawImage(view.canvas, 0, view.canvas.height - h, w, h, 0, 0, width, height);
    this.colorBar(context, width, height, ratio);
    this.element.dataset.frames = String(++this.frames);
    this.element.dataset.quality = name;
    if (this.frames === 1) this.element.dataset.firstPicture = performance.now().toFixed(1);
    else view.timed((cost) => { this.cost[level] = cost; this.element.dataset.frameMs = cost.toFixed(1); });
    if (!this.resting && level > 0) {
      this.rested = setTimeout(() => { this.resting = true; this.ask(); }, 250);
    }
  }

  /** Give the memory back while out of sight. */
  rest() { this.buffers?.free(); this.buffers = null; }

  restart() { this.buffers = null; this.draw(); }

  /** The points that the first view must show: samples, or other points of the shape, or the skeleton in its box. */
  outline() {
    if (this.outlined) return this.outlined;
    const places = [], { center, half } = this.camera;
    for (const scene of this.scenes) {
      const source = scene.points.length ? scene.points : scene.vertices;
      const rows = scene.samples ?? Uint32Array.from({ length: source.length / 3 }, (_, i) => i);
      for (const v of rows) {
        const p = [source[3 * v], source[3 * v + 1], source[3 * v + 2]];
        if (scene.points.length || p.every((x, k) => Math.abs(x - center[k]) <= 1.001 * half[k])) places.push(...p);
      }
    }
    return (this.outlined = Float32Array.from(places));
  }

  /** A scale of colours with three numbers, part of the picture so that it is saved with it. */
  colorBar(context, width, height, ratio) {
    const color = this.get("color"), { header, filter } = this;
    if (color === "none") return;
    const w = Math.min(150 * ratio, width * 0.4), h = 9 * ratio, x = 14 * ratio, y = height - 34 * ratio;
    const gradient = context.createLinearGradient(x, 0, x + w, 0);
    header.ramp.forEach((hex, k) => gradient.addColorStop(k / (header.ramp.length - 1), hex));
    context.fillStyle = "rgba(255,255,255,0.75)";
    context.fillRect(x - 10 * ratio, y - 18 * ratio, w + 24 * ratio, 50 * ratio);
    context.fillStyle = gradient;
    context.fillRect(x, y, w, h);
    context.fillStyle = "#222";
    context.font = `${11 * ratio}px system-ui, sans-serif`;
    context.textBaseline = "alphabetic";
    context.textAlign = "left";
    context.fillText(color === "radius" ? "radius of the ball" : "level: goes above this threshold", x, y - 6 * ratio);
    const { largest, power } = filter.header;
    const number = (share) => (color === "radius" ? String(Number((share * header.radius).toPrecision(2)))
      : share === 1 ? `≥ ${Number((largest / PI).toPrecision(2))} π` : `${Number(((largest * share ** power) / PI).toPrecision(2))} π`);
    [0, 0.5, 1].forEach((share) => {
      context.textAlign = ["left", "center", "right"][2 * share];
      context.fillText(number(share), x + share * w, y + h + 13 * ratio);
    });
  }

  save() {
    this.resting = true;
    this.paint();
    this.canvas.toBlob((blob) => {
      const link = make("a", { href: URL.createObjectURL(blob), download: "skeleton.png" });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    });
  }

  close() {
    this.gone.forEach((stop) => stop());
    cancelAnimationFrame(this.waiting);
    clearTimeout(this.telling);
    this.view?.users.delete(this);
    this.rest();
  }
}

/** Whether this browser can show the viewer at all. */
function able() {
  if (typeof DecompressionStream === "undefined") return false;
  try { return Boolean(renderer()); } catch { return false; }
}

function styled() {
  if (document.getElementById("psl-style")) return;
  document.head.append(make("style", { id: "psl-style" }, STYLE));
}

async function render({ model, el }) {
  const root = el.classList.contains("psl-viewer") ? el : el.appendChild(make("div", { class: "psl-viewer" }));
  if (!able()) {
    if (root === el) return undefined;
    root.innerHTML = model.get("strip") ?? "";
    root.append(make("p", {}, "This browser has no WebGL2, so the picture cannot be moved."));
    return undefined;
  }
  styled();
  const header = model.get("scene"), blob = model.get("blob");
  const bytes = typeof blob === "string" ? bytesOf(blob) : new Uint8Array(blob.buffer, blob.byteOffset, blob.byteLength);
  const buffer = await unpacked(bytes);
  const scenes = header.variants.map((variant) => new Scene(buffer, variant, header.dimension));
  root.querySelectorAll(".psl-strip").forEach((strip) => strip.remove());
  const viewer = new Viewer(model, root, scenes);
  return () => viewer.close();
}

/** Stands in for the model of a kernel on a page that has none. */
class PageModel {
  constructor(data) { this.data = data; this.heard = {}; }
  get(name) { return this.data[name]; }
  set(name, value) { this.data[name] = value; (this.heard[`change:${name}`] ?? []).forEach((f) => f()); }
  on(name, f) { (this.heard[name] ??= []).push(f); }
  off(name, f) { this.heard[name] = (this.heard[name] ?? []).filter((g) => g !== f); }
  save_changes() {}
}

/** Mount every viewer of a page that holds its data. Data far down the page wait until the reader comes near. */
function mount(page = document) {
  const near = new IntersectionObserver((entries) => entries.forEach(({ isIntersecting, target }) => {
    if (!isIntersecting) return;
    near.unobserve(target);
    const holder = target.querySelector("script[type='application/json']");
    render({ model: new PageModel(JSON.parse(holder.textContent)), el: target })
      .catch((error) => { target.dataset.error = String(error); console.warn("skeleton viewer:", error); });
  }), { rootMargin: "600px" });
  page.querySelectorAll(".psl-viewer").forEach((root) => {
    if (root.querySelector("script[type='application/json']") && !root.dataset.found) { root.dataset.found = "true"; near.observe(root); }
  });
}

if (typeof document !== "undefined") {
  if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", () => mount());
  else mount();
}

export default { render };
