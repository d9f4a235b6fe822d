"""A separate process for costly computations, so that pages keep theirs.

Python computes one thing at a time in a process, so a long computation among the pages would make
every visitor's slider stick. `Worker` is the pages' side of such a process; this file run as a
program is the other. They speak in pickles: an order, any number of words of progress, an answer.

It is not `multiprocessing`: a child that is spawned, or comes from a fork server, first imports
the parent's `__main__`, which is the page while Streamlit runs one; a child that is forked inherits
locks that other threads of the server held at that moment, and waits for them without end.
"""

import os
import pickle
import signal
import subprocess
import sys
import threading
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from queue import SimpleQueue
from typing import IO, Any, Literal

from ui.jobs.places import places
from ui.jobs.work import Progress  # imported with all that will be asked for, while nobody waits

_ROOT = Path(__file__).parents[2]
# Pages have priority over a worker for the processor.
NICER = 10

Order = tuple[int, Callable[..., Any], tuple[Any, ...], bool]
Answer = tuple[Literal["at", "done", "failed"], Any]


class WorkerError(RuntimeError):
    """The process ended during a computation."""


class Worker:
    """A process that runs one computation at a time, for one thread at a time.

    `nicer` is by how much it stands back behind other processes.
    """

    def __init__(self, nicer: int = NICER) -> None:
        command = [sys.executable, "-m", "ui.jobs.process", f"{nicer:d}"]
        self._process = subprocess.Popen(  # noqa: S603 - our own
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            env=os.environ | {"PYTHONPATH": str(_ROOT)},
        )  # fmt: skip
        self._number = 0
        self.idle = True

    def run(self, work: Callable[..., Any], args: tuple[Any, ...], tell: Progress | None) -> Any:
        """Return `work(*args)`, a module's function, or raise what it raises.

        Where there is someone to tell, work gets the keyword `progress`. What `tell` raises ends
        the computation.
        """
        self.idle = False
        self._number += 1
        self._send((self._number, work, args, tell is not None))
        while (answer := self._receive())[0] == "at":
            assert tell is not None  # noqa: S101 - else it would not be told
            try:
                tell(answer[1])
            except BaseException:
                self._stop()
                raise
        self.idle = True
        if answer[0] == "failed":
            raise answer[1]
        return answer[1]

    def close(self) -> None:
        """End the process."""
        self._process.kill()
        self._process.communicate()

    def _stop(self) -> None:
        self._send(self._number)
        while self._receive()[0] == "at":
            pass
        self.idle = True

    def _send(self, message: Order | int) -> None:
        assert self._process.stdin is not None  # noqa: S101 - it is a pipe
        try:
            _write(self._process.stdin, message)
        except OSError as error:
            raise WorkerError("the process for heavy computations has ended") from error

    def _receive(self) -> Answer:
        assert self._process.stdout is not None  # noqa: S101 - it is a pipe
        try:
            return pickle.load(self._process.stdout)  # noqa: S301 - of our own process
        except (EOFError, OSError, pickle.UnpicklingError) as error:  # also in mid-answer
            raise WorkerError("the process for heavy computations has ended") from error


class StoppedError(Exception):
    """The computation was cancelled."""


class _Orders:
    """Incoming orders: computations in sequence, and the number of one to stop."""

    def __init__(self, stream: IO[bytes]) -> None:
        self.queue: SimpleQueue[Order] = SimpleQueue()
        self.stopped = 0
        self._stream = stream

    def listen(self) -> None:
        """Read orders until the other side ends, then exit."""
        try:
            while True:
                message = pickle.load(self._stream)  # noqa: S301 - of the process that began this
                if isinstance(message, int):
                    self.stopped = message
                else:
                    self.queue.put(message)
        finally:
            os._exit(0)


def main(nicer: int) -> None:
    """Run the computations requested on standard input, and write results to standard output."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the server's, which ends this by itself
    with suppress(AttributeError, PermissionError):  # not everywhere there, nor allowed
        os.nice(nicer)
    out = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # whatever prints
    orders = _Orders(sys.stdin.buffer)
    threading.Thread(target=orders.listen, daemon=True).start()
    while True:
        _write(out, _answer(orders, out, orders.queue.get()))


def _answer(orders: _Orders, out: IO[bytes], order: Order) -> Answer:
    number, work, args, told = order

    def progress(share: float) -> None:
        if orders.stopped == number:
            raise StoppedError
        _write(out, ("at", share))

    try:
        return "done", work(*args, **({"progress": progress} if told else {}))
    except StoppedError:
        return "done", None
    except Exception as error:  # noqa: BLE001 - it is raised on the other side
        error.__dict__["places"] = places(error)  # its traceback cannot be sent
        return "failed", error


def _write(stream: IO[bytes], message: object) -> None:
    stream.write(pickle.dumps(message, protocol=pickle.HIGHEST_PROTOCOL))
    stream.flush()


if __name__ == "__main__":
    main(int(sys.argv[1]))
