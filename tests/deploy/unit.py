"""A replica as deploy/rotorcalc@.service describes it, below another folder than /srv/rotorcalc.

It does what systemd does with the lines that say what runs, where, how it is watched over and when
it is started anew; not those that take privileges away.
"""

import os
import shlex
import threading
from pathlib import Path

from deploy.watch import Watch
from tests.load.replicas import ROOT


class Unit:
    """A replica, `rotorcalc@PORT`; `settings` are those of /etc/rotorcalc.env."""

    def __init__(self, root: Path, port: int, log: Path, **settings: str) -> None:
        text = (ROOT / "deploy/rotorcalc@.service").read_text()
        text = text.replace("/srv/rotorcalc", str(root)).replace("%i", str(port))
        lines = [line.partition("=") for line in text.splitlines() if not line.startswith("#")]
        self._values = {name: value for name, _, value in lines}
        given = (
            word for name, _, value in lines if name == "Environment" for word in value.split()
        )
        self._environment = os.environ | dict(word.split("=", 1) for word in given) | settings
        self._log = log
        self._unwanted = threading.Event()
        self._lock = threading.Lock()

    def start(self) -> bool:
        """Start it, and return whether it is ready."""
        assert (self._values["Type"], self._values["Restart"]) == ("notify", "always")
        self._unwanted.clear()
        watch = self._watch = self._begun()
        ready = watch.is_ready()
        self._keeping = threading.Thread(target=self._keep, args=(watch,))
        self._keeping.start()
        return ready

    def stop(self) -> None:
        """End it, and wait until it has ended."""
        with self._lock:
            self._unwanted.set()
            self._watch.process.terminate()
        self._keeping.join()

    @property
    def process(self) -> int:
        """The number of its process."""
        return self._watch.process.pid

    def _begun(self) -> Watch:
        with self._log.open("ab") as out:
            return Watch(
                shlex.split(self._values["ExecStart"]),
                start=float(self._values["TimeoutStartSec"]),
                beat=float(self._values["WatchdogSec"]),
                cwd=Path(self._values["WorkingDirectory"]).resolve(),
                env=self._environment, stdout=out, stderr=out,
            )  # fmt: skip

    def _keep(self, watch: Watch) -> None:
        """Start it anew wherever it ends and is wanted."""
        while True:
            watch.end()
            if self._unwanted.wait(float(self._values["RestartSec"])):
                return
            with self._lock:
                if self._unwanted.is_set():
                    return
                watch = self._watch = self._begun()
