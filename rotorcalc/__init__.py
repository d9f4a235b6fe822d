"""Rotors on fluid-film journal bearings: equilibrium, force coefficients, whirl and response.

SI units throughout, temperature in °C. X points along the static load, Y at +90° in the sense of
rotation. `analyse(machine, speed)` computes the whole chain; the modules hold its links.
"""

from rotorcalc import coefficients, films, frames, modes, stability, unbalance_response
from rotorcalc.analysis import FilmCurves, Sweep, analyse, film_curves
from rotorcalc.machine import JournalBearing, Machine, Oil, Rotor
from rotorcalc.nonlinear import signals
from rotorcalc.nonlinear.continuation import BifurcationError
from rotorcalc.nonlinear.energy import EnergyBalance, energy_balance
from rotorcalc.nonlinear.hopf import Hopf, hopf
from rotorcalc.nonlinear.limit_cycles import Bifurcation, bifurcation
from rotorcalc.nonlinear.measured_onset import Onsets, onsets
from rotorcalc.nonlinear.transient import Start, Transient, TransientError, simulate, start_on_mode
from rotorcalc.onset import Onset, onset_speed
from rotorcalc.onset.whirl import WhirlOnset, whirl_onset
from rotorcalc.presets import PRESETS, Preset
from rotorcalc.unbalance_response import OrbitEllipse, orbit_ellipse

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
    "signals",
    "simulate",
    "stability",
    "start_on_mode",
    "unbalance_response",
    "whirl_onset",
]
