"""What a host decides by environment variables."""

import os

_LIVE = ("drag", "release", "off")


def live() -> str:
    """Return how charts and sliders follow, ROTORCALC_LIVE.

    "drag": sliders send while they move, and charts are redrawn in place. "release": sliders send
    when they are let go. "off": Streamlit's own sliders and charts.
    """
    word = os.environ.get("ROTORCALC_LIVE", "drag")
    if word not in _LIVE:
        raise ValueError(f"ROTORCALC_LIVE = {word!r}: must be one of {', '.join(_LIVE)}")
    return word
