"""Which addresses a server's process asks: a hook on Python's sockets, in each of its processes.

`environment` makes every Python that is started with it write the peers of its connections, and the
names that it looks up, into a file.
"""

import ast
from ipaddress import ip_address
from pathlib import Path

_HOOK = """
import sys

def note(event, given, path={path!r}):
    if event in ("socket.connect", "socket.sendto", "socket.sendmsg", "socket.getaddrinfo",
                 "socket.gethostbyname"):
        peer = given[0] if event.startswith("socket.get") else given[1]
        with open(path, "a") as file:
            file.write(repr((event, peer)) + "\\n")

sys.addaudithook(note)
"""


def environment(folder: Path) -> dict[str, str]:
    """Return the environment of a server whose connections are written into a folder."""
    (folder / "sitecustomize.py").write_text(_HOOK.format(path=str(_file(folder))))
    _file(folder).touch()
    return {"PYTHONPATH": str(folder)}


def asked(folder: Path) -> list[tuple[str, str]]:
    """Return each event and address outside this machine that was asked."""
    events = [ast.literal_eval(line) for line in _file(folder).read_text().splitlines()]
    names = [(event, peer[0] if isinstance(peer, tuple) else str(peer)) for event, peer in events]
    return [(event, name) for event, name in names if not _is_here(name)]


def _file(folder: Path) -> Path:
    return folder / "asked.txt"


def _is_here(name: str) -> bool:
    if name in ("localhost", "0.0.0.0", "::", "None") or name.startswith("/"):  # noqa: S104
        return True
    try:
        return ip_address(name).is_loopback
    except ValueError:
        return False
