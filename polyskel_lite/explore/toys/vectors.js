// Points and vectors of the plane, [x, y].

export const distanceTo = ([ax, ay], [bx, by]) => Math.sqrt((bx - ax) ** 2 + (by - ay) ** 2);
export const minus = (p, q) => [p[0] - q[0], p[1] - q[1]];
export const dot = (u, v) => u[0] * v[0] + u[1] * v[1];
export const between = ([ax, ay], [bx, by], t) => [ax + t * (bx - ax), ay + t * (by - ay)];

/** The largest of all coordinates, without its sign. */
export const extentOf = (points) => points.reduce((most, [x, y]) => Math.max(most, Math.abs(x), Math.abs(y)), 0);
