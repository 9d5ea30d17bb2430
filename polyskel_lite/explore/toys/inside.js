// The Voronoi graph seen from a shape, and the dual of the triangles in it. Mirrors VoronoiInside of sk1, sk2, sk3, and
// sk0 (skeletons.four_methods).

import { circumballs, delaunay, edgeKey, facetTable, isOrdinary, rayEnd } from "./plane.js";
import { UNIT, orientation, Rational } from "./signs.js";
import { between, boxOf, distanceTo, dot, extentOf, minus } from "./vectors.js";

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
export function footOn([a, b], p) {
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
      const stops = [center, ...found.map((u) => between(center, end, u)), end];
      for (let k = inside[s] ? 0 : 1; k + 1 < stops.length; k += 2) {
        pieces.push({ line: [stops[k], stops[k + 1]], ends: [k ? -1 : s, k + 2 === stops.length ? t : -1] });
      }
    } else {
      const exact = rational(), from = exact.center(simplices[s]);
      const [p, q] = orientation(points[a], points[b], points[apex]) > 0 ? [a, b] : [b, a];
      const part = exact.clip(from, t < 0 ? exact.far(from, p, q) : exact.center(simplices[t]));
      if (part.whole) edges.push([s, t]);
      else for (const { line, first, last } of part.pieces) {
        pieces.push({ line, ends: [first ? s : -1, last ? t : -1] });
      }
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
