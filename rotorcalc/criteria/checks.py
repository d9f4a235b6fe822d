"""A machine against what standards ask: every criterion with its value, limit, source and verdict.

Separation margins as in `amplification`, stability as in `level_one`, imbalance as in `unbalance`.
Two more come from the response to imbalance:

- at the probes beside the bearings the vibration, peak to peak, is at most A_1, in micrometres
  25.4 √(12000/N) with the maximum continuous speed N in rpm, and at most a mil, which standards
  round to 25 µm;
- scaled by S_cc = A_1/A, A its vibration at the speeds of operation, taken between 0.5 and 6, the
  response stays below 75 % of the diametral clearance at every speed up to the maximum. The
  clearance is the assembled bearing's, as this rotor has no seals.

An orbit's size is its major axis, which no probe exceeds.

Source: API 617 (7th edition, 2002). For A_1: inspection-for-industry.com, "Centrifugal compressor
vibration". For A_1 and S_cc: API 684, SP6.8.2.11, as Petrobras' open program ROSS cites and
computes them (`ross/API_Report/Report.py`). For the 75 %: API 617, 8th edition, 6.8.2.6, as cited
in the public program `lateral-criteria.js`.
"""

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import mil

from rotorcalc import heat
from rotorcalc.analysis import analyse
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, checked_speed, shown
from rotorcalc.criteria.amplification import DAMPED, Amplification, amplification
from rotorcalc.criteria.level_one import LEAST_DECREMENT, LEAST_RATIO, LevelOne, level_one
from rotorcalc.criteria.unbalance import API_RESIDUAL, GRADES, permissible_eccentricity
from rotorcalc.machine import Machine
from rotorcalc.numerics.first_answer import from_first_answer
from rotorcalc.onset import judge
from rotorcalc.records import Choice
from rotorcalc.unbalance_peaks import both_peaks
from rotorcalc.unbalance_response import orbit_sizes
from rotorcalc.units import rpm

# Largest share of the diametral clearance, and the range of the factor that scales the response.
CLEARANCE_SHARE = 0.75
_LEAST_SCALE, _LARGEST_SCALE = 0.5, 6.0
# Speeds of operation at which the response is computed, and lowest speed over the highest.
_SPEEDS, _SLOWEST = 200, 0.02
_MARGIN = "API 617 (7th ed., 2002); API 684, SP6.8.2.10"
_LEVEL_ONE = "API 617 (7th ed., 2002), level I; API 684, SP6.8.5.10"
_VIBRATION = "API 617 (7th ed., 2002); API 684, SP6.8.2.11"
_CLEARANCE = "API 617 (8th ed., 2014), 6.8.2.6, as cited"
_RESIDUAL = "API 617, API 610: 4W/N"


@dataclass(frozen=True, kw_only=True)
class Criterion:
    """One demand of a standard on a machine.

    Attributes
    ----------
    name : str
        What is judged, in words.
    value, limit : float
        In SI units; NaN where there is none.
    kind : str
        The kind of quantity: the name of its unit in `rotorcalc.units.Units`.
    source : str
        Standard, edition and paragraph.
    at_most : bool
        Whether the value must not exceed the limit, or must reach it.
    unjudged : str
        Why the criterion cannot be judged, a sentence; empty where it can.
    remark : str
        What else its reader must know, a sentence, or empty.
    speed : float or None
        The critical speed that is judged [rad/s]; None for the others.
    """

    name: str
    value: float
    limit: float
    kind: str
    source: str
    at_most: bool = False
    unjudged: str = ""
    remark: str = ""
    speed: float | None = None

    @property
    def passed(self) -> bool | None:
        """The verdict; None where the criterion cannot be judged."""
        if self.unjudged:
            return None
        return bool(self.value <= self.limit if self.at_most else self.value >= self.limit)


@checked
def vibration_limit(speed: ArrayLike) -> Array:
    """Return the vibration that API 617 admits at the probes, A_1.

    Parameters
    ----------
    speed : array_like, (...)
        Maximum continuous speed [rad/s].

    Returns
    -------
    array, (...)
        Peak to peak [m].

    Examples
    --------
    >>> print(f"{vibration_limit(18000 * rpm) / mil:.2f}")
    0.82
    """
    return mil * np.sqrt(np.minimum(12000.0 * rpm / checked_speed(speed), 1.0))


@checked
def checks(
    machine: Machine,
    speed: float,
    *,
    minimum_speed: float | None = None,
    cross_coupling: float | None = None,
    grade: Annotated[str, Choice(tuple(GRADES))] = API_RESIDUAL,
) -> tuple[Criterion, ...]:
    """Return the criteria of standards for a machine, each with its verdict.

    Parameters
    ----------
    machine : Machine
        The machine with the imbalance that its response is to be judged by.
    speed : float
        Maximum continuous speed [rad/s].
    minimum_speed : float or None
        Lowest speed of operation [rad/s]; None for operation at one speed.
    cross_coupling : float or None
        Anticipated cross-coupled stiffness of the whole machine, Q_A [N/m]
        (`anticipated_cross_coupling`); None where it is not known.
    grade : str
        The grade that the imbalance has to meet, as in `permissible_eccentricity`.

    Returns
    -------
    tuple of Criterion
        Separation margins, stability, vibration, clearance and imbalance.

    Raises
    ------
    ValueError
        Where a speed is not positive and finite, the minimum speed is above the maximum, or Q_A is
        negative or not finite.
    """
    top = float(checked_speed(speed))
    low = top if minimum_speed is None else minimum_speed
    if cross_coupling is not None and not 0.0 <= cross_coupling < math.inf:
        raise ValueError(f"cross_coupling = {shown(cross_coupling)} N/m: must be zero or more")
    found = amplification(machine, minimum_speed=low, maximum_speed=top)
    return (
        *_margins(found),
        *_stability(machine, top, cross_coupling),
        *_response(machine, low, top),
        _imbalance(machine, top, grade),
    )


def _margins(found: Amplification) -> list[Criterion]:
    """Return the separation margin of each critical speed."""
    name, nothing = "Separation margin", "The response has no peak at the speeds searched."
    rows = [
        Criterion(
            name=name, value=margin, limit=required, kind="percent", source=_MARGIN,
            remark=_of_peak(AF, stable=stable), speed=speed,
        )
        for speed, AF, margin, required, stable in zip(
            found.critical_speed.tolist(),
            found.amplification_factor.tolist(),
            found.separation_margin.tolist(),
            found.required_margin.tolist(),
            found.stable.tolist(),
            strict=True,
        )
    ]  # fmt: skip
    return rows or [
        Criterion(
            name=name, value=math.nan, limit=math.nan, kind="percent", source=_MARGIN,
            unjudged=nothing,
        )
    ]  # fmt: skip


def _of_peak(factor: float, *, stable: bool) -> str:
    """Return the remark on a critical speed."""
    words = f"Amplification factor {factor:.3g}"
    words += f", below {DAMPED:g}: no margin is required." if factor < DAMPED else "."
    return words if stable else f"{words} The machine is unstable at this speed."


def _stability(machine: Machine, speed: float, anticipated: float | None) -> list[Criterion]:
    """Return the log decrement at Q_A, or at zero, and Q_0/Q_A."""
    found = level_one(machine, speed, anticipated or 0.0)
    forward, backward = float(found.forward_decrement), float(found.backward_decrement)
    Q_0 = found.zero_decrement
    unknown = {
        None: "No anticipated cross-coupling was given.",
        0.0: "The anticipated cross-coupling is zero.",
    }.get(anticipated, "")
    never = "No Q makes the machine unstable." if math.isinf(Q_0) else ""
    return [
        Criterion(
            name="Log decrement of the first forward mode "
            + ("at Q_A" if anticipated else "without cross-coupling"),
            # A machine that is unstable by itself never meets it, whichever way it whirls.
            value=min(forward, backward) if backward < 0.0 else forward,
            limit=LEAST_DECREMENT, kind="number", source=_LEVEL_ONE,
            remark=_of_modes(found) or unknown,
        ),
        Criterion(
            name="Q_0/Q_A", value=Q_0 / anticipated if anticipated else math.nan,
            limit=LEAST_RATIO, kind="number", source=_LEVEL_ONE, unjudged=unknown, remark=never,
        ),
    ]  # fmt: skip


def _of_modes(found: LevelOne) -> str:
    """Return the remark on the modes other than the first forward one."""
    backward = float(found.backward_decrement)
    if backward == -math.inf:
        return "The machine is unstable: a mode grows without oscillating."
    if backward < min(found.forward_decrement, 0.0):
        return "The machine is unstable: a backward mode grows, of which the value is."
    if found.whirl_frequency == 0.0:
        return "No forward mode oscillates."
    if backward < found.forward_decrement:
        below = f", below {LEAST_DECREMENT:g}" if backward < LEAST_DECREMENT else ""
        return f"A backward mode is damped less: δ = {backward:.3g}{below}."
    return ""


def _response(machine: Machine, low: float, top: float) -> list[Criterion]:
    """Return the vibration at the probes and the clearance check."""
    limit, clearance = float(vibration_limit(top)), 2.0 * machine.bearing.assembled_clearance
    unjudged = _no_response(machine, top)
    unknown = "" if clearance > 0.0 else "Of own coefficients the clearance is not known."
    vibration = share = math.nan
    remark = ""
    if not unjudged:
        vibration = 2.0 * _largest(machine, low, top)
        scale = min(max(limit / vibration, _LEAST_SCALE), _LARGEST_SCALE)
        share = scale * 2.0 * _largest(machine, 0.0, top) / clearance
        remark = "" if unknown else f"The response is scaled by {scale:.3g}."
    return [
        Criterion(
            name="Vibration at the bearings, peak to peak", value=vibration, limit=limit,
            at_most=True, kind="film", source=_VIBRATION, unjudged=unjudged,
        ),
        Criterion(
            name="Scaled response over the diametral clearance", value=share,
            limit=CLEARANCE_SHARE, at_most=True, kind="percent", source=_CLEARANCE,
            unjudged=unjudged or unknown, remark=remark,
        ),
    ]  # fmt: skip


def _no_response(machine: Machine, top: float) -> str:
    """Return why a machine has no response to judge, or nothing."""
    if machine.rotor.imbalance == 0.0:
        return "The rotor has no imbalance."
    if bool(judge.is_unstable(machine, top)):
        return "The machine is unstable at its maximum speed: no response is steady."
    return ""


def _largest(machine: Machine, low: float, top: float) -> float:
    """Return the largest semi-major axis of the journal's orbit at speeds from low to top [m]."""
    if low == top:
        at = analyse(machine, top)
        return float(orbit_sizes(at.disk_response, at.journal_response)[1])
    speeds = np.linspace(max(low, _SLOWEST * top), top, _SPEEDS)
    carried = speeds[heat.has_film(machine, speeds)]
    sweep = from_first_answer(lambda speed: analyse(machine, speed), carried)
    size = orbit_sizes(sweep.disk_response, sweep.journal_response)[1]
    _, peaks = both_peaks(sweep)
    return float(max([*size, *peaks.amplitude]))


def _imbalance(machine: Machine, speed: float, grade: str) -> Criterion:
    """Return the mass centre's distance from the axis against a grade."""
    rotor = machine.rotor
    e = rotor.imbalance * rotor.disk_mass / rotor.half_mass
    limit = float(permissible_eccentricity(grade, speed=speed))
    # A rotor set to the limit meets it, whatever rounding says.
    e = limit if math.isclose(e, limit, rel_tol=1e-9) else e
    return Criterion(
        name="Distance of the mass centre from the axis", value=e, limit=limit, at_most=True,
        kind="film", source=_RESIDUAL if grade == API_RESIDUAL else f"ISO 21940-11, {grade}",
    )  # fmt: skip
