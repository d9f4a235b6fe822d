"""Peaks of the response to imbalance over speed, however narrow.

A mode whose frequency equals the running speed, |Im λ| = Ω, is in resonance with the imbalance, in
a band of width |Re λ|. With light damping that may be a millionth of the spacing of a sweep. So
each such crossing is located along the eigenvalues, the sweep is refined around it, and the maxima
of the refined sweep are computed to full precision. A peak without a crossing is wide, and a
maximum of the sweep as it is.

Source: San Andrés, Notes 5, Eq. 5.38, as in `unbalance_response`.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc import modes
from rotorcalc.analysis import Sweep
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, BoolArray, ComplexArray, IntArray
from rotorcalc.coefficients import rising_speed, stiffness_and_damping
from rotorcalc.display import Result
from rotorcalc.machine import Machine, Rotor
from rotorcalc.unbalance_response import Rotors, orbit_sizes, synchronous_response

# The film's synchronous stiffness and damping over speed, each (n, 2, 2).
_Film: TypeAlias = tuple[Array, Array]

# Speeds of a sweep, in equal ratios, at which eigenvalues are computed: between two of them a
# mode's frequency is taken to cross the running speed at most once.
_ASKED = 16
# A resonance wider than this many spacings of the sweep shows in the sweep itself.
_WIDE = 4.0
# A crossing is located where the frequency is off by this share of |Re λ|, or to rounding.
_CLOSE, _ROUNDING = 0.1, 1e-14
# Speeds around a crossing, in units of |Re λ|, densest in the middle: where two modes lie close
# together their peaks are displaced by a few units.
_AROUND = 16.0 * np.sinh(np.linspace(-4.0, 4.0, 33)) / np.sinh(4.0)
# Shares of the first and of the last spacing at which the response is computed too.
_INSIDE = np.geomspace(1e-3, 0.6, 8)
# Spacings of a first look between two speeds. In a second one, around the top of the parabola
# through its largest values, they grow with the distance: there the next top is exact enough.
_FIRST_LOOK = np.linspace(0.0, 1.0, 33)
_SECOND_LOOK = np.sinh(np.linspace(0.0, 3.2, 17)) / np.sinh(3.2)


@dataclass(frozen=True, eq=False)
class ResponsePeaks(Result):
    """Local maxima of an orbit's size over speed, each field of shape (peaks,).

    Attributes
    ----------
    speed : array
        Running speed, Ω [rad/s].
    amplitude : array
        Semi-major axis of the orbit [m].
    """

    speed: Array
    amplitude: Array


@checked
def response_peaks(machine: Machine, speed: ArrayLike, *, at: str = "disk") -> ResponsePeaks:
    """Return the speeds at which the orbit is largest: local maxima of its semi-major axis.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (n,)
        Rising speeds, Ω [rad/s]; a peak lies within them. A resonance is found however narrow, a
        wide maximum where the speeds resolve it.
    at : str
        Whose orbit, "disk" or "journal".

    Returns
    -------
    ResponsePeaks
        Speeds and amplitudes, the speeds to 1e-6 of the spacing.

    Raises
    ------
    ValueError
        Where `at` is neither, a speed is not positive and finite, or they do not rise.
    """
    if at not in ("disk", "journal"):
        raise ValueError(f"at = {at!r}: must be 'disk' or 'journal'")
    speeds, body = rising_speed(speed), ("disk", "journal").index(at)
    film = stiffness_and_damping(machine, speeds)
    size = orbit_sizes(*synchronous_response(machine.rotor, *film, speeds))
    return _peaks(machine, speeds, film, size[[body]], [body])[0]


@checked
def both_peaks(sweep: Sweep) -> tuple[ResponsePeaks, ResponsePeaks]:
    """Return the peaks of the disk's response and of the journals' from one search.

    Parameters
    ----------
    sweep : Sweep
        A machine over rising speeds, (n,).

    Returns
    -------
    disk, journal : ResponsePeaks
        As `response_peaks` gives them.

    Raises
    ------
    ValueError
        Where the speeds do not rise.
    """
    rising_speed(sweep.speed, name="sweep.speed")
    known = orbit_sizes(sweep.disk_response, sweep.journal_response)
    film = sweep.stiffness, sweep.damping
    disk, journal = _peaks(sweep.machine, sweep.speed, film, known, [0, 1])
    return disk, journal


def _peaks(
    machine: Machine, speed: Array, film: _Film, known: Array, bodies: list[int]
) -> list[ResponsePeaks]:
    """Return the peaks of bodies, 0 for the disk and 1 for the journals.

    From the film and the sizes of their orbits, (bodies, n), at speeds.
    """
    rotor = machine.rotor
    near = _near_resonances(machine, rotor, speed, film)
    # The sizes that are known are used again; only speeds near resonances are added.
    dense, size = _denser(
        speed, known, near, lambda more: _orbit_sizes(machine, rotor, more)[bodies]
    )
    which, place = np.nonzero(_is_peak(size))
    if not len(which):
        return [ResponsePeaks(speed=np.empty(0), amplitude=np.empty(0)) for _ in bodies]
    body = np.array(bodies)[which]
    tops, sizes = _tops(machine, rotor, body, dense[place], dense[place + 2])
    return [ResponsePeaks(speed=tops[body == i], amplitude=sizes[body == i]) for i in bodies]


def disk_peak_speeds(
    machine: Machine, rotors: Sequence[Rotor], speed: Array, film: _Film, size: Array
) -> Array:
    """Return the speeds of all peaks of several rotors' disks in one machine's bearings.

    Parameters
    ----------
    machine : Machine
        The machine; of its own rotor only the load is used.
    rotors : sequence of Rotor
        The m rotors.
    speed : array, (n,)
        Rising speeds, Ω [rad/s].
    film : pair of arrays, (n, 2, 2)
        The film's K [N/m] and C [N·s/m] at these speeds.
    size : array, (m, n)
        Semi-major axes of the disks' orbits at these speeds.

    Returns
    -------
    array, (peaks,)
        As `response_peaks` gives them, the first rotor's first [rad/s].
    """
    group = Rotors.of(rotors)
    near = np.concatenate([_near_resonances(machine, rotor, speed, film) for rotor in rotors])
    dense, sizes = _denser(speed, size, near, lambda more: _orbit_sizes(machine, group, more)[0])
    which, place = np.nonzero(_is_peak(sizes))
    if not len(which):
        return np.empty(0)
    disk = np.zeros_like(which)
    return _tops(machine, group.at(which), disk, dense[place], dense[place + 2])[0]


def _near_resonances(machine: Machine, rotor: Rotor, speed: Array, film: _Film) -> Array:
    """Return speeds within a sweep around each narrow resonance of a rotor."""
    crossing, width = _resonances(machine, rotor, speed, film)
    near = (crossing[:, None] + width[:, None] * _AROUND).ravel()
    return near[(near > speed[0]) & (near < speed[-1])]


def _resonances(machine: Machine, rotor: Rotor, speed: Array, film: _Film) -> tuple[Array, Array]:
    """Return the speeds Ω = |Im λ| of narrow resonances within a sweep, and their |Re λ|.

    The jth smallest frequency is a continuous function of speed, whichever mode it belongs to, so
    no mode has to be followed: regula falsi and bisection on it alternate.
    """
    ratio = np.linspace(0.0, 1.0, _ASKED)
    evenly: Array = speed[0] * (speed[-1] / speed[0]) ** ratio
    asked = np.unique(np.searchsorted(speed[:-1], evenly))
    places, values = speed[asked], _by_frequency(rotor, film[0][asked], film[1][asked])
    above = values.imag - places[:, None]
    i, j = np.nonzero((above[:-1] > 0.0) != (above[1:] > 0.0))
    width = np.minimum(np.abs(values.real[i, j]), np.abs(values.real[i + 1, j]))
    narrow = width < _WIDE * np.diff(speed).max()
    i, j, width = i[narrow], j[narrow], width[narrow]
    low, high, at_low, at_high = places[i], places[i + 1], above[i, j], above[i + 1, j]
    middle, row, turn = low, np.arange(len(i)), 0
    while len(i):
        # Bisection every other turn: regula falsi alone creeps where the frequency bends.
        share = 0.5 if turn % 2 else at_low / (at_low - at_high)
        middle = low + share * (high - low)
        here = _by_frequency(rotor, *stiffness_and_damping(machine, middle))[row, j]
        error, width = here.imag - middle, np.minimum(width, np.abs(here.real))
        if np.all((np.abs(error) <= _CLOSE * width) | (high - low <= _ROUNDING * high)):
            return middle, np.abs(here.real)
        left = (error > 0.0) == (at_low > 0.0)
        low, at_low = np.where(left, middle, low), np.where(left, error, at_low)
        high, at_high = np.where(left, high, middle), np.where(left, at_high, error)
        turn += 1
    return middle, width


def _by_frequency(rotor: Rotor, K: Array, C: Array) -> ComplexArray:
    """Return the eigenvalues by rising frequency, (..., n/2), one of each conjugate pair.

    With the synchronous coefficients: where a frequency is the running speed they are its own.
    """
    values = modes.eigenvalues(rotor, K, C)
    order = np.argsort(values.imag, axis=-1)[..., values.shape[-1] // 2 :]
    return np.take_along_axis(values, order, axis=-1)


def _denser(
    speed: Array, size: Array, near: Array, sizes: Callable[[Array], Array]
) -> tuple[Array, Array]:
    """Return speeds, (n,), and sizes, (m, n), of a sweep with more inserted, also at its ends."""
    # A maximum between the first two speeds, or the last two, is at no speed of the sweep.
    first = speed[0] + (speed[1] - speed[0]) * _INSIDE
    last = speed[-1] - (speed[-1] - speed[-2]) * _INSIDE
    more = np.concatenate([near, first, last])
    dense, order = np.unique(np.concatenate([speed, more]), return_index=True)
    return dense, np.concatenate([size, sizes(more)], axis=-1)[:, order]


def _orbit_sizes(machine: Machine, rotor: Rotor | Rotors, speed: Array) -> Array:
    K, C = stiffness_and_damping(machine, speed)
    return orbit_sizes(*synchronous_response(rotor, K, C, speed))


def _is_peak(size: Array) -> BoolArray:
    return (size[:, 1:-1] > size[:, :-2]) & (size[:, 1:-1] >= size[:, 2:])


def _tops(
    machine: Machine, rotor: Rotor | Rotors, body: IntArray, low: Array, high: Array
) -> tuple[Array, Array]:
    """Return speeds and heights of the peaks between two speeds each, (n,), all at once.

    `body` is 0 for a peak of the disk, 1 for one of the journal. The top of a parabola stands for
    that of the curve, as ever closer speeds would lose the flat top in rounding errors.
    """
    columns = np.arange(len(low))

    def looked(grid: Array) -> tuple[Array, Array]:
        """Return the three speeds about the largest value of each peak, and the values there."""
        size = _orbit_sizes(machine, rotor, grid)[body, :, columns].T
        three = size[1:-1].argmax(axis=0) + np.array([[0], [1], [2]])
        return grid[three, columns], size[three, columns]

    speeds, sizes = looked(low + (high - low) * _FIRST_LOOK[:, None])
    top, _ = _vertex(speeds, sizes)
    reach = _SECOND_LOOK[1:, None]
    below, above = top - reach[::-1] * (top - speeds[0]), top + reach * (speeds[2] - top)
    return _vertex(*looked(np.concatenate([below, top[None], above])))


def _vertex(x: Array, y: Array) -> tuple[Array, Array]:
    """Return place and height of the top of parabolas through three points each, (3, n).

    Where rounding leaves no downward curvature the middle point stays.
    """
    left, right = (y[1] - y[0]) / (x[1] - x[0]), (y[2] - y[1]) / (x[2] - x[1])
    bend = (right - left) / (x[2] - x[0])
    slope = left + bend * (x[1] - x[0])
    shift = slope / np.where(bend < 0.0, bend, -np.inf) / -2.0
    return x[1] + shift, y[1] + 0.5 * slope * shift
