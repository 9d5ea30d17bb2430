// What is drawn, and in which order.

import { clamp } from "./camera.js";

const BAR = 46; // height of the scale of colours
// Without a graphics card a picture of many polygons takes long; while it moves it may be a coarser one.
export const LEVELS = [
  { name: "smooth", scale: 1, samples: 4 },
  { name: "plain", scale: 1, samples: 1 },
  { name: "half", scale: 0.5, samples: 1 },
  { name: "third", scale: 0.34, samples: 1 },
];
const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);

/** One picture: everything drawn in its order, with what all steps share. */
export class Picture {
  constructor(viewer, width, height, ratio, level) {
    const { view, buffers, camera, palette, cut, shapeCut, counted, filter, sceneNow: scene } = viewer;
    const gl = view.gl, { colors } = palette, color = viewer.get("color");
    Object.assign(this, { viewer, view, gl, buffers, palette, colors, color, cut, shapeCut, counted, filter, scene, ratio });
    this.solid = viewer.dimension === 3;
    this.coarse = LEVELS[level].scale < 1;
    this.fine = LEVELS[level].samples > 1;
    this.opacity = viewer.get("opacity");
    this.clip = this.solid && scene.header.vertices.far ? " CLIP" : "";
    this.grow = ratio * clamp(camera.zoom ** 0.35, 0.8, 2.2); // of lines and dots
    this.skeleton = color === "none" ? this.paint(colors.skeleton) : {};
    // Buffers are made anew when these change.
    this.label = `${scene.label}|${filter.label}`;
    this.stamp = `${this.label}|${color}|${palette.name}`;
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
    gl.clearColor(...rgb(palette.ground), 1);
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
      if (shown("edges") && !this.coarse) this.sides(shown("polygons"));
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
    // Rims of wires and dots have left the picture not quite opaque there: what was on the stage would shine through.
    gl.colorMask(false, false, false, true);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.colorMask(true, true, true, true);
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

  /** The colour of each vertex, four bytes each (the fourth only fills up); made anew only when the stamp changes. */
  values() {
    const { viewer, stamp } = this;
    if (viewer.values?.stamp !== stamp) viewer.values = { stamp, bytes: this.tinted() };
    return viewer.values.bytes;
  }

  tinted() {
    const { scene, filter, color } = this, out = new Uint8Array(4 * scene.count), ramp = this.palette.ramp.map(rgb);
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
    const { beneath } = this.scene;
    if (beneath) this.segments("beneath", this.label, () => beneath, { ...this.paint(this.palette.ink), width: this.ratio });
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

  /** All edges as thin lines: dark ones between polygons, to tell these apart; alone, of the colour of writing. */
  sides(between) {
    this.bindSkeleton();
    this.gl.disableVertexAttribArray(1);
    this.indices("sides", this.label, () => this.filter.sides());
    const alpha = between ? 0.3 * clamp(15000 / this.counted.edges, 0.3, 1) : 0.75;
    this.use("faces", { ...this.paint(between ? "#0d121f" : this.palette.ink), alpha });
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
