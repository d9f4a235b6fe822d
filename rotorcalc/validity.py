"""Where the model holds: the assumptions of film and linear theory, checked at each speed.

The program computes outside these limits too, and says so beside the result.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, TypeAlias, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.constants import atmosphere

from rotorcalc import heat
from rotorcalc.analysis import Sweep
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array
from rotorcalc.coefficient_table import CoefficientTable
from rotorcalc.coefficients import operating_points
from rotorcalc.display import Result, in_brief
from rotorcalc.films import film_of
from rotorcalc.films.tilting import TiltingFilm
from rotorcalc.gas import air_density, mean_free_path
from rotorcalc.geometry import Foil, Hydrostatic, TiltingPads
from rotorcalc.machine import Machine, Oil
from rotorcalc.recesses import recess_equilibrium
from rotorcalc.unbalance_response import orbit_ellipse

Level: TypeAlias = Literal["good", "caution", "outside"]

_LEVELS = np.array(["good", "caution", "outside"])
# Composite roughness of ground or honed surfaces [m]; assumed, as no input gives it.
ROUGHNESS = 1e-6
# The name of the one check that depends on the imbalance.
IMBALANCE_ORBIT = "Imbalance orbit over clearance"
# The name of the check of heat: its value is a rise in K.
HEAT = "Heat: rise of the oil in the film, in K"


@dataclass(frozen=True, eq=False)
class Check(Result):
    """One assumption of the model, checked at each speed.

    Attributes
    ----------
    name : str
        The quantity checked, in words and by its symbol.
    value : array, (...)
        The number compared with the limits [-]; of `HEAT` a rise [K].
    caution, limit : array, (...)
        Above `caution` the model is doubtful, above `limit` it fails; for a film thickness, below
        them [-].
    level : array of str, (...)
        The verdict: "good", "caution" or "outside".
    reason : str
        What goes wrong, in a sentence.
    """

    name: str
    value: Array
    caution: Array
    limit: Array
    level: NDArray[np.str_]
    reason: str

    def __repr__(self) -> str:
        """Return name, verdict and value in a line, as there are several in a tuple."""
        return f"<{self.name}: {self.worst}, {in_brief(self.value)}>"

    @cached_property
    def worst(self) -> Level:
        """The worst verdict over the speeds; "good" where there are none."""
        found = self.level
        return "outside" if "outside" in found else "caution" if "caution" in found else "good"


@checked
def validity(sweep: Sweep) -> tuple[Check, ...]:
    """Return how well a machine satisfies the model's assumptions, at each speed.

    Parameters
    ----------
    sweep : Sweep
        The machine at one speed or over many, (...).

    Returns
    -------
    tuple of Check
        The film model's own assumptions about the bearing, such as L/D for the short one; the
        Reynolds number of the film, ρΩRC/μ, against that at which Taylor's vortices appear,
        41.1√(R/C) (Taylor 1923), with turbulence at 2000; the smallest film against an assumed
        roughness of 1 µm, full film above 3 of it, and against the clearance; the journal's
        imbalance orbit and the rotor's static sag against the clearance; the rise of the oil in
        the film against that by which its viscosity halves (`HEAT`); on recesses the lowest
        pressure of the film against the atmospheric one; of a gas how far it is compressed, and
        the mean free path of its molecules against the smallest film. Numbers and verdicts have
        the shape (...). None for a table of coefficients, whose film is not known.
    """
    machine = sweep.machine
    bearing = machine.bearing
    if isinstance(bearing, CoefficientTable):
        return ()
    R, C = bearing.radius, bearing.radial_clearance
    film = sweep.minimum_film_thickness
    reynolds = _density(sweep) * sweep.speed * R * C / sweep.viscosity
    # Taylor vortices appear at ρΩRC/μ = 41.1√(R/C), or turbulence at 2000 where that comes first.
    # The second limit governs where R/C > 2368.
    vortices = min(41.1 * math.sqrt(R / C), 2000.0)
    swing = orbit_ellipse(sweep.journal_response).semi_major / C
    # Limits of the bearing and the sag do not depend on speed.
    everywhere = np.ones(sweep.speed.shape)
    return (
        *(_above(one.name, one.value * everywhere, one.caution, one.outside, one.reason)
          for one in film_of(bearing).limits),
        _above("Reynolds number of the film, ρΩRC/μ", reynolds, vortices, 2000.0,
               "vortices, and then turbulence, replace the laminar flow"),
        _below("Smallest film over roughness of 1 µm", film / ROUGHNESS, 10.0, 3.0,
               "surface asperities touch through the film"),
        _below("Smallest film over clearance, h/C", film / C, 0.1, 0.03,
               "so thin a film heats up and deforms the bearing, which the model neglects"),
        _above(IMBALANCE_ORBIT, swing, np.minimum(0.1, film / C), film / C,
               "linear coefficients hold for small orbits; at the limit it touches the wall"),
        _above("Static sag over clearance, Γ/C", machine.static_sag / C * everywhere, 1.0, 10.0,
               "so flexible a shaft is inclined in its bearings, which the model assumes aligned"),
        *_suction(sweep),
        *_unloaded(sweep),
        *_heat(sweep),
        *_gas(sweep),
    )  # fmt: skip


def _density(sweep: Sweep) -> Array | float:
    """Return the density of the lubricant [kg/m³], of a gas that of air at ambient pressure."""
    machine = sweep.machine
    if isinstance(machine.oil, Oil):
        return machine.oil.density
    return air_density(sweep.temperature, _ambient_pressure(machine))


def _ambient_pressure(machine: Machine) -> float:
    shape = machine.bearing.geometry
    return shape.ambient_pressure if isinstance(shape, Foil) else atmosphere


def _gas(sweep: Sweep) -> tuple[Check, ...]:
    """Return the checks of a gas: how far it is compressed, and whether it slips along the walls.

    The film is thinnest at the bearing's ends, where its pressure is ambient.
    """
    machine, bearing = sweep.machine, sweep.machine.bearing
    if isinstance(machine.oil, Oil):
        return ()
    p_a = _ambient_pressure(machine)
    ratio = bearing.radius / bearing.radial_clearance
    number = 6.0 * sweep.viscosity * sweep.speed * ratio**2 / p_a
    load = machine.static_load / (p_a * bearing.diameter * bearing.length)
    path = mean_free_path(sweep.viscosity, sweep.temperature, p_a)
    with np.errstate(divide="ignore"):  # the foil touches at the ends
        knudsen = path / sweep.minimum_film_thickness
    return (
        _above("Compressibility number, 6μΩ(R/C)²/pₐ", number, 10.0, 30.0,
               "waves of the gas that turn at half speed become too sharp for the mesh"),
        _above("Load over ambient pressure, F/(pₐ D L)", load * np.ones(number.shape), 1.5, 2.0,
               "the foil deflects by so much that its own bending counts"),
        _above("Molecules' mean free path over smallest film, λ/h", knudsen, 0.01, 0.1,
               "the gas slips along the walls, which the model neglects"),
    )  # fmt: skip


def _suction(sweep: Sweep) -> tuple[Check, ...]:
    """Return the check of a full film's lowest pressure, of bearings that do not cavitate."""
    machine = sweep.machine
    if not isinstance(machine.bearing.geometry, Hydrostatic):
        return ()
    # 0.0 − p, so that no suction is no minus zero.
    suction = (0.0 - recess_equilibrium(machine, sweep.speed).lowest_pressure) / atmosphere
    return (_above("Suction in the film over atmospheric pressure, −p/pₐ", suction, 0.1, 1.0,
                   "the oil cavitates there, where the model takes the film as full"),)  # fmt: skip


def _unloaded(sweep: Sweep) -> tuple[Check, ...]:
    """Return the check of tilting pads that carry nothing, of a bearing that has such pads."""
    if not isinstance(sweep.machine.bearing.geometry, TiltingPads):
        return ()
    points = operating_points(sweep.machine, sweep.speed)
    pads = film_of(sweep.machine.bearing).state(points).unloaded_pads
    count = np.zeros(sweep.speed.shape) if pads is None else pads.sum(axis=-1).astype(float)
    unloaded = _above("Pads that carry nothing", count, 0.0, np.inf,
                      "nothing holds a pad without a film: it may flutter and touch the journal "
                      "with its leading edge, which the model leaves out")  # fmt: skip
    if sweep.machine.bearing.geometry.rotational_stiffness == 0.0:
        return (unloaded,)
    film = cast("TiltingFilm", film_of(sweep.machine.bearing))
    others = film.other_films(points).sum(axis=-1).astype(float)
    return (
        unloaded,
        _above("Pads with two possible films", others, 0.0, np.inf,
               "which of the two a pad has depends on what came before; the results are for the "
               "one that it keeps as its flexure becomes stiffer"),
    )  # fmt: skip


def _heat(sweep: Sweep) -> tuple[Check, ...]:
    """Return the check of the oil's rise, and of the range of Walther's law where the oil has it.

    One viscosity stands for the whole film: over the rise it falls by exp(α ΔT), α its slope at the
    film's temperature. A given temperature may be right with any loss, if enough oil passes besides
    the side flow, so it is doubtful at most.
    """
    machine, oil = sweep.machine, sweep.machine.oil
    # A film's model may not know its loss; and a gas is cooled by other means than its own flow.
    if not isinstance(oil, Oil) or np.all(np.isnan(sweep.power_loss)):
        return ()
    alpha = oil.thinning(sweep.temperature)
    with np.errstate(divide="ignore"):  # a viscosity that does not fall is that of the whole film
        half, tenth = np.log(2.0) / alpha, np.log(10.0) / alpha
    if machine.supply is None:
        rise = heat.lone_rise(machine, sweep.power_loss, sweep.side_flow)
        recesses = isinstance(machine.bearing.geometry, Hydrostatic)
        more = "more oil, as from a higher supply pressure" if recesses else (
            "more oil through the grooves")  # fmt: skip
        found = _above(HEAT, rise, half, np.inf,
                       "if the side flow alone carried the loss: the given temperature then needs "
                       f"{more}")  # fmt: skip
    else:
        rise = sweep.outlet_temperature - machine.supply.temperature
        found = _above(HEAT, rise, half, tenth,
                       "the viscosity differs twofold and more from inlet to outlet, where the "
                       "model takes one for the whole film")  # fmt: skip
    if oil.law == "exponential":
        return (found,)
    nu = 1e6 * sweep.viscosity / oil.density
    return found, _below("Kinematic viscosity, ν in mm²/s", nu, 2.0, 0.7,
                         "below 2 mm²/s ASTM D341 adds terms to Walther's law")  # fmt: skip


def _above(
    name: str, value: Array, caution: Array | float, limit: Array | float, reason: str
) -> Check:
    level = _level(value > caution, value > limit)
    low, high = np.full_like(value, caution), np.full_like(value, limit)
    return Check(name, value, low, high, level, reason)


def _below(name: str, value: Array, caution: float, limit: float, reason: str) -> Check:
    level = _level(value < caution, value < limit)
    low, high = np.full_like(value, caution), np.full_like(value, limit)
    return Check(name, value, low, high, level, reason)


def _level(doubtful: ArrayLike, failed: ArrayLike) -> NDArray[np.str_]:
    return np.asarray(_LEVELS[np.add(doubtful, failed, dtype=int)])
