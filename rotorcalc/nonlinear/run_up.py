"""A run-up and the run-down after it: amplitude and spectra over speed, and why whirl comes late.

Model: the nonlinear motion of `transient` at evenly rising, then evenly falling speed. Small pushes
disturb the rotor, as every real one is disturbed: without them a balanced rotor would never leave
its equilibrium.

Whirl needs time to grow. Past the onset Ω_on a small whirl grows at the rate Re λ(Ω), and while the
speed rises by Ω̇ it grows by the factor e^n with n = ∫ Re λ dΩ / Ω̇ from Ω_on on. Near the onset
Re λ ≈ (dRe λ/dΩ)(Ω − Ω_on), so a given factor takes Ω − Ω_on = √(2nΩ̇/(dRe λ/dΩ)): four times the
acceleration doubles the delay. The whirl of a run-down dies at the fold of the limit cycles, where
there is one, as late. Source of the delay: Mandel and Erneux, The slow passage through a steady
bifurcation: delay and memory effects, J. Stat. Phys. 48 (1987).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rotorcalc import modes
from rotorcalc.analysis import analyse
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array
from rotorcalc.display import Result
from rotorcalc.machine import Machine
from rotorcalc.nonlinear.signals import Waterfall, waterfall
from rotorcalc.nonlinear.transient import Start, Transient, last_state, simulate

# Velocity of the pushes over CΩ: each leaves a whirl of about C/1000.
PUSHES = 5e-3
# Amplitude over C from which a motion counts as whirl.
WHIRLS = 0.1
# Orders in which whirl is looked for, clear of the synchronous line and its window's flanks.
_WHIRL = (0.2, 0.85)
# A whirl that linear theory puts below them is looked for from this share of its order on; slower
# than the other it would lie on the flanks of the mean position's line.
_BELOW, _SLOWEST = 0.7, 0.09
# 16 samples a revolution resolve orders up to 8; a waterfall ends at 1.5. Its windows are so long
# that orders 1/32 apart are two lines, and as many as there are lines on a screen for.
_SAMPLES, _SPECTRA, _WIDTH = 16, 300, 64
# Revolutions over which an amplitude is taken: four turns of a whirl at half speed.
_WINDOW = 8
# Of the integrator's steps: spectra are read to a hundredth.
_TOLERANCE = 1e-7
# How far past an onset growth is followed, over the onset's speed, and in how many steps.
_FAR, _STEPS = 2.0, 400


@dataclass(frozen=True, eq=False)
class Passage(Result):
    """A motion at rising or falling speed; m windows of it, and its spectra.

    Attributes
    ----------
    speed : array, (m,)
        Running speed in the middle of each window [rad/s].
    amplitude : array, (m,)
        Of the journal, zero to peak [m]: half the larger of the ranges of X and Y in a window.
    seen : Waterfall
        Its spectra.
    whirl_order : array, (k,)
        Order of the whirl that decays slowest at the spectra's speeds by the linear theory [-].
    """

    speed: Array
    amplitude: Array
    seen: Waterfall
    whirl_order: Array

    @property
    def whirl(self) -> Array:
        """Amplitude of the whirl's line in each spectrum [m], (k,)."""
        order, slow = self.seen.order, self.whirl_order[self.whirl_order > _SLOWEST]
        # A floating ring whirls slower than any film: at half of its own speed.
        low = min(_WHIRL[0], _BELOW * float(slow.min(initial=math.inf)))
        near = (order > low) & (order < _WHIRL[1])
        return self.seen.amplitude[:, near].max(axis=1)


@dataclass(frozen=True, eq=False)
class RunUp(Result):
    """A run-up and the run-down from its end.

    Attributes
    ----------
    up, down : Passage
        At rising speed, and at falling speed.
    acceleration : float
        Ω̇ of the run-up, that of the run-down is −Ω̇ [rad/s²].
    clearance : float
        C [m].
    """

    up: Passage
    down: Passage
    acceleration: float
    clearance: float

    @property
    def whirls_from(self) -> float:
        """Speed at which whirl exceeds C/10 as the speed rises [rad/s]; NaN where it does not."""
        return self._first(self.up)

    @property
    def whirls_down_to(self) -> float:
        """Speed at which whirl last exceeds C/10 as the speed falls [rad/s]; NaN: it never does."""
        return self._first(self.down, last=True)

    def _first(self, passage: Passage, *, last: bool = False) -> float:
        whirling = np.flatnonzero(passage.whirl > WHIRLS * self.clearance)
        return float(passage.seen.speed[whirling[-1 if last else 0]]) if len(whirling) else math.nan


@dataclass(frozen=True)
class Delay:
    """How late whirl shows in a run-up.

    Attributes
    ----------
    speed : float
        Speed at which it has grown by the factor asked for [rad/s]; NaN: not up to twice the onset.
    rate : float
        Growth rate of whirl one per cent above the onset [1/s].
    """

    speed: float
    rate: float


@checked
def run_up(
    machine: Machine,
    lowest: float,
    highest: float,
    *,
    revolutions: int,
    progress: Callable[[float], object] | None = None,
) -> RunUp:
    """Return a run-up between two speeds, and the run-down from its end.

    Parameters
    ----------
    machine : Machine
        The machine, with its imbalance or without one.
    lowest, highest : float
        The speeds [rad/s].
    revolutions : int
        Number of revolutions each way, 64 to 20000.
    progress : callable or None
        Called repeatedly with the share done, 0 to 1. An exception that it raises ends the work.

    Returns
    -------
    RunUp
        With 300 spectra each way.

    Raises
    ------
    ValueError
        Where the speeds do not rise from a positive one, or the number of revolutions is out of
        bounds.
    TransientError
        As `simulate`.
    """
    if not 0.0 < lowest < highest < math.inf:
        raise ValueError(
            f"lowest = {lowest}, highest = {highest} rad/s: must be positive, finite, and rise"
        )
    if revolutions < _WIDTH:
        raise ValueError(f"revolutions = {revolutions}: must be {_WIDTH} or more")

    def run(first: float, last: float, start: Start | None, done: float) -> Transient:
        def tell(share: float) -> None:
            if progress is not None:
                progress(done + 0.5 * share)

        return simulate(
            machine,
            first,
            revolutions=revolutions,
            samples_per_revolution=_SAMPLES,
            start=start,
            final_speed=last,
            pushes=PUSHES * machine.bearing.radial_clearance * lowest,
            tolerance=_TOLERANCE,
            progress=tell,
        )

    up = run(lowest, highest, None, 0.0)
    down = run(highest, lowest, last_state(up), 0.5)
    return RunUp(
        up=_passage(machine, up),
        down=_passage(machine, down),
        acceleration=(highest - lowest) / float(up.time[-1]),
        clearance=machine.bearing.radial_clearance,
    )


@checked
def delay(machine: Machine, onset: float, acceleration: float, *, factor: float) -> Delay:
    """Return how late whirl shows in a run-up, by the linear theory's growth rate.

    Parameters
    ----------
    machine : Machine
        The machine.
    onset : float
        Onset of whirl, Ω_on [rad/s].
    acceleration : float
        Ω̇ [rad/s²], positive.
    factor : float
        By how much a disturbance must grow to be seen as whirl, more than 1 [-].

    Returns
    -------
    Delay
        The speed at which ∫ Re λ dΩ / Ω̇ from the onset on reaches the logarithm of the factor.

    Raises
    ------
    ValueError
        Where the onset or the acceleration is not positive and finite, or the factor not above 1.
    """
    for name, value, least in (
        ("onset", onset, 0.0), ("acceleration", acceleration, 0.0), ("factor", factor, 1.0),
    ):  # fmt: skip
        if not least < value < math.inf:
            raise ValueError(f"{name} = {value}: must be above {least:g}, and finite")
    # Close together at the onset, where the exponent begins as a square.
    speed = onset * (1.0 + (_FAR - 1.0) * np.linspace(0.0, 1.0, _STEPS + 1) ** 2)
    rate = modes.leading(analyse(machine, speed).flexible_eigenvalues).real
    step = np.diff(speed)
    grown = np.append(0.0, np.cumsum(0.5 * (rate[1:] + rate[:-1]) * step)) / acceleration
    needed = math.log(factor)
    reached = np.flatnonzero(grown >= needed)
    shows = math.nan
    if len(reached):
        # Up to there the exponent rises: where Re λ falls again it is not reached for the first
        # time.
        end = int(reached[0]) + 1
        shows = float(np.interp(needed, grown[end - 2 : end], speed[end - 2 : end]))
    return Delay(speed=shows, rate=float(np.interp(1.01 * onset, speed, rate)))


def _passage(machine: Machine, motion: Transient) -> Passage:
    seen = waterfall(motion, spectra=_SPECTRA, width=_WIDTH)
    whirl = modes.leading(analyse(machine, seen.speed).flexible_eigenvalues)
    samples = _WINDOW * _SAMPLES
    windows = len(motion.time) // samples
    path = motion.journal[: windows * samples].reshape(windows, samples, 2)
    return Passage(
        speed=motion.speed[samples // 2 : windows * samples : samples],
        amplitude=0.5 * np.ptp(path, axis=1).max(axis=1),
        seen=seen,
        whirl_order=whirl.imag / seen.speed,
    )
