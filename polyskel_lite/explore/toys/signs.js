// Signs that never round: floats where they are outside their error bound, whole numbers (BigInt) elsewhere.
// Mirrors polyskel_lite.exact (predicates, regions, rational) in the plane.

/** Half the distance from 1 to the next float: what one rounding may change, as a share. */
export const UNIT = 2 ** -53;
// Below it, products of coordinates may have lost all digits.
const FLOOR = 1e-280;

const sign = (x) => (x > 0) - (x < 0);

/** Floats times one common power of two, as whole numbers. */
function asIntegers(numbers) {
  const exponents = numbers.map((x) => Math.max(Math.floor(Math.log2(Math.abs(x))) - 53, -1074));
  const low = exponents.reduce((least, e, k) => (numbers[k] === 0 ? least : Math.min(least, e)), 1024);
  return numbers.map((x, k) => (x === 0 ? 0n : BigInt(x / 2 ** exponents[k]) << BigInt(exponents[k] - low)));
}

const turn = (ax, ay, bx, by, cx, cy) => (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);

/** +1 if a, b, c run counter-clockwise, -1 clockwise, 0 on a line. */
export function orientation(a, b, c) {
  const left = (b[0] - a[0]) * (c[1] - a[1]), right = (b[1] - a[1]) * (c[0] - a[0]), value = left - right;
  if (Math.abs(value) > 16 * UNIT * (Math.abs(left) + Math.abs(right)) + FLOOR) return value > 0 ? 1 : -1;
  return sign(turn(...asIntegers([...a, ...b, ...c])));
}

const lifted = (ax, ay, bx, by, cx, cy) =>
  (ax * ax + ay * ay) * (bx * cy - by * cx) - (bx * bx + by * by) * (ax * cy - ay * cx) +
  (cx * cx + cy * cy) * (ax * by - ay * bx);

/** +1 if d is inside the circle through a, b, c (counter-clockwise), 0 on it, -1 outside. */
export function inBall(a, b, c, d) {
  const ax = a[0] - d[0], ay = a[1] - d[1], bx = b[0] - d[0], by = b[1] - d[1], cx = c[0] - d[0], cy = c[1] - d[1];
  const value = lifted(ax, ay, bx, by, cx, cy);
  const size = (ax * ax + ay * ay) * (Math.abs(bx * cy) + Math.abs(by * cx)) +
    (bx * bx + by * by) * (Math.abs(ax * cy) + Math.abs(ay * cx)) +
    (cx * cx + cy * cy) * (Math.abs(ax * by) + Math.abs(ay * bx));
  if (Math.abs(value) > 32 * UNIT * size + FLOOR) return value > 0 ? 1 : -1;
  const [px, py, qx, qy, rx, ry, x, y] = asIntegers([...a, ...b, ...c, ...d]);
  return sign(lifted(px - x, py - y, qx - x, qy - y, rx - x, ry - y));
}

const diametral = (ax, ay, bx, by, px, py) => (px - ax) * (px - bx) + (py - ay) * (py - by);

/** +1 if p is inside the circle with diameter ab, 0 on it, -1 outside. */
export function inGabrielBall(a, b, p) {
  const value = diametral(...a, ...b, ...p);
  const size = Math.abs((p[0] - a[0]) * (p[0] - b[0])) + Math.abs((p[1] - a[1]) * (p[1] - b[1]));
  if (Math.abs(value) > 16 * UNIT * size + FLOOR) return -sign(value);
  return -sign(diametral(...asIntegers([...a, ...b, ...p])));
}

/** The quotient of two whole numbers, as a float. */
function ratio(x, d) {
  const size = (n) => 4 * n.toString(16).length;
  const shift = Math.max(0, size(d) - size(x) + 68);
  return Number((x << BigInt(shift)) / d) / 2 ** shift;
}

const above = (P, Q) => P[0] * Q[1] - Q[0] * P[1];

/** A region and samples in whole numbers of one unit. Points are [X, Y, D]: X / D and Y / D of it, D > 0. */
export class Rational {
  constructor(segments, points) {
    const flat = asIntegers([...segments.flat(2), ...points.flat(), 1]), begin = 4 * segments.length;
    this.segments = segments.map((_, k) => flat.slice(4 * k, 4 * k + 4));
    this.points = points.map((_, k) => flat.slice(begin + 2 * k, begin + 2 * k + 2));
    this.one = flat[flat.length - 1];
    const sizes = flat.map((x) => (x < 0n ? -x : x));
    this.extent = sizes.reduce((most, x) => (x > most ? x : most));
  }

  /** The circumcenter of three samples, counter-clockwise. */
  center(corners) {
    const [[px, py], [qx, qy], [rx, ry]] = corners.map((v) => this.points[v]);
    const bx = qx - px, by = qy - py, cx = rx - px, cy = ry - py, D = 2n * (bx * cy - by * cx);
    const B = bx * bx + by * by, C = cx * cx + cy * cy;
    return [px * D + cy * B - by * C, py * D + bx * C - cx * B, D];
  }

  /** A point outside the box of everything, from P to the right of the way from one sample to another. */
  far([X, Y, D], a, b) {
    const [[ax, ay], [bx, by]] = [this.points[a], this.points[b]];
    const size = ((X < 0n ? -X : X) + (Y < 0n ? -Y : Y)) / D + 1n, many = 4n * (size + this.extent) * D;
    return [X + many * (by - ay), Y + many * (ax - bx), D];
  }

  /** The same point in floats. */
  place([X, Y, D]) { return [ratio(X, D * this.one), ratio(Y, D * this.one)]; }

  /** Whether a point is in the closed region. */
  contains([X, Y, D]) {
    let inside = false;
    for (const [ax, ay, bx, by] of this.segments) {
      const aboveA = ay * D > Y, aboveB = by * D > Y, level = ay * D === Y || by * D === Y;
      if (aboveA === aboveB && !level) continue;
      const side = (bx - ax) * (Y - ay * D) - (by - ay) * (X - ax * D);
      if (side === 0n && diametral(ax * D, ay * D, bx * D, by * D, X, Y) <= 0n) return true;
      if (aboveA !== aboveB && (aboveB ? side > 0n : side < 0n)) inside = !inside;
    }
    return inside;
  }

  /** The `pieces` of the way from P to Q in the closed region, in floats, and whether it is `whole`. */
  clip(P, Q) {
    const D = P[2] * Q[2], ax = P[0] * Q[2], ay = P[1] * Q[2], dx = Q[0] * P[2] - ax, dy = Q[1] * P[2] - ay;
    const ends = [[0n, 1n], [1n, 1n]], at = ([t, c]) => [ax * c + dx * t, ay * c + dy * t, D * c];
    if (dx === 0n && dy === 0n) return { whole: this.contains(P), pieces: [] };
    const parts = [], stops = [...ends, ...this.meetings(ax, ay, dx, dy, D)].sort((s, t) => sign(above(s, t)));
    stops.slice(1).forEach((to, k) => {
      const from = stops[k], middle = [from[0] * to[1] + to[0] * from[1], 2n * from[1] * to[1]];
      if (above(from, to) === 0n || !this.contains(at(middle))) return;
      const last = parts[parts.length - 1];
      if (last && above(last[1], from) === 0n) last[1] = to;
      else parts.push([from, to]);
    });
    const whole = parts.length === 1 && parts[0][0][0] === 0n && parts[0][1][0] === parts[0][1][1];
    const piece = ([from, to]) =>
      ({ line: [from, to].map((t) => this.place(at(t))), first: from[0] === 0n, last: to[0] === to[1] });
    return { whole, pieces: parts.map(piece) };
  }

  /** Where the way meets the segments, as fractions of it; of a segment on its line, both ends. */
  meetings(ax, ay, dx, dy, D) {
    const found = [];
    for (const segment of this.segments) {
      const [px, py, qx, qy] = segment.map((x, k) => x * D - (k % 2 ? ay : ax)), ex = qx - px, ey = qy - py;
      const cross = dx * ey - dy * ex;
      if (cross === 0n) {
        if (dx * py !== dy * px) continue;
        for (const along of [px * dx + py * dy, qx * dx + qy * dy]) found.push([along, dx * dx + dy * dy]);
        continue;
      }
      const side = cross < 0n ? -1n : 1n, c = side * cross;
      const t = side * (px * ey - py * ex), u = side * (px * dy - py * dx);
      if (u >= 0n && u <= c) found.push([t, c]);
    }
    return found.filter(([t, c]) => t > 0n && t < c);
  }
}
