// Unions of a few discs, {c: [x, y], r}: arcs and singular points of the boundary, exact skeleton (appendix A).
// Mirrors polyskel_lite.polyballs in the plane, with its tolerances: pairs, discs, incidence, generating, power,
// skeleton.

import { bettiOf, circumballs, delaunay, edgeKey, facetTable, groupsOf } from "./plane.js";
import { between, distanceTo, dot, extentOf, minus } from "./vectors.js";

const TURN = 2 * Math.PI;
// As in polyballs.pairs: what rounding may change, what a ball is believed to, which points are on a circle.
const ROUNDING = 2 ** -49, SWALLOWED = 1e-10, PRECISION = 1e-12, WORST = 1e-6, ON = 1e-9;
// Voronoi vertices nearer than this share of their radius are one; so much may a vector miss a cone.
const SAME = 1e-9, CONE = 1e-9, FLAT = 1e-8;

const rounding = (...balls) => ROUNDING * balls.reduce((sum, { c, r }) => sum + extentOf([c]) + r, 0);
const believed = (a, b) => PRECISION * Math.min(a.r, b.r) + rounding(a, b);
const gap = (a, b) => distanceTo(a.c, b.c) - a.r - b.r;
const cross = (u, v) => u[0] * v[1] - u[1] * v[0];
const unitOf = (v) => [v[0] / Math.hypot(...v), v[1] / Math.hypot(...v)];
const onCircle = ({ c, r }, angle) => [c[0] + r * Math.cos(angle), c[1] + r * Math.sin(angle)];
const turned = (angle) => ((angle % TURN) + TURN) % TURN;
const pairsOf = (list) => list.flatMap((a, k) => list.slice(k + 1).map((b) => [a, b]));

/** The discs that are not equal, up to rounding, to one before them. */
function distinct(balls) {
  const rows = [];
  balls.forEach(({ c, r }, i) => {
    const equal = (j) => distanceTo(c, balls[j].c) + Math.abs(r - balls[j].r) <= PRECISION * Math.min(r, balls[j].r);
    if (!rows.some(equal)) rows.push(i);
  });
  return rows;
}

/** Which of two discs lies in the other one, up to rounding; of equal ones the second. */
function swallowed(balls, i, j) {
  const [small, large] = balls[i].r < balls[j].r ? [i, j] : [j, i], s = balls[small], l = balls[large];
  return distanceTo(s.c, l.c) + s.r - l.r <= SWALLOWED * s.r + rounding(s, l) ? [small] : [];
}

/** The part of the circle of a that is in b: from start to start + width, known to an error; angles. */
function cover(a, b) {
  const across = minus(b.c, a.c), d = Math.hypot(...across);
  // Half-angle formula: near tangency the law of cosines would lose half of the digits.
  const above = Math.max((b.r - d + a.r) * (b.r + d - a.r), 0), below = Math.max((d + a.r - b.r) * (d + a.r + b.r), 0);
  const half = 2 * Math.atan2(Math.sqrt(above), Math.sqrt(below)), known = PRECISION * (a.r + b.r) + rounding(a, b);
  const sine = (Math.sqrt(above) * Math.sqrt(below)) / (2 * a.r * b.r);
  const error = Math.min(known / sine, Math.max(WORST * Math.min(a.r, b.r), known)) / a.r;
  return { start: Math.atan2(across[1], across[0]) - half, width: 2 * half, error };
}

/** What covered parts leave of a circle: arcs {start, end, errors}. */
function uncovered(covers) {
  if (!covers.length) return [{ start: -Math.PI, end: Math.PI, errors: [0, 0] }];
  const origin = covers[0].start - covers[0].error;
  // Once around, from the start of one part to it again; widened by their errors, so that no gap is mere rounding.
  const parts = covers.flatMap(({ start, width, error }, k) => {
    const from = turned(start - origin), over = from + width + error > TURN ? [-TURN] : [];
    return [0, ...over, ...(k ? [] : [TURN])].map((t) => ({ from: from + t, to: from + width + t, error }));
  }).sort((a, b) => a.from - a.error - b.from + b.error);
  const arcs = [];
  let last = parts[0];
  for (const part of parts.slice(1)) {
    if (part.from - part.error > last.to + last.error) {
      const start = turned(origin + last.to + Math.PI) - Math.PI;
      arcs.push({ start, end: start + part.from - last.to, errors: [last.error, part.error] });
    }
    if (part.to + part.error > last.to + last.error) last = part;
  }
  return arcs.sort((a, b) => a.start - b.start);
}

/** Groups of points linked by distances up to `reach(i, j)`, the first one by `better` in front. */
function merged(points, reach, better) {
  const near = ([i, j]) => distanceTo(points[i], points[j]) <= reach(i, j);
  const groups = groupsOf(points.length, pairsOf([...points.keys()]).filter(near));
  const found = new Map();
  groups.forEach((group, k) => {
    const others = found.get(group) ?? [];
    found.set(group, others.length && !better(k, others[0]) ? [...others, k] : [k, ...others]);
  });
  return [...found.values()].sort(([i], [j]) => i - j);
}

/** Where two discs that touch from outside do so on the boundary, or null. */
function contact(balls, rows, i, j) {
  const [a, b] = [balls[i], balls[j]], slack = believed(a, b), p = between(a.c, b.c, a.r / (a.r + b.r));
  if (gap(a, b) > slack) return null;
  const through = [];
  for (const ball of rows.map((k) => balls[k])) {
    const out = distanceTo(p, ball.c) - ball.r, error = slack + PRECISION * ball.r + rounding(ball, ball);
    if (out < -error) return null;
    if (out <= error) through.push(unitOf(minus(ball.c, p)));
  }
  // Only the common tangent is free; a step along it leaves the discs that are not ahead.
  const [x, y] = unitOf(minus(b.c, p)), free = (way) => through.every((toward) => dot(way, toward) <= 1e-9);
  return through.length < 3 || free([-y, x]) || free([y, -x]) ? p : null;
}

/** The boundary of the union: arcs [disc, start, end], singular points, pairs that touch on it; the area. */
export function union(balls) {
  const rows = distinct(balls), pairs = pairsOf(rows);
  const gone = new Set(pairs.flatMap(([i, j]) => swallowed(balls, i, j)));
  const left = pairs.filter(([i, j]) => !gone.has(i) && !gone.has(j));
  const crosses = ([i, j]) => gap(balls[i], balls[j]) < -believed(balls[i], balls[j]);
  // Of what is within rounding the first part around a circle decides: the library's order, small discs first.
  const octave = (i) => Math.floor(Math.log2(balls[i].r)), kept = rows.filter((i) => !gone.has(i));
  const bySize = [...kept].sort((i, j) => octave(i) - octave(j));
  const covers = kept.map((i) => [...bySize.filter((j) => j > i), ...bySize.filter((j) => j < i)]
    .filter((j) => crosses([Math.min(i, j), Math.max(i, j)])).map((j) => cover(balls[i], balls[j])));
  const arcs = [], ends = [], errors = [], touching = [];
  kept.forEach((i, row) => {
    for (const arc of uncovered(covers[row])) {
      arcs.push([i, arc.start, arc.end]);
      if (arc.end - arc.start < TURN) [arc.start, arc.end].forEach((angle, k) => {
        const p = onCircle(balls[i], angle);
        ends.push(p);
        errors.push(arc.errors[k] * balls[i].r + ROUNDING * (extentOf([p]) + balls[i].r));
      });
    }
  });
  for (const [i, j] of left.filter((pair) => !crosses(pair))) {
    const p = contact(balls, rows, i, j);
    if (p) { touching.push([i, j]); ends.push(p); errors.push(0); }
  }
  const groups = merged(ends, (i, j) => errors[i] + errors[j], (i, j) => errors[i] < errors[j]);
  const singular = groups.map(([k]) => ends[k]);
  return { rows, arcs, singular, touching, area: areaOf(balls, arcs) };
}

/** By Green: half the integral of x dy - y dx along the arcs, seen from the first disc. */
function areaOf(balls, arcs) {
  return arcs.reduce((sum, [i, start, end]) => {
    const { c, r } = balls[i], [x, y] = minus(c, balls[0].c);
    const swing = x * (Math.sin(end) - Math.sin(start)) - y * (Math.cos(end) - Math.cos(start));
    return sum + (r * (r * (end - start) + swing)) / 2;
  }, 0);
}

// --- definitions 1 to 3 ------------------------------------------------------------------------------

/** Radius of the largest disc around a point in a union, negative if the point is not in it. */
function roomIn(balls, p) {
  if (!balls.some(({ c, r }) => distanceTo(c, p) <= r)) return -1;
  return union(balls).arcs.reduce((least, [i, start, end]) => {
    const { c, r } = balls[i], [x, y] = minus(p, c), d = Math.hypot(x, y);
    const near = d === 0 || turned(Math.atan2(y, x) - start) <= end - start ? Math.abs(d - r) : Infinity;
    return Math.min(least, near, ...[start, end].map((angle) => distanceTo(onCircle(balls[i], angle), p)));
  }, Infinity);
}

/** Discs that generate the union, none of which can be left out (definition 1); the smallest ones go first. */
export function generating(balls, { rows, arcs }) {
  const exposed = new Set(arcs.map(([i]) => i));
  let kept = rows;
  for (const i of kept.filter((k) => !exposed.has(k)).sort((a, b) => balls[a].r - balls[b].r)) {
    const others = kept.filter((j) => j !== i), ball = balls[i];
    if (roomIn(others.map((j) => balls[j]), ball.c) >= (1 - 1e-9) * ball.r) kept = others;
  }
  return kept;
}

/** Of generating discs those that meet no other one (definition 2). */
export function disconnected(balls, kept) {
  const meets = (i, j) => gap(balls[i], balls[j]) <= rounding(balls[i], balls[j]);
  return kept.filter((i) => !kept.some((j) => j !== i && meets(i, j)));
}

/** Pairs of generating discs that cross on the boundary and whose common part meets no third one (definition 3). */
export function quasiDisconnected(balls, kept, { rows, singular }) {
  const through = singular.map((p) => discsAt(balls, rows, p));
  return pairsOf(kept).filter(([i, j]) => through.filter((on) => on.includes(i) && on.includes(j)).length > 1)
    .filter(([i, j]) => kept.every((k) => k === i || k === j ||
      distanceToLens(balls[k].c, balls[i], balls[j]) > balls[k].r * (1 + PRECISION)));
}

function distanceToLens(p, a, b) {
  let least = Infinity;
  for (const [one, other] of [[a, b], [b, a]]) {
    const d = distanceTo(p, one.c), foot = between(one.c, p, Math.min(1, one.r / d));
    // The nearest point of one disc, if it is in the other one too, is the nearest of both.
    if (distanceTo(foot, other.c) <= other.r) least = Math.min(least, Math.max(d - one.r, 0));
  }
  if (least < Infinity) return least;
  const { start, width } = cover(a, b);
  return Math.min(...[start, start + width].map((angle) => distanceTo(onCircle(a, angle), p)));
}

// --- the skeleton ------------------------------------------------------------------------------------

/** The discs that a point is on, which may be off by a length. */
const discsAt = (balls, rows, p, off = 0) =>
  rows.filter((i) => distanceTo(p, balls[i].c) <= balls[i].r * (1 + ON) + rounding(balls[i]) + off);

/** Singular points so near to each other that they are one, and the discs that each is on. */
function gathered(balls, rows, corners) {
  const discs = corners.map((p) => discsAt(balls, rows, p));
  const least = discs.map((some) => Math.min(...some.map((i) => balls[i].r)));
  const reach = (i, j) => ON * Math.min(least[i], least[j]);
  const groups = merged(corners, reach, (i, j) => discs[i].length > discs[j].length);
  const spread = ([k, ...others]) => Math.max(0, ...others.map((other) => distanceTo(corners[k], corners[other])));
  const through = groups.map((group) => discsAt(balls, rows, corners[group[0]], 2 * spread(group)));
  return { singular: groups.map(([k]) => corners[k]), through };
}

/** The lesser factor of v as a combination of two vectors, not a number if these are in line. */
function leastShare(v, [u, w]) {
  const d = cross(u, w);
  return Math.abs(d) > PRECISION ? Math.min(cross(v, w) / d, cross(u, v) / d) : NaN;
}

/** Whether v is a positive combination of others, or nearly. */
const inCone = ([v, ways]) => ways.some((u) => dot(u, v) >= 0 && Math.abs(cross(u, v)) <= CONE) ||
  pairsOf(ways).some((two) => leastShare(v, two) >= 0);

/** Whether v is in its cone, of some [v, ways] that should agree: the clearest one decides. */
function inCones(cones) {
  const shares = cones.map(([v, ways]) => (ways.length === 2 ? leastShare(v, ways) : NaN));
  const clearest = shares.reduce((most, share) => (Math.abs(share) > Math.abs(most) ? share : most), 0);
  return Math.abs(clearest) < FLAT ? cones.every(inCone) : clearest > 0;
}

/** Edges between Delaunay neighbours: [a, b, its triangles]. On a line, or of two points, there are no triangles. */
function neighbourhood(points) {
  const t = delaunay(points), row = ({ ends, sides }) => [...ends, sides];
  if (t) return { balls: circumballs(t), simplices: t.simplices, rows: facetTable(t).map(row) };
  const order = [...points.keys()].sort((i, j) => points[i][0] - points[j][0] || points[i][1] - points[j][1]);
  return { balls: [], simplices: [], rows: order.slice(1).map((b, k) => [order[k], b, []]) };
}

/** The exact skeleton of a union: its vertices, and its edges as pairs of them. */
function skeletonOf(balls, { rows, arcs, singular: given }) {
  const { singular, through } = gathered(balls, rows, given), graph = neighbourhood(singular);
  const exposed = [...new Set(arcs.map(([i]) => i))], places = balls.map(({ c }) => c), sizes = balls.map(({ r }) => r);
  const labels = graph.simplices.map((corners, k) => {
    const common = through[corners[0]].filter((i) => corners.every((v) => through[v].includes(i)));
    if (common.length) return common[0];
    const { center, r } = graph.balls[k];
    const known = places.findIndex((p, i) => distanceTo(p, center) <= SAME * r && Math.abs(sizes[i] - r) <= SAME * r);
    if (known >= 0) return known;
    // The ball is in the union iff at each singular point its centre is between those of the discs there.
    const seen = (v, place) => unitOf(minus(place, singular[v]));
    const inside = inCones(corners.map((v) => [seen(v, center), through[v].map((i) => seen(v, balls[i].c))]));
    return inside ? (places.push(center), sizes.push(r)) - 1 : -1;
  });
  const edges = new Map();
  for (const [a, b, sides] of graph.rows) {
    const discs = exposed.filter((i) => through[a].includes(i) && through[b].includes(i));
    const ends = [...new Set([...sides.map((t) => labels[t] ?? -1), ...discs])].filter((v) => v >= 0);
    // They are on a line, which says more of its direction than two points that are nearly one.
    const middle = [0, 1].map((axis) => ends.reduce((sum, v) => sum + places[v][axis], 0) / ends.length);
    const from = (v) => minus(places[v], middle), far = ends.map(from).sort((u, v) => dot(v, v) - dot(u, u))[0];
    ends.sort((u, v) => dot(far, from(u)) - dot(far, from(v)));
    ends.slice(1).forEach((v, k) => { edges.set(edgeKey(ends[k], v), [ends[k], v]); });
  }
  const pairs = [...edges.values()], used = [...new Set([...exposed, ...pairs.flat()])];
  return { dots: used.map((v) => places[v]), edges: pairs.map((pair) => pair.map((v) => used.indexOf(v))) };
}

/** The Betti numbers of slightly larger discs by which two and three of them meet: no crossing need be told apart. */
function homotopy(balls) {
  const filled = [], rows = [...balls.keys()], bit = (i, j) => 1n << BigInt(i * balls.length + j);
  const meet = (...some) => {
    const more = ON * Math.min(...some.map((i) => balls[i].r ** 2));
    const [a, b, third] = some.map((i) => ({ c: balls[i].c, r: Math.sqrt(balls[i].r ** 2 + more) }));
    return third ? distanceToLens(third.c, a, b) <= third.r : gap(a, b) <= 0;
  };
  const pairs = pairsOf(rows).filter((pair) => meet(...pair)), [pieces, loops] = bettiOf(rows.length, pairs);
  for (const [i, j] of pairs) {
    for (const k of rows.slice(j + 1)) {
      if (filled.length === loops || !meet(i, j, k)) continue;
      // Each three that meet fill a loop, unless it is a sum, modulo 2, of ones that are filled.
      const around = bit(i, j) ^ bit(i, k) ^ bit(j, k);
      const left = filled.reduce((sum, loop) => ((sum ^ loop) < sum ? sum ^ loop : sum), around);
      if (left) filled.push(left);
    }
  }
  return [pieces, loops - filled.length];
}

/**
 * The union and its exact skeleton: `segments` and `dots` (its vertices), Betti numbers; how many discs are `needed`
 * and `disconnected`, how many pairs `quasiDisconnected`. Where the library raises an error, `refused` says why.
 */
export function ballSkeleton(balls) {
  const boundary = union(balls), kept = generating(balls, boundary);
  const found = {
    ...boundary, needed: kept.length, disconnected: disconnected(balls, kept).length,
    quasiDisconnected: quasiDisconnected(balls, kept, boundary).length,
  };
  const none = { ...found, segments: [], dots: [], betti: null };
  if (boundary.touching.length) return { ...none, refused: "tangent" };
  const { dots, edges } = skeletonOf(balls, boundary), betti = bettiOf(dots.length, edges);
  const right = homotopy(boundary.rows.map((i) => balls[i]));
  if (right.some((b, k) => b !== betti[k])) return { ...none, refused: "rounding" };
  return { ...found, segments: edges.map((edge) => edge.map((v) => dots[v])), dots, betti };
}
