"""Servers of the app on this machine, each a process of its own."""

import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from urllib.error import URLError
from urllib.request import urlopen

ROOT = Path(__file__).resolve().parents[2]
START_TIMEOUT = 60.0  # seconds


class Replica:
    """One server process in a folder, from its start until `stop`; `log` is what it wrote."""

    def __init__(
        self,
        *,
        port: int = 0,
        script: Path = ROOT / "app.py",
        folder: Path = ROOT,
        **environment: str,
    ) -> None:
        self.port = port or free_port()
        base = environment.get("STREAMLIT_SERVER_BASE_URL_PATH", "")
        self.address = f"http://127.0.0.1:{self.port}/{base}".rstrip("/")
        self.log = Path(tempfile.mkstemp(prefix="rotorcalc-", suffix=".log")[1])
        options = {"PORT": str(self.port), "HEADLESS": "true"}
        settings = {f"STREAMLIT_SERVER_{key}": value for key, value in options.items()}
        with self.log.open("wb") as out:
            self.process = subprocess.Popen(
                [sys.executable, "-m", "streamlit", "run", str(script)],
                cwd=folder,
                env={**os.environ, **settings, **environment},
                stdout=out,
                stderr=subprocess.STDOUT,
            )

    def wait(self) -> "Replica":
        """Wait until it answers."""
        end = time.monotonic() + START_TIMEOUT
        while self.process.poll() is None and time.monotonic() < end:
            try:
                with urlopen(f"{self.address}/_stcore/health", timeout=5) as answer:
                    if answer.status == 200:
                        return self
            except (URLError, OSError):
                time.sleep(0.1)
        raise RuntimeError(f"the server did not start:\n{self.log.read_text()}")

    def memory(self) -> float:
        """Return the memory it holds [MB]."""
        pages = Path(f"/proc/{self.process.pid}/statm").read_text().split()[1]
        return int(pages) * os.sysconf("SC_PAGE_SIZE") / 1e6

    def peak(self) -> float:
        """Return the most memory that it has held [MB]."""
        lines = Path(f"/proc/{self.process.pid}/status").read_text().splitlines()
        return next(int(line.split()[1]) for line in lines if line.startswith("VmHWM")) * 1.024e-3

    def seconds(self) -> float:
        """Return the processor time it has used [s]."""
        words = Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")

    def workers(self) -> list[int]:
        """Return the ids of the processes that compute for it."""
        found: list[int] = []
        for children in Path(f"/proc/{self.process.pid}/task").glob("*/children"):
            with suppress(OSError):  # the thread that began them has ended: another has them
                found += map(int, children.read_text().split())
        return found

    @contextmanager
    def held(self) -> Iterator[None]:
        """Let no long computation go on meanwhile."""
        workers = self.workers()
        assert workers, "it has no process that computes"
        for worker in workers:
            os.kill(worker, signal.SIGSTOP)
        yield
        for worker in workers:
            os.kill(worker, signal.SIGCONT)

    def kill(self) -> None:
        """End it at once, as a crash does."""
        self.process.kill()
        self.process.wait()

    def stop(self) -> None:
        """End it as a host does, and forget its log."""
        self.process.terminate()
        try:
            self.process.wait(timeout=10)
        except subprocess.TimeoutExpired:
            self.kill()
        self.log.unlink(missing_ok=True)


def free_port() -> int:
    """Return a port that nobody listens on."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]
