"""An orbit from a file of samples: two probes, with a keyphasor or a known running speed."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, BoolArray
from rotorcalc.measured import keyphasor
from rotorcalc.measured.columns import Quantity, Table, read_table
from rotorcalc.measured.probes import USUAL_ANGLES, checked_angles, to_axes, to_probes
from rotorcalc.nonlinear.sampled import MeasuredOrbit
from rotorcalc.nonlinear.transient import Transient

COLUMNS = {
    "time": Quantity(("time", "t"), "s"),
    "first": Quantity(("probe 1", "probe1", "probe a"), "m"),
    "second": Quantity(("probe 2", "probe2", "probe b"), "m"),
    "keyphasor": Quantity(("keyphasor", "key phasor", "kph", "tacho"), ""),
}
FEWEST = 16
# Bounds outside which a number is a slip: of the time between samples [s], its largest over its
# median, and the running speed [rad/s].
_LEAST_STEP, _LONGEST_STEP = 1e-9, 4.0
_SPEEDS = (1e-2, 1e6)


@dataclass(frozen=True, kw_only=True)
class Setting:
    """How the probes stood and were sampled; see `read_orbit`."""

    angles: tuple[float, float]
    sample_rate: float | None
    speed: float | None
    threshold: float | None
    falling: bool
    gap: bool
    keep_mean: bool
    imbalance_angle: float


@checked
def read_orbit(  # noqa: PLR0913 - how probes, keyphasor and samples are meant
    table: str | bytes | Path,
    *,
    angles: Sequence[float] = USUAL_ANGLES,
    sample_rate: float | None = None,
    speed: float | None = None,
    threshold: float | None = None,
    pulse: Literal["rising", "falling"] = "rising",
    reads: Literal["displacement", "gap"] = "displacement",
    mean: Literal["removed", "kept"] = "removed",
    imbalance_angle: float = 0.0,
) -> MeasuredOrbit:
    """Return the orbit that two probes recorded.

    Parameters
    ----------
    table : str, bytes or Path
        The text of a table, or the file that holds it. Its first line names the columns, with
        units: "time [s]", "probe 1 [µm]", "probe 2 [µm]", "keyphasor [V]". Displacements may be in
        m, mm, µm, in or mil, times in s, ms or µs, the keyphasor in anything. Other columns are
        left, and listed as unread.
    angles : sequence of 2 floats
        Directions of the probes [rad], from X, the load's direction, in the sense of rotation; by
        default 135° and 225°, 45° to both sides of the top.
    sample_rate : float or None
        Samples in a second [1/s], of a table without a column of times.
    speed : float or None
        Running speed, Ω [rad/s], of a table without a keyphasor.
    threshold : float or None
        At which the keyphasor's signal is a pulse, in its unit; None for the middle of its span.
    pulse : "rising" or "falling"
        The edge that counts.
    reads : "displacement" or "gap"
        Whether a reading rises as the journal comes nearer, or as its distance to the probe.
    mean : "removed" or "kept"
        Whether the mean of the record is taken off, as the zero of a probe is seldom known.
    imbalance_angle : float
        Where the imbalance points at a pulse, or without pulses at the first sample: its angle from
        X in the sense of rotation [rad].

    Returns
    -------
    MeasuredOrbit
        In X and Y; with a keyphasor, from its first pulse to its last.

    Raises
    ------
    ValueError
        Where a cell is no number, columns are missing, times do not rise or leave a gap, the
        probes are nearly parallel, pulses are missing, or there is neither keyphasor nor speed.
    """
    setting = Setting(
        angles=checked_angles(_two(angles)), sample_rate=sample_rate, speed=speed,
        threshold=threshold, falling=pulse == "falling", gap=reads == "gap",
        keep_mean=mean == "kept", imbalance_angle=imbalance_angle,
    )  # fmt: skip
    _check_numbers(setting)
    found = read_table(table, COLUMNS, fewest=FEWEST)
    for key in ("first", "second"):
        if key not in found.columns:
            raise ValueError(f"header: has no column '{COLUMNS[key].names[0]} [µm]'")
    return _orbit(found, _times(found, setting), setting)


def _orbit(found: Table, time: Array, setting: Setting) -> MeasuredOrbit:
    readings = np.stack([found.columns["first"], found.columns["second"]], axis=-1)
    position = (-readings if setting.gap else readings) @ to_axes(setting.angles).T
    signal = found.columns.get("keyphasor")
    if signal is None:
        speed = _known_speed(setting)
        taken = np.ones(len(time), dtype=bool)
        angle, speeds = speed * (time - time[0]), np.full(len(time), speed)
    else:
        at = keyphasor.pulses(time, signal, setting.threshold, falling=setting.falling)
        # Beyond its pulses the angle is not known.
        taken = _between(time, at)
        angle, speeds = keyphasor.turned(time[taken], at)
        _check_speeds(speeds)
    position = position[taken]
    mean = np.zeros(2) if setting.keep_mean else position.mean(axis=0)
    return MeasuredOrbit(
        time=time[taken],
        position=position - mean,
        speed=speeds,
        angle=angle + setting.imbalance_angle,
        mean=mean,
        has_keyphasor=signal is not None,
        unread=found.unread,
    )


def _between(time: Array, pulses: Array) -> BoolArray:
    # A pulse that falls on a sample is that sample, whatever rounding says.
    room = 1e-6 * float(pulses[-1] - pulses[0]) / len(time)
    taken = (time >= pulses[0] - room) & (time <= pulses[-1] + room)
    if np.sum(taken) < FEWEST:
        raise ValueError(
            f"keyphasor: {np.sum(taken)} samples between its pulses, must be {FEWEST} or more"
        )
    return taken


def _times(found: Table, setting: Setting) -> Array:
    if "time" not in found.columns:
        if setting.sample_rate is None:
            raise ValueError("header: has no column 'time [s]'; else the sample rate is needed")
        return np.arange(len(found.lines)) / setting.sample_rate
    if setting.sample_rate is not None:
        raise ValueError("sample_rate: given beside the file's column of times; leave it out")
    time = found.columns["time"]
    steps = np.diff(time)
    if (steps < _LEAST_STEP).any():
        line = found.lines[1 + int(np.argmax(steps < _LEAST_STEP))]
        raise ValueError(
            f"line {line}, column time: does not come after the line before; give times with more "
            "digits, or leave them out and give the sample rate"
        )
    longest = int(np.argmax(steps))
    if steps[longest] > _LONGEST_STEP * np.median(steps):
        raise ValueError(
            f"line {found.lines[longest + 1]}, column time: {steps[longest]:.4g} s after the line "
            f"before, where others lie {np.median(steps):.4g} s apart: samples are missing"
        )
    return time


def _known_speed(setting: Setting) -> float:
    if setting.speed is None:
        raise ValueError(
            "header: has no column 'keyphasor'; without one the running speed is needed"
        )
    return setting.speed


def _two(angles: Sequence[float]) -> Sequence[float]:
    if len(angles) != 2:
        raise ValueError(f"angles: {len(angles)} of them, must be two, in radians")
    return angles


def _check_numbers(setting: Setting) -> None:
    for name, value, unit, (low, high) in (
        ("sample_rate", setting.sample_rate, "1/s", (1e-3, 1.0 / _LEAST_STEP)),
        ("speed", setting.speed, "rad/s", _SPEEDS),
        ("threshold", setting.threshold, "", (-1e12, 1e12)),
        ("imbalance_angle", setting.imbalance_angle, "rad", (-2.0 * math.pi, 2.0 * math.pi)),
    ):
        if value is not None and not low <= value <= high:
            raise ValueError(f"{name} = {value:g} {unit}: must be {low:g} to {high:g}")


def _check_speeds(speeds: Array) -> None:
    low, high = _SPEEDS
    if not (speeds.min() >= low and speeds.max() <= high):
        raise ValueError(
            f"keyphasor: its pulses give {speeds.min():.4g} to {speeds.max():.4g} rad/s; must be "
            f"{low:g} to {high:g}"
        )


@checked
def orbit_table(
    motion: Transient, *, angles: Sequence[float] = USUAL_ANGLES, with_keyphasor: bool = True
) -> str:
    """Return a simulated motion as the table that two probes would give, for `read_orbit`.

    Parameters
    ----------
    motion : Transient
        The motion.
    angles : sequence of 2 floats
        Directions of the probes [rad], as for `read_orbit`.
    with_keyphasor : bool
        Whether the table has a keyphasor's pulses, one each time the imbalance points along X.

    Returns
    -------
    str
        Commas between the cells, times in s, displacements in µm.
    """
    readings = 1e6 * motion.journal @ to_probes(checked_angles(_two(angles))).T
    header = ["time [s]", "probe 1 [µm]", "probe 2 [µm]"]
    columns = [motion.time, *readings.T]
    if with_keyphasor:
        header.append("keyphasor [V]")
        columns.append(_pulses(motion.angle))
    lines = [",".join(f"{value:.10g}" for value in row) for row in zip(*columns, strict=True)]
    return "\r\n".join([",".join(header), *lines, ""])


def _pulses(angle: Array) -> Array:
    """Return a pulse of 5 V each turn, whose rising edge passes 2.5 V at whole turns."""
    samples = 2.0 * math.pi / float(angle[1] - angle[0])
    # Samples after a whole turn, from half a turn before it.
    after = samples * (np.mod(angle / (2.0 * math.pi) + 0.5, 1.0) - 0.5)
    edge = np.clip(2.5 + 2.5 * after, 0.0, 5.0)
    return np.where(after > 0.125 * samples, 0.0, edge)
