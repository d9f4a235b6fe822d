"""Rotors on fluid-film journal bearings: equilibrium, force coefficients, whirl and response.

SI units throughout, temperature in °C. X points along the static load, Y at +90° in the sense of
rotation. `analyse(machine, speed)` computes the whole chain; the modules hold its links.
"""

from rotorcalc import (
    batch,
    coefficient_files,
    coefficients,
    criteria,
    films,
    frames,
    heat,
    modes,
    oils,
    stability,
    unbalance_response,
)
from rotorcalc.analysis import FilmCurves, Sweep, analyse, film_curves
from rotorcalc.batch import read_machines
from rotorcalc.coefficient_files import read_coefficients
from rotorcalc.coefficient_table import CoefficientTable
from rotorcalc.comparison import BearingResult, compare_bearings
from rotorcalc.criteria import Amplification, LevelOne, amplification, level_one
from rotorcalc.design import onset_map, sensitivities, solve_onset
from rotorcalc.foils import foil_deflection, lift_off_speed
from rotorcalc.gas import Gas
from rotorcalc.geometry import (
    AxialGrooves,
    Elliptical,
    FloatingRing,
    Foil,
    Hydrostatic,
    Lobes,
    MultiDam,
    OffsetHalves,
    PartialArc,
    Plain,
    PressureDam,
    TiltingPads,
)
from rotorcalc.heat import HeatBalance, heat_balance
from rotorcalc.machine import JournalBearing, Machine, Oil, Rotor, Supply
from rotorcalc.measured import (
    MeasuredOrbit,
    MeasuredResponse,
    read_orbit,
    read_vibration_over_speed,
)
from rotorcalc.nonlinear import signals
from rotorcalc.nonlinear.continuation import BifurcationError
from rotorcalc.nonlinear.energy import EnergyBalance, energy_balance
from rotorcalc.nonlinear.hopf import Hopf, hopf
from rotorcalc.nonlinear.limit_cycles import Bifurcation, bifurcation
from rotorcalc.nonlinear.measured_onset import Onsets, measured_growth, onsets
from rotorcalc.nonlinear.transient import Start, Transient, TransientError, simulate, start_on_mode
from rotorcalc.oils import iso_oil
from rotorcalc.onset import (
    ModeOnset,
    Onset,
    RingWhirl,
    mode_onsets,
    onset_speed,
    ring_whirl,
)
from rotorcalc.onset.whirl import WhirlOnset, whirl_onset
from rotorcalc.presets import PRESETS, Preset
from rotorcalc.recesses import RecessEquilibrium, recess_equilibrium, recess_pressure
from rotorcalc.ring import RingEquilibrium, ring_equilibrium, ring_speed
from rotorcalc.tilting import pad_tilts
from rotorcalc.tolerances.statistics import Influence, Probability
from rotorcalc.tolerances.study import Tolerance, tolerance
from rotorcalc.unbalance_curves import unstable_ranges
from rotorcalc.unbalance_peaks import response_peaks
from rotorcalc.unbalance_response import OrbitEllipse, orbit_ellipse
from rotorcalc.units import rpm
from rotorcalc.validity import validity
from rotorcalc.variation import varied
from rotorcalc.working_point import load_for, stiffness_for

__version__ = "0.2.0"

__all__ = [
    "PRESETS",
    "Amplification",
    "AxialGrooves",
    "BearingResult",
    "Bifurcation",
    "BifurcationError",
    "CoefficientTable",
    "Elliptical",
    "EnergyBalance",
    "FilmCurves",
    "FloatingRing",
    "Foil",
    "Gas",
    "HeatBalance",
    "Hopf",
    "Hydrostatic",
    "Influence",
    "JournalBearing",
    "LevelOne",
    "Lobes",
    "Machine",
    "MeasuredOrbit",
    "MeasuredResponse",
    "ModeOnset",
    "MultiDam",
    "OffsetHalves",
    "Oil",
    "Onset",
    "Onsets",
    "OrbitEllipse",
    "PartialArc",
    "Plain",
    "Preset",
    "PressureDam",
    "Probability",
    "RecessEquilibrium",
    "RingEquilibrium",
    "RingWhirl",
    "Rotor",
    "Start",
    "Supply",
    "Sweep",
    "TiltingPads",
    "Tolerance",
    "Transient",
    "TransientError",
    "WhirlOnset",
    "amplification",
    "analyse",
    "batch",
    "bifurcation",
    "coefficient_files",
    "coefficients",
    "compare_bearings",
    "criteria",
    "energy_balance",
    "film_curves",
    "films",
    "foil_deflection",
    "frames",
    "heat",
    "heat_balance",
    "hopf",
    "iso_oil",
    "level_one",
    "lift_off_speed",
    "load_for",
    "measured_growth",
    "mode_onsets",
    "modes",
    "oils",
    "onset_map",
    "onset_speed",
    "onsets",
    "orbit_ellipse",
    "pad_tilts",
    "read_coefficients",
    "read_machines",
    "read_orbit",
    "read_vibration_over_speed",
    "recess_equilibrium",
    "recess_pressure",
    "response_peaks",
    "ring_equilibrium",
    "ring_speed",
    "ring_whirl",
    "rpm",
    "sensitivities",
    "signals",
    "simulate",
    "solve_onset",
    "stability",
    "start_on_mode",
    "stiffness_for",
    "tolerance",
    "unbalance_response",
    "unstable_ranges",
    "validity",
    "varied",
    "whirl_onset",
]
