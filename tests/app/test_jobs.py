"""Heavy computations: their order, their number at once, what is kept of them, what is said."""

import threading
import time

import numpy as np
import pytest

from rotorcalc import onset_speed
from tests.machines import SHEET
from ui.jobs import queue
from ui.jobs.cache import Cached, size_of
from ui.jobs.queue import Turns


class Here:
    """Computes like a worker, in this process."""

    idle = True

    def __init__(self) -> None:
        self.closed = False

    def run(self, work, args, _tell):
        return work(*args)

    def close(self) -> None:
        self.closed = True


class Witness:
    """Counts how many computations run at once, and remembers their order."""

    def __init__(self) -> None:
        self.running = self.most = 0
        self.order: list[int] = []
        self._lock = threading.Lock()

    def work(self, number: int) -> None:
        with self._lock:
            self.running += 1
            self.most = max(self.most, self.running)
            self.order.append(number)
        time.sleep(0.02)
        with self._lock:
            self.running -= 1


@pytest.mark.parametrize("limit", [1, 3])
def test_no_more_than_the_limit_run_at_once_and_first_come_first_served(limit: int) -> None:
    turns, witness = Turns(limit, hire=Here), Witness()

    def run(number: int) -> None:
        with turns.turn():
            witness.work(number)

    threads = [threading.Thread(target=run, args=(i,)) for i in range(9)]
    for thread in threads:
        thread.start()
        time.sleep(0.002)
    for thread in threads:
        thread.join()
    assert witness.most == limit
    if limit == 1:
        assert witness.order == sorted(witness.order)


def test_a_computation_that_fails_or_is_left_lets_the_next_one_in() -> None:
    turns = Turns(1, hire=Here)
    with pytest.raises(RuntimeError), turns.turn() as first:
        raise RuntimeError
    with turns.turn() as second:
        pass
    assert second is first


def test_a_process_left_in_the_middle_of_something_is_ended_and_another_hired() -> None:
    turns = Turns(1, hire=Here)
    with turns.turn() as first:
        first.idle = False
    assert first.closed
    with turns.turn() as second:
        assert second is not first
    turns.end()
    assert second.closed


def test_who_would_wait_too_long_is_told_and_not_kept_waiting(monkeypatch) -> None:
    said: list[str] = []
    monkeypatch.setattr(queue.st, "warning", said.append)

    class StoppedError(Exception):
        pass

    def stop() -> None:
        raise StoppedError

    monkeypatch.setattr(queue.st, "stop", stop)
    monkeypatch.setattr(queue, "_nobody_looks", lambda: False)
    turns = Turns(1, longest=0, hire=Here)
    with turns.turn():
        found: list[type] = []

        def other() -> None:
            try:
                with turns.turn():
                    pass
            except StoppedError as error:
                found.append(type(error))

        thread = threading.Thread(target=other)
        thread.start()
        thread.join()
    assert found == [StoppedError]
    assert said == [queue.BUSY]


def test_two_who_ask_for_the_same_at_once_compute_it_once() -> None:
    asked: list[int] = []

    def work(number: int) -> int:
        asked.append(number)
        time.sleep(0.05)
        return 2 * number

    cached = Cached(work, entries=4, megabytes=1, turns=Turns(1, hire=Here))
    found: list[int] = []
    threads = [threading.Thread(target=lambda: found.append(cached(21))) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [42] * 4
    assert asked == [21]


def test_results_are_kept_up_to_a_number_and_a_size() -> None:
    few = Cached(np.zeros, entries=3, megabytes=100)
    for n in range(1, 10):
        few(n)
    assert len(few) == 3
    small = Cached(np.zeros, entries=100, megabytes=0.1)
    for n in range(1000, 1040):
        small(n)
    assert small.size <= 0.1e6
    assert len(small) > 5
    small(10**6)  # larger than all of it: kept alone until the next one
    assert len(small) == 1


def test_the_size_of_a_result_is_that_of_its_arrays() -> None:
    assert size_of(np.zeros((10, 2))) == 160
    assert size_of((np.zeros(10), [np.zeros(5)])) == 120
    assert 64 < size_of(onset_speed(SHEET)) < 1000
