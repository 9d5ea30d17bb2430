"""The drawing board: what is drawn is in its picture, what is dragged is answered."""

import re

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite.drawing import KINDS
from polyskel_lite.explore.drawing_board.board import Board, box_around


def test_board_draws_every_content():
    board = Board((0, 0, 4, 2), width=400)
    board.draw("area", "shape", polygons=[[(0, 0), (2, 0), (2, 2)], [(1, 0.5), (1.5, 0.5), (1.5, 1)]])
    board.draw("segments", "sk2", lines=np.array([[(0, 0), (4, 2)], [(0, 2), (4, 0)]]))
    board.draw("chain", "sk0", lines=[[(0, 0), (1, 1), (2, 0)]])
    board.draw("dots", "samples", points=[(1, 1)])
    board.draw("diamonds", "sk1", points=[(1, 1)])
    board.draw("discs", "balls", circles=([(1, 1), (1.5, 1)], [0.5, 0.25]))
    board.draw("arc", "balls", arcs=([(1, 1)], [1], [0], [np.pi]))
    board.draw("words", "shape", text=[(1, 1, "a < b")])
    assert 'fill-rule="evenodd"' in board.picture("area")
    assert board.picture("area").count("z") == 2
    assert "M0 2000L4000 0M0 0L4000 2000" in board.picture("segments")
    assert "M0 2000 1000 1000 2000 2000" in board.picture("chain")
    assert "M1000 1000h0" in board.picture("dots")
    assert board.picture("diamonds").count("z") == 1
    assert board.picture("discs").count("a500 500") == 2
    assert "M2000 1000A1000 1000 0 0 0 1000 0A1000 1000 0 0 0 0 1000" in board.picture("arc")
    assert ">a &lt; b</text>" in board.picture("words")


def test_board_has_the_colours_and_patterns_of_the_drawings():
    board = Board((0, 0, 1, 1))
    for name, kind in KINDS.items():
        board.draw(name, name, lines=[[(0, 0), (1, 1)]], points=[(0.5, 0.5)], label=kind.label)
        assert kind.color in board.picture(name)
        assert ("stroke-dasharray" in board.picture(name)) == isinstance(kind.linestyle, tuple)
        assert kind.color in board.legend
    assert [KINDS[name].zorder for name in board._layers] == sorted(kind.zorder for kind in KINDS.values())


def test_board_sends_only_what_changed(monkeypatch):
    board = Board((0, 0, 4, 2))
    board.draw("fixed", "shape", polygons=[[(0, 0), (2, 0), (2, 2)]])
    board.draw("moving", "samples", points=[(1, 1)])
    sent = []
    monkeypatch.setattr(board, "send_state", lambda key=None: sent.append(set(key)))
    with board.hold_sync():
        board.draw("fixed", "shape", polygons=[[(0, 0), (2, 0), (2, 2)]])
        board.draw("moving", "samples", points=[(2, 1)])
    assert sent == [{"_svg_moving"}]


def test_board_answers_each_move_once_and_after_the_drawing(monkeypatch):
    board, log = Board((0, 0, 4, 2), handles=[(1, 1)]), []
    monkeypatch.setattr(board, "send", lambda content: log.append(content))
    board.observe(lambda change: log.append(change.new), "handles")
    board._receive(board, {"type": "move", "handles": [[2, 9]], "serial": 5}, [])
    assert log == [((2.0, 2.0),), {"type": "answer", "serial": 5}]


def test_board_answers_a_move_that_fails(monkeypatch):
    board, log = Board((0, 0, 4, 2), handles=[(1, 1)]), []
    monkeypatch.setattr(board, "send", lambda content: log.append(content))
    with pytest.raises(psl.InputError, match="handles"):
        board._receive(board, {"type": "move", "handles": [[float("nan"), 0]], "serial": 6}, [])
    board._receive(board, {"type": "move", "handles": [[0, 0], [1, 1]], "serial": 7}, [])  # of an older board
    board._receive(board, {"type": "other"}, [])
    assert [content["serial"] for content in log] == [6, 7]
    assert board.handles == ((1.0, 1.0),)


def test_board_keeps_handles_in_a_new_box():
    board = Board((0, 0, 4, 2), handles=[(4, 2)])
    board.box = (0, 0, 1, 1)
    assert board.handles == ((1.0, 1.0),)
    assert board.box == (0, 0, 1, 1)


def test_board_shows_and_hides():
    board = Board((0, 0, 2, 2), [{"name": "dots", "kind": "samples", "points": [(1, 1)], "label": "samples"}])
    assert "samples" in board.legend
    board.show("dots", False)
    assert not board.visible("dots")
    assert board.picture("dots") == board.legend == ""
    assert len(board.layers["dots"].points) == 1


def test_points_far_away_do_not_break_the_picture():
    board = Board((0, 0, 1, 1))
    board.draw("far", "voronoi", lines=np.array([[(0, 0), (1e300, np.inf)], [(np.nan, 0), (-1e30, 1)]]))
    assert not re.search(r"nan|inf|e\+", board.picture("far"))


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (lambda board: Board((0, 0, 0, 1)), "box"),
        (lambda board: Board((0, 0, np.inf, 1)), "box"),
        (lambda board: Board((0, 0, 1)), "box"),
        (lambda board: board.draw("a", "skeleton"), "no kind"),
        (lambda board: board.draw("a b", "sk0"), "called"),
        (lambda board: board.draw("a", "sk0", color="red"), "'color'"),
        (lambda board: board.draw("a", "sk0", rule="odd"), "rule"),
        (lambda board: board.show("a"), "no layer 'a'"),
        (lambda board: setattr(board, "handles", [(1, 2, 3)]), "handles"),
        (lambda board: setattr(board, "handles", [(1, np.nan)]), "handles"),
        (lambda board: box_around(np.empty((0, 3))), "points"),
    ],
)
def test_board_names_what_is_wrong(wrong, said):
    with pytest.raises(psl.InputError, match=said):
        wrong(Board((0, 0, 1, 1)))
