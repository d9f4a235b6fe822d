"""Whatever a notebook's user passes by mistake, the answer is a ValueError that names it."""

import inspect
import re
from collections.abc import Callable
from dataclasses import replace
from types import ModuleType
from typing import Any

import numpy as np
import pytest

import rotorcalc as rc
from rotorcalc.films.dynamics import FilmDynamics
from rotorcalc.measured import orbit_table, response_table
from tests.machines import RPM, SHEET

SPEEDS = np.linspace(1000, 12000, 12) * RPM
SWEEP = rc.analyse(SHEET, SPEEDS)
K, C = SWEEP.stiffness[5], SWEEP.damping[5]
RING = replace(
    SHEET,
    bearing=replace(
        SHEET.bearing, geometry=rc.FloatingRing.around(0.150, 0.050, 60e-6), film="short"
    ),
)
FOIL = replace(
    SHEET, oil=rc.Gas(), load=100.0, bearing=replace(SHEET.bearing, geometry=rc.Foil.usual(60e-6))
)
RECESSED = replace(SHEET, bearing=replace(SHEET.bearing, geometry=rc.Hydrostatic()))
WARM = replace(SHEET, temperature=None, supply=rc.Supply(temperature=40.0))


def functions_of(module: ModuleType) -> dict[str, Callable]:
    """Return the functions that a module offers as its own."""
    offered = getattr(module, "__all__", None)
    return {
        name: value
        for name, value in vars(module).items()
        if inspect.isfunction(value)
        and not name.startswith("_")
        and (value.__module__ == module.__name__ if offered is None else name in offered)
    }


def public() -> dict[str, Callable]:
    """Return every function that `rotorcalc` and its modules in `__all__` offer, by its name."""
    found = {"films.short." + name: one for name, one in functions_of(rc.films.short).items()}
    for exported in rc.__all__:
        value = getattr(rc, exported)
        if inspect.ismodule(value):
            found |= {f"{exported}.{name}": one for name, one in functions_of(value).items()}
        elif inspect.isfunction(value):
            found[exported] = value
    return found


# Good values of arguments, by their names: one alone of each call is spoiled.
CASE = rc.read_machines("speed [rpm]\n6000", SHEET).cases[0]
GOOD: dict[str, Any] = {
    "machine": SHEET, "bearing": SHEET.bearing, "rotor": SHEET.rotor, "sweep": SWEEP,
    "oil": SHEET.oil,
    "motion": rc.simulate(SHEET, 600.0, revolutions=5), "K": K, "C": C, "k": K, "c": C,
    "speed": 600.0, "eps": 0.5, "sigma": 1.0, "sommerfeld": 1.0, "theta": 1.0, "zeta": 0.0,
    "position": (0.1, 0.0), "velocity": (0.1, 0.0), "length_to_radius": 1.0, "eigenvalue": 1j,
    "eigenvalues": np.ones((4, 4)) * 1j, "stiffness": 1.0, "mass": 1.0, "coefficients": K,
    "angle": 0.1, "xx": 1.0, "xy": 1.0, "yx": 1.0, "yy": 1.0, "x": 1.0, "y": 1.0,
    "disk": SWEEP.disk_response, "journal": SWEEP.journal_response, "response": SWEEP.disk_response,
    "threshold_speed": 1.0, "equivalent_stiffness": 1.0, "sag_ratio": 1.0, "amplitude": 1e-6,
    "revolutions": 5, "grade": "ISO VG 32", "temperature": 40.0, "temperatures": (40.0, 60.0),
    "viscosities": (0.02, 0.01), "values": {"load": 1e3}, "vary": "load", "target": 900.0,
    "low": 1e3, "high": 2e3, "xs": [1e3, 2e3], "ys": [0.1], "path": np.ones((300, 2)), "step": 0.1,
    "dynamics": FilmDynamics, "frequency": 1.0, "power_loss": 100.0, "side_flow": 1e-5,
    "shapes": rc.analyse(SHEET, 600.0).mode_shapes(),
    "cross_coupling": 1e6, "power": 1e6, "diameter": 0.4, "width": 0.02,
    "amplification_factor": 5.0, "above": True, "whirl_ratio": 0.5,
    "spreads": {"load": ("uniform", 1e3, 2e3)}, "natural_frequency": 100.0,
    "load": 100.0, "viscosity": 0.01,
    "damping": 1.0, "source": rc.coefficient_files.written(SPEEDS, SWEEP.stiffness, SWEEP.damping),
    "text": "speed [rpm]\n6000", "cases": [CASE], "results": [], "columns": {"line": [2]},
}  # fmt: skip
# Where a name means something else.
ITS_OWN: dict[str, dict[str, Any]] = {
    "coefficient_files.written": {
        "speed": SPEEDS,
        "stiffness": SWEEP.stiffness,
        "damping": SWEEP.damping,
    },
    "criteria.campbell": {"speed": SPEEDS},
    "criteria.imbalance_of_grade": {"grade": "G 2.5"},
    "criteria.permissible_eccentricity": {"grade": "G 2.5"},
    "onset_map": {"x": "load", "y": "temperature"},
    "response_peaks": {"speed": SPEEDS},
    "foil_deflection": {"machine": FOIL},
    "lift_off_speed": {"machine": FOIL},
    "mode_onsets": {"machine": RING},
    "read_orbit": {"table": orbit_table(GOOD["motion"])},
    "read_vibration_over_speed": {
        "table": response_table(SPEEDS, SWEEP.disk_response),
        "reading": "0-p",
        "phase": "lag",
    },
    "recess_equilibrium": {"machine": RECESSED},
    "recess_pressure": {"machine": RECESSED},
    "ring_equilibrium": {"machine": RING},
    "ring_speed": {"machine": RING},
    "ring_whirl": {"machine": RING},
    "coefficients.rising_speed": {"speed": SPEEDS},
    "heat.hottest_speed": {"machine": WARM},
    "heat.heat_curves": {"machine": WARM},
    "heat.outlet_temperature": {"machine": WARM},
    "films.reduced": {"dynamics": rc.coefficients.dynamics(SHEET, 600.0)},
}
# A text where a machine is meant, nothing, a bearing or a dict: what a user has at hand.
HOSTILE = {"text": "x", "None": None, "dict": {}, "bearing": SHEET.bearing, "list": ["x", 1.0]}
# What is good for one argument: an empty change, an empty table, a file's text.
HARMLESS = {
    ("varied", "values", "dict"),
    *((f"batch.to_{form}", "columns", "dict") for form in ("csv", "json", "report")),
    *((f"{where}read_machines", "text", "text") for where in ("", "batch.")),
    ("read_orbit", "table", "text"),
    ("read_vibration_over_speed", "table", "text"),
    *((f"{where}read_coefficients", "units", "dict") for where in ("", "coefficient_files.")),
    ("signals.fitted_modes", "noise", "None"),
}
# A building block whose argument is a word of its own error.
OWN_WORDS = {("coefficients.rising_speed", "name"), ("modes.rotor_terms", "number")}

CALLS = [
    pytest.param(function, name, parameter, value, id=f"{name}({parameter.name}={kind})")
    for name, function in public().items()
    for parameter in inspect.signature(function).parameters.values()
    for kind, value in HOSTILE.items()
    if (name, parameter.name, kind) not in HARMLESS
    and (name, parameter.name) not in OWN_WORDS
    and not (kind == "bearing" and parameter.name == "bearing")
    and not (value is None and parameter.default is None)
]


def good(name: str, function: Callable) -> dict[str, Any]:
    """Return good values of the arguments that a function must have."""
    known = GOOD | ITS_OWN.get(name, {})
    needed = inspect.signature(function).parameters.values()
    return {one.name: known[one.name] for one in needed if one.default is one.empty}


@pytest.mark.parametrize(("function", "name", "parameter", "value"), CALLS)
def test_a_wrong_argument_is_named_in_a_valueerror(function, name, parameter, value):
    with pytest.raises(ValueError) as caught:  # noqa: PT011 - the message is looked at
        function(**good(name, function) | {parameter.name: value})
    message = str(caught.value)
    # An unknown input is named by itself.
    assert re.search(rf"\b{parameter.name}\b", message) or message.startswith("'x': no input")


@pytest.mark.parametrize("word", ["rigid", "no", 1, 0.0, None, []])
@pytest.mark.parametrize(
    ("name", "flag"),
    [
        (name, parameter.name)
        for name, function in public().items()
        for parameter in inspect.signature(function).parameters.values()
        if parameter.annotation is bool
    ],
)
def test_a_word_is_neither_true_nor_false(name, flag, word):
    function = public()[name]
    with pytest.raises(ValueError, match=rf"^{flag} = .*: must be True or False$"):
        function(**good(name, function) | {flag: word})


def test_the_message_names_argument_value_and_admitted_kind():
    with pytest.raises(ValueError, match=r"^machine = 'x': must be a Machine$"):
        rc.analyse("x", 5.0)
    with pytest.raises(ValueError, match=r"^flexible = 'rigid': must be True or False$"):
        rc.onset_speed(SHEET, "rigid")
    with pytest.raises(ValueError, match=r"^k: must have the shape \(\.\.\., 2, 2\), has \(3,\)$"):
        rc.whirl_onset([1.0, 2.0, 3.0], C)
