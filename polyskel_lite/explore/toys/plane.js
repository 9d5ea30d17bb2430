// The plane's geometry for pages without a kernel: samples, their graphs, what a shape sees of them, maximal balls.
// Points are [x, y], segments pairs of points, facets pairs of indices; every sign is right.
// Mirrors polyskel_lite: delaunay, gabriel_mask, Tessellation (graphs); VoronoiInside of sk1, sk2, sk3 and sk0
// (skeletons.four_methods); Shape.sample, .covering_radius; grown_ball and contact_points (skeletons.maximal_balls);
// exact.first_meeting is polygonCrosses here.

import { UNIT, orientation, inBall, inGabrielBall, Rational } from "./signs.js";
import { between, distanceTo, dot, extentOf, minus } from "./vectors.js";

/** Two vertices in either order as one number. */
export const edgeKey = (a, b) => (a < b ? a * 2 ** 26 + b : b * 2 ** 26 + a);

/** Whether products of four coordinates are ordinary floats. Others are left to whole numbers. */
const isOrdinary = (extent) => extent > 1e-60 && extent < 1e60;

/** The box of a segment: left, low, right, high. */
const boxOf = ([[ax, ay], [bx, by]]) => [Math.min(ax, bx), Math.min(ay, by), Math.max(ax, bx), Math.max(ay, by)];
const overlap = (a, b) => a[0] <= b[2] && b[0] <= a[2] && a[1] <= b[3] && b[1] <= a[3];

// --- the Delaunay tessellation -----------------------------------------------------------------------

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

// --- the Voronoi graph seen from a shape -------------------------------------------------------------

/** +1 if p is inside the closed segments, 0 on one, -1 outside: by the crossings of its ray to the right. */
export function locate(segments, p) {
  let inside = false;
  for (const [a, b] of segments) {
    if ((a[1] > p[1]) !== (b[1] > p[1])) {
      const side = a[1] < b[1] ? orientation(a, b, p) : orientation(b, a, p);
      if (side === 0) return 0;
      if (side > 0) inside = !inside;
    } else if (a[1] === p[1] && b[1] === p[1]) {
      if (Math.min(a[0], b[0]) <= p[0] && p[0] <= Math.max(a[0], b[0])) return 0;
    } else if ((a[0] === p[0] && a[1] === p[1]) || (b[0] === p[0] && b[1] === p[1])) return 0;
  }
  return inside ? 1 : -1;
}

/** The point of a segment that is nearest to p. */
function footOn([a, b], p) {
  const way = minus(b, a);
  return between(a, b, Math.min(1, Math.max(0, dot(minus(p, a), way) / dot(way, way))));
}

/** How far a point is from a segment. */
export const distance = (p, segment) => distanceTo(p, footOn(segment, p));

/**
 * Where the way from a to b meets segments, as shares of it; its ends are known to `slack`. Null if rounding leaves a
 * doubt.
 */
function cuts(segments, [ax, ay], [bx, by], slack) {
  const found = [], dx = bx - ax, dy = by - ay, long = Math.hypot(dx, dy);
  for (const [[px, py], [qx, qy]] of segments) {
    const ex = qx - px, ey = qy - py, wide = Math.hypot(ex, ey);
    const span = long + wide + Math.hypot(px - ax, py - ay);
    const blur = 2 * slack + 64 * UNIT * span, tilt = blur * (1 + (2 * span) / long);
    const a = (ex * (ay - py) - ey * (ax - px)) / wide, b = (ex * (by - py) - ey * (bx - px)) / wide;
    const apart = Math.abs(a) > blur && Math.abs(b) > blur;
    if (apart && a * b > 0) continue;
    const p = (dx * (py - ay) - dy * (px - ax)) / long, q = (dx * (qy - ay) - dy * (qx - ax)) / long;
    const split = Math.abs(p) > tilt && Math.abs(q) > tilt;
    if (split && p * q > 0) continue;
    if (!(apart && split)) return null;
    found.push(a / (a - b));
  }
  return found.sort((u, v) => u - v);
}

/**
 * The Voronoi graph of samples seen from a shape: `balls` of the triangles, the `table` of edges, which triangles have
 * their centre `inside` (Sk1), pairs of triangles whose Voronoi `edges` are wholly inside (Sk2), and the `pieces` of
 * the others that are inside (with these, Sk3). `doubts` were decided by whole numbers.
 */
export function voronoiInShape(segments, tessellation) {
  const { points, simplices } = tessellation, extent = Math.max(extentOf(points), extentOf(segments.flat()));
  const balls = circumballs(tessellation), table = facetTable(tessellation);
  const boxes = Float64Array.from(segments.flatMap(boxOf));
  const near = ([left, low, right, high]) => segments.filter((_, k) =>
    boxes[4 * k + 1] <= high && boxes[4 * k + 3] >= low && boxes[4 * k] <= right && boxes[4 * k + 2] >= left);
  let doubts = 0, made = null;
  const rational = () => { doubts += 1; made ??= new Rational(segments, points); return made; };
  const sure = (error) => isOrdinary(extent) && Number.isFinite(error);
  const inside = balls.map(({ center, error }, t) => {
    const most = 2 * error + 64 * UNIT * extent, [x, y] = center;
    if (sure(error)) {
      const level = near([x - most, y - most, Infinity, y + most]);
      if (level.every((s) => distance(center, s) > most)) return locate(level, center) > 0;
    }
    const exact = rational();
    return exact.contains(exact.center(simplices[t]));
  });
  const edges = [], pieces = [];
  for (const { ends: [a, b], sides: [s, t], apexes: [apex] } of table) {
    const { center, error } = balls[s];
    const end = t < 0 ? rayEnd(tessellation, [a, b], s, balls[s], extent) : balls[t].center;
    const slack = Math.max(error, balls[t]?.error ?? 0), [left, low, right, high] = boxOf([center, end]);
    const level = near([left - slack, low - slack, right + slack, high + slack]);
    const found = sure(slack) ? cuts(level, center, end, slack) : null;
    if (found && !found.length) {
      if (inside[s] && t >= 0) edges.push([s, t]);
    } else if (found) {
      const stops = [center, ...found.map((t) => between(center, end, t)), end];
      for (let k = inside[s] ? 0 : 1; k + 1 < stops.length; k += 2) {
        pieces.push({ line: [stops[k], stops[k + 1]], ends: [k ? -1 : s, k + 2 === stops.length ? t : -1] });
      }
    } else {
      const exact = rational(), from = exact.center(simplices[s]);
      const [p, q] = orientation(points[a], points[b], points[apex]) > 0 ? [a, b] : [b, a];
      const part = exact.clip(from, t < 0 ? exact.far(from, p, q) : exact.center(simplices[t]));
      if (part.whole) edges.push([s, t]);
      else for (const { line, first, last } of part.pieces) pieces.push({ line, ends: [first ? s : -1, last ? t : -1] });
    }
  }
  return { balls, table, inside, edges, pieces, doubts };
}

/** Sk0: pairs of inner triangles that share an edge. Facets that are not Delaunay are `missing`; null as `delaunay`. */
export function sk0(points, facets) {
  const tessellation = delaunay(points, facets);
  if (!tessellation) return null;
  const table = facetTable(tessellation), walls = new Set(facets.map(([a, b]) => edgeKey(a, b)));
  const there = new Set(table.map(({ ends: [a, b] }) => edgeKey(a, b)));
  const missing = facets.filter(([a, b]) => !there.has(edgeKey(a, b)));
  if (missing.length) return { tessellation, table, inner: null, edges: [], missing };
  const { simplices, neighbors } = tessellation, inner = simplices.map(() => null), todo = [];
  const enter = (t, within) => { if (inner[t] === null) { inner[t] = within; todo.push(t); } };
  for (const { ends: [a, b], sides: [s, t] } of table) if (t < 0) enter(s, walls.has(edgeKey(a, b)));
  while (todo.length) {
    const t = todo.pop();
    neighbors[t].forEach((s, i) => {
      if (s < 0) return;
      const wall = walls.has(edgeKey(simplices[t][(i + 1) % 3], simplices[t][(i + 2) % 3]));
      enter(s, wall ? !inner[t] : inner[t]);
    });
  }
  const edges = table.map(({ sides }) => sides).filter(([s, t]) => t >= 0 && inner[s] && inner[t]);
  return { tessellation, table, inner, edges, missing };
}

// --- samples of a boundary ---------------------------------------------------------------------------

/** n samples at equal distances along the rings, shared by length, ring by ring; null if there are fewer than three a ring. */
export function sampleRings(rings, n, start = 0) {
  if (n < 3 * rings.length) return null;
  const along = rings.map((ring) => {
    const reach = [0];
    ring.forEach((p, k) => { reach.push(reach[k] + distanceTo(p, ring[(k + 1) % ring.length])); });
    return reach;
  });
  const lengths = along.map((reach) => reach[reach.length - 1]), total = lengths.reduce((a, b) => a + b);
  // Largest remainders: the shares are fair and sum to n.
  const ideal = lengths.map((length) => (n * length) / total), share = ideal.map((x) => Math.max(3, Math.floor(x)));
  for (let left = n - share.reduce((a, b) => a + b); left !== 0; left -= Math.sign(left)) {
    const gain = ideal.map((x, k) => (left < 0 && share[k] <= 3 ? -Infinity : Math.sign(left) * (x - share[k])));
    share[gain.indexOf(gain.reduce((a, b) => Math.max(a, b)))] += Math.sign(left);
  }
  return rings.map((ring, r) => Array.from({ length: share[r] }, (_, i) => {
    const reach = along[r], length = lengths[r], at = ((((i + start) * length) / share[r]) % length + length) % length;
    const k = Math.min(reach.findLastIndex((x) => x <= at), ring.length - 1);
    return between(ring[k], ring[(k + 1) % ring.length], (at - reach[k]) / (reach[k + 1] - reach[k]));
  }));
}

/** The largest distance from a point of the segments to the nearest sample, right to 1e-9 of itself. */
export function coveringRadius(segments, E) {
  const nearest = ([x, y], some) => {
    let least = Infinity;
    for (const p of some) least = Math.min(least, (p[0] - x) * (p[0] - x) + (p[1] - y) * (p[1] - y));
    return Math.sqrt(least);
  };
  const coarse = 32 * UNIT * extentOf(segments.flat());
  let best = segments.reduce((most, [a]) => Math.max(most, nearest(a, E)), 0);
  let todo = segments.map(([a, b]) => ({ a, b, some: E }));
  while (todo.length) {
    const pieces = todo.map(({ a, b, some }) => {
      const middle = between(a, b, 0.5);
      return { a, b, some, middle, far: nearest(middle, some), reach: distanceTo(a, b) / 2 };
    });
    best = pieces.reduce((most, { far }) => Math.max(most, far), best);
    // The distance to the samples changes by at most the way walked: other pieces cannot beat the best, and on these
    // only samples that are near enough to the middle count.
    todo = pieces.filter(({ far, reach }) => far + reach > best * (1 + 1e-9) + coarse)
      .flatMap(({ a, b, some, middle, far, reach }) => {
        const close = some.filter((p) => distanceTo(p, middle) <= (far + 2 * reach) * (1 + 1e-9));
        return [{ a, b: middle, some: close }, { a: middle, b, some: close }];
      });
  }
  return best;
}

/** The first two facets that meet elsewhere than at a common end, as [i, j]; null if there are none. */
export function polygonCrosses(points, facets) {
  const boxes = facets.map(([a, b]) => boxOf([points[a], points[b]]));
  const sides = ([a, b], [c, d]) =>
    orientation(points[a], points[b], points[c]) * orientation(points[a], points[b], points[d]);
  const meet = (e, f) => {
    const common = e.find((v) => f.includes(v));
    if (common === undefined) return sides(e, f) <= 0 && sides(f, e) <= 0;
    const p = points[e.find((v) => v !== common)], q = points[f.find((v) => v !== common)], c = points[common];
    return p === q || (orientation(c, p, q) === 0 && inGabrielBall(p, q, c) < 0);
  };
  for (let i = 0; i < facets.length; i += 1) {
    const j = facets.findIndex((other, k) => k > i && overlap(boxes[i], boxes[k]) && meet(facets[i], other));
    if (j >= 0) return [i, j];
  }
  return null;
}

// --- maximal balls -----------------------------------------------------------------------------------

const feetOf = (segments, p) => segments.map((segment) => {
  const foot = footOn(segment, p);
  return { foot, far: distanceTo(p, foot) };
});

/** The radius of the ball around a place inside; centre and radius (`full`) of the maximal ball that touches there. */
export function grow(segments, place) {
  const nearest = (p) => feetOf(segments, p).reduce((best, one) => (one.far < best.far ? one : best));
  const { foot, far: radius } = nearest(place), away = minus(place, foot).map((x) => x / radius);
  const at = (r) => [foot[0] + r * away[0], foot[1] + r * away[1]];
  // A ball that is too large has a nearest boundary point; the next one goes through that.
  let full = 4 * extentOf(segments.flat().map((p) => minus(p, foot)));
  for (let tries = 0; tries < 100; tries += 1) {
    const { foot: next, far } = nearest(at(full)), way = minus(next, foot);
    const smaller = dot(way, way) / (2 * dot(way, away));
    if (far >= full * (1 - 1e-12) || !(smaller > 0 && smaller < full)) break;
    full = smaller;
  }
  full = Math.max(radius, full);
  return { radius, center: at(full), full };
}

/** The points of the boundary that a ball inside touches, each once. */
export function contacts(segments, center, radius) {
  const kept = [];
  for (const { foot, far } of feetOf(segments, center)) {
    // Two sides share the corner in which they touch the ball.
    if (far <= radius * (1 + 1e-6) && kept.every((other) => distanceTo(other, foot) > 1e-3 * radius)) kept.push(foot);
  }
  return kept;
}
