"""Texts of the stability page on threshold, film and whirl orbit."""

import math
from collections.abc import Callable
from functools import lru_cache

import numpy as np
import streamlit as st

from rotorcalc import thresholds, whirl_energy
from rotorcalc.analysis import FilmCurves
from rotorcalc.arrays import Array
from rotorcalc.figures import Chart
from rotorcalc.figures.stability import Crossing, Energies, FilmFigure
from rotorcalc.films import film_of
from rotorcalc.machine import Bearing
from rotorcalc.units import Units
from ui.choices import choose
from ui.computed import Computed
from ui.format import amount
from ui.preview import Text
from ui.words.citation import at_one_speed, capital, without_load, without_onset

NO_WHIRL = (
    "This film cannot whirl: whatever its load, it lacks the cross-coupled stiffness that feeds a "
    "whirl. Every rotor is stable on it, so there is no threshold speed to draw."
)
_OWN_NO_WHIRL = (
    "At no speed of the chart do these coefficients feed a whirl, so there is no threshold speed "
    "to draw."
)
SLOWER_WHIRL = (
    "Whatever its load, this film feeds no whirl at running speed, so there is no threshold speed "
    "to draw. Its stiffness and damping depend on the whirl's frequency, and a slower whirl may "
    "still grow: the machine's onset is searched for with all its moving parts."
)
WORK = r"""
\begin{gathered}
\oint \mathbf F\cdot d\mathbf x = \underbrace{(K_{XY}-K_{YX})\,A}_{\text{fed in}}
 - \underbrace{\pi\omega\,\mathbf P^{*}\mathbf C\,\mathbf P}_{\text{dissipated}} \\
\mathbf F=-\mathbf K\mathbf x-\mathbf C\dot{\mathbf x},\quad
\mathbf x=\mathrm{Re}\{\mathbf P e^{j\omega t}\} \\
A=\oint x\,dy=\pi\,\mathrm{Im}(P_X\overline{P}_Y)
\end{gathered}
"""
WORK_WORDS = (
    "The symmetric part of K does no work over a closed orbit. Only $K_{XY}-K_{YX}$ does: it acts "
    "along the motion, a force that follows the whirl, and its work is proportional to the orbit's "
    "area."
)
# Fig. 5.10's static sags over clearance, beside this machine's own.
_SAGS = (0.0, 0.3, 1.0, 3.0, 10.0)
# A share of the other energy below which one is but rounding.
_NO_ENERGY = 1e-9


def crossing(computed: Computed) -> Crossing:
    """Return the onset and whether the closed forms give it."""
    return Crossing(onset=computed.onset, closed_form=not _neglected(computed))


def over_speed(draw: Callable[..., Chart], computed: Computed, units: Units) -> Chart:
    """Return a chart of thresholds over speed."""
    over, here = (thresholds.at_each_speed(one) for one in (computed.sweep, computed.point))
    return draw(over, here, crossing(computed), units)


def _neglected(computed: Computed) -> list[str]:
    """Return what this machine has and Eqs. 5.45 to 5.50 neglect."""
    machine = computed.machine
    rotor = machine.rotor
    found = {
        "midspan damping": rotor.disk_damping > 0.0,
        "journal mass": rotor.journal_mass > 0.0 and not rotor.is_rigid,
        "that the film's coefficients change with the whirl's frequency": film_of(
            machine.bearing
        ).frequency_dependent,
    }
    return [words for words, has in found.items() if has]


def film_figure(computed: Computed, over_eccentricity: bool = False) -> FilmFigure:
    """Return the common data of the notes' figures."""
    bearing = computed.machine.bearing
    here = None if computed.unloaded else computed.curves_here
    return FilmFigure(
        computed.curves, _film_limit(computed.curves, bearing), here, over_eccentricity
    )


def ends_of_whirl(computed: Computed) -> str:
    """Return in words above which eccentricity the bearing's film feeds no whirl."""
    if film_of(computed.machine.bearing).frequency_dependent:
        return "Coefficients at the running frequency; at a whirl's own they differ."
    limit = film_figure(computed).limit
    ratio = float(computed.curves.onset.whirl_ratio[-1])
    share = "half" if abs(ratio - 0.5) < 1e-3 else f"{ratio:.3g} of"
    light = f"A lightly loaded film whirls at {share} the speed"
    light = light if ratio > 0.0 else "A lightly loaded film does not whirl"
    if limit is None:
        return f"{light}. {at_one_speed(computed)}".strip()
    return f"{light}; above ε = {float(limit.film.eccentricity_ratio):.4f} it cannot whirl."


def lowest_threshold(computed: Computed) -> str:
    """Return in words at which eccentricity the bearing's threshold speed is lowest."""
    if film_of(computed.machine.bearing).frequency_dependent:
        return ""
    eps = thresholds.lowest_threshold(computed.machine.bearing)
    return "" if math.isnan(eps) else f", lowest at ε = {eps:.3f}"


def bare(computed: Computed) -> Text | None:
    """Return that the closed forms drawn do not give the onset, where they do not."""
    if not (neglected := _neglected(computed)):
        return None
    marked = 0.0 < computed.onset.speed <= computed.top_speed
    return Text(
        f"The closed forms, drawn dashed, neglect {' and '.join(neglected)}, so they do not give "
        f"this machine's onset.{' The vertical line marks it.' if marked else ''}",
        "info",
    )


def meets(computed: Computed) -> str:
    """Return what the threshold's meeting with the line Ω tells, with its equations."""
    return f"{meeting(computed)} Eqs. 5.45, 5.46, 5.50."


def meeting(computed: Computed) -> str:
    """Return what the threshold's meeting with the line Ω tells."""
    return (
        "With all that the closed forms neglect left out, the rotor would become unstable where "
        "the threshold meets the line Ω."
        if _neglected(computed)
        else "Where the threshold meets the line Ω the rotor becomes unstable."
    )


def no_whirl(computed: Computed) -> str:
    """Return why there is no threshold speed to draw."""
    if computed.has_own:
        return _OWN_NO_WHIRL
    film = film_of(computed.machine.bearing)
    return SLOWER_WHIRL if film.can_whirl and film.frequency_dependent else NO_WHIRL


def can_whirl(computed: Computed) -> bool:
    """Return whether any load lets the film feed a whirl; say so if none does."""
    if not whirls(computed):
        st.info(no_whirl(computed))
        return False
    return True


def whirls(computed: Computed) -> bool:
    """Return whether any load lets the film feed a whirl."""
    film = film_of(computed.machine.bearing)
    if computed.has_own:
        return bool(np.any(computed.sweep.whirl_ratio > 0.0))
    return film.can_whirl and bool(np.any(computed.curves.onset.whirl_ratio > 0.0))


def sags(computed: Computed) -> tuple[float, ...]:
    """Return the static sags over clearance of Fig. 5.10, this machine's last."""
    return (*_SAGS, computed.machine.static_sag / computed.machine.bearing.radial_clearance)


def flexible_curves(computed: Computed) -> Array:
    """Return p_sf for each of the sags over the film's curves."""
    return thresholds.flexible_curves(computed.curves, sags(computed))


def flexible_here(computed: Computed) -> float:
    """Return this machine's p_sf at the running speed."""
    here = film_figure(computed).here
    return (
        math.nan if here is None else thresholds.flexible_curves(here, sags(computed)[-1:]).item()
    )


def energies(computed: Computed) -> Energies:
    """Return the energy of the whirl orbit over speed; the machine has an onset."""
    machine, onset = computed.machine, computed.onset
    orbit = whirl_energy.whirl_orbit(machine, onset)
    met = whirl_energy.whirl_energy(machine, onset.speed, orbit) if onset.speed > 0.0 else None
    return Energies(
        over=whirl_energy.whirl_energy(machine, computed.sweep.speed, orbit),
        here=whirl_energy.whirl_energy(machine, computed.speed, orbit),
        at_onset=met,
    )


def has_orbit(computed: Computed) -> bool:
    """Return whether the machine has an onset and so a whirl orbit; show a note if it has none."""
    if math.isinf(computed.onset.speed):
        st.info(f"{without_onset(computed)}, so there is no whirl orbit.")
        return False
    return True


def balance(computed: Computed, units: Units) -> str:
    """Return a text on the energy balance at the running speed."""
    here, running = energies(computed).here, amount(units.speed, computed.speed)
    if computed.onset.speed == 0.0:
        return (
            f"{capital(without_load(computed))}: the onset lies at zero speed, where the whirl is "
            f"infinitely slow and damping dissipates nothing. At {running}, as at any speed, the "
            "orbit grows."
        )
    lost, fed = float(here.film_loss + here.disk_loss), float(here.fed_in)
    whirl = amount(units.speed, computed.onset.whirl_frequency)
    level = "stable" if computed.is_stable else "unstable"
    # The orbit is kept as at the onset: far from there the machine's own is another.
    outcome = (
        f": the whirl {'decays' if lost > fed else 'grows'}."
        if (lost > fed) == computed.is_stable
        else f". That holds on this orbit, that of the onset; on its own the machine is {level}."
    )
    return (
        f"At its onset this machine whirls at {whirl}. On that orbit, but at a running "
        f"speed of {running}, {_balanced(lost, fed)}{outcome}"
    )


def _balanced(lost: float, fed: float) -> str:
    """Return how what damping dissipates compares with what cross-coupling feeds in."""
    if fed <= _NO_ENERGY * abs(lost):
        return (
            f"cross-coupling feeds nothing in, and damping {'brakes' if lost > 0 else 'drives'} it"
        )
    if lost < 0.0:
        return "cross-coupling and damping both feed it"
    return f"damping dissipates **{lost / fed:.3g} times** what cross-coupling feeds in"


def energies_over_speed(computed: Computed) -> str:
    """Return the caption of the energies over speed, which says no more than the chart shows."""
    over = energies(computed).over
    past, lost = computed.sweep.speed > computed.onset.speed, over.film_loss + over.disk_loss
    if np.all((over.fed_in > np.maximum(lost, _NO_ENERGY * np.abs(lost)))[past]):
        return (
            "The follower force grows with speed, the damping does not: past the onset more is fed "
            "in than dissipated, and the orbit grows."
        )
    return (
        "On the orbit of the onset, where the two meet. Farther off the machine whirls on another "
        "orbit, so this balance does not tell there whether the whirl grows."
    )


def _film_limit(curves: FilmCurves, bearing: Bearing) -> FilmCurves | None:
    """Return the film at which whirl ends, None where heavy loads whirl too, or none does."""
    film = film_of(bearing)
    if film.frequency_dependent or film.curve is None:
        # Not that of the coefficients at the running frequency, or not one for all speeds.
        return None
    whirls = curves.onset.whirl_ratio > 0.0
    return None if whirls[0] or not whirls.any() else _end_of_whirl(bearing)


@lru_cache(maxsize=16)
def _end_of_whirl(bearing: Bearing) -> FilmCurves:
    return thresholds.film_limit(bearing)


def choose_abscissa() -> bool:
    """Show the choice of the notes' figures' abscissa; return whether it is the eccentricity."""
    return choose("Over", ["σ", "ε"], "stability_over") == "ε"
