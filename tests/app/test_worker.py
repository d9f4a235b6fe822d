"""The process for heavy computations: its answers, its failures, its end."""

import os
import signal
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import TransientError
from tests.machines import SHEET
from ui.jobs import work
from ui.jobs.process import Worker, WorkerError
from ui.serving.log import described

LONG = (SHEET, 600.0, 0.3, 600)


@pytest.fixture
def worker() -> Iterator[Worker]:
    made = Worker()
    yield made
    made.close()


def test_the_answer_is_the_one_of_this_process(worker: Worker) -> None:
    asked = SHEET, 600.0, 0.3, 20
    there, here = worker.run(work.release, asked, None), work.release(*asked)
    assert np.array_equal(there.motion.journal, here.motion.journal)
    assert there.stopped == here.stopped


def test_progress_is_reported(worker: Worker) -> None:
    told: list[float] = []
    worker.run(work.release, LONG, told.append)
    assert len(told) > 10
    assert told == sorted(told)
    assert told[-1] == 1.0


def test_an_error_in_the_listener_ends_the_computation_and_not_the_process(worker: Worker) -> None:
    class LeftError(BaseException):
        pass

    told: list[float] = []

    def leave(share: float) -> None:
        told.append(share)
        raise LeftError

    with pytest.raises(LeftError):
        worker.run(work.release, LONG, leave)
    assert len(told) == 1
    assert worker.idle
    assert worker.run(np.zeros, (3,), None).shape == (3,)


def test_an_error_is_raised_here_with_its_places_in_the_code(worker: Worker) -> None:
    with pytest.raises(ValueError, match="radial clearance") as caught:
        worker.run(work.release, (SHEET, 600.0, 5.0, 20), None)
    assert any("work.py" in place for place in described(caught.value)["places"])
    assert worker.run(np.zeros, (3,), None).shape == (3,)


def test_a_motion_that_ends_early_is_returned_so_far(worker: Worker) -> None:
    with pytest.raises(TransientError, match="after") as caught:
        worker.run(break_off, (), None)
    assert len(caught.value.partial.time) == 5


def test_a_process_that_dies_is_said_to_be_dead(worker: Worker) -> None:
    with pytest.raises(WorkerError, match="ended"):
        worker.run(os.kill, (worker._process.pid, signal.SIGKILL), None)
    assert not worker.idle
    with pytest.raises(WorkerError, match="ended"):
        worker.run(np.zeros, (3,), None)


def test_it_ends_with_the_process_that_began_it() -> None:
    worker = Worker()
    worker.run(np.zeros, (3,), None)
    worker._process.stdin.close()
    assert worker._process.wait(timeout=10.0) == 0
    worker._process.stdout.close()


def break_off() -> None:
    """Raise what an integration raises that ends early."""
    motion = work.release(SHEET, 600.0, 0.3, 20).motion
    part = replace(motion, time=motion.time[:5])
    raise TransientError("stopped after 1 s", part)
