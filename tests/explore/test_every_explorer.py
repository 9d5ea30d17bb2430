"""What every explorer has: a picture with words in its place, labels, one drawing for changes together."""

import re
from xml.etree import ElementTree

import pytest

import polyskel_lite as psl
from polyskel_lite import explore
from polyskel_lite.explore.drawing_board.board import Board
from polyskel_lite.explore.explorers.explorer import Explorer

HORSE = psl.datasets.load("horse")
MAKERS = {
    "maximal_ball": lambda: explore.maximal_ball(HORSE),
    "sampling": lambda: explore.sampling(HORSE),
    "graphs": lambda: explore.graphs(),
    "four_methods": lambda: explore.four_methods(HORSE),
    "refinement": lambda: explore.refinement(),
    "removals": lambda: explore.removals(),
    "thresholds": lambda: explore.thresholds(),
    "balls": lambda: explore.balls(),
}


@pytest.fixture(params=MAKERS)
def explorer(request):
    return MAKERS[request.param]()


def test_controls_and_handles_have_labels(explorer):
    assert explorer.look_for.endswith(("?", "."))
    assert all(control.description for control in explorer.controls.values())
    assert len(explorer.board.handle_labels) == len(explorer.board.handles)


@pytest.mark.parametrize("name", ["refinement", "removals", "thresholds", "balls"])
def test_words_say_where_to_look(name):
    explorer = MAKERS[name]()
    assert "Look" in explorer.look_for
    assert len(explorer.board.alt) > 60


def test_stand_in_is_complete(explorer):
    page = explorer.stand_in()
    tree = ElementTree.fromstring(page)  # well-formed, so it cannot spoil a page
    script = tree.find("script")
    if script is not None:
        tree.remove(script)
    assert (script is not None) == bool(explorer.live)
    picture = tree.find(".//{http://www.w3.org/2000/svg}svg")
    assert picture.get("role") == "img"
    assert len(picture.get("aria-label")) > 20
    assert picture.get("aria-label") == explorer.board.alt
    assert picture.find("{http://www.w3.org/2000/svg}title").text == picture.get("aria-label")
    assert picture.findall(".//{http://www.w3.org/2000/svg}path")
    assert not [node for node in tree.iter() if node.get("id")]
    text = " ".join(tree.itertext())
    assert explorer.look_for in text
    assert explorer.board.text in text
    assert (
        "moves on a page with JavaScript" if explorer.live else "open this notebook in JupyterLab"
    ) in text
    assert page.isascii() or "π" in page or "·" in page
    for d in re.findall(r' d="([^"]*)"', page):
        assert "." not in d  # whole units
    assert len(page) < 150_000


def test_stand_in_travels_with_the_widget(explorer):
    bundle = explorer._repr_mimebundle_()
    assert bundle["text/html"] == explorer.stand_in()
    assert "0x" not in bundle["text/plain"]
    assert "application/vnd.jupyter.widget-view+json" in bundle


@pytest.mark.parametrize("name", MAKERS)
def test_deterministic(name):
    assert MAKERS[name]().stand_in() == MAKERS[name]().stand_in()


def test_changes_together_are_drawn_once():
    drawn = []

    class Counting(Explorer):
        def draw(self):
            drawn.append(self.board.handles)

    explorer = Counting(Board((0, 0, 1, 1), handles=[(0, 0)]), {}, "Nothing to see.")
    with explorer.together():
        explorer.board.handles = [(0.5, 0)]
        explorer.board.handles = [(1, 0)]
    assert drawn == [((0.0, 0.0),), ((1.0, 0.0),)]


@pytest.mark.parametrize("maker", [explore.maximal_ball, explore.sampling, explore.four_methods])
def test_planar_explorers_refuse_other_things(maker):
    with pytest.raises(psl.InputError, match="plane"):
        maker(psl.datasets.load("fourbranch"))
    with pytest.raises(psl.InputError):
        maker("horse")
