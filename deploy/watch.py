"""Watches over a server as systemd does over one of Type=notify: python -m deploy.watch COMMAND...

For a container, whose engine looks only whether its process runs. It ends with an error when the
server ends, is not ready in time, or gives no sign of life, and the engine starts all anew.
"""

import os
import signal
import socket
import subprocess
import sys
import time
from typing import Any

# Seconds until a server is ready, between two signs of life, and to end.
START, BEAT, STOP = 60.0, 10.0, 20.0
_LOOK = 0.2  # seconds between two looks whether it has ended


class Watch:
    """A server under watch; further arguments are those of its process."""

    def __init__(
        self, command: list[str], *, start: float = START, beat: float = BEAT, **process: Any
    ) -> None:
        self._beat = beat
        self._ear = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self._ear.bind("")  # a name without a file, which Linux gives
        self._ear.settimeout(_LOOK)
        heard_at = f"@{self._ear.getsockname()[1:].decode()}"
        environment = {**process.pop("env", os.environ), "NOTIFY_SOCKET": heard_at}
        self._patience, self._heard = start, time.monotonic()
        self.process = subprocess.Popen(command, env=environment, **process)  # noqa: S603 - the host's

    def is_ready(self) -> bool:
        """Wait until the server is ready, or has ended; return which."""
        return self._until("READY=1")

    def end(self) -> int:
        """Wait until the server ends, and return its code; end it where it gives no sign."""
        self._until(None)
        self._ear.close()
        return self.process.wait()

    def _until(self, word: str | None) -> bool:
        """Listen until the server says a word or ends, and return whether it said it."""
        while self.process.poll() is None:
            try:
                said = self._ear.recv(4096).decode().splitlines()
            except TimeoutError:
                said = []
            self._take(said)
            if word in said:
                return True
        return False

    def _take(self, said: list[str]) -> None:
        """Have patience after a sign of life, and end what gives none."""
        if {"READY=1", "WATCHDOG=1", "STOPPING=1"} & set(said):
            self._heard = time.monotonic()
            self._patience = STOP if "STOPPING=1" in said else self._beat
        elif time.monotonic() - self._heard > self._patience:
            sys.stderr.write(f"no sign of life for {self._patience:g} s: ended\n")
            self.process.kill()
            self.process.wait()


def main(command: list[str]) -> int:
    """Watch over a command; a signal to end goes to it."""
    watch = Watch(command)
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: watch.process.terminate())
    return watch.end()


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1:]) or 0)
