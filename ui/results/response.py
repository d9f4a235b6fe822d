"""Results of the imbalance response: the orbits at the running speed, and where they peak."""

import math

import numpy as np

from rotorcalc.unbalance_peaks import ResponsePeaks
from rotorcalc.unbalance_response import orbit_ellipse
from ui.format import tex
from ui.notes.equations import equation
from ui.results.record import Result


def _highest(peaks: ResponsePeaks) -> float:
    """Return the speed of the highest peak [rad/s], NaN where there is none."""
    return float(peaks.speed[np.argmax(peaks.amplitude)]) if len(peaks.speed) else math.nan


def _orbit(response: np.ndarray) -> tuple[complex, complex, float]:
    orbit = orbit_ellipse(response)
    return complex(orbit.forward), complex(orbit.backward), float(orbit.semi_major)


def _circles(response: np.ndarray) -> str:
    forward, backward, size = _orbit(response)
    return f"{tex(abs(forward))} + {tex(abs(backward))} = {tex(size, 'm')}"


_MOTION = equation("5.38")
_AXES = (
    "Semi-major axis; f and b are the orbit's forward and backward circles, (X ± jY)/2. Read zero "
    "to peak (0-p) it is a, peak to peak (p-p) 2a."
)
RESPONSE: tuple[Result, ...] = (
    Result(
        "disk_amplitude", "Disk orbit", "amplitude",
        lambda c: _orbit(c.point.disk_response)[2], "Eq. 5.38", r"a = |f| + |b|",
        lambda c: _circles(c.point.disk_response),
        _AXES,
        cites=_MOTION,
    ),
    Result(
        "journal_amplitude", "Journal orbit", "amplitude",
        lambda c: _orbit(c.point.journal_response)[2], "Eq. 5.38", r"a = |f| + |b|",
        lambda c: _circles(c.point.journal_response),
        _AXES,
        cites=_MOTION,
    ),
    Result(
        "disk_peak", "Disk peaks at", "speed", lambda c: _highest(c.disk_peaks),
        "Eq. 5.38", r"\frac{da}{d\Omega} = 0", lambda c: tex(_highest(c.disk_peaks), "rad/s"),
        "Up to the top speed.", cites=_MOTION,
    ),
    Result(
        "journal_peak", "Journal peaks at", "speed",
        lambda c: _highest(c.journal_peaks), "Eq. 5.38", r"\frac{da}{d\Omega} = 0",
        lambda c: tex(_highest(c.journal_peaks), "rad/s"),
        "Its highest peak up to the top speed.", cites=_MOTION,
    ),
)  # fmt: skip
