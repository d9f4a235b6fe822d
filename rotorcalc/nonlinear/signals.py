"""Measurements on a motion: spectrum, whirl ratio, growth rate, Poincaré points.

Signals are taken from X + jY, so that a positive order turns with the shaft and a negative one
against it. An order is a frequency over that of the running speed.

Source of the growth rate: Hua and Sarkar, Matrix pencil method for estimating parameters of
exponentially damped/undamped sinusoids in noise, IEEE Trans. ASSP 38 (1990).
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, ComplexArray, real_array
from rotorcalc.display import Result
from rotorcalc.nonlinear.transient import Transient

# Ranges of the synchronous line and of whirl [orders]: whirl lies near ½, and well below 1.
_SYNCHRONOUS, _WHIRL = (0.97, 1.03), (0.2, 0.85)
# A line below this share of the largest is taken for leakage of the window.
_LEAST_LINE = 1e-3
# Samples of a pencil at most, and the singular values, over the largest, taken for rounding.
_MOST_ROWS, _NOISE = 400, 1e-9
_MOST_MODES = 12


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
def spectrum(motion: Transient, *, of: str = "journal", last: int | None = None) -> Spectrum:
    """Return the spectrum of a motion, windowed by Hann, over orders of running speed.

    Parameters
    ----------
    motion : Transient
        The motion. Its samples are even in the angle of rotation, so orders stay sharp while the
        speed changes.
    of : str
        "journal" or "disk".
    last : int or None
        Number of final revolutions to take, where the motion has settled; None for all.

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
    signal, revolutions = _signal(motion, of, last)
    order, circles = _circles(signal, revolutions)
    size = np.abs(circles)
    at_1x, radius_1x = _line(order, size, _SYNCHRONOUS)
    # Whirl and imbalance are read in separate ranges: a large 1× line would hide a small whirl.
    ratio, radius = _line(order, size, _WHIRL)
    exists = radius > _LEAST_LINE * size.max() and not math.isnan(ratio)
    return Spectrum(
        order=order,
        amplitude=size,
        synchronous=radius_1x if not math.isnan(at_1x) else 0.0,
        whirl_ratio=ratio if exists else math.nan,
        whirl=radius if exists else 0.0,
    )


@checked
def waterfall(motion: Transient, *, spectra: int = 200, width: int = 32) -> Waterfall:
    """Return spectra of the journal's motion along a run-up.

    Parameters
    ----------
    motion : Transient
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
    whole, revolutions = _signal(motion, "journal", None)
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
def poincare_points(motion: Transient, *, of: str = "journal") -> Array:
    """Return the position once per revolution, when the imbalance points along X.

    Parameters
    ----------
    motion : Transient
        The motion.
    of : str
        "journal" or "disk".

    Returns
    -------
    array, (revolutions + 1, 2)
        Positions in X, Y [m]: a single point for a synchronous orbit, a closed curve for whirl at
        an irrational order.
    """
    return _path(motion, of)[:: _samples(motion)]


@checked
def free_modes(
    motion: Transient, *, rest: ArrayLike | None = None, revolutions: int | None = None
) -> ComplexArray:
    """Return eigenvalues measured on a small free motion: growth rates and frequencies.

    A sum of exponentials e^{λt} is fitted to X and Y of the journal together (matrix pencil). In a
    nonlinear motion the early part is small enough; the eigenvalues are then the linear theory's.

    Parameters
    ----------
    motion : Transient
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
    path = motion.journal - (np.zeros(2) if rest is None else real_array("rest", rest, ends=(2,)))
    samples = _samples(motion)
    count = len(path) if revolutions is None else min(revolutions * samples + 1, len(path))
    if count < 2 * samples:
        raise ValueError("motion: must have two revolutions or more")
    return fitted_modes(path[:count], float(motion.time[1] - motion.time[0]))


@checked
def fitted_modes(path: Array, step: float, *, noise: float = _NOISE) -> ComplexArray:
    """Return the exponents of the exponentials that add up to a path, as `free_modes` does.

    Parameters
    ----------
    path : array, (n, 2)
        X and Y at even steps of time.
    step : float
        Time from one to the next [s].
    noise : float
        Singular values below this share of the largest are taken for noise.

    Returns
    -------
    complex array, (modes,)
        λ [1/s] with Im λ ≥ 0, the one with the largest share in the path first.

    Raises
    ------
    ValueError
        Where the path is at rest.
    """
    stride = max(1, len(path) // _MOST_ROWS)
    path = path[::stride]
    factors = _pencil(path, noise)
    values: ComplexArray = np.asarray(np.log(factors) / (stride * step), dtype=complex)
    shares = _shares(factors, path)
    values = values[np.argsort(-shares)]
    # The path is real: each oscillating mode comes with its conjugate.
    return values[values.imag >= 0.0]


@checked
def growth(
    motion: Transient, *, rest: ArrayLike | None = None, revolutions: int | None = None
) -> complex:
    """Return growth rate and frequency of the whirl in a small free motion, as one eigenvalue.

    Parameters
    ----------
    motion : Transient
        The motion, at constant speed, without imbalance.
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
    values = free_modes(motion, rest=rest, revolutions=revolutions)
    speed = float(motion.speed[0])
    # Slower or faster modes are not whirl: drift of the fit, or the shaft's own.
    waves = values[(values.imag > 0.02 * speed) & (values.imag < 3.0 * speed)]
    return complex(waves[0]) if len(waves) else complex(math.nan, math.nan)


def _path(motion: Transient, of: str) -> Array:
    if of not in ("journal", "disk"):
        raise ValueError(f"of = {of!r}: must be 'journal' or 'disk'")
    return motion.journal if of == "journal" else motion.disk


def _samples(motion: Transient) -> int:
    """Return the samples in a revolution."""
    return round(2.0 * math.pi / float(motion.angle[1] - motion.angle[0]))


def _signal(motion: Transient, of: str, last: int | None) -> tuple[ComplexArray, int]:
    """Return X + jY over whole revolutions, and how many they are."""
    path, samples = _path(motion, of), _samples(motion)
    revolutions = (len(path) - 1) // samples
    if last is not None:
        revolutions = min(revolutions, last)
    # A Hann window widens a line by 2/revolutions orders to either side: four just separate whirl
    # at one half from the synchronous line.
    if revolutions < 4:
        raise ValueError(f"motion: {revolutions} revolutions, must be 4 or more")
    path = path[-revolutions * samples - 1 : -1]
    return path[:, 0] + 1j * path[:, 1], revolutions


def _circles(signal: ComplexArray, revolutions: int) -> tuple[Array, ComplexArray]:
    """Return orders and the phasors of the circles at them, without the mean."""
    n = len(signal)
    # Hann's window in its periodic form. The mean goes first, or its side lobes hide slow whirl;
    # over the sum of the window the height of a line is the radius of its circle.
    window = 0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(n) / n)
    mean = np.sum(window * signal) / np.sum(window)
    circles = np.fft.fft(window * (signal - mean)) / np.sum(window)
    order = np.fft.fftfreq(n, revolutions / n).astype(float)
    return np.fft.fftshift(order), np.fft.fftshift(circles)


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


def _pencil(path: Array, noise: float) -> ComplexArray:
    """Return the factors e^{λΔt} of the exponentials that add up to a path, (n, 2)."""
    n = len(path)
    # Pencil parameter n/3 to n/2: the least sensitive to noise (Hua and Sarkar).
    length = n // 3
    rows = np.lib.stride_tricks.sliding_window_view(path, length + 1, axis=0)
    table = rows.reshape(-1, length + 1)
    if not np.abs(table).max() > 0.0:
        raise ValueError("motion: is at rest, and no mode can be measured")
    _, sizes, across = np.linalg.svd(table, full_matrices=False)
    modes = int(np.sum(sizes > noise * sizes[0]))
    space = across[: min(modes, _MOST_MODES)].T
    return np.linalg.eigvals(np.linalg.pinv(space[:-1]) @ space[1:]).astype(complex)


def _shares(factors: ComplexArray, path: Array) -> Array:
    """Return the mean square of each exponential in the sum that fits a path best."""
    powers = factors[None, :] ** np.arange(len(path))[:, None]
    fitted = np.linalg.lstsq(powers, path.astype(complex), rcond=None)[0]
    return np.mean(np.abs(powers) ** 2, axis=0) * np.sum(np.abs(fitted) ** 2, axis=1)
