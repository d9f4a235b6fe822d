"""One page at a time, others while one waits for something else, and each visitor his share."""

import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest
from streamlit.runtime.scriptrunner import StopException

from tests.app.session import visit
from tests.waiting import PATIENCE, take, until
from ui.serving import one_at_a_time
from ui.serving.one_at_a_time import Gate


def test_the_gate_admits_one_thread_at_a_time() -> None:
    gate, inside, most = Gate(), set[int](), list[int]()

    def go(number: int) -> None:
        with gate.through():
            inside.add(number)
            until(lambda: len(gate._line) == 4 - len(most))  # all who are still to come wait
            most.append(len(inside))
            inside.remove(number)

    with ThreadPoolExecutor(5) as pool:
        list(pool.map(go, range(5), timeout=PATIENCE))
    assert most == [1] * 5


def test_a_thread_that_steps_aside_admits_others_and_re_enters_alone() -> None:
    gate, seen, met = Gate(), list[str](), threading.Event()

    def other() -> None:
        with gate.through():
            met.set()
            until(lambda: gate._line)  # the first wants to come back
            seen.append("second")

    with ThreadPoolExecutor(1) as pool:
        with gate.through():
            with gate.aside():
                second = pool.submit(other)
                take(met)
            seen.append("first")
        second.result(PATIENCE)
    assert seen == ["second", "first"]


def test_order_of_arrival_holds_after_stepping_aside_too() -> None:
    gate, seen, may_leave = Gate(), list[str](), threading.Event()

    def other(name: str) -> None:
        with gate.through():
            if name == "second":
                take(may_leave)
            seen.append(name)

    def first() -> None:
        with gate.through():
            with gate.aside():
                others.append(pool.submit(other, "second"))
                until(lambda: gate._taken)
                others.append(pool.submit(other, "third"))
                until(lambda: len(gate._line) == 1)
            seen.append("first")

    others: list = []
    with ThreadPoolExecutor(3) as pool:
        one = pool.submit(first)
        until(lambda: len(gate._line) == 2)  # the second is in; the third waits, then the first
        may_leave.set()
        for thread in (one, *others):
            thread.result(PATIENCE)
    assert seen == ["second", "first", "third"]


def test_the_gate_reopens_after_an_error_inside_or_aside() -> None:
    gate = Gate()
    with pytest.raises(RuntimeError), gate.through():
        raise RuntimeError
    assert _is_open(gate)
    with pytest.raises(RuntimeError), gate.through(), gate.aside():
        raise RuntimeError
    assert _is_open(gate)


def test_a_thread_outside_the_gate_opens_nothing_by_stepping_aside() -> None:
    gate, entered = Gate(), threading.Event()

    def stranger() -> None:
        with gate.aside(), gate.through():
            entered.set()

    with ThreadPoolExecutor(1) as pool:
        with gate.through():
            other = pool.submit(stranger)
            until(lambda: gate._line)  # outside, where it belongs
            assert not entered.is_set()
        other.result(PATIENCE)
    assert entered.is_set()
    assert _is_open(gate)


def _is_open(gate: Gate) -> bool:
    """Tell whether another thread gets in."""
    entered = threading.Event()

    def go() -> None:
        with gate.through():
            entered.set()

    thread = threading.Thread(target=go, daemon=True)  # where it gets in never, it ends with us
    thread.start()
    return entered.wait(PATIENCE)


@pytest.mark.parametrize("rpm", ["6000", "nonsense"])
def test_a_page_waits_for_the_previous_one_and_then_admits_the_next(rpm: str) -> None:
    ended = threading.Event()

    def go() -> None:
        visit("pages/5_Response.py", rpm=rpm)
        ended.set()

    with ThreadPoolExecutor(1) as pool:
        with one_at_a_time.PAGES.through():
            page = pool.submit(go)
            until(lambda: one_at_a_time.PAGES._line)
            assert not ended.is_set()
        page.result(PATIENCE)
    assert ended.is_set()
    assert _is_open(one_at_a_time.PAGES)


def test_visitors_with_less_use_go_before_earlier_arrivals() -> None:
    gate, seen = Gate(), list[str]()
    with gate.through("busy"):
        time.sleep(0.01)

    def go(name: str) -> None:
        with gate.through(name):
            seen.append(name)

    with ThreadPoolExecutor(2) as pool:
        with gate.through():
            threads = [pool.submit(go, "busy")]
            until(lambda: len(gate._line) == 1)
            threads.append(pool.submit(go, "quiet"))
            until(lambda: len(gate._line) == 2)
        for thread in threads:
            thread.result(PATIENCE)
    assert seen == ["quiet", "busy"]


def test_late_arrivals_get_no_credit_for_time_before_they_came(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    now, gate, begun = [0.0], Gate(), list[float]()
    monkeypatch.setattr(one_at_a_time.time, "monotonic", lambda: now[0])
    for name in ("one", "other", "one", "other", "late"):
        with gate.through(name):
            begun.append(gate._mine.place.begin)
            now[0] += 2.0
    assert begun == [0, 0, 2, 2, 2]
    assert gate._ends == {"one": 4, "other": 4, "late": 4}


def test_a_visitors_newer_page_takes_the_place_of_one_that_waits() -> None:
    gate, seen = Gate(), list[str]()

    def go(name: str) -> None:
        with gate.through("visitor"):
            seen.append(name)

    with ThreadPoolExecutor(2) as pool:
        with gate.through("another"):
            first = pool.submit(go, "first")
            until(lambda: len(gate._line) == 1)
            second = pool.submit(go, "second")
            with pytest.raises(StopException):
                first.result(PATIENCE)
        second.result(PATIENCE)
    assert seen == ["second"]
    assert _is_open(gate)
