"""Independent truth about unions of balls: distance to the boundary, maximal balls, Betti numbers.

Nothing here imports the library, and nothing here knows a theorem about skeletons. Everything is brute
force over pairs and triples of balls, so it is meant for some thirty balls.

**Distance.** The nearest boundary point of m lies inside a spherical patch, inside an arc of the circle of
two spheres (3D), or at a corner, where N spheres meet. The distance to a sphere has one local minimum on it,
the distance to a circle too; so the candidates are the nearest point of every whole sphere, of every whole
circle, and every corner, as far as they are on the boundary of Y.

**On the boundary.** A point on the spheres of the balls I and in the open interior of no ball is on the
boundary of Y iff it can be left: with u_i = (c_i - p) / r_i there is v != 0 with v.u_i <= 0 for all i in I
(then p + tv is in no ball: |p + tv - c_i|^2 = r_i^2 + t^2 - 2 t r_i v.u_i). Three unit discs at equal angles
through one point, for example, cover all of its surroundings.

**Maximal balls.** Let r be the distance from m in Y to the boundary and B = B(m, r).

* B lies in a larger ball B' of Y only if B' touches the boundary wherever B does, from the same side, so all
  contacts of B lie on the ray from the centre of B' through m: *two contacts make B maximal*.
* With one contact q and u = (m - q)/r, every larger ball in question is B(q + tu, t), t > r. It lies in Y
  iff every boundary point p keeps out of it: t <= |p - q|^2 / (2 (p - q).u) whenever (p - q).u > 0. So the
  smallest of these bounds, T(q, u), is the radius of *the* maximal ball that touches at q with this normal,
  and B is maximal iff r = T.
* If T is not reached by a second contact it is a limit p -> q: q osculates. Inside a patch of sphere i the
  bound is r_i for all p, so there m = c_i and the whole patch is contact. On an arc, u is a mixture of two
  u_i, and the bound from its circle is reached on the line of the two centres, with the whole arc as contact.
  At corners the limits come from arcs that end there: the same lines. So one contact alone never makes a ball
  maximal. Left out are tangent balls only, as in the paper.

`Union.grow` finds T by shrinking: start with a ball that is too large, take the boundary point nearest to its
centre, and shrink until that point is on the sphere. It ends after a few steps because each patch, circle and
corner gives one bound.

**Errors.** If a boundary point p at distance r + e from m is seen from m at an angle a to the contact q, then
a ball touching at q grows by at most e / (1 - cos a). With e = `SLACK` times the size of Y this is the error
that comes with each maximal ball. It is large where all contacts are close together (short arcs).
"""

from __future__ import annotations

import numpy as np

from .complexes import lengths
from .nerves import nerve_betti

# Corners of circles that cross at an angle a are off by about 1e-16 / sin a of the size of Y.
SLACK = 1e-12
# A point this much (of the size) inside a ball still counts as on the boundary: 100 times the error of
# corners, so that corners on more than N spheres are kept; a wrong one changes a distance by no more.
INSIDE = 1e-10
# Unit vectors u_i and v count as orthogonal up to here: corners of nearly tangent circles are off by 1e-8.
LEVEL = 1e-7


class Union:
    """A union of closed balls in the plane or in space, looked at by brute force.

    `corners` are its singular points; `arcs` rows (i, j, angle) of the exposed arcs in 3D; `spread` some more
    boundary points (of patches and arcs), so that a ball with a whole patch as contact is seen as such.
    """

    def __init__(self, centers, radii, seed=0):
        centers, radii = np.asarray(centers, dtype=float), np.asarray(radii, dtype=float)
        _, first = np.unique(np.column_stack([centers, radii]), axis=0, return_index=True)
        self.index = np.sort(first)  # of equal balls the first
        self.origin = centers[0].copy()
        self.c, self.r = centers[self.index] - self.origin, radii[self.index]
        self.N = self.c.shape[1]
        self.size = lengths(self.c - self.c.mean(axis=0)).max() + self.r.max()
        self.pairs = self._meeting()
        self._circles()
        self._corners()
        self._spread(np.random.default_rng(seed))

    def _meeting(self):
        i, j = np.triu_indices(len(self.r), 1)
        d = lengths(self.c[i] - self.c[j])
        # A ball that touches another one from inside is part of it: it may stick out by rounding.
        meet = (d < self.r[i] + self.r[j]) & (d > np.abs(self.r[i] - self.r[j]) + 0.1 * INSIDE * self.size)
        return np.column_stack([i[meet], j[meet]])

    def gap(self, points):
        """Signed distance of points to every sphere, negative inside: (..., k)."""
        return lengths(points[..., None, :] - self.c) - self.r

    def exposed(self, points):
        """Which points (on some sphere) are in the interior of no ball."""
        return (self.gap(points) >= -INSIDE * self.size).all(axis=-1)

    def on_boundary(self, points):
        """Which points of spheres are on the boundary: exposed, and free to leave where spheres meet."""
        gap = self.gap(points)
        keep = (gap >= -INSIDE * self.size).all(axis=-1)
        meet = keep & ((np.abs(gap) <= INSIDE * self.size).sum(axis=-1) > 1)
        keep[meet] = [self._can_be_left(p) for p in points[meet]]
        return keep

    def inside(self, points):
        return (self.gap(points) <= INSIDE * self.size).any(axis=-1)

    def _circles(self):
        """Where two spheres cross: middle o, radius, unit normal, and in 3D a basis of the plane."""
        i, j = self.pairs.T
        across = self.c[j] - self.c[i]
        d = lengths(across)
        self.normal = across / d[:, None]
        # Signed distance from c_i to the plane, in the form that loses least.
        along = (d + (self.r[i] - self.r[j]) * (self.r[i] + self.r[j]) / d) / 2
        self.o = self.c[i] + along[:, None] * self.normal
        heron = (self.r[i] + self.r[j] + d) * (self.r[i] + self.r[j] - d)
        heron = heron * (d + self.r[i] - self.r[j]) * (d - self.r[i] + self.r[j])
        self.rho = np.sqrt(np.maximum(heron, 0)) / (2 * d)
        if self.N == 3:
            least = np.eye(3)[np.abs(self.normal).argmin(axis=1)] if len(i) else np.zeros((0, 3))
            e = np.cross(self.normal, least)
            self.e1 = e / lengths(e)[:, None]
            self.e2 = np.cross(self.normal, self.e1)

    def _corners(self):
        self.arcs = np.zeros((0, 3))
        self.arc_middles = np.zeros((0, self.N))
        if self.N == 2:
            flip = np.column_stack([-self.normal[:, 1], self.normal[:, 0]]) * self.rho[:, None]
            corners = np.concatenate([self.o + flip, self.o - flip])
        else:
            corners = self._arcs()
        self.corners = corners[self.on_boundary(corners)]

    def _arcs(self):
        """Cut every circle by all spheres; keep exposed arcs, return all cuts."""
        d = self.o[:, None] - self.c
        # |o + rho (cos e1 + sin e2) - c_l|^2 = r_l^2, a cos + b sin = h
        a = 2 * self.rho[:, None] * (d @ self.e1[:, :, None])[..., 0]
        b = 2 * self.rho[:, None] * (d @ self.e2[:, :, None])[..., 0]
        h = self.r**2 - (d**2).sum(axis=-1) - self.rho[:, None] ** 2
        top = np.hypot(a, b)
        rows = np.arange(len(self.o))[:, None]
        noise = 1e-12 * self.size**2
        cut = (np.abs(h) <= top + noise) & (top > noise)
        cut[rows, self.pairs] = False
        middle, half = np.arctan2(b, a), np.arctan2(np.sqrt(np.maximum(top**2 - h**2, 0)), h)
        angles = np.where(cut[..., None], np.stack([middle - half, middle + half], axis=-1), np.nan)
        angles = np.sort(angles.reshape(len(self.o), 2 * len(self.r)) % (2 * np.pi), axis=1)
        count = (~np.isnan(angles)).sum(axis=1)
        cuts = self._on_circle(np.nonzero(~np.isnan(angles))[0], angles[~np.isnan(angles)])
        # From each cut to the next one, and from the last one around to the first one.
        angles = np.column_stack([angles, np.full(len(angles), np.nan)])
        angles[np.arange(len(angles)), count] = np.where(count, angles[:, 0], 0) + 2 * np.pi
        start = angles[:, :-1].copy()
        start[count == 0, 0], angles[count == 0, 1:2] = 0, 2 * np.pi
        circle, column = np.nonzero(~np.isnan(angles[:, 1:]) & ~np.isnan(start))
        first, width = start[circle, column], angles[circle, column + 1] - start[circle, column]
        middles = self._on_circle(circle, first + width / 2)
        # Slivers between cuts that are one cut up to rounding are no arcs.
        keep = self.exposed(middles) & (width > 1e-6)
        circle, width, first = circle[keep], width[keep], first[keep]
        self.arcs = np.column_stack([self.pairs[circle], width])
        self.arc_circle = circle
        shares = np.array([0.02, 0.35, 0.5, 0.65, 0.98])
        self.arc_middles = self._on_circle(
            np.repeat(circle, 5), (first[:, None] + width[:, None] * shares).ravel()
        )
        return cuts

    def _on_circle(self, circle, angle):
        ring = np.cos(angle)[:, None] * self.e1[circle] + np.sin(angle)[:, None] * self.e2[circle]
        return self.o[circle] + self.rho[circle, None] * ring

    def directions(self, point):
        """Unit vectors from a boundary point to the centres of the balls through it."""
        through = np.abs(self.gap(point)) <= 10 * INSIDE * self.size
        u = self.c[through] - point
        return u / lengths(u)[:, None]

    def _can_be_left(self, point):
        u = self.directions(point)
        if self.N == 2:
            v = np.column_stack([-u[:, 1], u[:, 0]])
        else:
            i, j = np.triu_indices(len(u), 1)
            v = np.cross(u[i], u[j])
            v = v[lengths(v) > 1e-9] / lengths(v)[lengths(v) > 1e-9, None]
        v = np.concatenate([v, -v])
        return bool(len(v) == 0 or (v @ u.T <= LEVEL).all(axis=1).any())

    def _spread(self, rng):
        around = rng.standard_normal((len(self.r), 24, self.N))
        around[:, 12:] = -around[:, :12]
        around /= lengths(around)[..., None]
        points = self.c[:, None] + self.r[:, None, None] * around
        ball = np.repeat(np.arange(len(self.r)), 24)
        points = points.reshape(-1, self.N)
        keep = self.exposed(points)
        self.patch_points, self.patch_ball = points[keep], ball[keep]
        self.spread = np.concatenate([self.corners, self.patch_points, self.arc_middles])

    # Distances ------------------------------------------------------------------------------------------

    def nearest(self, queries):
        """Distance to the boundary and one nearest boundary point, in the moved coordinates."""
        m = np.atleast_2d(queries)
        best = np.full(len(m), np.inf)
        where = np.zeros_like(m)
        if len(self.spread):  # boundary points all of them, so none of them is nearer than the nearest
            d = lengths(m[:, None] - self.spread)
            k = d.argmin(axis=1)
            best, where = d[np.arange(len(m)), k], self.spread[k]
        away = m[:, None] - self.c
        far = lengths(away)
        away[far == 0] = np.eye(self.N)[0]
        points = self.c + self.r[:, None] * away / np.where(far == 0, 1, far)[..., None]
        best, where = self._improve(best, where, np.abs(far - self.r), points)
        if len(self.arcs):
            seen = np.unique(self.arc_circle)
            w = m[:, None] - self.o[seen]
            a = (w * self.normal[seen]).sum(axis=-1)
            w = w - a[..., None] * self.normal[seen]
            w = w - (w * self.normal[seen]).sum(axis=-1)[..., None] * self.normal[seen]
            far = lengths(w)
            w[far == 0] = np.broadcast_to(self.e1[seen], w.shape)[far == 0]
            points = self.o[seen] + self.rho[seen, None] * w / np.where(far == 0, 1, far)[..., None]
            best, where = self._improve(best, where, np.hypot(a, far - self.rho[seen]), points)
        return best, where

    def _improve(self, best, where, distance, points):
        row, column = np.nonzero(distance < best[:, None])
        keep = self.on_boundary(points[row, column])
        row, column = row[keep], column[keep]
        order = np.argsort(-distance[row, column], kind="stable")  # the nearest one is written last
        best, where = best.copy(), where.copy()
        best[row[order]] = distance[row, column][order]
        where[row[order]] = points[row, column][order]
        return best, where

    def boundary_distance(self, queries):
        return self.nearest(np.asarray(queries, dtype=float) - self.origin)[0]

    def contains(self, queries):
        return self.inside(np.asarray(queries, dtype=float) - self.origin)

    def singular_points(self):
        return self.corners + self.origin

    # Maximal balls --------------------------------------------------------------------------------------

    def grow(self, q, u):
        """The maximal balls touching the boundary at q whose centres lie on the rays q + tu.

        Returns centres (moved), radii, and the error of both.
        """
        t, error = self._bound(q, u, self.spread[None])
        first = np.isinf(t)
        t[first], error[first] = 2 * self.size, 0
        active = np.arange(len(q))
        for _ in range(100):  # about as many as there are strata in the way; 3 or 4 as a rule
            if not len(active):
                break
            distance, p = self.nearest(q[active] + t[active, None] * u[active])
            closer = distance < t[active] - SLACK * self.size
            active, p = active[closer], p[closer]
            limit, bound_error = self._bound(q[active], u[active], p[:, None])
            shrunk = limit < t[active]
            error[active] = np.where(shrunk, bound_error, np.inf)  # or too near q for rounding to see
            active = active[shrunk]
            t[active] = limit[shrunk]
        error[active] = np.inf
        # Holes that rounding opens between spheres through one point are no shapes.
        error[t < 1e3 * INSIDE * self.size] = np.inf
        return q + t[:, None] * u, t, error

    def _bound(self, q, u, p):
        """Least radius at which the ball that touches at q, with normal u, has one of the points p on it."""
        w = p - q[:, None]
        along, square = (w * u[:, None]).sum(axis=-1), (w * w).sum(axis=-1)
        sees = along > SLACK * self.size  # points that rounding puts beside q bound nothing
        limits = np.where(sees, square / np.where(sees, 2 * along, 1), np.inf)
        if not limits.shape[1]:
            return np.full(len(q), np.inf), np.full(len(q), np.inf)
        k = limits.argmin(axis=1)[:, None]
        limit, rise = (np.take_along_axis(x, k, axis=1)[:, 0] for x in (limits, along))
        # 1 - cos a = |p - q|^2 / (2 t^2) = (p - q).u / t
        return limit, SLACK * self.size * limit / np.maximum(rise, SLACK * self.size)

    def starts(self, rng, patches=4, arcs=2, corners=2, interior=20):
        """Boundary points with inward normals: on patches, arcs, corners, and nearest to interior points."""
        q, u = [], []
        if len(self.patch_points):
            k = rng.integers(len(self.patch_points), size=patches * len(self.r))
            q.append(self.patch_points[k])
            u.append((self.c[self.patch_ball[k]] - q[-1]) / self.r[self.patch_ball[k], None])
        for points, number in ((self.arc_middles, arcs * len(self.arcs)), (self.corners, corners * 8)):
            for p in points[rng.integers(len(points), size=min(number, 24))] if len(points) else ():
                toward = self.directions(p)
                mixed = rng.dirichlet(np.full(len(toward), 0.7)) @ toward
                if lengths(mixed) > 1e-6:
                    q.append(p[None])
                    u.append(mixed[None] / lengths(mixed))
        ball = rng.integers(len(self.r), size=interior)
        v = rng.standard_normal((interior, self.N))
        m = self.c[ball] + self.r[ball, None] * rng.random((interior, 1)) * v / lengths(v)[:, None]
        d, p = self.nearest(m)
        far = d > 1e-3 * self.r[ball]
        q.append(p[far])
        u.append((m - p)[far] / d[far, None])
        return np.concatenate(q), np.concatenate(u)

    def medial_points(self, rng, **numbers):
        """Centres (in the input's coordinates), radii and errors of maximal balls grown from `starts`."""
        m, t, error = self.grow(*self.starts(rng, **numbers))
        return m + self.origin, t, error

    def growth(self, points):
        """By how much the largest ball around each point can grow in Y, and the error of that number.

        0 for centres of maximal balls; a point outside Y gets inf.
        """
        m = np.asarray(points, dtype=float) - self.origin
        d, q = self.nearest(m)
        u = (m - q) / np.maximum(d, 1e-300)[:, None]
        # The ray is known to the rounding of m - q over d.
        _, t, error = self.grow(q, u)
        return np.where(self.inside(m), np.abs(t - d), np.inf), error

    # Topology -------------------------------------------------------------------------------------------

    def betti(self, inflate=0.0):
        """Betti numbers of the closed union, by the nerve of the balls (radii changed by `inflate`)."""
        return nerve_betti(self.c, self.r + inflate * self.size)

    def robust_betti(self):
        """Betti numbers of the interior, or None in space if radii changed by 1e-9 of the size change them.

        In the plane only tangent discs make a difference between the closed set and its interior. A point
        that is on several circles and inside closes with the radii a little larger.
        """
        low, high = self.betti(-1e-9), self.betti(1e-9)
        return high if low == high or self.N == 2 else None

    def tangent_pairs(self, tolerance=1e-9):
        """Pairs that touch from outside."""
        i, j = np.triu_indices(len(self.r), 1)
        touch = np.abs(lengths(self.c[i] - self.c[j]) - self.r[i] - self.r[j]) <= tolerance * self.size
        return np.column_stack([i[touch], j[touch]])

    def redundant(self, ball):
        """Whether a ball lies in the union of the others."""
        rest = np.delete(np.arange(len(self.r)), ball)
        if not len(rest):
            return False
        others = Union(self.c[rest], self.r[rest])
        center = self.c[ball : ball + 1]
        return bool(
            others.contains(center)[0]
            and others.boundary_distance(center)[0] >= self.r[ball] - 1e-9 * self.size
        )
