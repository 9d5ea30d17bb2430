"""What an answer may take: time of its own, not that of a busy machine."""

import time

import pytest

from polyskel_lite.coursework import checks


@pytest.fixture
def called(monkeypatch):
    """Calls a function as a check does, with 0.2 seconds to compute."""
    monkeypatch.setenv(checks.PATIENCE, "0.02")

    def call(answer):
        monkeypatch.setitem(globals(), "answer", answer)
        return checks.guarded("answer")()

    return call


@pytest.mark.parametrize("step", [lambda: sum(range(1000)), lambda: time.sleep(0.01)])
def test_what_computes_or_waits_without_end_is_stopped(called, step):
    def forever():
        while True:
            step()

    with pytest.raises(checks.Wrong, match=r"was not ready after 0\.2 seconds"):
        called(forever)


def test_a_busy_machine_takes_no_points(called):
    def late():
        time.sleep(0.3)
        return "there"

    assert called(late) == "there"
