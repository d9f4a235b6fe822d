"""A presentation: large type, the sliders in use, and one chart at a time, for a lecture hall.

It is in the link, as `present=1`, or with the key of the chart in view.
"""

from dataclasses import dataclass, field

import streamlit as st
from streamlit.delta_generator import DeltaGenerator

from ui.inputs import inputs_of
from ui.session import Session
from ui.widgets import show_inputs

# All of Streamlit's sizes are in rem. Where one chart is shown, a column without one has no place,
# unless it has the numbers beside the drawing. The choice of the chart stands beside the title,
# what is asked before it is drawn, and what came of it, below it. Type grows with the window,
# which a projector shows at one size.
STYLE = """<style>
html {font-size: clamp(100%, min(1.39vw, 2.22vh), 175%);}
.stMainBlockContainer {padding: 0.3rem 1.25rem;}
.st-key-page_title > .stElementContainer:has(> .stMarkdown) {display: none;}
.st-key-views {align-items: flex-end;}
@media (min-width: 1100px) {.st-key-views {margin-top: -2.4rem;}}
.stMain .stHorizontalBlock:has(.live-chart):not(:has(.stMetric)) > .stColumn {flex: 1 1 100%;}
.stMain .stHorizontalBlock:has(.live-chart):not(:has(.stMetric)) > .stColumn:not(:has(.live-chart)),
.stMain .stHorizontalBlock:has(.stMetric):not(:has(.live-chart)):has(> .stColumn),
.stMain .stColumn [data-testid="stPageLink"] {display: none;}
[data-testid="stLayoutWrapper"]:has(> :is(
  .st-key-release, .st-key-outcome, .st-key-ask, .st-key-own_ask, .st-key-criteria_ask,
  .st-key-said_modes)) {order: 1;}
[class*="st-key-results_"] .stPopover {display: none;}
</style>"""
# The sliders shown first: the speed and what were changed from the preset, up to as many.
_MOST = 5


@dataclass
class Views:
    """The charts of what is open, of which a presentation shows one.

    `place` is where the choice between them is drawn, none at a desk.
    """

    place: DeltaGenerator | None
    visitor: Session
    keys: list[str] = field(default_factory=list)
    shown: str = ""

    def shows(self, key: str) -> bool:
        """Return whether a chart is shown; all are asked in their order."""
        self.keys.append(key)
        visitor = self.visitor
        if not self.shown:
            known = visitor.views.get(key, ())
            self.shown = visitor.present if visitor.present in known else key
        return not visitor.present or key == self.shown

    def draw(self) -> None:
        """Draw the choice, where there is one; run again where another chart was meant."""
        visitor = self.visitor
        if self.place is None or not self.keys:
            return
        first = self.keys[0]
        visitor.views[first] = tuple(self.keys)
        if self.shown not in self.keys or (
            visitor.present in self.keys and visitor.present != self.shown
        ):
            st.rerun()
        if len(self.keys) > 1:
            key = f"view_{first}"
            visitor.mirror(key, self.shown)
            self.place.segmented_control(
                "View", self.keys, format_func=_title, key=key, required=True,
                label_visibility="collapsed", on_change=lambda: visitor.view(st.session_state[key]),
            )  # fmt: skip


def draw_switch(visitor: Session) -> None:
    """Draw the switch between desk and presentation."""
    presenting = bool(visitor.present)
    st.button(
        "Desk" if presenting else "Present", key="present", shortcut="p", type="tertiary",
        on_click=visitor.view, args=("" if presenting else "1",),
        help="Large type, the sliders in use, and one chart at a time, for a lecture hall.",
    )  # fmt: skip


def draw_sliders(visitor: Session) -> None:
    """Draw the sliders in use: those changed from the preset first, or those chosen."""
    items = inputs_of(visitor.values)
    changed = [key for key in visitor.changed() if key in items]
    usual = list(dict.fromkeys(["rpm", *changed, "C", "T", "L"]))[:_MOST]
    # Another kind of bearing has other inputs.
    chosen = [key for key in st.session_state.get("in_use", usual) if key in items]
    show_inputs("in use", [items[key] for key in chosen])
    with st.popover("Other sliders", width="stretch"):
        st.multiselect(
            "Sliders in use", list(items), format_func=lambda key: items[key].label,
            key="in_use", default=None if "in_use" in st.session_state else usual,
            persist_state="session",
        )  # fmt: skip


def _title(key: str) -> str:
    """Return a view's name from its chart's key."""
    for page in ("home_", "orbits_", "tolerances_", "sweep_"):
        key = key.removeprefix(page)
    return key.replace("_", " ").capitalize()
