"""Every submission gets the marks it should get: right ones all, and one mistake costs its own task only."""

import course
import pytest
from marking import marked
from truth.submissions import SOURCES, SUBMISSIONS

# What a teacher may choose; of a hidden shape one draw in ten may be none.
SECRETS = ["another group", *(pytest.param(f"group {k}", marks=pytest.mark.slow) for k in range(10))]
RIGHT = [(name, SOURCES[name]) for name in SOURCES]
RIGHT += [
    (f"{told.assignment} {told.about['name']}", course.collected(SOURCES[told.assignment], told.notebook))
    for told in SUBMISSIONS
    if not told.about.get("lost")
]


@pytest.mark.parametrize("secret", SECRETS)
@pytest.mark.parametrize(("name", "notebook"), RIGHT, ids=[name for name, _ in RIGHT])
def test_what_is_right_has_full_marks(name, notebook, secret, monkeypatch):
    monkeypatch.setenv("POLYSKEL_COURSE_SECRET", secret)
    found = marked(notebook)
    assert [mark for mark in found.marks if mark.points < mark.most] == []
    assert found.taken == []


def test_a_source_that_fails_its_own_checks_is_not_released(tmp_path, monkeypatch):
    broken = course.copy.deepcopy(SOURCES["a2"])
    cell = next(cell for cell in broken.cells if course.grade_id(cell) == "a2-gabriel")
    cell.source = cell.source.replace("<= 0", "< 0")
    monkeypatch.setattr(course, "read", lambda path: broken)
    with pytest.raises(ValueError, match=r"own solution fails a2-gabriel-border: .*ON the circle"):
        course.write("a2", tmp_path)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("told", SUBMISSIONS, ids=lambda told: f"{told.assignment} {told.about['name']}")
def test_a_submission_gets_its_marks(told, monkeypatch):
    if any("never ends" in words for words in told.about.get("says", {}).values()):
        monkeypatch.setenv("POLYSKEL_COURSE_PATIENCE", "0.3")
    found = marked(course.collected(SOURCES[told.assignment], told.notebook))
    lost = {mark.name: mark.most - mark.points for mark in found.marks if mark.points < mark.most}
    said = {mark.name: mark.message for mark in found.marks}
    assert lost == told.about.get("lost", {}), said
    assert found.taken == told.about.get("taken", [])
    for name, words in told.about.get("says", {}).items():
        assert words in said[name]
