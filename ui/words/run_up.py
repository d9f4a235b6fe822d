"""What the run-up asks, says before it is computed, and says of what was seen."""

import math
from dataclasses import dataclass

import streamlit as st

from rotorcalc import Bifurcation, Machine, TransientError
from rotorcalc.figures import Units
from rotorcalc.figures.run_up import Marks
from rotorcalc.films import InnerMotion, film_of
from rotorcalc.nonlinear.run_up import RunUp, delay
from rotorcalc.unbalance_response import orbit_ellipse
from ui.choices import choose
from ui.computed import Computed
from ui.format import amount, digits
from ui.frame.page import Page
from ui.jobs import cache, work
from ui.jobs.work import Progress
from ui.words.limit_cycles import balanced
from ui.words.on_demand import Job, attempt, on_demand, slow_film

# Ends of a passage around the onset, over its speed; and the start of one to the top speed, over
# that.
_AROUND, _FROM = (0.9, 1.08), 0.1
_PACES = {"quick": 1600, "slow": 5000, "very slow": 15000}
_SPEEDS = ["around the onset", "to the top speed"]
_BALANCES = ["none", "its own"]
# Seconds of computing a revolution and way, on one core of a laptop; of recesses, and of the parts
# of a film.
_COST, _COST_OF_PARTS = 0.7e-3, 5e-3
# From the noise of the pushes, C/1000, to what counts as whirl, C/10.
_GROWTH = 100.0

_runs = cache.Cached(work.run_up, entries=8, megabytes=24)


@dataclass(frozen=True)
class AskRun:
    """A run-up: the machine, with or without its imbalance, the speeds [rad/s], its length."""

    machine: Machine
    lowest: float
    highest: float
    revolutions: int

    @property
    def time(self) -> float:
        """Duration of the run-up [s]."""
        return 4.0 * math.pi * self.revolutions / (self.lowest + self.highest)

    @property
    def acceleration(self) -> float:
        """Acceleration of the run-up [rad/s²]."""
        return (self.highest - self.lowest) / self.time

    @property
    def is_balanced(self) -> bool:
        """Whether nothing drives a synchronous motion."""
        return self.machine.rotor.imbalance == 0.0


def choose_run(computed: Computed) -> AskRun:
    """Show the choices of a run-up; return the chosen one."""
    onset = computed.onset.speed
    has_onset = 0.0 < onset < math.inf
    with st.container(horizontal=True, gap="medium", key="run_asked"):
        speeds = choose("Speeds", _SPEEDS, "orbits_speeds") if has_onset else _SPEEDS[1]
        pace = choose(
            "Revolutions", list(_PACES), "orbits_pace",
            format_func=lambda pace: f"{_PACES[pace]}, {pace}",
        )  # fmt: skip
        balance = choose("Imbalance", _BALANCES, "orbits_balance")
    if speeds == _SPEEDS[0]:
        lowest, highest = (share * onset for share in _AROUND)
    else:
        lowest, highest = _FROM * computed.top_speed, computed.top_speed
    machine = balanced(computed.machine) if balance == _BALANCES[0] else computed.machine
    return AskRun(machine, lowest, highest, _PACES[pace])


def ask_run(page: Page, asked: AskRun) -> RunUp | None:
    """Return the run-up on request; until then say what comes, and how long it takes."""
    units = page.units
    ends = " to ".join(amount(units.speed, speed) for speed in (asked.lowest, asked.highest))
    rate = amount(units.speed, asked.acceleration)
    seconds = math.ceil(_takes(page.computed, asked))
    job = Job(
        "Run up and down", "orbits_run_up",
        f"The speed rises from {ends} within {digits(asked.time)} s, by {rate} each second, "
        "and falls again as slowly, in as many revolutions. The charts will show the "
        "journal's amplitude over speed both ways, and its spectra. A slower run takes longer to "
        f"compute; this one takes about {seconds}\u00a0s.",
    )  # fmt: skip
    request = (asked.machine, asked.lowest, asked.highest, asked.revolutions)
    return on_demand(
        page, job, ("run-up", *request), lambda tell: attempt(lambda: _run(asked, units, tell))
    )


def _takes(computed: Computed, asked: AskRun) -> float:
    """Return about how many seconds a run-up and its run-down take."""
    ways, film = 2.0 * asked.revolutions, slow_film(computed)
    if film is not None:  # after the tables of a film that needs them
        return ways * film.revolution + film.seconds
    has_parts = isinstance(film_of(computed.machine.bearing).motion(), InnerMotion)
    return ways * (_COST_OF_PARTS if has_parts else _COST)


def _run(asked: AskRun, units: Units, tell: Progress | None) -> RunUp:
    """Return the run-up; where it ends early, say at which speed, and what to do."""
    try:
        return _runs(asked.machine, asked.lowest, asked.highest, asked.revolutions, tell=tell)
    except TransientError as error:
        where = amount(units.speed, float(error.partial.speed[-1]))
        words = f"At {where} {error}. A run-up that ends below this speed can be computed."
        raise TransientError(words, error.partial) from error


def expected(computed: Computed, asked: AskRun) -> float:
    """Return where the growth rate lets whirl show [rad/s]; NaN where there is no onset."""
    onset = computed.onset.speed
    if not 0.0 < onset < math.inf:
        return math.nan
    return delay(asked.machine, onset, asked.acceleration, factor=_GROWTH).speed


def marks(computed: Computed, asked: AskRun) -> Marks:
    """Return the speeds to mark on the charts."""
    onset = computed.onset.speed
    return Marks(
        onset=onset if 0.0 < onset < math.inf else math.nan,
        running_speed=computed.speed,
        expected=expected(computed, asked),
    )


def say_why(computed: Computed, asked: AskRun, units: Units) -> None:
    """Say with this machine's growth rate why whirl shows late."""
    onset = computed.onset.speed
    if not 0.0 < onset < math.inf:
        return
    found = delay(asked.machine, onset, asked.acceleration, factor=_GROWTH)
    if not found.rate > 0.0:
        return
    time = math.log(_GROWTH) / found.rate
    where = "not below twice the onset's speed"
    if math.isfinite(found.speed):
        where = f"at {amount(units.speed, found.speed)}{_beside(found.speed, onset)}"
    st.markdown(
        "**Why whirl shows late:** growth needs time. 1 % above the onset a small whirl grows at "
        f"{digits(found.rate)} 1/s: it takes {digits(time)} s to grow a hundredfold, in which the "
        f"speed rises by {amount(units.speed, time * asked.acceleration)}. From a noise of C/1000 "
        f"it therefore reaches C/10 {where}. A quarter of the acceleration halves the delay."
    )


def say_seen(computed: Computed, asked: AskRun, run: RunUp, units: Units) -> None:
    """Say where whirl began as the speed rose, and where it ended as the speed fell."""
    up, down, onset = run.whirls_from, run.whirls_down_to, computed.onset.speed
    if math.isnan(up):
        st.info(f"No whirl was seen as the speed rose.{_suppressed(computed, asked, units)}")
        return
    words = f"Rising, whirl shows from {amount(units.speed, up)}{_beside(up, onset)}. "
    if down <= run.down.seen.speed[-1]:
        words += "Falling, it lasts down to the lowest speed of this run."
    else:
        words += f"Falling, it lasts down to {amount(units.speed, down)}{_beside(down, onset)}."
    if down < onset < up:
        words += (
            " Between the two speeds the machine is at rest or whirls, whichever it did before."
        )
    st.warning(words)


def _suppressed(computed: Computed, asked: AskRun, units: Units) -> str:
    if asked.is_balanced or not 0.0 < computed.onset.speed < asked.highest:
        return ""
    journal = computed.point.journal_response
    size = amount(units.amplitude, float(orbit_ellipse(journal).semi_major))
    return (
        f" The imbalance drives the journal around an orbit of {size} at the running speed. The "
        "onset is that of a small motion about equilibrium: so large an orbit can suppress whirl."
    )


def _beside(speed: float, onset: float) -> str:
    if not 0.0 < onset < math.inf:
        return ""
    way = "above" if speed > onset else "below"
    return f", {_share(abs(speed / onset - 1.0))} {way} the onset"


def _share(part: float) -> str:
    return f"{100.0 * part:.1f} %"


def caption(branch: Bifurcation | None) -> str:
    """Return the caption of the chart of amplitudes."""
    behind = "" if branch is None else (
        " Behind: the limit cycles, solid where stable, dashed where unstable, without imbalance."
    )  # fmt: skip
    return (
        "Half the larger range of X and Y within eight revolutions. A push of the disk every 20 "
        f"revolutions disturbs it.{behind}"
    )
