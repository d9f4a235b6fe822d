"""Measurements on a motion: spectrum, whirl ratio, growth, synchronous vector, Poincaré points.

A motion is an integration's (`Transient`) or was recorded on a machine (`MeasuredOrbit`).
Signals are taken from X + jY, so that a positive order turns with the shaft and a negative one
against it. An order is a frequency over that of the running speed.

Source of the growth rate: Hua and Sarkar, Matrix pencil method for estimating parameters of
exponentially damped/undamped sinusoids in noise, IEEE Trans. ASSP 38 (1990).
"""

import math
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, ComplexArray, real_array
from rotorcalc.display import Result
from rotorcalc.nonlinear.sampled import MeasuredOrbit
from rotorcalc.nonlinear.transient import Transient

Motion: TypeAlias = Transient | MeasuredOrbit

# Ranges of the synchronous line, of whirl, and of a free motion's modes [orders]. Whirl lies near
# ½, and well below 1; modes beyond a free motion's are drift of a fit, or the shaft's own.
_SYNCHRONOUS, _WHIRL, _FREE = (0.97, 1.03), (0.2, 0.85), (0.02, 3.0)
# A line below this share of the largest is taken for leakage of the window; one below this multiple
# of the median for noise, whose lines rise above it once in a hundred thousand.
_LEAST_LINE, _OVER_NOISE = 1e-3, 4.0
# Samples of a pencil at most, and the singular values, over the largest, taken for rounding.
_MOST_ROWS, _NOISE = 400, 1e-9
_MOST_MODES = 12
# Of a recorded motion, singular values below this multiple of their median are noise's; and whirls
# with less than this share of the largest are not looked at.
_OVER_MEDIAN, _LEAST_SHARE = 4.0, 0.1


@dataclass(frozen=True, eq=False)
class Spectrum(Result):
    """Amplitudes of a motion over orders of running speed, n of them, rising from negative ones.

    Attributes
    ----------
    order : array, (n,)
        Frequency over running speed [-]; negative where a circle turns against the shaft.
    amplitude : array, (n,)
        Radius of the circle that turns at that order [m].
    synchronous : float
        Radius of the circle that turns with the shaft, 1× [m].
    whirl_ratio : float
        Order of the whirl line [-]; NaN where there is none.
    whirl : float
        Radius of the whirl's circle [m]; zero where there is none.
    """

    order: Array
    amplitude: Array
    synchronous: float
    whirl_ratio: float
    whirl: float


@dataclass(frozen=True, eq=False)
class Waterfall(Result):
    """Spectra of the forward circles over a run-up.

    Attributes
    ----------
    speed : array, (m,)
        Running speed in the middle of each window [rad/s].
    order : array, (n,)
        Frequency over running speed, zero and up [-].
    amplitude : array, (m, n)
        Radius of the circle that turns forward at that order [m].
    """

    speed: Array
    order: Array
    amplitude: Array


@checked
def spectrum(
    motion: Motion, *, of: str = "journal", last: int | None = None, slowest: float = _WHIRL[0]
) -> Spectrum:
    """Return the spectrum of a motion, windowed by Hann, over orders of running speed.

    Parameters
    ----------
    motion : Transient or MeasuredOrbit
        The motion. Its samples are even in the angle of rotation, or made so, and orders stay
        sharp while the speed changes.
    of : str
        "journal" or "disk"; a recorded motion is the journal's.
    last : int or None
        Number of final revolutions to take, where the motion has settled; None for all.
    slowest : float
        Order from which whirl is looked for; a floating ring's is below the usual.

    Returns
    -------
    Spectrum
        Lines between the spectrum's points are interpolated by the window's shape: an order to
        about a hundredth of a point, an amplitude to about a part in a thousand.

    Raises
    ------
    ValueError
        Where there are fewer than four revolutions.
    """
    signal, _, revolutions = _signal(motion, of, last)
    order, circles = _circles(signal, revolutions)
    size = np.abs(circles)
    at_1x, radius_1x = _line(order, size, _SYNCHRONOUS)
    # Whirl and imbalance are read in separate ranges: a large 1× line would hide a small whirl.
    ratio, radius = _line(order, size, (slowest, _WHIRL[1]))
    least = max(_LEAST_LINE * size.max(), _OVER_NOISE * float(np.median(size)))
    exists = radius > least and not math.isnan(ratio)
    return Spectrum(
        order=order,
        amplitude=size,
        synchronous=radius_1x if not math.isnan(at_1x) else 0.0,
        whirl_ratio=ratio if exists else math.nan,
        whirl=radius if exists else 0.0,
    )


@checked
def waterfall(motion: Motion, *, spectra: int = 200, width: int = 32) -> Waterfall:
    """Return spectra of the journal's motion along a run-up.

    Parameters
    ----------
    motion : Transient or MeasuredOrbit
        The motion, its speed rising or falling.
    spectra : int
        Number of spectra, evenly spaced over the revolutions.
    width : int
        Revolutions in each spectrum.

    Returns
    -------
    Waterfall
        With orders up to 1.5.

    Raises
    ------
    ValueError
        Where the motion is shorter than one window.
    """
    motion = _over_angle(motion)
    whole, _, revolutions = _signal(motion, "journal", None)
    if not 4 <= width <= revolutions:
        raise ValueError(f"width = {width}: must be 4 to {revolutions} revolutions")
    samples = round(len(whole) / revolutions)
    # Windows overlap where there are more spectra than would fit side by side.
    starts = np.linspace(0, len(whole) - width * samples, spectra).astype(int)
    order, _ = _circles(whole[: width * samples], width)
    shown = (order >= 0.0) & (order <= 1.5)
    rows = [np.abs(_circles(whole[i : i + width * samples], width)[1])[shown] for i in starts]
    return Waterfall(
        speed=motion.speed[starts + width * samples // 2],
        order=order[shown],
        amplitude=np.array(rows),
    )


@checked
def synchronous_vector(
    motion: Motion, *, of: str = "journal", last: int | None = None
) -> ComplexArray:
    """Return the part of a motion that turns with the shaft, as phasors of X and Y.

    Parameters
    ----------
    motion : Transient or MeasuredOrbit
        The motion.
    of : str
        "journal" or "disk"; a recorded motion is the journal's.
    last : int or None
        Number of final revolutions to take, where the motion has settled; None for all.

    Returns
    -------
    complex array, (2,)
        P of Re{P e^{jθ}} [m], θ the angle through which the imbalance has turned from X: as the
        response to imbalance of the linear theory.

    Raises
    ------
    ValueError
        Where there are fewer than four revolutions.
    """
    signal, angle, _ = _signal(motion, of, last)
    window = _hann(len(signal))
    # Hann's window has no side lobes at whole orders, and small ones at a whirl's.
    turning = 2.0 * window * np.exp(-1j * angle) / np.sum(window)
    centred = signal - np.sum(window * signal) / np.sum(window)
    both = np.stack([centred.real, centred.imag], axis=-1)
    vector: ComplexArray = np.asarray(turning @ both, dtype=complex)
    return vector


@checked
def poincare_points(motion: Motion, *, of: str = "journal") -> Array:
    """Return the position once per revolution, when the imbalance points along X.

    Parameters
    ----------
    motion : Transient or MeasuredOrbit
        The motion.
    of : str
        "journal" or "disk"; a recorded motion is the journal's.

    Returns
    -------
    array, (revolutions + 1, 2)
        Positions in X, Y [m]: a single point for a synchronous orbit, a closed curve for whirl at
        an irrational order.
    """
    motion = _over_angle(motion)
    return _path(motion, of)[:: _samples(motion)]


@checked
def free_modes(
    motion: Motion, *, rest: ArrayLike | None = None, revolutions: int | None = None
) -> ComplexArray:
    """Return eigenvalues measured on a small free motion: growth rates and frequencies.

    A sum of exponentials e^{λt} is fitted to X and Y of the journal together (matrix pencil). In a
    nonlinear motion the early part is small enough; the eigenvalues are then the linear theory's.

    Parameters
    ----------
    motion : Transient or MeasuredOrbit
        The motion, at constant speed, without imbalance.
    rest : array_like, (2,) or None
        Where the journal would rest [m]; None fits it with the modes.
    revolutions : int or None
        How many revolutions to take, from the start; None for all.

    Returns
    -------
    complex array, (modes,)
        λ [1/s] with Im λ ≥ 0, the one with the largest share in the motion first.

    Raises
    ------
    ValueError
        Where the motion is at rest, or has less than two revolutions.
    """
    return _free_modes(motion, rest, revolutions)[0]


@checked
def fitted_modes(path: Array, step: float, *, noise: float | None = _NOISE) -> ComplexArray:
    """Return the exponents of the exponentials that add up to a path, as `free_modes` does.

    Parameters
    ----------
    path : array, (n, 2)
        X and Y at even steps of time.
    step : float
        Time from one to the next [s].
    noise : float or None
        Singular values below this share of the largest are taken for noise; None estimates it from
        their median, as most of them are noise's where a path was recorded.

    Returns
    -------
    complex array, (modes,)
        λ [1/s] with Im λ ≥ 0, the one with the largest share in the path first.

    Raises
    ------
    ValueError
        Where the path is at rest.
    """
    return _fitted(path, step, noise)[0]


@checked
def growth(
    motion: Motion, *, rest: ArrayLike | None = None, revolutions: int | None = None
) -> complex:
    """Return growth rate and frequency of the whirl in a small free motion, as one eigenvalue.

    Parameters
    ----------
    motion : Transient or MeasuredOrbit
        The motion, at constant speed; an integrated one without imbalance. In a recorded one only
        whirl is looked for, orders 0.2 to 0.85, as the imbalance is in it too; and of several
        whirls, as imbalance and whirl at one half make two of, the slowest to decay is taken.
    rest : array_like, (2,) or None
        Where the journal would rest [m]; None fits it with the modes.
    revolutions : int or None
        How many revolutions to take, from the start; None for all.

    Returns
    -------
    complex
        λ = growth rate + j frequency [1/s] of the oscillating mode with the largest share in the
        motion; NaN where none oscillates.

    Raises
    ------
    ValueError
        As `free_modes`.
    """
    values, shares = _free_modes(motion, rest, revolutions)
    recorded = isinstance(motion, MeasuredOrbit)
    low, high = _WHIRL if recorded else _FREE
    order = values.imag / float(np.median(motion.speed))
    inside = (order > low) & (order < high)
    waves, shares = values[inside], shares[inside]
    if not len(waves):
        return complex(math.nan, math.nan)
    if recorded:
        waves = waves[shares >= _LEAST_SHARE * shares[0]]
        return complex(waves[np.argmax(waves.real)])
    return complex(waves[0])


def _free_modes(
    motion: Motion, rest: ArrayLike | None, revolutions: int | None
) -> tuple[ComplexArray, Array]:
    """Return the eigenvalues of `free_modes`, and their shares in the motion."""
    recorded = isinstance(motion, MeasuredOrbit)
    motion = motion.over_time if recorded else motion
    path = _path(motion, "journal")
    path = path - (np.zeros(2) if rest is None else real_array("rest", rest, ends=(2,)))
    samples = _samples(motion)
    count = len(path) if revolutions is None else min(revolutions * samples + 1, len(path))
    if count < 2 * samples:
        raise ValueError("motion: must have two revolutions or more")
    step = float(motion.time[1] - motion.time[0])
    return _fitted(path[:count], step, None if recorded else _NOISE)


def _fitted(path: Array, step: float, noise: float | None) -> tuple[ComplexArray, Array]:
    """Return the exponents of `fitted_modes`, and their shares, the largest first."""
    stride = max(1, len(path) // _MOST_ROWS)
    # Means of neighbours keep the exponents, and less of the noise.
    path = path[: len(path) // stride * stride].reshape(-1, stride, 2).mean(axis=1)
    factors = _pencil(path, noise)
    values: ComplexArray = np.asarray(np.log(factors) / (stride * step), dtype=complex)
    shares = _shares(factors, path)
    # The path is real: each oscillating mode comes with its conjugate.
    places = [place for place in np.argsort(-shares) if values[place].imag >= 0.0]
    return values[places], shares[places]


def _over_angle(motion: Motion) -> Motion:
    """Return a motion whose samples are even in the angle of rotation."""
    return motion.over_angle if isinstance(motion, MeasuredOrbit) else motion


def _path(motion: Motion, of: str) -> Array:
    if of not in ("journal", "disk"):
        raise ValueError(f"of = {of!r}: must be 'journal' or 'disk'")
    if isinstance(motion, Transient):
        return motion.journal if of == "journal" else motion.disk
    if of == "disk":
        raise ValueError("of = 'disk': of a recorded motion only the journal's is known")
    return motion.position


def _samples(motion: Motion) -> int:
    """Return the samples in a revolution."""
    return round(2.0 * math.pi * (len(motion.angle) - 1) / float(np.ptp(motion.angle)))


def _signal(motion: Motion, of: str, last: int | None) -> tuple[ComplexArray, Array, int]:
    """Return X + jY and the angle over whole revolutions, and how many they are."""
    motion = _over_angle(motion)
    path, samples = _path(motion, of), _samples(motion)
    revolutions = (len(path) - 1) // samples
    if last is not None:
        revolutions = min(revolutions, last)
    # A Hann window widens a line by 2/revolutions orders to either side: four just separate whirl
    # at one half from the synchronous line.
    if revolutions < 4:
        raise ValueError(f"motion: {revolutions} revolutions, must be 4 or more")
    taken = slice(-revolutions * samples - 1, -1)
    path = path[taken]
    return path[:, 0] + 1j * path[:, 1], motion.angle[taken], revolutions


def _circles(signal: ComplexArray, revolutions: int) -> tuple[Array, ComplexArray]:
    """Return orders and the phasors of the circles at them, without the mean."""
    n = len(signal)
    # The mean goes first, or its side lobes hide slow whirl; over the sum of the window the height
    # of a line is the radius of its circle.
    window = _hann(n)
    mean = np.sum(window * signal) / np.sum(window)
    circles = np.fft.fft(window * (signal - mean)) / np.sum(window)
    order = np.fft.fftfreq(n, revolutions / n).astype(float)
    return np.fft.fftshift(order), np.fft.fftshift(circles)


def _hann(n: int) -> Array:
    """Return Hann's window in its periodic form, (n,)."""
    return 0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(n) / n)


def _line(order: Array, size: Array, within: tuple[float, float]) -> tuple[float, float]:
    """Return order and radius of the largest line in a range, NaN where there is none.

    With d the line's distance from its highest point in points of the spectrum, a Hann window's
    neighbours are as (1 + d) : (2 − d), and the line's height is that of the point times
    πd(1 − d²)/sin πd.
    """
    spacing = order[1] - order[0]
    inside = (order[1:-1] >= within[0]) & (order[1:-1] <= within[1])
    # A maximum inside the range, not the flank of a line outside it.
    is_peak = (size[1:-1] > size[:-2]) & (size[1:-1] >= size[2:])
    peaks = 1 + np.flatnonzero(inside & is_peak)
    if not len(peaks):
        return math.nan, 0.0
    top = int(peaks[np.argmax(size[peaks])])
    before, peak, after = (float(value) for value in size[top - 1 : top + 2])
    side, beside = (1.0, after) if after > before else (-1.0, before)
    d = min(max((2.0 * beside - peak) / (beside + peak), 0.0), 1.0)
    height = 1.0 if d == 0.0 else math.pi * d * (1.0 - d * d) / math.sin(math.pi * d)
    return float(order[top] + side * d * spacing), peak * (height if d < 1.0 else 2.0)


def _pencil(path: Array, noise: float | None) -> ComplexArray:
    """Return the factors e^{λΔt} of the exponentials that add up to a path, (n, 2)."""
    n = len(path)
    # Pencil parameter n/3 to n/2: the least sensitive to noise (Hua and Sarkar).
    length = n // 3
    rows = np.lib.stride_tricks.sliding_window_view(path, length + 1, axis=0)
    table = rows.reshape(-1, length + 1)
    if not np.abs(table).max() > 0.0:
        raise ValueError("motion: is at rest, and no mode can be measured")
    _, sizes, across = np.linalg.svd(table, full_matrices=False)
    if noise is None:
        noise = max(_NOISE, _OVER_MEDIAN * float(np.median(sizes) / sizes[0]))
    modes = max(int(np.sum(sizes > noise * sizes[0])), 1)
    space = across[: min(modes, _MOST_MODES)].T
    return np.linalg.eigvals(np.linalg.pinv(space[:-1]) @ space[1:]).astype(complex)


def _shares(factors: ComplexArray, path: Array) -> Array:
    """Return the mean square of each exponential in the sum that fits a path best."""
    powers = factors[None, :] ** np.arange(len(path))[:, None]
    fitted = np.linalg.lstsq(powers, path.astype(complex), rcond=None)[0]
    return np.mean(np.abs(powers) ** 2, axis=0) * np.sum(np.abs(fitted) ** 2, axis=1)
