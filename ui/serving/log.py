"""The server's log: one line per event, as text or JSON, and never a visitor's input.

An exception's message can hold a visitor's numbers, so of an exception only its type and its places
in the code are written. What failed for a visitor has an id, which the visitor's page shows too.
"""

import json
import logging
import math
import secrets
import threading
import time
from collections import Counter
from collections.abc import Mapping
from datetime import UTC, datetime
from typing import Any

import streamlit as st
import streamlit.logger
from streamlit import config

from ui.jobs.places import places
from ui.serving import settings

_LOGGER = logging.getLogger("rotorcalc")
_UVICORN = ("uvicorn", "uvicorn.asgi", "uvicorn.error")
# Their lines hold visitors' addresses and links, and every link is a machine.
_VISITS = ("uvicorn.access", "uvicorn.error")
# Their lines below an error hold sessions' ids, and words of whoever asks.
_SESSIONS = (
    "streamlit.runtime.websocket_session_manager",
    "streamlit.runtime.app_session",
    "streamlit.web.server.starlette.starlette_websocket",
)
# uvicorn's line about each websocket that is refused with a status.
_REFUSED = "ASGI callable returned without completing handshake."
_EVERY = 10.0  # seconds between two lines about one thing
# What stands above a failure on a page.
TITLE = "Something went wrong here"
# Streamlit's own line about an exception that `failed` reports with its id.
_TOLD_TWICE = "Uncaught app execution"


class Rarely:
    """Counts events, of which one of a kind is written in ten seconds: a flood fills no disk."""

    def __init__(self) -> None:
        self._lock = threading.Lock()  # each page runs in a thread of its own
        self._counted: Counter[str] = Counter()
        self._written: dict[str, tuple[float, str]] = {}

    def count(self, kind: str) -> tuple[str, int]:
        """Return the id of the line that tells of an event, and what it is to tell.

        That is how many there were since the line before, or 0 where the line is written already.
        """
        with self._lock:
            self._counted[kind] += 1
            now = time.monotonic()
            at, number = self._written.get(kind, (-math.inf, ""))
            if now - at < _EVERY:
                return number, 0
            number = secrets.token_hex(4)
            self._written[kind] = now, number
            return number, self._counted.pop(kind)


class Record(logging.LogRecord):
    """A record of an exception's type and places, without its message."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        error = self.exc_info[1] if isinstance(self.exc_info, tuple) else None
        self.fields = {} if error is None else described(error)
        self.exc_info = None

    def getMessage(self) -> str:
        """Return the record as text."""
        return _text(super().getMessage(), self.fields)


class JsonRecord(Record):
    """A record whose message is a line of JSON."""

    def getMessage(self) -> str:
        """Return the record as a line of JSON."""
        fields = {
            "time": datetime.fromtimestamp(self.created, UTC).isoformat(timespec="milliseconds"),
            "level": self.levelname.lower(),
            "logger": self.name,
            "event": logging.LogRecord.getMessage(self),
        }
        return json.dumps(fields | self.fields | getattr(self, "more", {}), ensure_ascii=False)


_FAILURES = Rarely()


def begin() -> None:
    """Log no visits and no exception's message, and write JSON where the host wants it."""
    for name in _VISITS:
        logging.getLogger(name).setLevel(logging.WARNING)
    for name in _SESSIONS:
        logging.getLogger(name).setLevel(logging.ERROR)
    logging.getLogger("uvicorn.error").addFilter(lambda record: record.msg != _REFUSED)
    error_log = logging.getLogger("streamlit.error_util")
    error_log.addFilter(lambda record: record.msg != _TOLD_TWICE)
    logging.setLogRecordFactory(Record if settings.log() == "text" else JsonRecord)
    if settings.log() == "json":
        _write_json()


def _write_json() -> None:
    config.set_option("logger.messageFormat", "%(message)s")
    streamlit.logger.get_logger(_LOGGER.name)  # with the handler that Streamlit's loggers have
    streamlit.logger.update_formatter()
    for name in _UVICORN:
        logger = logging.getLogger(name)
        own = getattr(logger, "streamlit_console_handler", None)
        logger.handlers = [] if own is None else [own]
        logger.propagate = False


def event(name: str, *, level: int = logging.INFO, **fields: object) -> None:
    """Write an event with its fields, in either form of the log."""
    if settings.log() == "text":
        name = _text(name, fields)
    _LOGGER.log(level, name, extra={"more": fields})


def failed(error: Exception) -> bool:
    """Report an exception of a page's script in the log and to the visitor, under one id.

    Failures of one type at one place have the same id for ten seconds.
    """
    what = described(error)
    number, times = _FAILURES.count(" ".join([what["type"], *what["places"][-1:]]))
    if times:
        event("failed", level=logging.ERROR, id=number, times=times, **what)
    st.error(
        f"Give this server's operator the number **{number}**, under which its log records what "
        "happened. Your inputs are in the address bar: reload the page to continue.",
        title=TITLE,
    )
    return True


def described(error: BaseException) -> dict[str, Any]:
    """Return an exception's type and stack, outermost frame first."""
    return {"type": type(error).__name__, "places": places(error)}


def _text(name: str, fields: Mapping[str, object]) -> str:
    return " ".join([name, *(f"{key}={value}" for key, value in fields.items())])
