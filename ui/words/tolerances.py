"""The study of a machine's tolerances: what a visitor asks, what it costs, and what came of it."""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np
import streamlit as st

from rotorcalc import Tolerance
from rotorcalc.figures.design import Quantity
from rotorcalc.units import Units
from ui import comparison
from ui.choices import choice
from ui.format import amount, digits, quoted, typed_number
from ui.frame.page import Page
from ui.inputs import INPUTS, as_shown, in_units, values_of
from ui.jobs import cache, work
from ui.jobs.queue import SHORT
from ui.serving.downloads import offer
from ui.session import session
from ui.words import spreads
from ui.words.design import fields_of, name
from ui.words.on_demand import Job, on_demand
from ui.words.spread_rows import choose_spreads
from ui.words.studies import FEWEST, Study, most_samples, usual_samples

SAMPLES, SEED = "tolerances_samples", "tolerances_seed"
_DRAW, _HELD, _REFUSED = "tolerances_draw", "tolerances_held", "tolerances_refused"

_ROWS = 200  # of the table on the page

# Each kept for a visitor as long as others leave room.
_studies = cache.Cached(work.study, entries=64, megabytes=64)
_quick = cache.Cached(work.study, entries=64, megabytes=16, turns=SHORT)


# --- What is asked -----------------------------------------------------------------------------


@dataclass(frozen=True)
class Drawn:
    """A study that was drawn, what came of it, and of an earlier one in what it differs."""

    study: Study
    found: Tolerance
    before: str = ""


def choose_study(page: Page) -> Study | str:
    """Ask what spreads, how many machines are drawn and by which seed, or return why none can be.

    The reason stands beside its input too.
    """
    machine, units = page.computed.machine, page.units
    rows = choose_spreads(machine, units)
    most = most_samples(machine, rows.fields)
    rows.draw_add()
    with st.container(horizontal=True, gap="xsmall", vertical_alignment="bottom"):
        samples = _text("Machines drawn", SAMPLES, f"{usual_samples(machine, rows.fields)}")
        seed = _text("Seed", SEED, "1")
    if rows.problem:
        return rows.problem
    try:
        return Study(
            machine, page.computed.speed, spreads.given(machine, rows.spreads, units),
            _whole("Machines drawn", samples, 1, most, _more(most)),
            _whole("Seed", seed, 0, 10**9),
        )  # fmt: skip
    except ValueError as error:
        st.warning(f"{error}.")
        return f"{error}"


def _text(label: str, key: str, usual: str) -> str:
    # Left empty it is the usual one, also of the next machine.
    begun = choice(key, "", lambda word: len(word) < 40)
    if begun is not None:
        st.session_state[key] = begun
    return st.text_input(label, key=key, width=140, placeholder=usual).strip() or usual


def _whole(label: str, text: str, low: int, high: int, why: str = "") -> int:
    """Return a whole number, or raise ValueError naming it and its bounds."""
    try:
        value = typed_number(text)
    except ValueError as error:
        raise ValueError(f"{label} = {quoted(text)} {error}") from None
    if not (low <= value <= high and value == int(value)):
        raise ValueError(
            f"{label} = {quoted(text)} must be a whole number between {low} and {high}{why}"
        )
    return int(value)


def _more(most: int) -> str:
    return (
        f", as others share this server; more than {most} are drawn in a notebook, by "
        "`rc.tolerance(machine, spreads, samples, seed, executor=pool)`, or by the command "
        "`python -m rotorcalc`"
    )


# --- The study ---------------------------------------------------------------------------------


def drawn(page: Page, asked: Study | str) -> Drawn | None:
    """Return the study asked for, once it is drawn; until then the one before, and whose it is."""
    if not isinstance(asked, str):
        found = _found(page, asked)
        if found is not None:
            st.session_state[_HELD] = asked
            return Drawn(asked, found)
    held = st.session_state.get(_HELD)
    known = None if held is None else _known(held)
    if held is None or known is None:
        return None
    return Drawn(held, known, _of_before(held, page, asked))


def _found(page: Page, asked: Study) -> Tolerance | None:
    """Return a study: at once where it is quick or known, else on request."""
    known = _known(asked)
    if known is not None:
        return known
    refused, why = st.session_state.get(_REFUSED, (None, ""))
    if refused == asked:
        st.warning(why)
        return None
    if asked.at_once:
        return _attempt(page, lambda: _quick(*asked.request), asked)
    # What is not kept any more is computed with its progress shown, as at first.
    st.session_state.pop(f"{_DRAW}_done", None)
    job = Job(
        "Draw", _DRAW,
        f"{asked.samples} machines will be drawn within these spreads, and the onset of each "
        "computed: the speed at which a mode begins to grow, Eq. 5.38. It takes about "
        f"{_time(asked.seconds)}.",
    )  # fmt: skip
    found = on_demand(
        page, job, ("study", *asked.request),
        lambda tell: _attempt(page, lambda: _studies(*asked.request, tell=tell), asked),
    )  # fmt: skip
    if st.session_state.get(_REFUSED, (None, ""))[0] == asked:
        session().ask_no_more(_DRAW)
    return found


def _known(asked: Study) -> Tolerance | None:
    return (_quick if asked.at_once else _studies).known(*asked.request)


def _attempt(page: Page, draw: Callable[[], Tolerance], asked: Study) -> Tolerance | None:
    """Return a study, or show why there is none, which is kept until another is asked for."""
    try:
        return draw()
    except ValueError as error:
        fields = [field for field, _ in asked.spreads]
        said = spreads.worded(f"{error}", asked.machine, fields, page.units)
        why = as_shown(said, page.preview.values, page.units) + "."
        st.session_state[_REFUSED] = asked, why
        st.warning(why)
        return None


def _time(seconds: float) -> str:
    return f"{max(math.ceil(seconds), 1)}\u00a0s"


def _of_before(held: Study, page: Page, asked: Study | str) -> str:
    """Return that a result belongs to what was drawn before, and what has changed since."""
    changes = list(_changes(held, page, asked))
    listed = "; ".join(changes[:4]) + ("; and more" if len(changes) > 4 else "")
    words = f"This result is of an earlier machine or other spreads{f': {listed}' * bool(listed)}."
    if isinstance(asked, str):
        return f"Nothing was drawn: {asked}. {words}"
    refused, _ = st.session_state.get(_REFUSED, (None, ""))
    return words if refused == asked else f"{words} **Draw** gives it for this machine."


def _changes(held: Study, page: Page, asked: Study | str) -> Iterator[str]:
    now, top = page.computed, page.computed.top_speed
    machines = [
        values_of(machine, speed, top)
        for machine, speed in ((held.machine, held.speed), (now.machine, now.speed))
    ]
    for row in comparison.inputs(machines, page.units):
        yield f"{row.label} was {row.texts[0]}, now {row.texts[1]}"
    if not isinstance(asked, str):
        if held.spreads != asked.spreads:
            yield "other spreads"
        for words, was, is_now in (
            ("machines drawn", held.samples, asked.samples), ("seed", held.seed, asked.seed),
        ):  # fmt: skip
            if was != is_now:
                yield (
                    f"{words} were {was}, now {is_now}"
                    if words[-1] == "n"
                    else (f"{words} was {was}, now {is_now}")
                )


# --- What came of it ---------------------------------------------------------------------------


def said(found: Tolerance, units: Units) -> str:
    """Return how likely a machine is unstable, with its interval, and how the onsets spread."""
    return " ".join(
        filter(None, (_probability(found, units), _onsets(found, units), _unanswered(found, units)))
    )


def _probability(found: Tolerance, units: Units) -> str:
    chance, running = found.probability_unstable, amount(units.speed, found.speed)
    n = len(found.onset)
    if math.isnan(chance.value):
        return f"None of the {n} machines drawn has an answer at {running}."
    low, high = (_share(end) for end in (chance.low, chance.high))
    return (
        f"**{_share(chance.value)}** of the machines drawn are unstable at {running}; with 95 % "
        f"confidence the probability lies between {low} and {high} ({n} drawn, seed {found.seed})."
    )


def _share(value: float) -> str:
    return f"{digits(float(f'{100.0 * value:.3g}'))} %"


def _onsets(found: Tolerance, units: Units) -> str:
    # Of all machines with an answer, as the command line has them: those without an onset too.
    known = found.onset[~np.isnan(found.onset)]
    without = int(np.count_nonzero(known == math.inf))
    words = f"For {without} of them no onset was found." if without else ""
    if without == known.size:
        return words
    low, middle, high = (
        amount(units.speed, speed) if math.isfinite(speed) else "not found"
        for speed in np.quantile(known, (0.05, 0.5, 0.95), method="inverted_cdf")
    )
    return f"Onset: median {middle}; 5 % quantile {low}, 95 % quantile {high}. {words}".rstrip()


def _unanswered(found: Tolerance, units: Units) -> str:
    number = int(np.count_nonzero(~found.answered))
    if not number:
        return ""
    why = in_units(found.refusals[0], units)
    return f"{number} have no answer, which widens the interval; one because {why}."


def names_of(study: Study) -> dict[str, str]:
    """Return words for the inputs that spread, by the core's names."""
    own = {field: key for key, field in fields_of(study.machine).items()}
    return {field: name(study.machine, own[field]) for field, _ in study.spreads}


def quantity_of(study: Study, found: Tolerance, field: str, units: Units) -> Quantity:
    """Return an input that spreads as an axis over what was drawn of it."""
    key = next(key for key, known in fields_of(study.machine).items() if known == field)
    values = found.values[:, found.fields.index(field)]
    unit = spreads.unit_of(study.machine, key, units)
    words, symbol = (
        (INPUTS[key].label, INPUTS[key].symbol) if key in INPUTS else (name(study.machine, key), "")
    )
    return Quantity(words, symbol, unit, float(values.min()), float(values.max()))


def matters(found: Tolerance, names: Mapping[str, str]) -> str:
    """Return which input matters most, and what is left to inputs acting together."""
    known = [one for one in found.influences if not math.isnan(one.index)]
    if not known:
        return (
            "No input can be ranked: the onsets have no finite variance, as some machine has no "
            f"onset or no answer, all are alike, or fewer than {FEWEST} were drawn."
        )
    first, rest = known[0], 1.0 - sum(max(one.index, 0.0) for one in known)
    share = min(max(100.0 * first.index, 0.0), 100.0)
    left = digits(float(f"{100.0 * rest:.2g}"))
    together = f" Inputs acting together account for {left} %." if rest > 0.02 else ""
    return (
        f"**{names[first.field]}** matters most: alone it accounts for "
        f"{digits(float(f'{share:.2g}'))} % of the onset's variance.{together}"
    )


def table(study: Study, found: Tolerance, units: Units) -> None:
    """Show the first machines drawn, and offer all of them as a file."""
    from ui.sharing import drawn as files  # noqa: PLC0415 - a file is seldom asked for

    quantities = {field: quantity_of(study, found, field, units) for field in found.fields}
    rows = files.columns(found, quantities, units, _ROWS)
    st.dataframe(
        rows | {"At the running speed": files.state(found, _ROWS)},
        height=280,
        placeholder="–",
        alt="The first of the machines drawn: their inputs, onset, margin and stability.",
    )
    number = len(found.onset)
    among = f"The first {_ROWS} of {number}" if number > _ROWS else f"All {number}"
    st.caption(f"{among}; without a number where no onset was found.")
    offer(
        "All machines drawn (CSV)",
        lambda: files.drawn_csv(found, study.spreads, quantities, units),
        "tolerances.csv",
        "text/csv",
        key="save_tolerances.csv",
    )
