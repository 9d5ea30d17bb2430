"""Tables of results, in a terminal and on a page."""

import math

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
