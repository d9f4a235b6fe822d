"""Limit cycles and the onset three ways: computed once a visitor asks, and words for them."""

import hashlib
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
import streamlit as st

from rotorcalc import (
    Bifurcation,
    BifurcationError,
    Onsets,
    TransientError,
)
from rotorcalc.arrays import Array
from rotorcalc.figures import Units
from rotorcalc.films import FilmMotion, InnerMotion, film_of
from rotorcalc.machine import Bearing
from rotorcalc.nonlinear.film_forces import has_forces
from rotorcalc.nonlinear.limit_cycles import sweep
from rotorcalc.nonlinear.measured_onset import GrowthCurve
from ui import ring
from ui.computed import Computed
from ui.format import amount, digits
from ui.frame.page import Page
from ui.jobs import cache, work
from ui.jobs.bar import show_progress
from ui.jobs.work import Progress
from ui.results.stability import fastest_growing
from ui.session import session
from ui.words import limit_cycles
from ui.words.citation import capital, without_load, without_onset

T = TypeVar("T")

# Seconds that limit cycles and the onset three ways take on a laptop's core, and on a film whose
# force takes long.
_CYCLES_TAKE, _SLOW_CYCLES_TAKE, _SLOW_THREE_TAKE = 15, 45, 25
_CYCLES = (
    "From the onset on, whirl of a constant size is possible at each speed: a limit cycle. The "
    "chart will show the size of these cycles over speed, without imbalance: stable cycles, on "
    "which a machine stays, unstable ones, beyond which a disturbance grows, and the fold where "
    "both end. It takes about {}\u00a0s."
)
_THREE = (
    "The onset comes three ways: by the notes' equations, by eigenvalues, and measured on the "
    "nonlinear motion. A few seconds …"
)
_NOT_FOLLOWED = (
    "Limit cycles are followed on plain films and floating rings. A pad of this bearing may stand "
    "still without pressure, which the method leaves out; a release and a run-up show the whirl on "
    "which this machine ends."
)
# Two searches for one onset differ by rounding.
_SAME_ONSET = 1e-6
_STARTED_AGAIN = "This computation was interrupted and has started again."

_three = cache.Cached(work.three_onsets, entries=16, megabytes=4)


@dataclass(frozen=True)
class Job:
    """What a visitor may ask for: its button's label and key, and what will come, and when."""

    label: str
    key: str
    comes: str


def on_demand(
    page: Page, job: Job, token: object, work: Callable[[Progress | None], T]
) -> T | None:
    """Return what work gives once a visitor asks for it; until then say what comes, with a button.

    `token` names what the work is about: when it changes, the visitor is asked again. While it
    runs, a bar shows how far it is, and a button ends it: its click makes the page run anew, and
    the next word of progress ends the old run. That it had to start again stands beside the result
    until the visitor's next action: it may take too short to be read meanwhile.
    """
    key = job.key
    visitor, done, place = session(), f"{key}_done", st.empty()
    name = _name(token)
    if visitor.asked.get(key) != name:
        with place.container():
            st.markdown(job.comes)
            st.button(
                job.label, key=key, type="primary", on_click=visitor.ask_for, args=(key, name)
            )
        return None
    if st.session_state.get(done) == name:
        return work(None)
    page.run_whole()
    again = _STARTED_AGAIN if key in visitor.begun else ""
    with place.container():
        if again:
            st.info(again)
        _, tell = show_progress("Computing …")
        st.button("Cancel", key=f"{key}_cancel", on_click=visitor.ask_no_more, args=(key,))
    visitor.begun.add(key)
    result = work(tell)
    if again:
        place.info(again)
    else:
        place.empty()
    visitor.begun.remove(key)
    st.session_state[done] = name
    return result


def _name(token: object) -> str:
    return hashlib.sha256(repr(token).encode()).hexdigest()


def request_cycles(computed: Computed) -> None:
    """Ask for the limit cycles as their button does."""
    key, name = "orbits_cycles", _name(("cycles", limit_cycles.branch_of(computed)))
    if session().asked.get(key) != name:
        session().ask_for(key, name)


def ask_cycles(page: Page) -> Bifurcation | None:
    """Return the limit cycles on request, or show why there are none."""
    computed, onset = page.computed, page.computed.onset.speed
    if not 0.0 < onset < math.inf:
        st.info(_no_onset(computed))
        return None
    if not has_forces(computed.machine.bearing):
        st.info(_NOT_FOLLOWED)
        return None
    limit_cycles.choose_whirl(computed)
    branch = limit_cycles.branch_of(computed)
    comes = _CYCLES.format(_SLOW_CYCLES_TAKE if slow_film(computed) else _CYCLES_TAKE)
    return on_demand(
        page, Job("Follow the limit cycles", "orbits_cycles", comes), ("cycles", branch),
        lambda tell: attempt(lambda: limit_cycles.followed(*branch.asked, tell=tell)),
    )  # fmt: skip


def begins_at_rest(branch: Bifurcation, computed: Computed) -> bool:
    """Return whether the machine rests stably below the branch's onset."""
    return branch.hopf.speed <= computed.onset.speed * (1.0 + _SAME_ONSET)


def swept(branch: Bifurcation, computed: Computed) -> tuple[Array, Array, Array] | None:
    """Return speeds, and the amplitudes as the speed slowly rises and falls through them.

    None where the machine whirls already below the branch's onset: no sweep leaves rest there.
    """
    if not begins_at_rest(branch, computed):
        return None
    onset = branch.hopf.speed
    low, high = min(float(branch.speed.min()), 0.97 * onset), float(branch.speed.max())
    speeds = np.linspace(low - 0.1 * (high - low), max(high, 1.001 * onset), 400)
    return speeds, sweep(branch, speeds), sweep(branch, speeds, down=True)


def say_cycles(branch: Bifurcation, computed: Computed, units: Units) -> None:
    """Show whether the onset is subcritical or supercritical, and how the branch ended."""
    if begins_at_rest(branch, computed):
        _say_direction(branch, units)
    else:
        st.info(
            f"This whirl sets in at {amount(units.speed, branch.hopf.speed)}, where the other "
            "film's whirl grows already: its small cycles are unstable, and no slow change of the "
            "speed leads to them from rest."
        )
    st.caption(f"The branch of limit cycles {branch.ended}.")


def _say_direction(branch: Bifurcation, units: Units) -> None:
    found = branch.hopf
    rate = f"ℓ = {'−' if found.lyapunov < 0.0 else ''}{digits(abs(found.lyapunov))} 1/s"
    error = f"± {digits(float(f'{found.lyapunov_error:.1g}'))}"
    at = f"ε = {found.eccentricity_ratio:.4f}"
    if found.subcritical is None:
        st.info(
            f"Whether the onset is subcritical or supercritical is uncertain at {at}: {rate} "
            f"({error}). The chart shows the limit cycles themselves."
        )
    elif found.subcritical:
        where = ""
        if len(branch.folds):
            fold = amount(units.speed, branch.folds.min())
            share = digits((1.0 - branch.folds.min() / found.speed) * 100.0)
            where = (
                f" Above {fold}, {share} % below the onset, a large enough disturbance makes the "
                "machine whirl permanently; as the speed falls, the whirl persists down to there."
            )
        st.warning(f"Subcritical at {at}: {rate} ({error}).{where}")
    else:
        st.info(f"Supercritical at {at}: {rate} ({error}). {_above_the_onset(branch, units)}")


def _above_the_onset(branch: Bifurcation, units: Units) -> str:
    """Return how a whirl that begins gradually goes on, and where it dies out."""
    onset, lowest = branch.hopf.speed, float(branch.speed.min())
    if lowest >= onset * (1.0 - _SAME_ONSET):
        return (
            "Above the onset a whirl grows gradually with the speed, and it dies out as the speed "
            "falls below the onset."
        )
    begins = (
        "So it is close to the onset only: there a whirl grows gradually with the speed. The "
        "branch then turns back to speeds below the onset, where a large enough disturbance makes "
        "the machine whirl permanently; as the speed falls, the whirl persists down to "
    )
    folds = branch.folds[branch.folds < onset]
    if not len(folds):
        return f"{begins}below {amount(units.speed, lowest)}, the end of the branch."
    share = digits((1.0 - folds.min() / onset) * 100.0)
    return f"{begins}{amount(units.speed, folds.min())}, {share} % below the onset."


def say_held(branch: Bifurcation, computed: Computed, units: Units) -> None:
    """Show on which cycle a machine on a floating ring runs, and where two whirls are at once."""
    if ring.has_ring(computed):
        st.markdown(" ".join(limit_cycles.held(branch, computed.speed, units)))


def ask_onsets(page: Page) -> tuple[Onsets, GrowthCurve] | None:
    """Return the onset found three ways, and growth over speed, or show why there is none."""
    computed, onset = page.computed, page.computed.onset.speed
    if not 0.0 < onset < math.inf:
        st.info(_no_onset(computed))
        return None
    if (film := slow_film(computed)) is not None:
        comes = f"{_THREE.removesuffix('A few seconds …')}About {_SLOW_THREE_TAKE} s."
        about = film.tables or limit_cycles.balanced(computed.machine)
        return on_demand(
            page, Job("Find the onset three ways", "orbits_three", comes), ("three", about),
            lambda _: attempt(lambda: three_onsets(computed)),
        )  # fmt: skip
    place = st.empty()
    place.markdown(_THREE)
    found = attempt(lambda: three_onsets(computed))
    place.empty()
    return found


def three_onsets(computed: Computed) -> tuple[Onsets, GrowthCurve]:
    """Return the onset found three ways, and growth over speed, of a machine that has one."""
    found, curve = _three(limit_cycles.balanced(computed.machine))
    here = fastest_growing(computed).real
    return found, replace(curve, running_speed=computed.speed, running_rate=here)


def with_onset(page: Page) -> Page:
    """Return the page without the cases that have no onset."""
    whirling = (shown for shown in page.cases if 0.0 < shown.computed.onset.speed < math.inf)
    return replace(page, cases=tuple(whirling))


def say_onsets(found: Onsets, units: Units) -> None:
    """Show the three results side by side, and whether they agree."""
    rows = (
        ("Closed form", found.closed_form, r"Eqs. 5.45 to 5.50, $Ω_{on} = Ω_{sf}(ε(Ω_{on}))$"),
        ("Eigenvalues", found.eigenvalues, "max Re λ = 0"),
        ("Measured growth in time", found.measured, "the motion neither grows nor decays"),
    )
    with st.container(key=f"results_{len(rows)}_onsets"):
        for label, speed, how in rows:
            unknown = "no closed form" if label == "Closed form" else "not found"
            reading = f"{float(units.speed.of(speed)):.2f} {units.speed.name}"
            st.metric(label, unknown if math.isnan(speed) else reading)
            st.caption(how)
    if found.agree == "agree":
        st.success(f"They agree to {digits(float(f'{found.spread:.2g}'))} of the onset.")
    elif found.agree == "not measured":
        st.warning(
            "Not measured: between half and twice the onset from the eigenvalues, no change from "
            "decay to growth was found within the time allowed."
        )
    else:
        st.error(f"They disagree by {found.spread:.1%} of the onset.")


def _no_onset(computed: Computed) -> str:
    if computed.onset.speed == 0.0:
        return (
            f"{capital(without_load(computed))}, so this machine whirls at any speed: there is no "
            "onset from which limit cycles could branch off, and none to compare."
        )
    return f"{without_onset(computed)}: no onset was found, and no limit cycles."


def slow_film(computed: Computed) -> FilmMotion | InnerMotion | None:
    """Return the force of a film whose motion a page cannot have at once, else None."""
    try:
        motion = film_of(computed.machine.bearing).motion()
    except ValueError:
        return None
    return motion if motion.revolution > 0.0 else None


def has_motion(bearing: Bearing) -> bool:
    """Return whether a film gives a force in any motion; say why not where it gives none."""
    try:
        film_of(bearing).motion()
    except ValueError as error:
        # Without the field's name in front.
        st.info(
            f"No nonlinear motion can be computed: {f'{error}'.partition(': ')[2]}. The linear "
            "orbits to imbalance are on the page Response."
        )
        return False
    return True


def attempt(work: Callable[[], T]) -> T | None:
    """Return the result of a computation, or show why there is none."""
    try:
        return work()
    except (ValueError, TransientError, BifurcationError) as error:
        st.error(f"{error}", title="This cannot be computed")
        return None
