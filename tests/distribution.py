"""Which tests a worker runs one after the other, and in which order they are begun.

A file stays with one worker: what it has started, and the tables it has made, serve all of its
tests. The tests behind nginx share two replicas, so their files stay together as well.
"""

from collections import Counter

from xdist.scheduler import LoadScopeScheduling

SITE = "tests/deploy: behind nginx"
BEHIND_NGINX = {
    f"tests/deploy/test_{name}.py" for name in ("preview", "proxy", "replicas", "visitors")
}
# Long ones go first, so that the workers end at about the same time, and those of each folder in
# turn: while one waits for a server that was killed, the others compute.
LONG = (
    "tests/deploy", "tests/browser", "tests/app/test_sources", "tests/app/test_pages", "tests/app",
)  # fmt: skip


def scope(nodeid: str) -> str:
    """Return the name of the group of tests to which one belongs."""
    path = nodeid.partition("::")[0]
    return SITE if path in BEHIND_NGINX else path


def turns(nodeids: list[str]) -> list[tuple[int, int, str]]:
    """Return the place of each test in the order in which the groups are begun, file by file."""
    places = _places([scope(nodeid) for nodeid in nodeids])
    return [(*places[scope(nodeid)], nodeid.partition("::")[0]) for nodeid in nodeids]


def _places(scopes: list[str]) -> dict[str, tuple[int, int]]:
    begun = Counter[str]()
    places = {}
    for name in dict.fromkeys(scopes):
        folder = next((long for long in LONG if name.startswith(long)), "")
        places[name] = (begun[folder], LONG.index(folder)) if folder else (len(scopes), 0)
        begun[folder] += 1
    return places


class ByFile(LoadScopeScheduling):
    """Gives a worker one group of tests after the other, in the order of the collection."""

    def _split_scope(self, nodeid: str) -> str:
        return scope(nodeid)
