"""What a host decides by environment variables.

The app's own, each a function below: ROTORCALC_LIVE, ROTORCALC_HEAVY_JOBS, ROTORCALC_REPLICA,
ROTORCALC_COMMIT, ROTORCALC_LOG. Streamlit's settings stand in .streamlit/config.toml; each has a
variable too, of which a host needs these:

STREAMLIT_SERVER_ADDRESS, STREAMLIT_SERVER_PORT
    Where a replica listens; behind a proxy on the same machine, 127.0.0.1 and a port of its own.
STREAMLIT_SERVER_BASE_URL_PATH
    The path below which the app stands, e.g. rotorcalc.
STREAMLIT_SERVER_ALLOWED_HOSTS
    Names by which visitors may call the server, e.g. "rotor.example.org"; any where it is unset.
STREAMLIT_SERVER_CORS_ALLOWED_ORIGINS
    Other sites whose pages may use the server; none where it is unset.
STREAMLIT_SERVER_COOKIE_SECRET
    Any long random text, the same for all replicas; each makes its own where it is unset.
STREAMLIT_SERVER_DISCONNECTED_SESSION_TTL
    Seconds for which a replica keeps the session of a closed or lost tab.
"""

import os

_LIVE = ("drag", "release", "off")
_LOG = ("text", "json")


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
    text = os.environ.get("ROTORCALC_HEAVY_JOBS", "1")
    if not (text.isascii() and text.isdigit() and 1 <= int(text) <= 64):
        raise ValueError(f"ROTORCALC_HEAVY_JOBS = {text!r}: must be a number from 1 to 64")
    return int(text)


def replica() -> str:
    """Return this process's name among others behind a proxy, ROTORCALC_REPLICA; "" alone."""
    name = os.environ.get("ROTORCALC_REPLICA", "")
    if name and not (name.isascii() and name.isalnum()):
        raise ValueError(f"ROTORCALC_REPLICA = {name!r}: must be letters and digits")
    return name


def commit() -> str:
    """Return the commit that runs, ROTORCALC_COMMIT, where there is no checkout to ask; or ""."""
    return os.environ.get("ROTORCALC_COMMIT", "")


def log() -> str:
    """Return how the log is written, ROTORCALC_LOG: "text", or "json", a line an event."""
    return _word("ROTORCALC_LOG", _LOG)


def _word(name: str, words: tuple[str, ...]) -> str:
    """Return a variable's word, the first of those it may be where it is unset."""
    word = os.environ.get(name, words[0])
    if word not in words:
        raise ValueError(f"{name} = {word!r}: must be one of {', '.join(words)}")
    return word
