"""Long tests are shared out before short ones, and none is lost."""

import pytest

from tests.order import LONG, shared_out

# A few long ones, some less long, and many short ones, as pytest collects them.
TESTS = [
    *((f"app {i}", "app") for i in range(40)),
    *((f"browser {i}", "browser") for i in range(6)),
    *((f"deploy {i}", "deploy") for i in range(6)),
    *((f"short {i}", "films") for i in range(500)),
]
FOLDER = dict(TESTS)


@pytest.mark.parametrize("workers", [1, 2, 3, 5])
def test_each_worker_has_an_equal_share_of_what_is_long_and_first(workers: int) -> None:
    order = shared_out(TESTS, workers)
    assert sorted(order) == sorted(FOLDER)
    seconds, rest = [], order
    for i in range(workers):  # as pytest-xdist cuts it
        part = rest[: len(rest) // (workers - i)]
        rest = rest[len(part) :]
        is_long = [FOLDER[test] in LONG for test in part]
        assert is_long == sorted(is_long, reverse=True)
        seconds.append(sum(LONG.get(FOLDER[test], 0.0) for test in part))
    equal = sum(seconds) / workers
    assert all(abs(share - equal) <= max(LONG.values()) for share in seconds)
    # Tests of a folder keep their order, and so share what they share.
    for folder in LONG:
        own = [test for test in order if FOLDER[test] == folder]
        assert own == [test for test, name in TESTS if name == folder]


def test_where_all_are_long_or_all_are_short_none_is_lost() -> None:
    for folder in ("app", "films"):
        tests = [(f"{i}", folder) for i in range(7)]
        assert sorted(shared_out(tests, 3)) == sorted(name for name, _ in tests)
