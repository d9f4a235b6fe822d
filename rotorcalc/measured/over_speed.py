"""Amplitude and phase over speed from a file: the synchronous vectors of two probes."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Literal

import numpy as np

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, BoolArray, ComplexArray, complex_array, real_array
from rotorcalc.display import Result
from rotorcalc.measured.columns import Quantity, Table, read_table, share_of
from rotorcalc.measured.probes import USUAL_ANGLES, checked_angles, to_axes, to_probes
from rotorcalc.unbalance_response import OrbitEllipse, orbit_ellipse, phase_lag
from rotorcalc.units import AMPLITUDES, rpm

COLUMNS = {
    "speed": Quantity(("speed", "running speed", "rotor speed"), "rad/s"),
    "amplitude 1": Quantity(("amplitude 1", "amplitude1", "amplitude a"), "m"),
    "phase 1": Quantity(("phase 1", "phase1", "phase a"), "rad"),
    "amplitude 2": Quantity(("amplitude 2", "amplitude2", "amplitude b"), "m"),
    "phase 2": Quantity(("phase 2", "phase2", "phase b"), "rad"),
}
# Readings of two speeds at least make a curve; bounds outside which a number is a slip.
FEWEST, _SPEEDS, _MOST_ANGLE = 2, (1e-2, 1e6), 1e6


@dataclass(frozen=True, eq=False)
class MeasuredResponse(Result):
    """The synchronous motion of a journal, measured over speed, n readings.

    Attributes
    ----------
    speed : array, (n,)
        Running speed, Ω [rad/s], rising.
    response : complex array, (n, 2)
        Phasors of X and Y, zero to peak [m], as a sweep's `journal_response`.
    unread : tuple of str
        Headers of the file's columns that were not read.
    """

    speed: Array
    response: ComplexArray
    unread: tuple[str, ...] = ()

    @cached_property
    def ellipse(self) -> OrbitEllipse:
        """Axes of the orbits, each of shape (n,)."""
        return orbit_ellipse(self.response)

    @property
    def amplitude(self) -> Array:
        """Amplitudes of X and Y, zero to peak [m], (n, 2)."""
        return np.abs(self.response)

    @property
    def lag(self) -> Array:
        """Lag of X behind cos Ωt and of Y behind sin Ωt [rad], (n, 2)."""
        return phase_lag(self.response)


@checked
def read_vibration_over_speed(  # noqa: PLR0913 - how amplitude and phase are meant
    table: str | bytes | Path,
    *,
    reading: Literal["0-p", "p-p"],
    phase: Literal["lag", "lead"],
    angles: Sequence[float] = USUAL_ANGLES,
    reads: Literal["displacement", "gap"] = "displacement",
    imbalance_angle: float = 0.0,
) -> MeasuredResponse:
    """Return amplitude and phase that two probes measured over speed, in X and Y.

    Parameters
    ----------
    table : str, bytes or Path
        The text of a table, or the file that holds it. Its first line names the columns, with
        units: "speed [rpm]", "amplitude 1 [µm]", "phase 1 [°]", "amplitude 2 [µm]", "phase 2 [°]".
        Speeds may be in rpm, rad/s or Hz, amplitudes in m, mm, µm, in or mil. A unit may name the
        reading, "µm p-p". Other columns are left, and listed as unread.
    reading : "0-p" or "p-p"
        Whether amplitudes are zero to peak or peak to peak.
    phase : "lag" or "lead"
        Whether a phase says by how much a probe's peak comes after the keyphasor's pulse, or by how
        much before it.
    angles : sequence of 2 floats
        Directions of the probes [rad], from X, the load's direction, in the sense of rotation; by
        default 135° and 225°, 45° to both sides of the top.
    reads : "displacement" or "gap"
        Whether a reading rises as the journal comes nearer, or as its distance to the probe.
    imbalance_angle : float
        Where the imbalance points at a pulse: its angle from X in the sense of rotation [rad].

    Returns
    -------
    MeasuredResponse
        In the order of the speeds.

    Raises
    ------
    ValueError
        Where a cell is no number, columns are missing, a value is out of bounds, a speed comes
        twice, a unit contradicts the reading, or the probes are nearly parallel.
    """
    if len(angles) != 2:
        raise ValueError(f"angles: {len(angles)} of them, must be two, in radians")
    if not abs(imbalance_angle) <= 2.0 * np.pi:
        raise ValueError(f"imbalance_angle = {imbalance_angle:g} rad: must be −2π to 2π")
    directions = checked_angles(angles)
    found = read_table(table, COLUMNS, fewest=FEWEST)
    _check(found, reading)
    values, order = found.columns, np.argsort(found.columns["speed"])
    turns = -1.0 if phase == "lag" else 1.0
    probes = np.stack([
        values[f"amplitude {one}"] * np.exp(1j * turns * values[f"phase {one}"]) for one in (1, 2)
    ], axis=-1)  # fmt: skip
    sign = -1.0 if reads == "gap" else 1.0
    # What turns with the imbalance, which at the pulse is that angle ahead of X.
    turning = sign * share_of(reading) * np.exp(-1j * imbalance_angle)
    response = turning * probes @ to_axes(directions).T
    return MeasuredResponse(values["speed"][order], response[order], found.unread)


def _check(found: Table, reading: str) -> None:
    for key, quantity in COLUMNS.items():
        if key not in found.columns:
            unit = {"m": "µm", "rad": "°", "rad/s": "rpm"}[quantity.si]
            raise ValueError(f"header: has no column '{key} [{unit}]'")
    for key, said in found.readings.items():
        if said != reading:
            raise ValueError(f"header: {key} is {said}, but amplitudes were said to be {reading}")
    for key, values in found.columns.items():
        wrong, bound = _out_of_bounds(key, values)
        if wrong.any():
            line = found.lines[int(np.argmax(wrong))]
            raise ValueError(f"line {line}, column {key}: must be {bound}")
    _check_no_speed_twice(found)


def _out_of_bounds(key: str, values: Array) -> tuple[BoolArray, str]:
    """Return which values of a column are a slip, and the bound."""
    if key == "speed":
        low, high = _SPEEDS
        return (values < low) | (values > high), f"{low:g} to {high:g} rad/s"
    if key.startswith("amplitude"):
        return values < 0.0, "zero or more"
    return np.abs(values) > _MOST_ANGLE, f"within {_MOST_ANGLE:g} rad"


def _check_no_speed_twice(found: Table) -> None:
    speeds = found.columns["speed"]
    order = np.argsort(speeds, kind="stable")
    same = np.diff(speeds[order]) == 0.0
    if same.any():
        at = int(np.argmax(same))
        first, second = (found.lines[int(order[place])] for place in (at, at + 1))
        raise ValueError(
            f"line {second}, column speed: the same as on line {first}; give a run-up and a "
            "run-down as two files"
        )


@checked
def response_table(
    speed: Array, response: ComplexArray, *, angles: Sequence[float] = USUAL_ANGLES
) -> str:
    """Return a computed response as the table that two probes would give.

    Parameters
    ----------
    speed : array, (n,)
        Running speed, Ω [rad/s].
    response : complex array, (n, 2)
        Phasors of X and Y [m], as a sweep's `journal_response`.
    angles : sequence of 2 floats
        Directions of the probes [rad], as for `read_vibration_over_speed`.

    Returns
    -------
    str
        Commas between the cells, speeds in rpm, amplitudes in µm peak to peak, phases as a lag.
    """
    to_each = to_probes(checked_angles(angles))
    probes = complex_array("response", response, ends=(2,)) @ to_each.T
    sizes, lags = 1e6 * AMPLITUDES["p-p"] * np.abs(probes), np.degrees(-np.angle(probes)) % 360.0
    header = "speed [rpm],amplitude 1 [µm p-p],phase 1 [°],amplitude 2 [µm p-p],phase 2 [°]"
    columns = [real_array("speed", speed) / rpm, sizes[:, 0], lags[:, 0], sizes[:, 1], lags[:, 1]]
    lines = [",".join(f"{value:.10g}" for value in row) for row in zip(*columns, strict=True)]
    return "\r\n".join([header, *lines, ""])
