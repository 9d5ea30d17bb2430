"""Tables of results, in a terminal and on a page."""

import math
import re

import numpy as np
import pytest

import polyskel_lite as psl


def test_every_kind_of_cell():
    made = psl.table(
        [(1, -0.5, True, (1, 0), None), (20, math.nan, np.bool_(False), "a < b", 2.0)], "abcde", 2
    )
    assert made.rows == (("1", "−0.50", "yes", "(1, 0)", "–"), ("20", "–", "no", "a < b", "2.00"))
    assert repr(made).splitlines() == [
        " a      b  c    d          e",
        " 1  −0.50  yes  (1, 0)     –",
        "20      –  no   a < b   2.00",
    ]


def test_a_page_gets_a_table_with_heads():
    page = psl.table([("a < b", 1)], ["case", "n"])._repr_html_()
    assert '<th scope="col" style="text-align: left">case</th>' in page
    assert (
        '<th scope="row" style="text-align: left">a &lt; b</th><td style="text-align: right">1</td>' in page
    )


@pytest.mark.parametrize(("rows", "decimals"), [([(1, 2), (1,)], 3), ([(1, 2)], [1])])
def test_a_row_of_another_length_is_named(rows, decimals):
    with pytest.raises(psl.InputError, match=r"(row 1|decimals) has 1 entries for 2 columns"):
        psl.table(rows, ["a", "b"], decimals)


BAR = psl.skeleton([[(0, 0), (20, 0), (20, 4), (0, 4)]])
THINGS = [
    BAR.given,
    BAR.skeleton,
    BAR.hierarchy,
    BAR.hierarchy.P,
    BAR.skeleton.balls(),
    BAR.given.tessellation,
]


@pytest.mark.parametrize("thing", [*THINGS, BAR.branches], ids=lambda thing: type(thing).__name__)
def test_what_a_notebook_shows_is_a_table_without_addresses(thing):
    page, line = thing._repr_html_(), repr(thing)
    assert page.startswith("<table>")
    assert page.count("<tr>") == page.count("</tr>") > 1
    assert "id=" not in page
    assert not re.search(r"0x[0-9a-f]{4}", page + line)
    if thing is not BAR.branches:
        assert type(thing).__name__ in page
        assert line.startswith(type(thing).__name__)
        assert len(line) < 110


def test_a_repr_never_fails():
    """Vertices at infinity, nothing at all, and rays in space, where Betti numbers are not defined."""
    flat = psl.Skeleton([(np.inf, 0)], [np.inf], [-1], np.zeros((0, 2), dtype=int))
    assert repr(flat) == "Skeleton(2D, 1 vertices, 0 edges, Betti (1, 0))"
    space = psl.voronoi([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
    assert "Betti" not in repr(space)
    assert "4 rays" in repr(space)
