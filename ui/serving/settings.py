"""The host's settings, from environment variables.

The app's own, each a function below: ROTORCALC_LIVE, ROTORCALC_HEAVY_JOBS, ROTORCALC_REPLICA,
ROTORCALC_COMMIT, ROTORCALC_DOCS, ROTORCALC_LOG, and ROTORCALC_MAX_... for each of the limits.
Streamlit's settings stand in .streamlit/config.toml; each has a variable too, of which a host needs
these:

STREAMLIT_SERVER_ADDRESS, STREAMLIT_SERVER_PORT
    Where a replica listens; behind a proxy on the same machine, 127.0.0.1 and a port of its own.
STREAMLIT_SERVER_BASE_URL_PATH
    The path below which the app stands, e.g. rotorcalc.
STREAMLIT_SERVER_ALLOWED_HOSTS
    Names by which visitors may call the server, e.g. "rotor.example.org". Where it is unset, any;
    but a server that listens on this machine alone goes by this machine's names.
STREAMLIT_SERVER_CORS_ALLOWED_ORIGINS
    Other sites whose pages may use the server; none where it is unset.
STREAMLIT_SERVER_COOKIE_SECRET
    Any long random text, the same for all replicas; each makes its own where it is unset.
FORWARDED_ALLOW_IPS
    Addresses of proxies whose X-Forwarded-For is believed; 127.0.0.1 where it is unset.
STREAMLIT_SERVER_DISCONNECTED_SESSION_TTL
    Seconds for which a replica keeps the session of a closed or lost tab.
"""

import difflib
import os
import re
import sys
from dataclasses import asdict, dataclass

_PREFIX = "ROTORCALC_"
# What Kubernetes sets in every container beside a service of that name, or of one that begins so.
_OF_A_SERVICE = re.compile(r"ROTORCALC_(\w+_)?(SERVICE_(HOST|PORT)|PORT)(_|$)")
_LIVE = ("drag", "release", "off")
_LOG = ("text", "json")


@dataclass(frozen=True, kw_only=True)
class Limits:
    """How much a replica takes; each is a variable too, ROTORCALC_MAX_SOCKETS and so on.

    An address may be a whole class's. A page's messages are its runs, which take turns.
    """

    sockets: int = 400  # open at once
    sockets_address: int = 300  # of them of one address, and its burst of new ones
    openings_address: int = 5  # new ones a second of one address after that
    waiting: int = 60  # messages of one page, after which it is closed
    waiting_megabytes: int = 2  # that they may take
    upload_session: int = 4  # megabytes of files of one page
    upload: int = 32  # megabytes of files of all


def limits() -> Limits:
    """Return the limits, each as the environment or its default says."""
    read = {
        name: _number(f"ROTORCALC_MAX_{name.upper()}", value, 1_000_000)
        for name, value in asdict(Limits()).items()
    }
    return Limits(**read)


def live() -> str:
    """Return when sliders send and how charts are drawn, ROTORCALC_LIVE.

    "drag": sliders send while they move, and charts are redrawn in place. "release": sliders send
    on release. "off": Streamlit's own sliders and charts.
    """
    return _word("ROTORCALC_LIVE", _LIVE)


def heavy_jobs() -> int:
    """Return how many long computations a replica runs at once, ROTORCALC_HEAVY_JOBS.

    Each has a process of its own, of some 90 MB, which stands back behind the pages; releases have
    one more. The default is 1; more help where there are cores to spare.
    """
    return _number("ROTORCALC_HEAVY_JOBS", 1, 64)


def replica() -> str:
    """Return this process's name among others behind a proxy, ROTORCALC_REPLICA; "" alone."""
    name = os.environ.get("ROTORCALC_REPLICA", "")
    if name and not (name.isascii() and name.isalnum()):
        raise ValueError(
            f"ROTORCALC_REPLICA = {name!r}: must be letters and digits; unset it for one replica"
        )
    return name


def commit() -> str:
    """Return the running commit, ROTORCALC_COMMIT, where there is no checkout to read; or ""."""
    return os.environ.get("ROTORCALC_COMMIT", "")


def docs() -> str:
    """Return the address of the documentation, ROTORCALC_DOCS, where it is served; or ""."""
    address = os.environ.get("ROTORCALC_DOCS", "")
    if address and not address.startswith(("/", "https://", "http://")):
        raise ValueError(
            f"ROTORCALC_DOCS = {address!r}: must begin with /, https:// or http://; unset it where "
            "the documentation is not served"
        )
    return address


def log() -> str:
    """Return how the log is written, ROTORCALC_LOG: "text", or "json", one line per event."""
    return _word("ROTORCALC_LOG", _LOG)


def check() -> None:
    """Read every setting, or raise ValueError with the name, the value and what it must be.

    A name that is none is refused too: its setting would be left out in silence.
    """
    _check_names()
    for ask in (limits, live, heavy_jobs, replica, docs, log):
        ask()


def end_where_wrong() -> None:
    """End the program with a line on the first wrong setting, and without a traceback."""
    try:
        check()
    except ValueError as error:
        sys.exit(f"The server does not start: {error}.")


def names() -> tuple[str, ...]:
    """Return the app's own settings, by the names of their variables."""
    own = ("LIVE", "HEAVY_JOBS", "REPLICA", "COMMIT", "DOCS", "LOG")
    most = (f"MAX_{name.upper()}" for name in asdict(Limits()))
    return tuple(f"{_PREFIX}{name}" for name in (*own, *most))


def _check_names() -> None:
    known = names()
    for name in sorted(os.environ):
        is_ours = name.upper().startswith(_PREFIX) and not _OF_A_SERVICE.match(name)
        if not is_ours or name in known:
            continue
        near = difflib.get_close_matches(name.upper(), known, n=1, cutoff=0.0)[0]
        raise ValueError(
            f"{name} is no setting of this app: rename it, perhaps to {near}, or unset it; the "
            f"settings are {', '.join(known)}"
        )


def _word(name: str, words: tuple[str, ...]) -> str:
    """Return a variable's word, by default the first of the admitted ones."""
    word = os.environ.get(name, words[0])
    if word not in words:
        raise ValueError(
            f"{name} = {word!r}: must be one of {', '.join(words)}; unset it for {words[0]}"
        )
    return word


def _number(name: str, default: int, most: int) -> int:
    """Return a variable's whole number, from 1 to the most that it may be."""
    text = os.environ.get(name, str(default))
    if not (text.isascii() and text.isdigit() and len(text) < 12 and 1 <= int(text) <= most):
        raise ValueError(
            f"{name} = {text!r}: must be a whole number from 1 to {most}; unset it for {default}"
        )
    return int(text)
