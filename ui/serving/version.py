"""The running program's version, and its commit where known."""

import subprocess
from functools import cache
from pathlib import Path

from rotorcalc import __version__
from ui.serving import settings

_ROOT = Path(__file__).resolve().parents[2]


@cache
def commit() -> str:
    """Return the running commit, abbreviated; "" where nobody knows it.

    The host names it, or a release's file COMMIT (`deploy/release.py`), or a checkout.
    """
    named = settings.commit()
    if not named and (_ROOT / "COMMIT").exists():
        named = (_ROOT / "COMMIT").read_text("utf-8")
    if named:
        return named.strip()[:12]
    # A checkout is often another user's than the server's, which git would not read by itself.
    safe = f"safe.directory={_ROOT}"
    command = ["git", "-c", safe, "-C", str(_ROOT), "rev-parse", "--short", "HEAD"]
    try:
        done = subprocess.run(  # noqa: S603 - no word of it comes from outside
            command, capture_output=True, text=True, timeout=5, check=False
        )
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return done.stdout.strip()


def label() -> str:
    """Return version and commit as a page shows them."""
    return f"rotorcalc {__version__}" + (f" · {commit()}" if commit() else "")
