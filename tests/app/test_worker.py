"""The process for heavy computations: its answers, its failures, its end."""

import os
import signal
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from rotorcalc import TransientError
from tests.machines import SHEET
from tests.waiting import PATIENCE, until
from ui.jobs import process, queue, work
from ui.jobs.process import Worker, WorkerError
from ui.jobs.queue import Turns
from ui.serving.log import described

LONG = (SHEET, 600.0, 0.3, 600)


@pytest.fixture(scope="module")
def worker() -> Iterator[Worker]:
    """A process for all tests that leave it idle."""
    made = Worker()
    yield made
    made.close()


@pytest.fixture
def doomed() -> Iterator[Worker]:
    """A process for a test that ends or stops it."""
    made = Worker()
    yield made
    made.close()


def test_a_worker_returns_the_same_result_as_this_process(worker: Worker) -> None:
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


def test_an_error_in_the_progress_callback_ends_the_computation_only(worker: Worker) -> None:
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


def test_a_motion_that_ends_early_is_returned_up_to_its_end(worker: Worker) -> None:
    with pytest.raises(TransientError, match="after") as caught:
        worker.run(break_off, (), None)
    assert len(caught.value.partial.time) == 5


def test_the_death_of_a_process_is_reported(doomed: Worker) -> None:
    with pytest.raises(WorkerError, match="ended"):
        doomed.run(os.kill, (doomed._process.pid, signal.SIGKILL), None)
    assert not doomed.idle
    with pytest.raises(WorkerError, match="ended"):
        doomed.run(np.zeros, (3,), None)


def test_a_hanging_process_is_reported_as_giving_no_sign(
    doomed: Worker, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert doomed.answers()
    monkeypatch.setattr(process, "_LOOK", 0.1)
    with pytest.raises(WorkerError, match="no sign of life"):
        doomed.run(os.kill, (doomed._process.pid, signal.SIGSTOP), None)
    assert doomed.silent
    assert not doomed.idle
    assert not doomed.answers()


def test_a_process_in_a_long_computation_gives_signs_of_life(worker: Worker) -> None:
    worker.run(time.sleep, (process._PATIENCE * process._LOOK + 1.0,), None)
    assert worker.idle


def test_a_computation_whose_process_ends_begins_again_once(tmp_path: Path) -> None:
    turns = Turns(1)
    assert turns.run(end_once, (str(tmp_path),), None) == 1
    with pytest.raises(WorkerError):
        turns.run(end, (), None)
    turns.end()


@pytest.mark.parametrize("what", [signal.SIGKILL, signal.SIGSTOP])
def test_a_free_process_that_is_lost_is_replaced(
    what: signal.Signals, monkeypatch: pytest.MonkeyPatch
) -> None:
    turns = Turns(1)
    assert turns.run(np.ndim, (3,), None) == 0
    assert turns.inspect() == ""
    monkeypatch.setattr(process, "_LOOK", 0.2)
    with turns.turn() as lost:
        os.kill(lost._process.pid, what)
        until(lambda: _state(lost) in "TZ")
    assert "does not answer" in turns.inspect()
    with turns.turn() as new:
        assert new is not lost
        assert new.answers()
    turns.end()


def test_a_process_lost_at_work_is_told_for_a_while_after_it_is_replaced(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A server looks at itself more rarely than a process takes to be replaced."""
    now = [100.0]
    monkeypatch.setattr(queue, "time", SimpleNamespace(monotonic=lambda: now[0]))
    turns = Turns(1)
    assert turns.inspect() == ""
    assert turns.run(end_once, (str(tmp_path),), None) == 1
    for later, told in ((10.0, True), (10.0, False)):
        now[0] += later
        assert ("does not answer" in turns.inspect()) is told
    turns.end()


def test_a_worker_ends_with_its_parent_process() -> None:
    worker = Worker()
    worker.run(np.zeros, (3,), None)
    worker._process.stdin.close()
    assert worker._process.wait(PATIENCE) == 0
    worker._process.stdout.close()


def _state(worker: Worker) -> str:
    """Return whether a process runs (R), sleeps (S), is stopped (T) or has ended (Z)."""
    return Path(f"/proc/{worker._process.pid}/stat").read_text().rsplit(")", 1)[1].split()[0]


def end() -> None:
    """End the process that computes this."""
    os.kill(os.getpid(), signal.SIGKILL)


def end_once(folder: str) -> int:
    """End the process the first time, and return how often it has ended."""
    note = Path(folder) / "ended"
    if not note.exists():
        note.touch()
        end()
    return 1


def break_off() -> None:
    """Raise what an integration raises that ends early."""
    motion = work.release(SHEET, 600.0, 0.3, 20).motion
    part = replace(motion, time=motion.time[:5])
    raise TransientError("stopped after 1 s", part)
