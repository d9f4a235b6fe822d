"""The frame of every page: title, navigation, sidebar, and means to show a machine's results."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from datetime import timedelta
from functools import cache, partial
from pathlib import Path
from typing import Literal, NamedTuple, NoReturn

import streamlit as st
from streamlit.delta_generator import DeltaGenerator

from rotorcalc.figures import Chart, cursor
from rotorcalc.units import Units
from ui import choices
from ui.bores import Values
from ui.cases import Draw, Shown, compared, on_axes_of
from ui.cases import computed as computed_cases
from ui.choices import choice
from ui.computed import Computed, computed_from
from ui.frame import bore, cases, history, presentation, sidebar
from ui.inputs import as_shown, in_units
from ui.preview import Preview, Text, Words
from ui.results.row import show_results
from ui.serving import one_at_a_time, settings, version
from ui.session import Session, session, write_address_bar
from ui.sharing import popover
from ui.widgets import (
    chart_key,
    is_dark,
    keep,
    show_chart,
    show_connection,
    show_links,
    show_preview,
)
from ui.words import validity, verdict

_ICON = str(Path(__file__).with_name("icon.svg"))

_ABOUT = f"{version.label()}: rotors on fluid-film bearings, after San Andrés, Notes 5."
# Least width of a row of results [rem] by the number of its columns; on less there are fewer.
_COLUMNS = {5: 42, 4: 32, 3: 24, 2: 12}


def _pairs_in_columns(columns: int, least: int) -> str:
    """Return the rule that lays out pairs in columns where a row is wide enough for them."""
    places = (
        f":nth-child({2 * columns}n + {2 * i + part}) {{grid-column: {i + 1};}}"
        for i in range(columns)
        for part in (1, 2)
    )
    # Four in rows of three, or five in rows of four, would leave one alone. To count a row's
    # children by :has() would style the whole page anew whenever anything is put into it.
    row = '[class*="st-key-results_"]'
    if columns in (3, 4):
        row += f':where(:not([class*="st-key-results_{columns + 1}_"]))'
    rules = " ".join(f"{row} > {place}" for place in places)
    return f"@container (min-width: {least}rem) {{{rules}}}"


STYLE = "\n".join([
    "<style>",
    Path(__file__).with_name("page.css").read_text(encoding="utf-8"),
    *(_pairs_in_columns(*rule) for rule in sorted(_COLUMNS.items())),
    "</style>",
])  # fmt: skip

NO_MACHINE = "These inputs do not describe a valid machine"
HOME = "app.py"
PAGES = {
    HOME: "Machine",
    "pages/1_Equilibrium.py": "Equilibrium",
    "pages/9_Heat.py": "Heat",
    "pages/2_Coefficients.py": "Coefficients",
    "pages/3_Stability.py": "Stability",
    "pages/4_Root_locus.py": "Root locus",
    "pages/5_Response.py": "Response",
    "pages/10_Criteria.py": "Criteria",
    "pages/11_Tolerances.py": "Tolerances",
    "pages/6_Orbits.py": "Orbits",
    "pages/7_Bearings.py": "Bearings",
    "pages/13_Your_data.py": "Your data",
    "pages/12_Lecture.py": "Lecture",
    "pages/14_Exercises.py": "Exercises",
    "pages/8_Notes.py": "Notes",
}


@dataclass(frozen=True)
class Page:
    """A page's machine, the cases beside it, and the units shown."""

    computed: Computed
    cases: tuple[Shown, ...]
    units: Units
    preview: Preview
    views: presentation.Views
    # Whether the content runs with the frame as one.
    whole: bool = False
    # Machines for whose charts the axes have room too.
    fixed_for: tuple[Computed, ...] = ()

    def chart(  # noqa: PLR0913 - a chart's drawing, its words, and how it answers
        self,
        draw: Draw,
        key: str,
        *,
        alt: str,
        caption: str | Callable[[Computed], str],
        while_dragging: Draw | None = None,
        at_one_speed: bool = False,
    ) -> None:
        """Show a chart of the live machine, the cases thin and in their colours behind it.

        A caption that depends on the inputs of sliders is a function of the machine's results.
        While one is dragged a chart that takes long has another function, quicker and coarser.
        A chart at one speed is asked for at another one that is marked on the page.
        """
        if self.views.shows(key):
            if at_one_speed:
                draw = self._at_marked_speeds(draw)
                while_dragging = while_dragging and self._at_marked_speeds(while_dragging)
            shown = compared(self._on_fixed_axes(draw), self.cases)
            dragged = shown
            if while_dragging:
                dragged = compared(self._on_fixed_axes(while_dragging), self.cases)
            self._show((shown, dragged), key, alt, caption)

    def figure_of_the_notes(
        self, draw: Draw, key: str, *, alt: str, caption: str | Callable[[Computed], str]
    ) -> None:
        """Show a chart with that of the notes' own bearing, short and plain, behind it too."""
        if self.views.shows(key):
            shown = compared(draw, self.cases, with_notes=True)
            self._show((shown, shown), key, alt, caption)

    def _show(
        self, draws: tuple[Draw, Draw], key: str, alt: str, caption: str | Callable[[Computed], str]
    ) -> None:
        """Show a chart; `draws` has what draws it at first and while a slider is dragged."""
        drawn, self.preview.charts[chart_key(key)] = draws
        show_chart(drawn(self.computed), key=key, alt=alt)
        if isinstance(caption, str):
            st.caption(caption)
        else:
            self.say(f"under_{key}", lambda c: Text(caption(c), "caption"))

    def _on_fixed_axes(self, draw: Draw) -> Draw:
        return on_axes_of(draw, self.fixed_for) if self.fixed_for else draw

    def _at_marked_speeds(self, draw: Draw) -> Draw:
        """Return a chart that is asked for at other running speeds, those of the sweep."""

        def drawn(c: Computed) -> Chart:
            asked = {"input": "rpm", "ends": self.units.speed.of(c.sweep.speed[[0, -1]])}
            return cursor.over_speed(draw(c), c.speed, self.units, asked=asked)

        return drawn

    def tabs(self, key: str, contents: Mapping[str, Callable[["Page"], object]]) -> None:
        """Show tabs by their labels, of which only the open one's content is drawn."""
        labels = list(contents)
        if (first := choice(key, labels[0], contents.__contains__)) not in (None, labels[0]):
            # Another default would be another widget to Streamlit.
            st.session_state[key] = first
        tabs = st.tabs(labels, on_change="rerun", key=key)
        for tab, draw in zip(tabs, contents.values(), strict=True):
            if tab.open:
                with tab:
                    draw(self)

    def is_case(self, computed: Computed) -> bool:
        """Return whether a machine is one of the cases."""
        return any(computed is shown.computed for shown in self.cases)

    def alone(self) -> "Page":
        """Return the page without cases, for results too costly to compute for each."""
        return replace(self, cases=())

    def run_whole(self) -> None:
        """Run the whole page: a click can end such a run, but not that of a fragment."""
        if not self.whole:
            session().whole = True
            st.rerun()

    def results(self, *keys: str) -> None:
        """Show results in a row, each with its equation and its change from the first case."""
        show_results(self.preview, *keys)

    def say(self, key: str, words: Words, *, while_dragging: Words | None = None) -> None:
        """Show a text that depends on the machine."""
        self.preview.say(key, words, while_dragging=while_dragging)


class Stage(NamedTuple):
    """What a page has in place of title and sidebar, whose machine is not the visitor's own."""

    arrive: Callable[[], object]
    heading: Callable[[], object]
    sidebar: Callable[[], object]
    # Whether a presentation begins without the sidebar.
    is_whole: bool = False


class Places(NamedTuple):
    """Places in the frame whose content changes while sliders move."""

    history: DeltaGenerator
    foot: DeltaGenerator
    bore: DeltaGenerator | None
    # That of the links between pages, where a browser cannot complete them.
    navigation: DeltaGenerator | None
    # Whether the page itself says what its machine does.
    is_stage: bool


def show(
    title: str,
    sentence: str,
    content: Callable[[Page], None],
    *,
    unanswered: Callable[[str], object] | None = None,
    stage: Stage | None = None,
) -> None:
    """Draw a page: its frame, then its content, which alone is redrawn when a slider moves.

    While a slider is dragged, what depends on the machine has a preview. Where the film has no
    answer at the running speed the content is not drawn, unless it can do without and
    `unanswered` shows the reason.
    """
    with one_at_a_time.PAGES.through():
        places = _frame(title, sentence, stage)
        visitor = session()
        whole, visitor.whole = visitor.whole, False
        if whole:
            # As a fragment's content stands in a container: elsewhere it would stand twice, beside
            # the old, until the run ends.
            with st.container():
                _content(content, places, unanswered, whole=True)
        else:
            st.fragment(_content)(content, places, unanswered, whole=False)


def _frame(title: str, sentence: str, stage: Stage | None) -> Places:
    """Draw what stays while sliders move; return the places for what changes."""
    st.set_page_config(
        page_title=f"{title} · rotorcalc",
        page_icon=_ICON,
        layout="wide",
        initial_sidebar_state=_sidebar_at_first(stage),
        menu_items={"About": _ABOUT},
    )
    st.html(STYLE)
    visitor = session()
    show_connection()
    _run_when_reconnected()
    visitor.frame += 1
    visitor.arriving = visitor.page != title
    if visitor.arriving and visitor.page:
        choices.choices().arrive()
    if stage:
        stage.arrive()
    else:
        visitor.give_back()
    visitor.drawn = visitor.framed()
    with st.sidebar:
        past, foot, picture = _sidebar(visitor, stage)
    visitor.page = title
    navigation = _top(visitor)
    with st.container(key="page_title"):
        if stage:
            stage.heading()
        else:
            st.header(title, anchor=False)
            st.markdown(sentence)
    return Places(past, foot, picture, navigation, stage is not None)


def _top(visitor: Session) -> DeltaGenerator | None:
    """Draw the links between pages, and the switch beside them.

    Returns the links' place where no browser completes them, so that each run draws them anew.
    """
    by_browser = show_links()
    with st.container(key="frame_top"):
        navigation = st.container()
        if by_browser:
            with navigation:
                _navigation({})
        presentation.draw_switch(visitor)
    return None if by_browser else navigation


def _sidebar_at_first(stage: Stage | None) -> Literal["collapsed"] | int:
    presented = bool(stage and stage.is_whole and session().present)
    return "collapsed" if presented else sidebar.WIDTH


def _sidebar(
    visitor: Session, stage: Stage | None
) -> tuple[DeltaGenerator, DeltaGenerator, DeltaGenerator | None]:
    """Draw the inputs, in a presentation those in use.

    Returns places above and below them, and at a desk that of the bore's picture.
    """
    if visitor.present:
        st.html(presentation.STYLE)
    if not stage and not visitor.present:
        sidebar.draw_presets()
    past = _always_in_sight(shared=stage is None)
    if stage or visitor.present:
        if stage:
            stage.sidebar()
        else:
            presentation.draw_sliders(visitor)
        return past, st.container(), None
    cases.draw_buttons()
    picture = sidebar.draw_inputs()
    foot = st.container()
    st.caption(_foot())
    return past, foot, picture


def _always_in_sight(*, shared: bool) -> DeltaGenerator:
    """Draw what stays in sight while the sidebar scrolls; return the place of undo and redo.

    A machine that is not the visitor's own is not theirs to share.
    """
    with st.container(key="past"):
        past = st.container()
        with st.container(horizontal=True, gap="small", key="always"):
            sidebar.draw_settings()
            if shared:
                popover.draw()
    return past


def _foot() -> str:
    """Return the version, and the way to the documentation where it is served."""
    docs = settings.docs()
    return f"{version.label()} · [documentation]({docs})" if docs else version.label()


# The browser's longest timer is 24 days.
@st.fragment(run_every=timedelta(days=20))
def _run_when_reconnected() -> None:
    """Draw nothing: where anything runs by itself, a browser runs the page when it is back.

    Else it waits for a visitor's first action, which a server without the session would lose.
    """


def _content(
    content: Callable[[Page], None],
    places: Places,
    unanswered: Callable[[str], object] | None,
    *,
    whole: bool,
) -> None:
    with one_at_a_time.PAGES.through():
        visitor = session()
        if visitor.drawn != visitor.framed():
            # A button of the content, such as a demonstration's, changed more than sliders show.
            st.rerun()
        views = presentation.Views(st.container(key="views") if visitor.present else None, visitor)
        page = replace(_page(places, views, unanswered or _stop), whole=whole)
        if visitor.asked:
            keep("before")  # the server may be lost while it computes
        content(page)
        page.views.draw()
        cases.draw_table(page.preview, page.cases)
        # The widgets drawn now have taken their choices.
        write_address_bar()
        keep("after")


def _stop(problem: str) -> NoReturn:
    """Say why there are no results, and draw no more."""
    st.error(problem, title=NO_MACHINE)
    st.stop()


def _page(places: Places, views: presentation.Views, unanswered: Callable[[str], object]) -> Page:
    """Return the page's machine and draw what depends on it everywhere; stop where there is none.

    A fragment may write into the places where it has done so when the whole page ran; the
    preview, through which a better value comes, is written in any case.
    """
    visitor = session()
    visitor.record()
    of_inputs = _draw_inputs(places, visitor)
    params = write_address_bar()
    if places.navigation is not None:
        with places.navigation:
            _navigation({key: word for key, word in params.items() if key not in choices.NAMES})
    for problem in (*visitor.refused, *visitor.problems):
        st.warning(problem)
    if visitor.refused:
        with places.foot:
            show_preview(None)
        _offer_the_rest(visitor)
        st.stop()
    try:
        computed = computed_from(visitor.values)
    except ValueError as error:
        with places.foot:
            show_preview(None)
        _stop(in_units(f"{error}", visitor.units))
    beside, problems = computed_cases(visitor.cases)
    for problem in problems:
        st.warning(in_units(problem, visitor.units))
    first, units = (beside[0] if beside else None), visitor.units
    preview = Preview(
        dict(visitor.values), computed, first, units, dark=is_dark(), of_inputs=of_inputs
    )
    page = Page(computed=computed, cases=beside, units=units, preview=preview, views=views)
    return _answered(page, places, visitor, unanswered)


def _answered(
    page: Page, places: Places, visitor: Session, unanswered: Callable[[str], object]
) -> Page:
    """Return a page after what the frame says of its machine, or why the film has no answer."""
    try:
        _ = page.computed.point
    except ValueError as error:
        with places.foot:
            show_preview(None)
        unanswered(as_shown(f"{error}", visitor.values, page.units))
        return page.alone()
    visitor.preview = page.preview
    if not places.is_stage:
        page.say("verdict", lambda c: verdict.text(c, page.units))
    with places.foot:
        validity.draw(page.preview, visitor.set_film)
        show_preview(page.preview)
    return page


def _draw_inputs(places: Places, visitor: Session) -> dict[str, Callable[[Values], Text]]:
    """Draw what depends on the inputs alone; return it as functions of them, by their keys."""
    with places.history:
        history.draw(visitor)
    drawn: dict[str, Callable[[Values], Text]] = {
        history.CHANGES: partial(_changes, visitor.preset)
    }
    if places.bore is not None:
        drawn[bore.PICTURE] = bore.drawing
        with places.bore:
            bore.draw_picture(visitor.values)
    return drawn


def _changes(preset: str, values: Values) -> Text:
    return Text(history.changes(preset, values), "caption")


def _offer_the_rest(visitor: Session) -> None:
    """Ask whether to show the machine without what was refused of a link or a file."""
    st.markdown(
        "Without these values it is a different machine from the one in the link or file, so "
        "nothing is computed yet. The sidebar shows the values that can be used."
    )
    st.button("Use the valid values", key="take", type="primary", on_click=visitor.take)


def _navigation(params: dict[str, str]) -> None:
    """Draw the links between pages, each with query parameters."""
    with st.container(horizontal=True, gap="small"):
        for path, label in PAGES.items():
            st.page_link(_place(path), label=label, query_params=params)


@cache
def _place(path: str) -> st.Page:
    """Return a page to link to: for its path alone Streamlit asks the disk at each link."""
    return st.Page(path, default=path == HOME)
