"""Rotors on fluid-film journal bearings: equilibrium, force coefficients, whirl and response.

SI units throughout, temperature in °C. X points along the static load, Y at +90° in the sense of
rotation. `analyse(machine, speed)` computes the whole chain; the modules hold its links.
"""

from rotorcalc import coefficients, films, frames, modes, response, signals, stability
from rotorcalc.analysis import FilmCurves, Sweep, analyse, film_curves
from rotorcalc.cycles import Bifurcation, BifurcationError, bifurcation
from rotorcalc.energy import EnergyBalance, energy_balance
from rotorcalc.machine import JournalBearing, Machine, Oil, Rotor
from rotorcalc.normal_form import Hopf, hopf
from rotorcalc.onset_check import Onsets, onsets
from rotorcalc.presets import PRESETS, Preset
from rotorcalc.response import OrbitEllipse, orbit_ellipse
from rotorcalc.stability import Onset, WhirlOnset, onset_speed, whirl_onset
from rotorcalc.transient import Start, Transient, TransientError, simulate, start_on_mode

__version__ = "0.1.0"

__all__ = [
    "PRESETS",
    "Bifurcation",
    "BifurcationError",
    "EnergyBalance",
    "FilmCurves",
    "Hopf",
    "JournalBearing",
    "Machine",
    "Oil",
    "Onset",
    "Onsets",
    "OrbitEllipse",
    "Preset",
    "Rotor",
    "Start",
    "Sweep",
    "Transient",
    "TransientError",
    "WhirlOnset",
    "analyse",
    "bifurcation",
    "coefficients",
    "energy_balance",
    "film_curves",
    "films",
    "frames",
    "hopf",
    "modes",
    "onset_speed",
    "onsets",
    "orbit_ellipse",
    "response",
    "signals",
    "simulate",
    "stability",
    "start_on_mode",
    "whirl_onset",
]
