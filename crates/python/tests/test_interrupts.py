"""Long calls: other threads of Python go on meanwhile, and Ctrl-C ends them."""

import os
import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

import congruent

# From the signal to the exception, s. Kind: choice; the signal is looked at every 20 ms.
PROMPT_S = 1.5


@contextmanager
def interrupted_after(delay_s: float) -> Iterator[None]:
    """Ctrl-C after this time; the timer is a thread of Python, which runs only if the call has released the interpreter."""
    sent: list[float] = []

    def interrupt() -> None:
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(delay_s, interrupt)
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            yield
        assert time.monotonic() - sent[0] < PROMPT_S
    finally:
        timer.cancel()


def test_a_search_of_many_targets(ur5e: congruent.Robot) -> None:
    beyond = np.full((200_000, 3), 50.0)
    with interrupted_after(0.3):
        ur5e.ik(beyond)
    # Nothing of the interrupted call is in the way of the next.
    assert ur5e.ik(ur5e.fk(np.full(6, 0.3))).converged


def test_regressors_of_many_motions(ur5e: congruent.Robot) -> None:
    many = np.zeros((400_000, 6))
    with interrupted_after(0.1):
        ur5e.regressor(many, many, many)


def test_a_check(root: Path) -> None:
    with interrupted_after(0.1):
        while True:
            congruent.check(root / "robots/panda/wrong_convention.toml")


def test_a_run_keeps_what_it_has_computed(root: Path, tmp_path: Path) -> None:
    with interrupted_after(1.0):
        congruent.run(root / "scenarios/ur5e_pick.toml", set={"simulation.step_s": 1e-5}, out=tmp_path)
    [report] = tmp_path.glob("*/report.json")
    assert "interrupted" in report.read_text()


def test_other_threads_go_on(ur5e: congruent.Robot) -> None:
    q = np.random.default_rng(11).uniform(-3, 3, (400_000, 6))
    counted, is_over = [0], threading.Event()

    def count() -> None:
        while not is_over.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    ur5e.mass_matrix(q)
    after = counted[0]
    is_over.set()
    thread.join()
    # A call that holds the interpreter lets no other thread count.
    assert after - before >= 5


def test_several_threads_use_one_robot(ur5e: congruent.Robot) -> None:
    q = np.random.default_rng(12).uniform(-3, 3, (3000, 6))
    expected, found = ur5e.fk(q), {}

    def compute(at: int) -> None:
        found[at] = ur5e.fk(q)

    threads = [threading.Thread(target=compute, args=(at,)) for at in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for at in range(4):
        np.testing.assert_array_equal(found[at], expected)
