"""Explorers of chapters 1 to 3, driven from Python: what they show is what the public functions return."""

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest

import polyskel_lite as psl
from polyskel_lite import explore
from polyskel_lite.drawing import KINDS
from polyskel_lite.explore.drawing_board.board import Board, box_around
from polyskel_lite.explore.explorers.explorer import Explorer

HORSE = psl.datasets.load("horse")
FRAME = psl.Shape.from_rings([[(0, 0), (6, 0), (6, 6), (0, 6)], [(2, 2), (4, 2), (4, 4), (2, 4)]])
MAKERS = {
    "maximal_ball": lambda: explore.maximal_ball(HORSE),
    "sampling": lambda: explore.sampling(HORSE),
    "graphs": lambda: explore.graphs(),
    "four_methods": lambda: explore.four_methods(HORSE),
}


@pytest.fixture(params=MAKERS)
def explorer(request):
    return MAKERS[request.param]()


# ---- the board ----


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


# ---- what every explorer has ----


def test_controls_and_handles_have_labels(explorer):
    assert explorer.look_for.endswith(("?", "."))
    assert all(control.description for control in explorer.controls.values())
    assert len(explorer.board.handle_labels) == len(explorer.board.handles)


def test_stand_in_is_complete(explorer):
    page = explorer.stand_in()
    tree = ET.fromstring(page)  # well-formed, so it cannot spoil a page
    picture = tree.find(".//{http://www.w3.org/2000/svg}svg")
    assert picture.get("role") == "img"
    assert len(picture.get("aria-label")) > 20
    assert picture.find("{http://www.w3.org/2000/svg}title").text == picture.get("aria-label")
    assert picture.findall(".//{http://www.w3.org/2000/svg}path")
    assert not [node for node in tree.iter() if node.get("id")]
    text = " ".join(tree.itertext())
    assert explorer.look_for in text
    assert explorer.board.text in text
    assert "JupyterLab" in text
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


# ---- chapter 1: maximal balls ----


@pytest.mark.parametrize("name", psl.datasets.names())
def test_ball_grows_to_a_maximal_one(name):
    shape = psl.datasets.load(name)
    explorer, rng = explore.maximal_ball(shape), np.random.default_rng(1)
    low, high = shape.points.min(axis=0), shape.points.max(axis=0)
    places = rng.uniform(low, high, (400, 2))
    for place in places[shape.contains(places)][:15]:
        explorer.board.handles = [place]
        center, radius = (value[0] for value in explorer.board.layers["ball"].circles)
        contacts = explorer.board.layers["contacts"].points
        assert shape.boundary_distance([center])[0] == pytest.approx(radius, rel=1e-9)
        assert np.hypot(*(center - contacts).T) == pytest.approx(radius, rel=1e-5)
        assert explorer.numbers["contacts"] == len(contacts) >= 2
        assert explorer.numbers["radius_at_the_dot"] == pytest.approx(shape.boundary_distance([place])[0])
        # The ball around the handle is in the maximal one.
        apart = np.hypot(*(np.array(explorer.board.handles[0]) - center))
        assert apart + explorer.numbers["radius_at_the_dot"] <= radius * (1 + 1e-9)


def test_growth_slider_stops_on_the_way():
    explorer = explore.maximal_ball(FRAME, center=(3, 0.5))
    assert explorer.numbers["radius"] == pytest.approx(1)
    explorer.controls["growth"].value = 0.5
    assert explorer.numbers["radius"] == pytest.approx(0.75)
    assert explorer.numbers["contacts"] == 1
    assert "Not maximal" in explorer.board.text


def test_centre_on_the_skeleton_is_told():
    explorer = explore.maximal_ball(FRAME, center=(3, 1.001))
    explorer.controls["growth"].value = 0
    assert explorer.numbers["contacts"] == 2
    assert "on the skeleton" in explorer.board.text


@pytest.mark.parametrize("place", [(3, 3), (6.2, 3), (0, 0), (3, 0)])
def test_no_ball_outside(place):
    explorer = explore.maximal_ball(FRAME, center=place)
    assert "not inside" in explorer.board.text
    assert explorer.board.picture("ball") == ""
    explorer.board.handles = [(1, 3)]
    assert explorer.numbers["contacts"] >= 2


def test_trace_keeps_the_centres():
    explorer = explore.maximal_ball(FRAME, center=(3, 0.5))
    explorer.controls["trace"].value = True
    for x in (2.5, 3.0, 3.5):
        explorer.board.handles = [(x, 0.5)]
    trace = explorer.board.layers["trace"].points
    assert np.unique(trace.round(9), axis=0).tolist() == [[2.5, 1], [3, 1], [3.5, 1]]
    explorer.controls["trace"].value = False
    assert len(explorer.board.layers["trace"].points) == 0


def test_skeleton_of_the_shape_on_demand():
    explorer = explore.maximal_ball(HORSE)
    assert not explorer.board.visible("skeleton")
    explorer.controls["skeleton"].value = True
    assert np.array_equal(explorer.board.layers["skeleton"].lines, psl.sk2(HORSE).segments())
    explorer.controls["skeleton"].value = False
    assert explorer.board.picture("skeleton") == ""


# ---- 2.1 and 3.2: samples ----


@pytest.mark.parametrize(("n", "start"), [(50, 0.0), (120, 0.35), (400, 0.95)])
def test_sampling_shows_what_the_functions_return(n, start):
    explorer = explore.sampling(HORSE)
    with explorer.together():
        explorer.controls["n"].value = n
        explorer.controls["start"].value = start
        explorer.controls["polyball"].value = True
    E = HORSE.sample(n, start)
    skeleton, layers = psl.sk2(HORSE, E), explorer.board.layers
    assert np.array_equal(layers["samples"].points, E)
    assert np.array_equal(layers["skeleton"].lines, skeleton.segments())
    assert np.array_equal(layers["polyball"].circles[0], skeleton.balls().centers)
    assert explorer.numbers["covering_radius"] == HORSE.covering_radius(E)
    assert explorer.numbers["density_w"] == HORSE.sampling_density(E)
    assert explorer.numbers["Betti_numbers_of_Sk2"] == skeleton.betti()
    assert explorer.numbers["those_of_the_shape"] == (1, 0)
    assert (explorer.numbers["vertices"], explorer.numbers["edges"]) == (
        len(skeleton.vertices),
        len(skeleton.edges),
    )


def test_noise_is_seeded():
    noisy = [explore.sampling(HORSE, seed=seed) for seed in (0, 0, 1)]
    for explorer in noisy:
        explorer.controls["noise"].value = 0.5
    one, same, other = (explorer.samples() for explorer in noisy)
    assert np.array_equal(one, same)
    assert not np.array_equal(one, other)
    step = one - HORSE.sample(100)
    size = np.hypot(*np.ptp(HORSE.points, axis=0))
    assert step.std() == pytest.approx(0.005 * size, rel=0.2)
    noisy[0].controls["noise"].value = 0
    assert np.array_equal(noisy[0].samples(), HORSE.sample(100))


@pytest.mark.parametrize("n", [2, 401])
def test_sampling_refuses_what_is_not_on_the_slider(n):
    with pytest.raises(psl.InputError, match="from 3 to 400"):
        explore.sampling(HORSE, n=n)


# ---- 2.2: graphs ----


def test_graphs_of_the_handles():
    explorer = explore.graphs()
    points = np.random.default_rng(3).uniform((1, 1), (8, 4), (len(explorer.board.handles), 2))
    explorer.board.handles = points
    explorer.controls["gabriel"].value = True
    graph, layers = psl.delaunay(points), explorer.board.layers
    assert np.array_equal(layers["delaunay"].lines, points[graph.facets()])
    assert np.array_equal(layers["gabriel"].lines, points[psl.gabriel(graph)])
    dual = psl.voronoi(graph)
    assert np.array_equal(layers["voronoi"].lines[: len(dual.edges)], dual.segments())
    assert len(layers["voronoi"].lines) == len(dual.edges) + len(dual.rays)
    number = explorer.controls["triangle"].value
    assert layers["ball"].circles[1] == [graph.circumradii[number]]
    assert explorer.numbers["triangles"] == len(graph.simplices)
    assert explorer.numbers["Gabriel_segments"] == len(psl.gabriel(graph))


@pytest.mark.parametrize("name", ["delaunay", "voronoi", "gabriel"])
def test_graphs_can_be_switched_off(name):
    explorer = explore.graphs()
    explorer.controls[name].value = True
    assert explorer.board.picture(name)
    explorer.controls[name].value = False
    assert explorer.board.picture(name) == ""
    assert name.title() not in explorer.board.alt
    explorer.controls["triangle"].value = -1
    assert "radius_of_the_ball" not in explorer.numbers
    assert explorer.board.picture("ball") == ""


def test_ball_stays_with_its_triangle_until_a_sample_comes_in():
    explorer = explore.graphs([(0, 0), (4, 0), (2, 3), (2, -5)])
    graph = psl.delaunay(explorer.board.handles)
    upper = next(k for k, corners in enumerate(graph.simplices.tolist()) if 2 in corners)
    explorer.controls["triangle"].value = upper
    for y in (-4, -3, -2):
        explorer.board.handles = [(0, 0), (4, 0), (2, 3), (2, y)]
        assert explorer.numbers["radius_of_the_ball"] == pytest.approx(13 / 6)
        assert "no triangle" not in explorer.board.text
    explorer.board.handles = [(0, 0), (4, 0), (2, 3), (2, -1)]
    assert "Samples 0, 1 and 2 are no triangle any more" in explorer.board.text


def test_handle_on_handle_is_explained_and_undone():
    explorer = explore.graphs([(0, 0), (4, 0), (2, 3), (2, -5)])
    before = explorer.board.picture("delaunay")
    explorer.board.handles = [(0, 0), (4, 0), (0, 0), (2, -5)]
    assert isinstance(explorer.error, psl.DuplicatePointError)
    assert explorer.board.text == str(explorer.error)
    assert explorer.board.picture("delaunay") == before
    explorer.board.handles = [(0, 0), (4, 0), (2, 3), (2, -5)]
    assert explorer.error is None
    assert explorer.board.text.startswith("samples 4")


@pytest.mark.parametrize(
    "points", [[(0, 0), (1, 1)], [(0, 0), (0, 0), (1, 1)], np.zeros((41, 2)), [(0, np.nan)]]
)
def test_graphs_refuses_bad_points(points):
    with pytest.raises(psl.PolyskelError):
        explore.graphs(points)


# ---- 3.1 to 3.4: four methods ----


@pytest.mark.parametrize(("name", "n", "start"), [("horse", 96, 0.7), ("lake", 400, 0.0), ("gear", 150, 0.5)])
def test_four_methods_show_what_the_functions_return(name, n, start):
    shape = psl.datasets.load(name)
    explorer = explore.four_methods(shape, n=n, start=start)
    E = shape.sample(n, start)
    expected = {
        "sk0": psl.sk0(shape.resample(n, start)),
        "sk1": psl.sk1(shape, E),
        "sk2": psl.sk2(shape, E),
        "sk3": psl.sk3(shape, E),
    }
    for key, skeleton in expected.items():
        layer = explorer.board.layers[key]
        assert np.allclose(layer.lines, skeleton.segments() + explorer.offsets[key], rtol=0, atol=1e-15)
        numbers = explorer.numbers[f"Sk{key[2]}"]
        assert numbers == {
            "vertices": len(skeleton.vertices),
            "edges": len(skeleton.edges),
            "betti": skeleton.betti(),
        }
        assert f"Betti {skeleton.betti()}" in explorer.board.layers[f"heading_{key}"].text[0][2]
    assert explorer.numbers["shape"] == shape.betti()
    assert len(explorer.board.layers["sk1"].points) == len(expected["sk1"].vertices)


def test_four_methods_without_sk0():
    explorer = explore.four_methods(HORSE, n=60)
    polygon = HORSE.resample(60, 0.7)
    missing = psl.missing_facets(polygon, of="delaunay")
    assert explorer.numbers["Sk0"] is None
    assert f"none, {len(missing)} sides are not Delaunay" in explorer.board.text
    sides = explorer.board.layers["missing"].lines - explorer.offsets["sk0"]
    assert np.allclose(sides, polygon.segments[missing])
    explorer.controls["n"].value = 96
    assert explorer.numbers["Sk0"]["betti"] == (1, 0)
    assert explorer.board.picture("missing") == ""


def test_four_methods_on_a_polygon_that_crosses_itself():
    with pytest.raises(psl.ShapeError):
        HORSE.resample(9)
    explorer = explore.four_methods(HORSE, n=9, start=0)
    assert explorer.numbers["Sk0"] is None
    assert "crosses itself" in explorer.board.text


@pytest.mark.parametrize("wrong", [{"n": 2}, {"n": 1000}, {"start": 1.0}])
def test_four_methods_refuse_what_is_not_on_a_slider(wrong):
    with pytest.raises(psl.InputError, match="choose n from 3 to 400"):
        explore.four_methods(HORSE, **wrong)


@pytest.mark.parametrize("maker", [explore.maximal_ball, explore.sampling, explore.four_methods])
def test_planar_explorers_refuse_other_things(maker):
    with pytest.raises(psl.InputError, match="plane"):
        maker(psl.datasets.load("fourbranch"))
    with pytest.raises(psl.InputError):
        maker("horse")
