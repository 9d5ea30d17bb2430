// From the box of the data to the screen.

export const PI = Math.PI;
const product = (a, b) => {
  const out = new Float32Array(16);
  for (let c = 0; c < 4; c++) for (let r = 0; r < 4; r++) {
    for (let k = 0; k < 4; k++) out[4 * c + r] += a[4 * k + r] * b[4 * c + k];
  }
  return out;
};
export const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

/** Where the reader looks from. */
export class Camera {
  constructor(dimension, low, high, view) {
    this.flat = dimension === 2;
    this.view = view;
    this.center = low.map((l, k) => (l + high[k]) / 2);
    this.radius = Math.hypot(...low.map((l, k) => high[k] - l)) / 2 || 1;
    this.half = low.map((l, k) => (high[k] - l) / 2);
    if (this.flat) { this.center.push(0); this.half.push(0); }
    this.rise = 0; // how far the middle of the free part of the stage is above that of the stage
    this.reset();
  }

  reset() { this.azimuth = this.view.azim; this.elevation = this.view.elev; this.zoom = 1; this.x = 0; this.y = 0; }

  place() { const { azimuth, elevation, zoom, x, y } = this; return { azimuth, elevation, zoom, x, y }; }

  stand(place) { Object.assign(this, place); }

  turn(dx, dy) { this.azimuth -= dx; this.elevation = clamp(this.elevation + dy, -89.9, 89.9); }

  /** Zoom so that the place (px, py), from -1 to 1, stays under the pointer; without one, the middle of the free part. */
  scale(factor, px = 0, py = this.rise) {
    const before = this.zoom;
    this.zoom = clamp(this.zoom * factor, 0.3, 60);
    factor = this.zoom / before;
    this.x = px + (this.x - px) * factor;
    this.y = py - this.rise + (this.y - py + this.rise) * factor;
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
    this.rise = 1 - free;
    const x = this.x - lens.x * f, y = this.y + this.rise - lens.y * f;
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
