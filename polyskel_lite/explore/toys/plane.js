// The plane's geometry for pages without a kernel: samples and their graphs. Points are [x, y], segments pairs of
// points, facets pairs of indices; every sign is right. Mirrors delaunay, gabriel_mask, Tessellation (graphs).

import { UNIT, orientation, inBall, inGabrielBall, Rational } from "./signs.js";
import { distanceTo, extentOf, minus } from "./vectors.js";

/** Two vertices in either order as one number. */
export const edgeKey = (a, b) => (a < b ? a * 2 ** 26 + b : b * 2 ** 26 + a);

/** Whether products of four coordinates are ordinary floats. Others are left to whole numbers. */
export const isOrdinary = (extent) => extent > 1e-60 && extent < 1e60;

/** Triangles, counter-clockwise, and the one opposite each corner (-1: none). */
class Triangles {
  constructor(points, rank) { this.points = points; this.rank = rank; this.simplices = []; this.neighbors = []; }

  add(a, b, c) {
    this.neighbors.push([-1, -1, -1]);
    return this.simplices.push([a, b, c]) - 1;
  }

  join(s, i, t, j) { this.neighbors[s][i] = t; this.neighbors[t][j] = s; }

  /** The corner of the triangle across from corner i of t. */
  apex(t, i) {
    const s = this.neighbors[t][i];
    return s < 0 ? -1 : this.simplices[s][this.neighbors[s].indexOf(t)];
  }

  /** Whether the apex across is inside the ball of t, 0 on it. */
  side(t, apex) {
    const [a, b, c] = this.simplices[t], p = this.points;
    return inBall(p[a], p[b], p[c], p[apex]);
  }

  /** Give the two triangles on both sides of an edge the other diagonal: t then has corner i, b and the apex. */
  flip(t, i) {
    const T = this.simplices, N = this.neighbors, s = N[t][i], j = N[s].indexOf(t);
    const a = T[t][i], b = T[t][(i + 1) % 3], c = T[t][(i + 2) % 3], d = T[s][j];
    const ca = N[t][(i + 1) % 3], ab = N[t][(i + 2) % 3], bd = N[s][(j + 1) % 3], dc = N[s][(j + 2) % 3];
    T[t] = [a, b, d]; N[t] = [bd, s, ab];
    T[s] = [a, d, c]; N[s] = [dc, ca, t];
    if (bd >= 0) N[bd][N[bd].indexOf(s)] = t;
    if (ca >= 0) N[ca][N[ca].indexOf(t)] = s;
  }

  /**
   * Flip edges until no ball has a sample inside. Of cocircular samples the first from the left (then from below) gets
   * all diagonals, as in the library; edges in `fixed` stay.
   */
  settle(fixed) {
    const T = this.simplices, { rank } = this, tied = new Set();
    const todo = T.flatMap((_, t) => [t, t, t]), corner = todo.map((_, k) => k % 3);
    while (todo.length) {
      const t = todo.pop(), i = corner.pop(), d = this.apex(t, i);
      if (d < 0) continue;
      const side = this.side(t, d);
      if (side < 0) continue;
      const s = this.neighbors[t][i], a = T[t][i], b = T[t][(i + 1) % 3], c = T[t][(i + 2) % 3];
      if (side === 0) {
        for (const v of [a, b, c, d]) tied.add(v);
        if (Math.min(rank[a], rank[d]) > Math.min(rank[b], rank[c]) || fixed.has(edgeKey(b, c))) continue;
      }
      this.flip(t, i);
      todo.push(t, t, s, s);
      corner.push(0, 2, 0, 1);
    }
    return tied;
  }

  /** Join a and b by another tessellation of cocircular samples, if there is one. */
  connect(a, b, fixed) {
    const p = this.points, T = this.simplices;
    const toward = (t) => {
      const i = T[t].indexOf(a), c = T[t][(i + 1) % 3], d = T[t][(i + 2) % 3];
      return i >= 0 && (c === b || d === b || (orientation(p[a], p[c], p[b]) > 0 && orientation(p[a], p[b], p[d]) > 0));
    };
    let t = T.findIndex((_, k) => toward(k));
    while (t >= 0 && !T[t].includes(b)) {
      const i = T[t].indexOf(a), s = this.neighbors[t][i], d = this.apex(t, i);
      if (d < 0 || this.side(t, d) !== 0 || fixed.has(edgeKey(T[t][(i + 1) % 3], T[t][(i + 2) % 3]))) return;
      this.flip(t, i);
      t = toward(t) ? t : s;
    }
    if (t >= 0) fixed.add(edgeKey(a, b));
  }
}

/**
 * The Delaunay tessellation of points; where cocircular ones leave a choice, with these facets. Null if there is none:
 * fewer than three points, two at one place, or all on a line.
 */
export function delaunay(points, facets = []) {
  const order = [...points.keys()].sort((i, j) => points[i][0] - points[j][0] || points[i][1] - points[j][1]);
  const same = (v, k) => k > 0 && points[v].every((x, axis) => x === points[order[k - 1]][axis]);
  const turned = (a, b, c) => orientation(points[a], points[b], points[c]);
  const first = order.findIndex((v, k) => k > 1 && turned(order[0], order[1], v) !== 0);
  if (first < 0 || order.some(same)) return null;
  const rank = new Int32Array(points.length);
  order.forEach((v, k) => { rank[v] = k; });
  const all = swept(points, order, first, rank), fixed = new Set(), tied = all.settle(fixed);
  const wanted = facets.filter(([a, b]) => tied.has(a) && tied.has(b))
    .map(([a, b]) => (rank[a] < rank[b] ? [a, b] : [b, a]))
    .sort((e, f) => rank[e[0]] - rank[f[0]] || rank[e[1]] - rank[f[1]]);
  for (const [a, b] of wanted) all.connect(a, b, fixed);
  if (wanted.length) all.settle(fixed);
  return { points, simplices: all.simplices, neighbors: all.neighbors };
}

/** Some triangulation: points from left to right, each joined to the part of the hull that it sees. */
function swept(points, order, first, rank) {
  const all = new Triangles(points, rank), next = [], previous = [], beside = []; // beside: the triangle on v, next[v]
  const link = (a, b, t) => { next[a] = b; previous[b] = a; beside[a] = t; };
  const apex = order[first], run = order.slice(0, first);
  if (orientation(points[run[0]], points[run[1]], points[apex]) < 0) run.reverse();
  run.slice(1).forEach((v, k) => {
    const t = all.add(run[k], v, apex);
    link(run[k], v, t);
    if (k) all.join(t - 1, 0, t, 1);
  });
  link(run[first - 1], apex, all.simplices.length - 1);
  link(apex, run[0], 0);
  for (let k = first + 1; k < order.length; k += 1) {
    const p = order[k], sees = (v) => orientation(points[v], points[next[v]], points[p]) < 0;
    let from = order[k - 1], to = from, last = -1; // it sees an edge at the point before it
    while (sees(previous[from])) from = previous[from];
    while (sees(to)) to = next[to];
    const start = all.simplices.length;
    for (let v = from; v !== to; v = next[v]) {
      const t = all.add(next[v], v, p), s = beside[v], i = (all.simplices[s].indexOf(v) + 2) % 3;
      all.join(t, 2, s, i);
      if (last >= 0) all.join(t, 0, last, 1);
      last = t;
    }
    link(from, p, start);
    link(p, to, last);
  }
  return all;
}

/** The balls of the triangles; a centre is within `error` of the true one. */
export function circumballs({ points, simplices }) {
  const ordinary = isOrdinary(extentOf(points));
  let whole = null;
  return simplices.map((corners) => {
    const [p, q, s] = corners.map((v) => points[v]), [ax, ay] = minus(q, p), [bx, by] = minus(s, p);
    const A = ax * ax + ay * ay, B = bx * bx + by * by, twice = 2 * (ax * by - ay * bx);
    const size = Math.sqrt(A) * Math.sqrt(B);
    // Of a thin triangle rounding would move, or lose, the centre.
    if (!ordinary || !(Math.abs(twice) > 1e-6 * size)) {
      whole ??= new Rational([], points);
      const center = whole.place(whole.center(corners)), r = Math.hypot(...minus(center, p));
      return { center, r, error: 8 * UNIT * (extentOf([center]) + r) };
    }
    const x = (by * A - ay * B) / twice, y = (ax * B - bx * A) / twice, r = Math.hypot(x, y);
    const center = [p[0] + x, p[1] + y];
    const error = (64 * UNIT * (Math.sqrt(Math.max(A, B)) + r) * size) / Math.abs(twice);
    return { center, r, error: error + 8 * UNIT * (extentOf([center]) + r) };
  });
}

/** Every edge once: its ends, the triangles on its sides and their apexes (-1: none). */
export function facetTable({ simplices, neighbors }) {
  return simplices.flatMap((corners, t) => corners.flatMap((v, i) => {
    const s = neighbors[t][i], a = corners[(i + 1) % 3], b = corners[(i + 2) % 3];
    if (s >= 0 && s < t) return [];
    const apex = s < 0 ? -1 : simplices[s][neighbors[s].indexOf(t)];
    return [{ ends: a < b ? [a, b] : [b, a], sides: [t, s], apexes: [v, apex] }];
  }));
}

/** Which rows of the table are Gabriel edges: no other sample in their ball, if closed not even on it. */
export function gabrielMask({ points }, table, closed = true) {
  const limit = closed ? 0 : 1;
  return table.map(({ ends: [a, b], apexes }) =>
    apexes.every((v) => v < 0 || inGabrielBall(points[a], points[b], points[v]) < limit));
}

/** A point far outside on the Voronoi ray of an edge of the hull, which begins at the centre of triangle s. */
export function rayEnd({ points, simplices }, [a, b], s, { center }, extent = extentOf(points)) {
  const p = points[a], q = points[b], apex = points[simplices[s].find((v) => v !== a && v !== b)];
  const way = 8 * Math.max(extent, extentOf([center])) * (orientation(p, q, apex) > 0 ? 1 : -1) / distanceTo(p, q);
  return [center[0] + way * (q[1] - p[1]), center[1] - way * (q[0] - p[0])];
}

/** The Voronoi edges as segments; unbounded ones leave every picture. */
export const voronoiEdges = (tessellation, balls, table) => table.map(({ ends, sides: [s, t] }) =>
  [balls[s].center, t < 0 ? rayEnd(tessellation, ends, s, balls[s]) : balls[t].center]);

/** For each of some things one of those that it is linked to, the same for all of them. */
export function groupsOf(count, links) {
  const parent = Array.from({ length: count }, (_, v) => v);
  const root = (v) => { while (parent[v] !== v) v = parent[v] = parent[parent[v]]; return v; };
  for (const [a, b] of links) parent[root(a)] = root(b);
  return parent.map((_, v) => root(v));
}

/** Betti numbers of a graph: pieces and loops. */
export function bettiOf(count, edges) {
  const pieces = new Set(groupsOf(count, edges)).size;
  return [pieces, edges.length - count + pieces];
}
