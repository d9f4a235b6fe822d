"""Heavy computations: their order, concurrency, cache and messages."""

import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from rotorcalc import onset_speed
from tests.machines import SHEET
from tests.waiting import PATIENCE, take, until
from ui.jobs import queue
from ui.jobs.cache import Cached, size_of
from ui.jobs.process import WorkerError
from ui.jobs.queue import Turns


class Here:
    """Computes like a worker, in this process."""

    idle, ended, silent = True, False, False

    def __init__(self) -> None:
        self.closed = False

    def run(self, work, args, _tell):
        return work(*args)

    def answers(self) -> bool:
        return not self.ended

    def close(self) -> None:
        self.closed = True


@pytest.mark.parametrize("limit", [1, 3])
def test_no_more_than_the_limit_run_at_once_in_order_of_arrival(limit: int) -> None:
    turns, all_here, together = Turns(limit, hire=Here), threading.Event(), threading.Barrier(limit)
    running, most, order = set[int](), list[int](), list[int]()

    def run(number: int) -> None:
        with turns.turn():
            order.append(number)
            running.add(number)
            take(all_here)
            together.wait(PATIENCE)  # as many as may run do run
            most.append(len(running))
            together.wait(PATIENCE)
            running.remove(number)

    with ThreadPoolExecutor(9) as pool:
        runs = []
        for i in range(9):
            runs.append(pool.submit(run, i))
            until(lambda i=i: len(turns._line) > i)
        all_here.set()
        for one in runs:
            one.result(PATIENCE)
    assert most == [limit] * 9
    for i in range(0, 9, limit):  # those who run at once may begin in any order
        assert sorted(order[i : i + limit]) == list(range(i, i + limit))


def test_threads_at_once_never_share_a_process() -> None:
    turns, together = Turns(4, hire=Here), threading.Barrier(4)

    def run(_: int) -> Here:
        with turns.turn() as worker:
            together.wait(PATIENCE)  # four at once
            return worker

    with ThreadPoolExecutor(4) as pool:
        for _ in range(50):
            assert len(set(pool.map(run, range(4)))) == 4


def test_a_process_is_used_again_after_a_failed_computation() -> None:
    turns = Turns(1, hire=Here)
    with pytest.raises(RuntimeError), turns.turn() as first:
        raise RuntimeError
    with turns.turn() as second:
        pass
    assert second is first


def test_a_process_abandoned_while_busy_is_ended_and_replaced() -> None:
    turns = Turns(1, hire=Here)
    with turns.turn() as first:
        first.idle = False
    assert first.closed
    with turns.turn() as second:
        assert second is not first
    turns.end()
    assert second.closed


def test_a_free_process_that_does_not_answer_is_replaced_and_named() -> None:
    turns = Turns(1, hire=Here, name="releases")
    with turns.turn() as first:
        pass
    assert turns.inspect() == ""
    first.ended = True
    assert turns.inspect() == "a process for releases does not answer"
    assert first.closed
    assert turns.inspect() == ""
    with turns.turn() as second:
        assert second is not first
        assert turns.inspect() == ""  # at work: not asked


def test_a_computation_whose_process_hangs_begins_again_once_in_another() -> None:
    class Hanging(Here):
        def run(self, _work, _args, _tell):
            self.idle = False
            raise WorkerError("no sign of life")

    hired: list[Here] = []

    def hire() -> Here:
        hired.append(Hanging() if len(hired) in (0, 2, 3) else Here())
        return hired[-1]

    turns = Turns(1, hire=hire)
    assert turns.run(abs, (-2,), None) == 2
    assert [worker.closed for worker in hired] == [True, False]
    hired[1].ended = True
    with pytest.raises(WorkerError):
        turns.run(abs, (-2,), None)
    assert len(hired) == 4


def test_a_free_process_that_has_ended_is_given_to_nobody() -> None:
    turns = Turns(1, hire=Here)
    with turns.turn() as first:
        pass
    first.ended = True
    with turns.turn() as second:
        assert second is not first


def test_a_visitor_beyond_a_full_queue_gets_a_message_at_once(monkeypatch) -> None:
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


@pytest.mark.parametrize("limit", [1, 2, 4])
def test_requests_for_the_same_at_once_are_computed_once(limit: int) -> None:
    begun, go_on = threading.Semaphore(0), threading.Event()
    asked: list[int] = []

    def work(number: int) -> int:
        asked.append(number)
        begun.release()
        take(go_on)
        return 2 * number

    cached = Cached(work, entries=4, megabytes=1, turns=Turns(limit, hire=Here))
    with ThreadPoolExecutor(4) as pool:
        found = [pool.submit(cached, 21) for _ in range(4)]
        assert begun.acquire(timeout=PATIENCE)
        assert not begun.acquire(timeout=0.2)  # nobody else computes
        go_on.set()
        assert [one.result(PATIENCE) for one in found] == [42] * 4
    assert asked == [21]


def test_requests_that_wait_for_the_same_do_not_hold_up_others() -> None:
    begun, go_on = threading.Event(), threading.Event()

    def work(number: int) -> int:
        if number == 21:
            begun.set()
            take(go_on)
        return 2 * number

    cached = Cached(work, entries=4, megabytes=1, turns=Turns(2, hire=Here))
    with ThreadPoolExecutor(5) as pool:
        same = [pool.submit(cached, 21) for _ in range(4)]
        take(begun)
        assert pool.submit(cached, 5).result(PATIENCE) == 10
        assert not any(one.done() for one in same)
        go_on.set()
        assert [one.result(PATIENCE) for one in same] == [42] * 4


def test_the_next_request_takes_over_a_failed_computation() -> None:
    begun, go_on = threading.Event(), threading.Event()
    asked: list[int] = []

    def work(number: int) -> int:
        asked.append(number)
        begun.set()
        take(go_on)
        if len(asked) == 1:
            raise RuntimeError
        return 2 * number

    cached = Cached(work, entries=4, megabytes=1, turns=Turns(2, hire=Here))
    with ThreadPoolExecutor(3) as pool:
        first = pool.submit(cached, 21)
        take(begun)
        others = [pool.submit(cached, 21) for _ in range(2)]
        go_on.set()
        assert isinstance(first.exception(PATIENCE), RuntimeError)
        assert [one.result(PATIENCE) for one in others] == [42, 42]
    assert asked == [21, 21]


def doubled(asked: list[tuple[int]], most: int) -> list[int]:
    return [2 * number for (number,) in asked[:most]]


def test_one_order_gives_several_results() -> None:
    cached = Cached(lambda number: 2 * number, entries=9, megabytes=1, turns=Turns(1, hire=Here))
    asked = [(1,), (2,), (3,), (4,)]
    assert cached.several(asked, doubled, 2) == 2
    assert [cached.known(*one) for one in asked] == [2, 4, None, None]
    assert cached.several(asked[:2], doubled, 4) == 0  # known: nothing is ordered
    assert cached.several(asked, doubled, 4) == 2  # what was asked and not given is free
    assert [cached.known(*one) for one in asked] == [2, 4, 6, 8]
    assert not cached._under_way


def test_an_order_leaves_to_another_visitor_what_he_has_begun() -> None:
    begun, go_on, orders = threading.Event(), threading.Event(), list[object]()

    def work(number: int) -> int:
        begun.set()
        take(go_on)
        return 2 * number

    def together(asked: list[tuple[int]], most: int) -> list[int]:
        orders.append(asked)
        return doubled(asked, most)

    cached = Cached(work, entries=9, megabytes=1, turns=Turns(2, hire=Here))
    with ThreadPoolExecutor(1) as pool:
        his = pool.submit(cached, 2)
        take(begun)
        assert cached.several([(1,), (2,), (3,)], together, 9) == 2
        assert cached.several([(2,)], together, 9) == 0
        go_on.set()
        assert his.result(PATIENCE) == 4
    assert orders == [((1,), (3,))]


def test_a_failed_order_is_free_for_others() -> None:
    def together(*_: object) -> list[int]:
        raise RuntimeError

    cached = Cached(lambda number: 2 * number, entries=9, megabytes=1, turns=Turns(1, hire=Here))
    with pytest.raises(RuntimeError):
        cached.several([(1,), (2,)], together)
    assert [cached(1), cached(2)] == [2, 4]


def test_results_are_kept_up_to_a_number_and_a_size() -> None:
    few = Cached(np.zeros, entries=3, megabytes=100, turns=Turns(1, hire=Here))
    for n in range(1, 10):
        few(n)
    assert len(few) == 3
    small = Cached(np.zeros, entries=100, megabytes=0.1, turns=Turns(1, hire=Here))
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
