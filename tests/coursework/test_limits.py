"""What an answer may take: time of its own, not that of a busy machine."""

import threading
import time

import numpy as np
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


def test_threads_beside_it_take_no_points(called):
    """As those of a matrix product do: they are let compute, and the answer waits for them."""

    def shared():
        square = np.ones((1_000_000,))
        end = time.monotonic() + 0.3

        def work():
            while time.monotonic() < end:
                np.sin(square)  # which lets other threads compute

        others = [threading.Thread(target=work) for _ in range(2)]
        for other in others:
            other.start()
        for other in others:
            other.join()
        return "there"

    assert called(shared) == "there"
