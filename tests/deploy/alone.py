"""A server and its visitors, best in a network namespace: python -m tests.deploy.alone [shut]

Where no way leads out, Linux counts every packet for which there is none, whoever sends it, Python
or not: a connection outside, a datagram, a question to a name server. `shut` says that it is run in
such a place, where one packet is sent at last. What Python's own sockets ask is noted anywhere;
there one more is asked too, of which no packet goes out.
"""

import asyncio
import fcntl
import json
import os
import socket
import struct
import subprocess
import sys
import tempfile
from contextlib import suppress
from pathlib import Path

from websockets.asyncio.client import connect
from websockets.exceptions import InvalidStatus

from tests.deploy import audit
from tests.load.client import Visitor
from tests.load.replicas import Replica

_UP, _SET_FLAGS = 0x1, 0x8914  # IFF_UP, SIOCSIFFLAGS of <net/if.h> and <bits/ioctls.h>
# A datagram's socket that is connected sends nothing yet.
_ONE_MORE = "import socket; socket.socket(type=socket.SOCK_DGRAM).connect_ex(('198.51.100.7', 80))"
FOREIGN = ("http://evil.example", "http://198.51.100.7", "http://localhost:1", "null")


def raise_loopback() -> None:
    """Make this machine reach itself, which a new namespace does not."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as there:
        fcntl.ioctl(there, _SET_FLAGS, struct.pack("16sh", b"lo", _UP))


def packets_without_a_way() -> int:
    """Return how many packets had no way out of this namespace, of both families."""
    names, counts = (
        line.split()[1:]
        for line in Path("/proc/net/snmp").read_text().splitlines()
        if line.startswith("Ip:")
    )
    four = dict(zip(names, counts, strict=True))
    six = dict(line.split() for line in Path("/proc/net/snmp6").read_text().splitlines())
    return int(four["OutNoRoutes"]) + int(six.get("Ip6OutNoRoutes", 0))


async def visit(server: Replica) -> None:
    """Do what visitors do, and what pages of other sites try."""
    for origin in FOREIGN:
        with suppress(InvalidStatus):
            address = f"{server.address.replace('http', 'ws')}/_stcore/stream"
            async with connect(address, origin=origin, proxy=None):  # type: ignore[arg-type]
                pass
    async with Visitor(server.address) as visitor:
        await visitor.open()
        await visitor.slide("Radial clearance", 83)
        for page in ("Orbits", "Notes"):
            await visitor.open(page)


def main(*, shut: bool) -> None:
    """Start a server, visit it, end it, and write what was asked outside."""
    if shut:
        raise_loopback()
    with tempfile.TemporaryDirectory() as folder:
        heard = audit.environment(Path(folder))
        server = Replica(**heard).wait()
        try:
            asyncio.run(visit(server))
        finally:
            server.stop()
        seen = {"asked": audit.asked(Path(folder))}
        seen["without a way"] = packets_without_a_way() if shut else 0
        subprocess.run([sys.executable, "-c", _ONE_MORE], env=os.environ | heard, check=True)
        seen["asked after one more"] = audit.asked(Path(folder))
    if shut:
        with suppress(OSError):
            socket.create_connection(("198.51.100.7", 80))
        seen["without a way after one more"] = packets_without_a_way()
    json.dump(seen, sys.stdout)


if __name__ == "__main__":
    main(shut=sys.argv[1:] == ["shut"])
