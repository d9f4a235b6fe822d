"""One page at a time, others while one waits for something else."""

import threading
import time

import pytest

from tests.app.session import visit
from ui.serving import one_at_a_time
from ui.serving.one_at_a_time import Gate


def test_one_thread_is_in_at_a_time() -> None:
    passage, inside, most = Gate(), [], []

    def go(number: int) -> None:
        with passage.through():
            inside.append(number)
            most.append(len(inside))
            time.sleep(0.01)
            inside.remove(number)

    together(go, 5)
    assert most == [1] * 5


def test_who_steps_aside_lets_the_others_in_and_comes_back_alone() -> None:
    passage, seen = Gate(), []
    begun, met = threading.Event(), threading.Event()

    def go(number: int) -> None:
        if number == 0:
            with passage.through():
                begun.set()
                with passage.aside():
                    assert met.wait(10.0)
                seen.append("first")
        else:
            begun.wait(10.0)
            with passage.through():
                met.set()
                time.sleep(0.02)
                seen.append("second")

    together(go, 2)
    assert seen == ["second", "first"]


def test_who_came_first_goes_first_after_stepping_aside_too() -> None:
    passage, seen = Gate(), []
    steps = [threading.Event() for _ in range(3)]  # the first is aside; may come back; may go on

    def go(number: int) -> None:
        if number == 0:
            with passage.through():
                with passage.aside():
                    steps[0].set()
                    steps[1].wait(10.0)
                seen.append("first")
            return
        steps[0].wait(10.0)
        time.sleep(0.05 * number)
        with passage.through():
            if number == 1:
                steps[2].wait(10.0)
            seen.append(("second", "third")[number - 1])

    threads = [threading.Thread(target=go, args=(i,)) for i in range(3)]
    for thread in threads:
        thread.start()
    time.sleep(0.3)  # the second is in, the third waits
    steps[1].set()
    time.sleep(0.1)  # so does the first
    steps[2].set()
    for thread in threads:
        thread.join(10.0)
    assert seen == ["second", "first", "third"]


def test_what_fails_inside_or_aside_leaves_the_gate_open() -> None:
    passage = Gate()
    with pytest.raises(RuntimeError), passage.through():
        raise RuntimeError
    with pytest.raises(RuntimeError), passage.through(), passage.aside():
        raise RuntimeError
    with passage.through():
        pass


def test_who_is_not_in_need_not_step_aside() -> None:
    passage = Gate()
    with passage.aside(), passage.through():
        pass


@pytest.mark.parametrize("rpm", ["6000", "nonsense"])
def test_a_page_waits_for_the_one_before_and_lets_the_next_in(rpm: str) -> None:
    ended: list[int] = []

    def go(number: int) -> None:
        visit("pages/5_Response.py", rpm=rpm)
        ended.append(number)

    with one_at_a_time.PAGES.through():
        thread = threading.Thread(target=go, args=(1,))
        thread.start()
        thread.join(1.0)
        assert not ended
    thread.join(30.0)
    assert ended == [1]


def together(go, number: int) -> None:
    threads = [threading.Thread(target=go, args=(i,)) for i in range(number)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(10.0)
