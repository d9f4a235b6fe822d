"""A separate process for costly computations, so that pages keep theirs.

Python computes one thing at a time in a process, so a long computation among the pages would make
every visitor's slider stick. `Worker` is the pages' side of such a process; this file run as a
program is the other. They speak in pickles: an order, any number of words of progress, an answer.
Where a word is long in coming the pages' side asks for a sign of life, which the other gives by a
thread of its own while it computes. A process that gives none is taken for hung.

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
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import IO, Any, Literal

from ui.jobs.places import places
from ui.jobs.work import Progress  # imported with all that will be asked for, while nobody waits

_ROOT = Path(__file__).parents[2]
# Pages have priority over a worker for the processor.
NICER = 10

_LOOK = 1.0  # seconds that a word is waited for before a sign of life is asked for
# Looks without a sign, after which a process is taken for hung: on a busy machine one that stands
# back waits for seconds. The first come while it imports.
_PATIENCE, _PATIENCE_AT_FIRST = 10, 60

# A number, and in a pickle of its own what to compute: to read that may import much.
Order = tuple[int, bytes]
Answer = tuple[Literal["at", "done", "failed", "alive", "ended"], Any]


class WorkerError(RuntimeError):
    """The process ended or hung during a computation."""


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
        self._answers: SimpleQueue[Answer] = SimpleQueue()
        self._number = self._asked = 0
        self._hired = time.monotonic()
        self._patience = _PATIENCE_AT_FIRST
        self.idle = True
        self.ended = False
        self._looks = 0  # since its last sign of life
        threading.Thread(target=self._listen, daemon=True).start()

    def run(self, work: Callable[..., Any], args: tuple[Any, ...], tell: Progress | None) -> Any:
        """Return `work(*args)`, a module's function, or raise what it raises.

        Where there is someone to tell, work gets the keyword `progress`. What `tell` raises ends
        the computation. Raises WorkerError where the process ends, or gives no sign of life.
        """
        self.idle = False
        self._number += 1
        self._send((self._number, pickle.dumps((work, args, tell is not None))))
        while (answer := self._receive())[0] == "at":
            assert tell is not None  # noqa: S101 - else it would not be told
            try:
                tell(answer[1])
            except BaseException:
                with suppress(WorkerError):  # it is then not idle, and replaced
                    self._stop()
                raise
        self.idle = True
        if answer[0] == "failed":
            raise answer[1]
        return answer[1]

    @property
    def silent(self) -> bool:
        """Whether the process, at work, has given no sign of life for half of the patience."""
        return self._patience == _PATIENCE and self._looks > _PATIENCE / 2

    def answers(self) -> bool:
        """Return whether the idle process gives a sign of life, or may still begin."""
        if self._patience == _PATIENCE_AT_FIRST and self._answers.empty():
            return time.monotonic() - self._hired < _PATIENCE_AT_FIRST * _LOOK
        try:
            asked = self._ask_for_a_sign()
            while self._heard()[1] < asked:  # an answer to an earlier question
                pass
        except WorkerError:
            return False
        return True

    def close(self) -> None:
        """End the process."""
        self._process.kill()
        self._process.wait()
        with suppress(OSError):  # what was not yet sent
            self._stdin().close()

    def _stop(self) -> None:
        self._send(self._number)
        while self._receive()[0] == "at":
            pass
        self.idle = True

    def _ask_for_a_sign(self) -> int:
        """Ask with the next number, which the answer has too."""
        self._asked += 1
        self._send(-self._asked)  # a number above zero stops a computation
        return self._asked

    def _send(self, message: Order | int) -> None:
        try:
            _write(self._stdin(), message)
        except OSError as error:
            raise WorkerError("the process for long computations has ended") from error

    def _receive(self) -> Answer:
        """Return the next word that is more than a sign of life."""
        while (answer := self._heard())[0] == "alive":
            pass
        return answer

    def _heard(self) -> Answer:
        """Return the next word, and ask for a sign of life where it is long in coming."""
        self._looks = 0
        while self._looks < self._patience:  # looks, not seconds: this process may be held up too
            try:
                answer = self._answers.get(timeout=_LOOK)
            except Empty:
                self._looks += 1
                self._ask_for_a_sign()
                continue
            self._looks, self._patience = 0, _PATIENCE
            if answer[0] == "ended":
                raise WorkerError("the process for long computations has ended")
            return answer
        raise WorkerError("the process for long computations gives no sign of life")

    def _listen(self) -> None:
        """Take what the process says until it ends, in a thread of its own: a word may hang."""
        assert self._process.stdout is not None  # noqa: S101 - it is a pipe
        with self._process.stdout as stream:
            # Also in mid-word, which leaves a pickle that is cut off.
            with suppress(EOFError, OSError, pickle.UnpicklingError):
                while True:
                    self._answers.put(pickle.load(stream))  # noqa: S301 - of our own process
            self.ended = True
            self._answers.put(("ended", None))

    def _stdin(self) -> IO[bytes]:
        assert self._process.stdin is not None  # noqa: S101 - it is a pipe
        return self._process.stdin


class StoppedError(Exception):
    """The computation was cancelled."""


class _Words:
    """What the process says, by two threads: one that computes, one that gives signs of life."""

    def __init__(self, stream: IO[bytes]) -> None:
        self._stream = stream
        self._whole = threading.Lock()

    def say(self, answer: Answer) -> None:
        """Write a word whole."""
        with self._whole:
            _write(self._stream, answer)


class _Orders:
    """Incoming orders: computations in sequence, and the number of one to stop."""

    def __init__(self, stream: IO[bytes], words: _Words) -> None:
        self.queue: SimpleQueue[Order] = SimpleQueue()
        self.stopped = 0
        self._stream = stream
        self._words = words

    def listen(self) -> None:
        """Read orders until the other side ends, then exit."""
        try:
            while True:
                self._take(pickle.load(self._stream))  # noqa: S301 - of the process that began this
        finally:
            os._exit(0)

    def _take(self, message: Order | int) -> None:
        if not isinstance(message, int):
            self.queue.put(message)
        elif message > 0:
            self.stopped = message
        else:
            self._words.say(("alive", -message))


def main(nicer: int) -> None:
    """Run the computations requested on standard input, and write results to standard output."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the server's, which ends this by itself
    with suppress(AttributeError, PermissionError):  # not everywhere there, nor allowed
        os.nice(nicer)
    words = _Words(os.fdopen(os.dup(sys.stdout.fileno()), "wb"))
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # whatever prints
    orders = _Orders(sys.stdin.buffer, words)
    words.say(("alive", 0))
    threading.Thread(target=orders.listen, daemon=True).start()
    while True:
        words.say(_answer(orders, words, orders.queue.get()))


def _answer(orders: _Orders, words: _Words, order: Order) -> Answer:
    number, what = order

    def progress(share: float) -> None:
        if orders.stopped == number:
            raise StoppedError
        words.say(("at", share))

    try:
        work, args, told = pickle.loads(what)  # noqa: S301 - of the process that began this
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
