"""Links between pages in the browser, which carry the machine as the address bar has it."""

from collections.abc import Iterable

from streamlit.components.v2 import component

from ui.live import assets

_component = component("rotorcalc.links", js=assets.module("links"), isolate_styles=False)


def show(names: Iterable[str]) -> None:
    """Let every link to a page have the query of the address bar, but for these names."""
    _component(key="live_links", data=sorted(names))
