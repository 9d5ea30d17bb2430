// Samples of a boundary, and maximal balls. Mirrors Shape.sample and .covering_radius, grown_ball and contact_points
// (skeletons.maximal_balls); exact.first_meeting is polygonCrosses here.

import { footOn } from "./inside.js";
import { UNIT, orientation, inGabrielBall } from "./signs.js";
import { between, boxOf, distanceTo, dot, extentOf, minus } from "./vectors.js";

const overlap = (a, b) => a[0] <= b[2] && b[0] <= a[2] && a[1] <= b[3] && b[1] <= a[3];

/** n samples at equal distances along the rings, shared by length, ring by ring; null if fewer than three a ring. */
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
