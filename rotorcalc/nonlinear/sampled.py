"""An orbit as it is sampled on a machine: even in time, with the angle of rotation beside it.

Orders of the running speed and phases need samples that are even in the angle, growth rates such
that are even in time; a cubic spline through the samples gives both. A simulation's samples are
even in both, and remain what they are.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.interpolate import CubicSpline

from rotorcalc.arrays import Array
from rotorcalc.display import Result

# With fewer samples in a revolution the spline misses 1× by more than a thousandth.
FEWEST_SAMPLES = 8


@dataclass(frozen=True, eq=False)
class MeasuredOrbit(Result):
    """An orbit that two probes recorded, n samples.

    Attributes
    ----------
    time : array, (n,)
        t [s].
    position : array, (n, 2)
        Displacement of the journal in X, Y [m].
    speed : array, (n,)
        Running speed, Ω [rad/s].
    angle : array, (n,)
        Angle through which the imbalance has turned from X, in the sense of rotation [rad].
    mean : array, (2,)
        The mean that was taken off the displacement in X, Y [m]; zero where it was kept.
    has_keyphasor : bool
        Whether pulses gave speed and angle. Otherwise the angle begins at an unknown place, and
        phases are relative to the first sample.
    unread : tuple of str
        Headers of the file's columns that were not read.
    """

    time: Array
    position: Array
    speed: Array
    angle: Array
    mean: Array
    has_keyphasor: bool
    unread: tuple[str, ...] = ()

    @property
    def revolutions(self) -> float:
        """Revolutions from the first sample to the last [-]."""
        return float(self.angle[-1] - self.angle[0]) / (2.0 * math.pi)

    @property
    def sample_rate(self) -> float:
        """Samples in a second [1/s]."""
        return (len(self.time) - 1) / float(self.time[-1] - self.time[0])

    @cached_property
    def over_angle(self) -> "MeasuredOrbit":
        """The orbit at even steps of the angle, from the first whole turn to the last.

        Raises
        ------
        ValueError
            Where it holds less than a whole turn, or fewer than 8 samples in a revolution.
        """
        turn = 2.0 * math.pi
        # Rounding must not lose a sample or a turn.
        samples = math.floor((len(self.time) - 1) / self.revolutions + 1e-6)
        if samples < FEWEST_SAMPLES:
            raise ValueError(
                f"the orbit has {samples} samples in a revolution, must have {FEWEST_SAMPLES} or "
                "more: sample faster"
            )
        first = math.ceil(float(self.angle[0]) / turn - 1e-6)
        last = math.floor(float(self.angle[-1]) / turn + 1e-6)
        if last <= first:
            raise ValueError("the orbit holds no whole revolution")
        count = (last - first) * samples + 1
        even: Array = np.linspace(turn * first, turn * last, count)
        return self._at(self.angle, even)

    @cached_property
    def over_time(self) -> "MeasuredOrbit":
        """The orbit at even steps of time."""
        first, last = (float(self.time[place]) for place in (0, -1))
        return self._at(self.time, np.linspace(first, last, len(self.time)))

    def _at(self, knots: Array, even: Array) -> "MeasuredOrbit":
        """Return the orbit at other values of its time or its angle."""
        # A spline goes through its knots: where these are even already, nothing changes.
        values = np.column_stack([self.time, self.position, self.speed, self.angle])
        found: Array = CubicSpline(knots, values)(even)
        return replace(
            self, time=found[:, 0], position=found[:, 1:3], speed=found[:, 3], angle=found[:, 4]
        )
