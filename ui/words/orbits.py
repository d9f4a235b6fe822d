"""What the orbits page asks of the core: releases, run-ups, limit cycles, and words for them."""

import hashlib
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal, TypeVar

import numpy as np
import streamlit as st

from rotorcalc import Bifurcation, BifurcationError, Machine, Onsets, TransientError, bifurcation
from rotorcalc.arrays import Array
from rotorcalc.figures import Units
from rotorcalc.nonlinear import run_up
from rotorcalc.nonlinear.limit_cycles import sweep
from rotorcalc.nonlinear.measured_onset import GrowthCurve
from rotorcalc.nonlinear.release import Release, affordable_revolutions
from rotorcalc.nonlinear.run_up import RunUp
from ui.computed import Computed, computed_from
from ui.format import amount, digits
from ui.frame.page import Page
from ui.inputs import INPUTS, PRESET_VALUES
from ui.jobs import cache, queue, work
from ui.jobs.work import Progress
from ui.results.stability import leading
from ui.session import session

T = TypeVar("T")

_KICK, _REVOLUTIONS = "orbits_kick", "orbits_revolutions"
# Sizes, in clearances, below which a journal is at rest, and from which a circle is a whirl.
_AT_REST, _WHIRLS = 2e-3, 0.02
# Between these ratios of late to early size a motion neither dies nor grows.
_STAYS = (0.8, 1.25)
# A rigid rotor just below a subcritical onset: ε = 0.06, p² one per cent below critical.
_SUBCRITICAL = PRESET_VALUES["sheet-1e8"] | {
    "mass": 660.0, "load": 948.0, "k": math.inf, "u": 0.0, "rpm": 5730.0, "rpm_max": 8000.0,
}  # fmt: skip

Demo = Literal["below", "above", "small", "big"]
_DEMOS: dict[Demo, tuple[str, float, int]] = {
    "below": ("5 % below onset", 0.30, 60),
    "above": ("5 % above onset", 0.05, 160),
    "small": ("Subcritical: small kick", 0.01, 400),
    "big": ("Subcritical: big kick", 0.25, 400),
}
_ABOUT_DEMOS = (
    "The first two take this machine without its imbalance, which can hold a whirl down. The last "
    "two take a rigid rotor 0.5 % below its onset, at ε = 0.06, where the linear theory promises "
    "that every whirl dies."
)


@dataclass(frozen=True)
class Ask:
    """How the journal is let go: how far off its rest, in clearances, and for how long."""

    kick: float
    revolutions: int


# Half a megabyte each, at most four.
_release = cache.Cached(work.release, entries=32, megabytes=24, turns=queue.SHORT)
_long_release = cache.Cached(work.release, entries=16, megabytes=40)
_run_up = cache.Cached(work.run_up, entries=8, megabytes=16)
_cycles = cache.Cached(bifurcation, entries=16, megabytes=16)
_three = cache.Cached(work.three_onsets, entries=16, megabytes=4)

# --- How the journal is let go ----------------------------------------------------------------


def choose_release(computed: Computed) -> Ask:
    """Show the demonstrations, kick and length; return what is asked for."""
    visitor = session()
    with st.container(horizontal=True, gap="small"):
        for demo, (label, _, _) in _DEMOS.items():
            st.button(
                label, key=f"orbits_{demo}", help=_ABOUT_DEMOS, on_click=_set_up, args=(demo,),
                disabled=not _can_set_up(demo, computed),
            )  # fmt: skip
    left, right = st.columns(2)
    with left:
        kick = st.slider(
            "Journal let go above its rest by, over C [-]", 0.0, 1.2,
            visitor.choice(_KICK, 0.30, 0.0, 1.2), 0.01, key=_KICK, persist_state="session",
            help="Against the load, at rest, the shaft with its sag.",
        )  # fmt: skip
    with right:
        turns = st.slider(
            "Revolutions [-]", 20, 600, visitor.choice(_REVOLUTIONS, 40, 20, 600), 20,
            key=_REVOLUTIONS, persist_state="session",
        )  # fmt: skip
    return Ask(kick, turns)


def _can_set_up(demo: Demo, computed: Computed) -> bool:
    return demo in ("small", "big") or not INPUTS["rpm"].problem(_demo_rpm(demo, computed))


def _demo_rpm(demo: Demo, computed: Computed) -> float:
    rpm = computed.onset.speed * (0.95 if demo == "below" else 1.05) * 30.0 / math.pi
    return round(rpm, 1) if math.isfinite(rpm) else rpm


def _set_up(demo: Demo) -> None:
    visitor = session()
    if demo in ("small", "big"):
        visitor.set_preset("sheet-1e8")
        visitor.values |= _SUBCRITICAL
    else:
        rpm = _demo_rpm(demo, computed_from(visitor.values))
        visitor.set_value("u", 0.0)
        visitor.set_value("rpm", rpm)
    _, st.session_state[_KICK], st.session_state[_REVOLUTIONS] = _DEMOS[demo]


def let_go(computed: Computed, ask: Ask, tell: Progress | None = None) -> Release:
    """Return the release of a machine's journal."""
    ask = _affordable(computed, ask)
    release = _long_release if ask.revolutions >= work.LONG else _release
    return release(computed.machine, computed.speed, ask.kick, ask.revolutions, tell=tell)


def _affordable(computed: Computed, ask: Ask) -> Ask:
    """Return what is asked for, shorter where the machine swings many times in a revolution."""
    most = affordable_revolutions(computed.point)
    return ask if ask.revolutions <= most else replace(ask, revolutions=most)


def try_out(page: Page, ask: Ask) -> tuple[Page, Release]:
    """Return the release, and the page without a pinned machine that allows none.

    Say in words why there is none, and stop, where there is none.
    """
    ask = _affordable(page.computed, ask)
    bar = st.progress(0.0, "Integrating …") if ask.revolutions >= work.LONG else None
    try:
        found = let_go(page.computed, ask, None if bar is None else bar.progress)
    except (ValueError, TransientError) as error:
        st.error(f"{error}", title="This release cannot be computed")
        st.stop()
    finally:
        if bar is not None:
            bar.empty()
    if page.baseline is not None:
        try:
            let_go(page.baseline, ask)
        except (ValueError, TransientError):
            return replace(page, baseline=None), found
    return page, found


# --- What became of it ------------------------------------------------------------------------


def say_outcome(computed: Computed, asked: Ask, found: Release, units: Units) -> None:
    """Say in one sentence what the journal did, and in another what the linear theory said."""
    followed = round(float(found.revolutions[-1]))
    if followed < asked.revolutions and not found.stopped:
        st.info(
            f"This machine swings so often in a revolution that only {followed} of them are "
            "followed."
        )
    if found.stopped:
        st.warning(f"The integration ended early: {found.stopped}.")
    whirls = _is_whirling(found)
    show = st.warning if whirls else st.success
    show(f"{_outcome(found, units)} {_theory(computed, found)}")


def _is_whirling(found: Release) -> bool:
    seen, C = found.spectrum, found.clearance
    return seen.whirl > max(_WHIRLS * C, 0.5 * seen.synchronous) and _trend(found) > _STAYS[0]


def _trend(found: Release) -> float:
    """Return the size of the motion in its last quarter over that in its second."""
    n = found.settled
    earlier = float(found.size[n : 2 * n].max())
    return found.last_size / earlier if earlier > 0.0 else 1.0


def _outcome(found: Release, units: Units) -> str:
    C, seen, turns = found.clearance, found.spectrum, f"{found.revolutions[-1]:.0f} revolutions"
    size = f"{found.last_size / C:.3g} C from rest"
    thin = f"its film gets as thin as {amount(units.film, found.film.min())}"
    if _is_whirling(found):
        grows = " and growing" if _trend(found) > _STAYS[1] else ""
        return (
            f"After {turns} the journal whirls at {seen.whirl_ratio:.3f} of the running speed, up "
            f"to {size}{grows}; {thin}."
        )
    if found.last_size < _AT_REST * C:
        return f"Within {turns} the journal comes to rest."
    if seen.synchronous > 0.5 * found.last_size:
        return f"After {turns} the journal follows the imbalance, up to {size}; {thin}."
    low, high = _STAYS
    way = "dying" if _trend(found) < low else "growing" if _trend(found) > high else "going on"
    return f"After {turns} the motion is still {way}, up to {size}; {thin}."


def _theory(computed: Computed, found: Release) -> str:
    rate = digits(abs(found.whirl.real))
    if math.isnan(found.whirl.real):
        return "The linear theory knows no whirl here."
    if not computed.is_stable:
        said = f"The linear theory: unstable, a small whirl grows at {rate} 1/s"
        if not _is_whirling(found) and found.spectrum.synchronous > 0.0:
            return f"{said}. It takes whirl and imbalance apart; together, this holds that down."
        return f"{said}."
    said = f"The linear theory: stable, a small whirl dies at {rate} 1/s"
    if _is_whirling(found) and found.last_size > found.first_size:
        return f"{said}. This kick was too large for it."
    return f"{said}."


def show_measured(computed: Computed, found: Release, units: Units) -> None:
    """Show what the spectrum says beside what the linear theory says."""
    seen, C = found.spectrum, found.clearance
    ratio = "no whirl" if math.isnan(seen.whirl_ratio) else f"{seen.whirl_ratio:.4f}"
    predicted = found.whirl.imag / computed.speed
    rows = [
        ("Whirl ratio, measured", ratio),
        ("Whirl ratio, linear", "none" if math.isnan(predicted) else f"{predicted:.4f}"),
        ("Whirl's circle", amount(units.film, seen.whirl)),
        ("1× circle", amount(units.film, seen.synchronous)),
        ("Ends within", f"{found.last_size / C:.3g} C of rest"),
    ]
    with st.container(horizontal=True):
        for label, value in rows:
            st.metric(label, value)


# --- Long work: on demand, with progress and a way out ----------------------------------------


def on_demand(
    page: Page, label: str, key: str, token: object, work: Callable[[Progress | None], T]
) -> T | None:
    """Return what work gives once a visitor asks for it; until then show a button.

    `token` names what the work is about: when it changes, the visitor is asked again. While it
    runs, a bar shows how far it is, and a button ends it: its click makes the page run anew, and
    the next word of progress ends the old run.
    """
    visitor, done, place = session(), f"{key}_done", st.empty()
    name = hashlib.sha256(repr(token).encode()).hexdigest()
    if visitor.asked.get(key) != name:
        place.button(label, key=key, on_click=visitor.ask_for, args=(key, name))
        return None
    if st.session_state.get(done) == name:
        return work(None)
    page.run_whole()
    with place.container():
        if key in visitor.begun:
            st.info("This computation was interrupted, and has begun again.")
        bar = st.progress(0.0, "Computing …")
        st.button("Cancel", key=f"{key}_cancel", on_click=visitor.ask_no_more, args=(key,))
    visitor.begun.add(key)
    result = work(bar.progress)
    place.empty()
    visitor.begun.remove(key)
    st.session_state[done] = name
    return result


def ask_run_up(page: Page) -> RunUp | None:
    """Return the run-up's spectra once asked for."""
    computed = page.computed
    token = ("run-up", computed.machine, computed.top_speed)
    found = on_demand(
        page, "Run up to the top speed", "orbits_run_up", token,
        lambda tell: _try(lambda: _run_up(computed.machine, computed.top_speed, tell=tell)),
    )  # fmt: skip
    if found is None:
        return None
    return replace(found, onset=computed.onset.speed, running_speed=computed.speed)


def run_up_caption(computed: Computed) -> str:
    """Return what the waterfall shows."""
    stirred = computed.machine.rotor.imbalance == 0.0
    return (
        f"{run_up.REVOLUTIONS} revolutions from {run_up.FROM:g} times the top speed to "
        "the top speed, the journal's forward circles; dashed: Im λ/Ω of the least damped whirl."
        + (" An imbalance of C/1000 stirs the balanced rotor." if stirred else "")
    )


def ask_cycles(page: Page) -> Bifurcation | None:
    """Return the limit cycles once asked for; say in words why there are none."""
    computed, onset = page.computed, page.computed.onset.speed
    if not 0.0 < onset < math.inf:
        st.info(_no_onset(onset))
        return None
    return on_demand(
        page, "Follow the limit cycles", "orbits_cycles", ("cycles", _balanced(computed.machine)),
        lambda tell: _try(lambda: _cycles(_balanced(computed.machine), tell=tell)),
    )  # fmt: skip


def swept(branch: Bifurcation) -> tuple[Array, Array, Array]:
    """Return speeds, and the amplitudes of creeping up and down through them."""
    onset = branch.hopf.speed
    low, high = min(float(branch.speed.min()), 0.97 * onset), float(branch.speed.max())
    speeds = np.linspace(low - 0.1 * (high - low), max(high, 1.001 * onset), 400)
    return speeds, sweep(branch, speeds), sweep(branch, speeds, down=True)


def say_cycles(branch: Bifurcation, units: Units) -> None:
    """Say which way the whirl sets in."""
    found = branch.hopf
    rate = f"ℓ = {'−' if found.lyapunov < 0.0 else ''}{digits(abs(found.lyapunov))} 1/s"
    error = f"± {found.lyapunov_error:.1g}"
    at = f"ε = {found.eccentricity_ratio:.4f}"
    if found.subcritical is None:
        st.info(
            f"Subcritical or supercritical is not certain at {at}: {rate} ({error}). "
            "The chart shows the cycles themselves."
        )
    elif found.subcritical:
        where = ""
        if len(branch.folds):
            fold = amount(units.speed, branch.folds.min())
            share = digits((1.0 - branch.folds.min() / found.speed) * 100.0)
            where = (
                f" From {fold}, {share} % below the onset, a large enough kick "
                "makes the machine whirl for good, and creeping down it whirls as far."
            )
        st.warning(f"Subcritical at {at}: {rate} ({error}).{where}")
    else:
        st.info(
            f"Supercritical at {at}: {rate} ({error}). Above the onset a small whirl grows gently "
            "with speed and goes with it."
        )
    st.caption(f"The branch of limit cycles {branch.ended}.")


# --- Three ways to the onset ------------------------------------------------------------------


def ask_onsets(computed: Computed) -> tuple[Onsets, GrowthCurve] | None:
    """Return the onset found three ways, and growth over speed; say why where there is none."""
    onset = computed.onset.speed
    if not 0.0 < onset < math.inf:
        st.info(_no_onset(onset))
        return None
    return _try(lambda: three_onsets(computed))


def three_onsets(computed: Computed) -> tuple[Onsets, GrowthCurve]:
    """Return the onset found three ways, and growth over speed, of a machine that has one."""
    found, curve = _three(_balanced(computed.machine))
    here = leading(computed).real
    return found, replace(curve, running_speed=computed.speed, running_rate=here)


def with_onset(page: Page) -> Page:
    """Return the page without a pinned machine that has no onset."""
    pinned = page.baseline
    return page if pinned is None or 0.0 < pinned.onset.speed < math.inf else page.alone()


def say_onsets(found: Onsets, units: Units) -> None:
    """Show the three answers side by side, and say whether they agree."""
    rows = (
        ("Closed form", found.closed_form, "Eqs. 5.45 to 5.50, Ω = Ωₛ(ε(Ω))"),
        ("Eigenvalues", found.eigenvalues, "max Re λ = 0"),
        ("Measured growth in time", found.measured, "the nonlinear motion neither grows nor dies"),
    )
    with st.container(key="results_onsets"):
        for label, speed, how in rows:
            unknown = "no closed form" if label == "Closed form" else "not found"
            reading = f"{float(units.speed.of(speed)):.2f} {units.speed.name}"
            st.metric(label, unknown if math.isnan(speed) else reading)
            st.caption(how)
    if found.agree == "agree":
        st.success(f"They agree: the largest difference is {found.spread:.1e} of the onset.")
    elif found.agree == "not measured":
        st.warning(
            "Not measured: from half to twice the speed that the eigenvalues give, no change from "
            "decay to growth could be watched in the time allowed."
        )
    else:
        st.error(f"They disagree by {found.spread:.1%} of the onset.")


def _balanced(machine: Machine) -> Machine:
    return replace(machine, rotor=replace(machine.rotor, imbalance=0.0))


def _no_onset(onset: float) -> str:
    if onset == 0.0:
        return (
            "Without load this machine whirls at any speed (Eq. 5.37): there is no onset at which "
            "a limit cycle could be born, and none to compare."
        )
    return "No speed makes this machine whirl: it has no onset, and no limit cycles are born."


def _try(work: Callable[[], T]) -> T | None:
    """Return what work gives, or say in words why it gives nothing."""
    try:
        return work()
    except (ValueError, TransientError, BifurcationError) as error:
        st.error(f"{error}", title="This cannot be computed")
        return None
