"""What the orbits page asks and says of a released journal."""

import math
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Literal, TypeVar

import streamlit as st

from rotorcalc import Machine, TransientError
from rotorcalc.figures import Units
from rotorcalc.nonlinear.release import Release, affordable_revolutions
from ui.choices import KICKS, TURNS, choice
from ui.computed import Computed, computed_from
from ui.format import amount, digits
from ui.frame.page import Page
from ui.inputs import INPUTS, PRESET_VALUES
from ui.jobs import cache, queue, work
from ui.jobs.bar import show_progress
from ui.jobs.work import Progress
from ui.preview import Preview, Text, not_at_once
from ui.ring import has_ring
from ui.session import session
from ui.words.on_demand import Job, on_demand, slow_film

T = TypeVar("T")

_KICK, _REVOLUTIONS = "orbits_kick", "orbits_revolutions"
# Sizes, in clearances, below which a journal is at rest, and from which a circle is a whirl.
_AT_REST, _WHIRLS = 2e-3, 0.02
# Between these ratios of late to early size a motion neither dies nor grows.
_STAYS = (0.8, 1.25)
# Revolutions of a release while a slider is dragged: some 20 ms.
_COARSE = 20
# Seconds of a revolution from which each release is asked for, not the first alone.
_SLOW_REVOLUTION = 0.1
_COARSELY = f"Coarse while dragging, {_COARSE} revolutions at most. "
# A rigid rotor just below a subcritical onset: ε = 0.06, p² one per cent below critical.
_SUBCRITICAL = PRESET_VALUES["sheet-1e8"] | {
    "mass": 660.0, "load": 948.0, "k": math.inf, "u": 0.0, "rpm": 5730.0, "rpm_max": 8000.0,
}  # fmt: skip

Demo = Literal["below", "above", "small", "big"]
# What a film has whose motion comes by tables, or by a solution at each step.
_TABULATED = (
    "The force of this film in any motion comes from solutions of Reynolds' equation, tabulated "
    "once for {}. With this release that takes about {} s; then other loads, speeds{} follow at "
    "once."
)
_OF_PADS = "each pad's arc and L/D", ", clearances and preloads"
_OF_RING = "the L/D of its films", " and clearances"
_BALANCED = (
    "At each step the tilts of the pads are balanced with their films, whose forces are tabulated. "
    "This release takes about {} s."
)
_SOLVED = (
    "Pads with pockets have no table of their force in motion: Reynolds' equation is solved at "
    "each step. This release takes about {} s."
)


@dataclass(frozen=True)
class _Demo:
    """A demonstration: its name, what it changes of the machine, displacement and revolutions."""

    name: str
    changes: str
    kick: float
    revolutions: int

    @property
    def label(self) -> str:
        """The button's label: the name, and all that it changes."""
        return f"{self.name}, sets {self.changes}"


_HERE, _THERE = "Ω, u, release", "all"
_DEMOS: dict[Demo, _Demo] = {
    "below": _Demo("5 % below onset", _HERE, 0.30, 60),
    "above": _Demo("5 % above onset", _HERE, 0.05, 160),
    "small": _Demo("Subcritical: small kick", _THERE, 0.01, 400),
    "big": _Demo("Subcritical: big kick", _THERE, 0.25, 400),
}


@dataclass(frozen=True)
class Ask:
    """A release: the initial displacement of the journal, in clearances, and the revolutions."""

    kick: float
    revolutions: int


# Half a megabyte each, at most four.
_release = cache.Cached(work.release, entries=32, megabytes=24, turns=queue.SHORT)
_long_release = cache.Cached(work.release, entries=16, megabytes=40)


def choose_release(computed: Computed) -> Ask:
    """Show the demonstrations, displacement and length; return the chosen release."""
    with st.container(horizontal=True, gap="small", key="demonstrations"):
        for name, demo in _DEMOS.items():
            st.button(
                demo.label, key=f"orbits_{name}", on_click=_set_up, args=(name,),
                disabled=not _can_set_up(name, computed),
            )  # fmt: skip
        visitor = session()
        st.button(
            "Undo last change", key="orbits_undo", on_click=visitor.undo,
            help="Machine and release, as they were before the last change.",
            disabled=not visitor.history.can_undo,
        )  # fmt: skip
    left, right = st.columns(2)
    with left:
        kick = st.slider(
            "Initial displacement over clearance [-]", *KICKS,
            choice(_KICK, 0.30, lambda kick: KICKS[0] <= kick <= KICKS[1]), 0.01, key=_KICK,
            help="From equilibrium, against the load; the journal is released at rest.",
        )  # fmt: skip
    with right:
        turns = st.slider(
            "Revolutions [-]", *TURNS,
            choice(_REVOLUTIONS, 40, lambda turns: TURNS[0] <= turns <= TURNS[1]), 20,
            key=_REVOLUTIONS,
        )  # fmt: skip
    return Ask(kick, turns)


def _can_set_up(demo: Demo, computed: Computed) -> bool:
    return demo in ("small", "big") or not INPUTS["rpm"].problem(_demo_rpm(demo, computed))


def _demo_rpm(demo: Demo, computed: Computed) -> float:
    rpm = computed.onset.speed * (0.95 if demo == "below" else 1.05) * 30.0 / math.pi
    return round(rpm, 1) if math.isfinite(rpm) else rpm


def _set_up(demo: Demo) -> None:
    visitor = session()
    visitor.record()  # with the release as it was
    if demo in ("small", "big"):
        visitor.set_preset("sheet-1e8")
        visitor.values |= _SUBCRITICAL
    else:
        rpm = _demo_rpm(demo, computed_from(visitor.values))
        visitor.set_value("u", 0.0)
        visitor.set_value("rpm", rpm)
    shown = _DEMOS[demo]
    st.session_state[_KICK], st.session_state[_REVOLUTIONS] = shown.kick, shown.revolutions


def let_go(computed: Computed, ask: Ask, tell: Progress | None = None) -> Release:
    """Return the release of a machine's journal."""
    ask = _affordable(computed, ask)
    return _releases(computed, ask)(*_of(computed, ask), tell=tell)


def _releases(computed: Computed, ask: Ask) -> cache.Cached[Release]:
    """Return the cache, and the queue, that a release belongs to."""
    return _long_release if ask.revolutions >= work.LONG or _is_solved(computed) else _release


def _of(computed: Computed, ask: Ask) -> tuple[Machine, float, float, int]:
    return computed.machine, computed.speed, ask.kick, ask.revolutions


def _is_solved(computed: Computed) -> bool:
    """Return whether each release takes long, not the first alone."""
    film = slow_film(computed)
    return film is not None and (film.tables is None or film.revolution > _SLOW_REVOLUTION)


def coarse(computed: Computed, ask: Ask) -> Release:
    """Return the first revolutions of a release, coarsely, for each value of a dragged slider.

    Raises ValueError where it cannot be computed, or not as fast as the slider moves.
    """
    if slow_film(computed) is not None:
        not_at_once(computed)
    ask = _affordable(computed, ask)
    turns = min(ask.revolutions, _COARSE)
    try:
        return _coarse(computed.machine, computed.speed, ask.kick, turns)
    except TransientError as error:
        raise ValueError(f"{error}") from error


# A page asks for the same release for each of its charts and texts.
@lru_cache(maxsize=16)
def _coarse(machine: Machine, speed: float, kick: float, revolutions: int) -> Release:
    return work.release(machine, speed, kick, revolutions)


def _affordable(computed: Computed, ask: Ask) -> Ask:
    """Return the release, shorter where the machine vibrates many times in a revolution."""
    most = affordable_revolutions(computed.point)
    return ask if ask.revolutions <= most else replace(ask, revolutions=most)


def try_out(page: Page, ask: Ask) -> Page | None:
    """Return the page without the cases that allow no such release.

    Say in words why there is none, and stop, where the live machine allows none. Where it takes
    long, say so, and return None until a visitor asks for it.
    """
    ask = _affordable(page.computed, ask)
    if not _asked_for(page, ask):
        return None
    bar, tell = show_progress("Integrating …") if ask.revolutions >= work.LONG else (None, None)
    try:
        let_go(page.computed, ask, tell)
    except (ValueError, TransientError) as error:
        st.error(f"{error}", title="This release cannot be computed")
        st.stop()
    finally:
        if bar is not None:
            bar.empty()
    return replace(page, cases=tuple(s for s in page.cases if _is_drawn(s.computed, ask)))


def _asked_for(page: Page, ask: Ask) -> bool:
    """Return whether a release comes at once, or a visitor has asked for it."""
    film = slow_film(page.computed)
    if film is None or _is_known(page.computed, ask):
        return True
    seconds = math.ceil(film.seconds + ask.revolutions * film.revolution)
    if _is_solved(page.computed):
        how = (_SOLVED if film.tables is None else _BALANCED).format(seconds)
        about = "release", page.computed.machine, page.computed.speed, ask
    else:
        once, others = _OF_RING if has_ring(page.computed) else _OF_PADS
        how, about = _TABULATED.format(once, seconds, others), ("tables", film.tables)
    # An error comes again, and is shown, where the release is asked for anew.
    asked = on_demand(
        page, Job("Release the journal", "orbits_slow_release", how), about,
        lambda tell: (_can_let_go(page.computed, ask, tell), True),
    )  # fmt: skip
    return asked is not None


def _is_drawn(computed: Computed, ask: Ask) -> bool:
    """Return whether a case's release can be drawn; one that takes long, once it was asked for."""
    return _is_known(computed, ask) if _is_solved(computed) else _can_let_go(computed, ask)


def _is_known(computed: Computed, ask: Ask) -> bool:
    ask = _affordable(computed, ask)
    return _releases(computed, ask).known(*_of(computed, ask)) is not None


def _can_let_go(computed: Computed, ask: Ask, tell: Progress | None = None) -> bool:
    try:
        let_go(computed, ask, tell)
    except (ValueError, TransientError):
        return False
    return True


def of_ring(computed: Computed) -> str:
    """Return what the chart of a path shows of a floating ring, for its caption."""
    if not has_ring(computed):
        return ""
    return " Ochre: the ring's centre; dotted, the clearance in the ring, in which the journal is."


def say_outcome(preview: Preview, asked: Ask) -> None:
    """Show what the journal did, and what the linear theory predicts."""
    units = preview.units
    preview.say("followed", lambda c: _followed(asked, let_go(c, asked)), while_dragging=_unsaid)
    preview.say(
        "stopped",
        lambda c: _stopped(let_go(c, asked)),
        while_dragging=lambda c: _stopped(coarse(c, asked)),
    )
    preview.say(
        "outcome",
        lambda c: _judged(c, let_go(c, asked), units),
        while_dragging=lambda c: _judged(c, coarse(c, asked), units, _COARSELY),
    )
    preview.say(
        "suction",
        lambda c: _suction(let_go(c, asked), units),
        while_dragging=lambda c: _suction(coarse(c, asked), units),
    )


def _unsaid(_: Computed) -> None:
    return None


def _followed(asked: Ask, found: Release) -> Text | None:
    followed = round(float(found.revolutions[-1]))
    if followed >= asked.revolutions or found.stopped:
        return None
    return Text(
        f"This machine oscillates so often per revolution that only {followed} revolutions are "
        "computed.",
        "info",
    )


def _stopped(found: Release) -> Text | None:
    words = f"The integration ended early: {found.stopped}."
    return Text(words, "warning") if found.stopped else None


def _suction(found: Release, units: Units) -> Text | None:
    if not found.lowest_pressure < 0.0:
        return None
    lowest = amount(units.pressure, found.lowest_pressure)
    return Text(
        f"In this motion the film's pressure falls to {lowest}: suction, at which oil cavitates "
        "sooner or later. This model keeps the film full, in motion as at rest.",
        "info",
    )


def _judged(computed: Computed, found: Release, units: Units, before: str = "") -> Text:
    words = f"{before}{_outcome(found, units)} {_theory(computed, found)}"
    return Text(words, "warning" if _is_whirling(found) else "success")


def _is_whirling(found: Release) -> bool:
    seen, C = found.spectrum, found.clearance
    return seen.whirl > max(_WHIRLS * C, 0.5 * seen.synchronous) and _trend(found) > _STAYS[0]


def _trend(found: Release) -> float:
    """Return the size of the motion in its last quarter over that in its second."""
    n = found.settled
    earlier = float(found.size[n : 2 * n].max())
    return found.last_size / earlier if earlier > 0.0 else 1.0


def _follows_the_imbalance(found: Release) -> bool:
    at_rest = found.last_size < _AT_REST * found.clearance
    return not at_rest and found.spectrum.synchronous > 0.5 * found.last_size


def _outcome(found: Release, units: Units) -> str:
    C, seen, turns = found.clearance, found.spectrum, f"{found.revolutions[-1]:.0f} revolutions"
    size = f"{found.last_size / C:.3g} C from equilibrium"
    thin = f"the smallest film is {amount(units.film, found.film.min())}"
    if _is_whirling(found):
        grows = " and growing" if _trend(found) > _STAYS[1] else ""
        return (
            f"After {turns} the journal whirls at {seen.whirl_ratio:.3g} of the running speed, up "
            f"to {size}{grows}; {thin}."
        )
    if found.last_size < _AT_REST * C:
        return f"Within {turns} the journal returns to equilibrium."
    if _follows_the_imbalance(found):
        return f"After {turns} the journal follows the imbalance, up to {size}; {thin}."
    low, high = _STAYS
    way = "decaying" if _trend(found) < low else "growing" if _trend(found) > high else "going on"
    return f"After {turns} the motion is still {way}, up to {size}; {thin}."


def _theory(computed: Computed, found: Release) -> str:
    rate = digits(abs(found.whirl.real))
    if math.isnan(found.whirl.real):
        return "The linear theory has no oscillating mode here."
    if not computed.is_stable:
        said = f"The linear theory: unstable, a small whirl grows at {rate} 1/s"
        if not _is_whirling(found) and _follows_the_imbalance(found):
            return (
                f"{said}. It treats whirl and imbalance separately; here the imbalance suppresses "
                "the whirl."
            )
        return f"{said}."
    said = f"The linear theory: stable, a small whirl decays at {rate} 1/s"
    if _is_whirling(found) and found.last_size > found.first_size:
        return f"{said}. This displacement was too large for the linear theory to hold."
    return f"{said}."


def show_measured(preview: Preview, asked: Ask) -> None:
    """Show whirl ratio and amplitudes, measured and by the linear theory."""
    units = preview.units
    preview.say(
        "measured",
        lambda c: _measured(c, let_go(c, asked), units),
        while_dragging=lambda c: _measured(c, coarse(c, asked), units),
    )


def _measured(computed: Computed, found: Release, units: Units) -> Text:
    seen, C = found.spectrum, found.clearance
    ratio = "no whirl" if math.isnan(seen.whirl_ratio) else digits(seen.whirl_ratio)
    predicted = found.whirl.imag / computed.speed
    rows = {
        "Whirl ratio, simulated": ratio,
        "Whirl ratio, linear": "none" if math.isnan(predicted) else digits(predicted),
        "Whirl's circle": amount(units.amplitude, seen.whirl),
        "1× circle": amount(units.amplitude, seen.synchronous),
        "Ends within": f"{digits(float(f'{found.last_size / C:.3g}'))} C of equilibrium",
    }
    lines = (rows, ["--:"] * len(rows), rows.values())
    return Text("\n".join(f"| {' | '.join(line)} |" for line in lines))
