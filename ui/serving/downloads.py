"""Files that are made when a visitor asks for them."""

from collections.abc import Callable
from itertools import count
from typing import Literal

import streamlit as st
from streamlit import runtime

# More files than a full server makes while a browser fetches its own; a report has 6 MB.
KEPT = 8

_made = count()


def offer(  # noqa: PLR0913 (as a download button takes)
    label: str,
    build: Callable[[], str | bytes],
    name: str,
    mime: str,
    *,
    key: str | None = None,
    width: Literal["content", "stretch"] = "content",
    help: str | None = None,  # noqa: A002 (Streamlit's name)
) -> None:
    """Draw a button that saves a file; it is made when asked for, outside the session."""

    def made() -> bytes:
        content = build()
        data = content.encode() if isinstance(content, str) else content
        _keep(data, name, mime)
        return data

    st.download_button(
        label, made, name, mime, key=key, on_click="ignore", width=width, help=help
    )  # fmt: skip


def _keep(data: bytes, name: str, mime: str) -> None:
    """Keep a file until others have been made.

    Streamlit counts a file made on demand as nobody's and drops it when any two runs have ended,
    whoever's they are: on a busy server before its browser has fetched it.
    """
    place = f"made {next(_made) % KEPT}"
    runtime.get_instance().media_file_mgr.add(
        data, mime, place, file_name=name, is_for_static_download=True
    )
