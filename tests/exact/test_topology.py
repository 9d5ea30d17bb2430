"""Betti numbers of complexes that are known."""

import numpy as np
import pytest

from polyskel_lite.exact.topology import betti_numbers, components


def grid_surface(rows, columns, wrap_rows, wrap_columns, twist=False):
    """Squares of a grid with opposite sides glued: disk, annulus, torus, Klein bottle."""
    index = {}

    def vertex(i, j):
        if wrap_rows and i == rows:
            i, j = 0, (columns - j) % columns if twist else j
        if wrap_columns and j == columns:
            j = 0
        return index.setdefault((i, j), len(index))

    polygons = [
        [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)]
        for i in range(rows)
        for j in range(columns)
    ]
    edges = {tuple(sorted(side)) for p in polygons for side in zip(p, [*p[1:], p[0]], strict=True)}
    return len(index), np.array(sorted(edges)), [np.array(p) for p in polygons]


@pytest.mark.parametrize(
    ("wraps", "betti"),
    [
        ((False, False), (1, 0, 0)),
        ((True, False), (1, 1, 0)),
        ((True, True), (1, 2, 1)),
        ((True, True, True), (1, 2, 1)),  # Klein bottle over two elements
    ],
)
def test_surfaces(wraps, betti):
    n, edges, polygons = grid_surface(4, 5, *wraps)
    assert betti_numbers(n, edges, polygons) == betti
    assert n - len(edges) + len(polygons) == betti[0] - betti[1] + betti[2]


def test_two_spheres_sharing_a_vertex():
    cube = [(0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5)]
    other = [tuple(0 if v == 0 else v + 7 for v in p) for p in cube]
    polygons = [np.array(p) for p in cube + other]
    edges = {
        tuple(sorted(s)) for p in polygons for s in zip(p.tolist(), [*p.tolist()[1:], p[0]], strict=True)
    }
    assert betti_numbers(15, np.array(sorted(edges)), polygons) == (1, 0, 2)


def test_nothing_and_points():
    none = np.zeros((0, 2), dtype=int)
    assert betti_numbers(0, none) == (0, 0)
    assert betti_numbers(3, none) == (3, 0)
    assert betti_numbers(3, none, []) == (3, 0, 0)
    assert components(0, none)[0] == 0
