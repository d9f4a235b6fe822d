"""Rotors on fluid-film journal bearings: equilibrium, force coefficients, whirl and response.

SI units throughout, temperature in °C. X points along the static load, Y at +90° in the sense of
rotation. `analyse(machine, speed)` computes the whole chain; the modules hold its links.
"""

from rotorcalc import coefficients, films, frames, modes, response, stability
from rotorcalc.analysis import FilmCurves, Sweep, analyse, film_curves
from rotorcalc.machine import JournalBearing, Machine, Oil, Rotor
from rotorcalc.presets import PRESETS, Preset
from rotorcalc.response import OrbitEllipse, orbit_ellipse
from rotorcalc.stability import Onset, WhirlOnset, onset_speed, whirl_onset
from rotorcalc.transient import Start, Transient, TransientError, simulate

__version__ = "0.1.0"

__all__ = [
    "PRESETS",
    "FilmCurves",
    "JournalBearing",
    "Machine",
    "Oil",
    "Onset",
    "OrbitEllipse",
    "Preset",
    "Rotor",
    "Start",
    "Sweep",
    "Transient",
    "TransientError",
    "WhirlOnset",
    "analyse",
    "coefficients",
    "film_curves",
    "films",
    "frames",
    "modes",
    "onset_speed",
    "orbit_ellipse",
    "response",
    "simulate",
    "stability",
    "whirl_onset",
]
