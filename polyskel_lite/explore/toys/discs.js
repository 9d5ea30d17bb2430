// Unions of a few discs, {c: [x, y], r}: arcs and singular points of the boundary, exact skeleton (appendix A).
// Mirrors polyskel_lite.polyballs in the plane with its tolerances: pairs, discs, incidence, generating, skeleton.

import { bettiOf, circumballs, delaunay, edgeKey, facetTable, groupsOf } from "./plane.js";
import { between, distanceTo, dot, extentOf, minus } from "./vectors.js";

const TURN = 2 * Math.PI;
// As in polyballs.pairs: what rounding may change, what a ball is believed to, which points are on a circle.
const ROUNDING = 2 ** -49, SWALLOWED = 1e-10, PRECISION = 1e-12, WORST = 1e-6, ON = 1e-9;
// Voronoi vertices nearer than this share of their radius are one; so much may a vector miss a cone.
const SAME = 1e-9, CONE = 1e-9, FLAT = 1e-8;
// If rounding spoils the skeleton, discs that differ by less than such shares count as one.
const ALIKE = [0, 1e-8, 1e-7, 1e-6, 1e-5], CLEAR = 1e-6;

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
  const covers = new Map(rows.filter((i) => !gone.has(i)).map((i) => [i, []]));
  for (const [i, j] of left.filter(crosses)) {
    covers.get(i).push(cover(balls[i], balls[j]));
    covers.get(j).push(cover(balls[j], balls[i]));
  }
  const arcs = [], ends = [], errors = [], touching = [];
  for (const [i, parts] of covers) {
    for (const arc of uncovered(parts)) {
      arcs.push([i, arc.start, arc.end]);
      if (arc.end - arc.start < TURN) [arc.start, arc.end].forEach((angle, k) => {
        const p = onCircle(balls[i], angle);
        ends.push(p);
        errors.push(arc.errors[k] * balls[i].r + ROUNDING * (extentOf([p]) + balls[i].r));
      });
    }
  }
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

/** The lesser factor of the vector v as a combination of u and w, not a number if these are in line. */
function leastShare(v, u, w) {
  const d = cross(u, w);
  return Math.abs(d) > PRECISION ? Math.min(cross(v, w) / d, cross(u, v) / d) : NaN;
}

/** Whether a vector is a positive combination of others, or nearly. */
function inCone(v, ways) {
  const along = (u) => dot(u, v) >= 0 && Math.abs(cross(u, v)) <= CONE;
  return ways.some(along) || pairsOf(ways).some(([u, w]) => leastShare(v, u, w) >= 0);
}

/** Whether a vector is in a cone, of [vector, its ways] that should agree: the clearest one decides. */
function inCones(cones) {
  const shares = cones.map(([v, ways]) => (ways.length === 2 ? leastShare(v, ...ways) : NaN));
  const clearest = shares.reduce((most, share) => (Math.abs(share) > Math.abs(most) ? share : most), 0);
  return Math.abs(clearest) < FLAT ? cones.every((cone) => inCone(...cone)) : clearest > 0;
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
    const middle = ends.reduce(([x, y], v) => [x + places[v][0] / ends.length, y + places[v][1] / ends.length], [0, 0]);
    const from = (v) => minus(places[v], middle), far = ends.map(from).sort((u, v) => dot(v, v) - dot(u, u))[0];
    ends.sort((u, v) => dot(far, from(u)) - dot(far, from(v)));
    ends.slice(1).forEach((v, k) => { edges.set(edgeKey(ends[k], v), [ends[k], v]); });
  }
  const pairs = [...edges.values()], used = [...new Set([...exposed, ...pairs.flat()])];
  return { dots: used.map((v) => places[v]), edges: pairs.map((pair) => pair.map((v) => used.indexOf(v))) };
}

// --- whether rounding spoils it ----------------------------------------------------------------------

/** Where some discs come nearest to a common point: the least that the largest of their powers there can be. */
function levelOf(discs) {
  const power = (p, { c, r }) => dot(minus(p, c), minus(p, c)) - r * r, [a, b, third] = discs;
  let best = -Infinity;
  for (const [k, l] of pairsOf(discs)) {
    const d = distanceTo(k.c, l.c), share = (1 + ((k.r - l.r) / d) * ((k.r + l.r) / d)) / 2;
    const p = between(k.c, l.c, Math.min(Math.max(share, 0), 1)), level = Math.max(power(p, k), power(p, l));
    // Two discs decide if the others have less power there.
    if (discs.every((disc) => power(p, disc) <= level + PRECISION * disc.r ** 2)) return level;
    best = Math.max(best, level);
  }
  const u = minus(b.c, a.c), v = minus(third.c, a.c), twice = 2 * cross(u, v);
  const f = dot(u, u) - b.r ** 2 + a.r ** 2, g = dot(v, v) - third.r ** 2 + a.r ** 2;
  const x = (v[1] * f - u[1] * g) / twice, y = (u[0] * g - v[0] * f) / twice;
  return Math.max(best, x * x + y * y - a.r ** 2);
}

/** Betti numbers of a union by which two and three discs have a point in common; of powers larger by a share. */
function homotopy(balls, share) {
  const meets = (discs) => levelOf(discs) < share * Math.min(...discs.map(({ r }) => r * r));
  const numbers = [...balls.keys()], pairs = pairsOf(numbers).filter(([i, j]) => meets([balls[i], balls[j]]));
  const edge = new Map(pairs.map(([i, j], k) => [edgeKey(i, j), 1n << BigInt(k)])), reduced = new Map();
  for (const [i, j] of pairs) {
    for (let k = j + 1; k < balls.length; k += 1) {
      const others = [edge.get(edgeKey(i, k)), edge.get(edgeKey(j, k))];
      if (!others[0] || !others[1] || !meets([balls[i], balls[j], balls[k]])) continue;
      // A row of the boundary matrix modulo 2: what is left of it fills one more loop.
      let loop = edge.get(edgeKey(i, j)) ^ others[0] ^ others[1], top = loop.toString(2).length;
      while (reduced.has(top)) { loop ^= reduced.get(top); top = loop && loop.toString(2).length; }
      if (loop) reduced.set(top, loop);
    }
  }
  const [pieces, loops] = bettiOf(balls.length, pairs);
  return `${[pieces, loops - reduced.size]}`;
}

/** Nearly the same union: one ball for all that differ from it by less than a share of its radius. */
function alike(balls, share) {
  let left = [...balls].sort((a, b) => b.r - a.r);
  const found = [];
  while (left.length) {
    const [{ c, r }] = left, reach = (ball) => distanceTo(c, ball.c) + ball.r;
    const away = ({ c: p, r: q }) => distanceTo(c, p) + r - q > share * r;
    found.push({ c, r: Math.max(...left.filter((ball) => !away(ball)).map(reach)) });
    left = left.filter(away);
  }
  return found;
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
  const different = boundary.rows.map((i) => balls[i]);
  const clear = alike(different, CLEAR), trues = [-ON, ON].map((share) => homotopy(clear, share));
  let tried = 0;
  for (const share of ALIKE) {
    const like = share ? alike(different, share) : different, around = share ? union(like) : boundary;
    if (like.length === tried || around.touching.length) continue;
    tried = like.length;
    const { dots, edges } = skeletonOf(share ? like : balls, around), betti = bettiOf(dots.length, edges), key = `${betti}`;
    const steady = share && homotopy(like, -4 * share) === homotopy(like, 4 * share);
    if (key === homotopy(like, ON) && (trues.includes(key) || steady)) {
      return { ...found, segments: edges.map((edge) => edge.map((v) => dots[v])), dots, betti };
    }
  }
  return { ...none, refused: "rounding" };
}
