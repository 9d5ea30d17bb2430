// What is there to be shown, before anything is removed.

import { positions, read } from "./data.js";
import { Filter } from "./filter.js";

/** One state of the data: its geometry and its hierarchies. */
export class Scene {
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
    this.beneath = get("beneath"); // the outline of the shape that a union of discs approximates
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
