"""Settings of every test."""

import os

import pytest
from hypothesis import settings

from tests import distribution

# Before NumPy is imported: tests run side by side, and its threads would only get in their way.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# No deadline: an example that meets a cold cache or a busy machine is slow, not wrong.
settings.register_profile("local", deadline=None)
# The same examples in every run, so that a red build is red for its change.
settings.register_profile("ci", deadline=None, derandomize=True, database=None, print_blob=True)
settings.load_profile("ci" if os.environ.get("CI") else "local")


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_auto_num_workers() -> int:
    """Run one test more at once than there are cores: half of a test's time it waits for a page."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return (cores or 1) + 1


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: object) -> distribution.ByFile:
    """Keep the tests of a file together, whose servers and tables are then made once."""
    config.option.loadscopereorder = False
    return distribution.ByFile(config, log)


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Put long files first."""
    turns = distribution.turns([item.nodeid for item in items])
    items[:] = [items[i] for i in sorted(range(len(items)), key=turns.__getitem__)]


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Say by how much the workers ended apart: one that goes on alone leaves a core idle."""
    ends: dict[str, float] = {}
    for report in (one for reports in terminalreporter.stats.values() for one in reports):
        if node := getattr(report, "node", None):
            ends[node.gateway.id] = max(report.stop, ends.get(node.gateway.id, 0.0))
    last = max(ends.values(), default=0.0)
    for name in sorted(ends):
        terminalreporter.write_line(f"{name} ended {last - ends[name]:.1f} s before the last")
