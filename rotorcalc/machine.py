"""The machine: oil, journal bearing, rotor, and the three together.

A symmetric rotor of mass 2M turns on two identical journal bearings. Everything but the rotor's
mass is per bearing. SI units inside; temperature in °C. The records are frozen and hashable, so
that they serve as keys of a cache, and each checks its values once, when it is made.
"""

import json
import math
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Any, ClassVar, Self, TypeAlias, cast

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import g, zero_Celsius

from rotorcalc.arrays import Array, real_array, shown
from rotorcalc.coefficient_table import BearingRecord, CoefficientTable
from rotorcalc.gas import Gas, Lubricant
from rotorcalc.geometry import WIDEST, Geometry, Plain
from rotorcalc.records import Bound, Choice, Record, from_tree, parsed, to_tree

# Version 2 added the bearing's geometry and leaves defaults out; version 1 is still read.
FORMAT_VERSION = 2
# Where a program may keep what it shows of a machine; no field of the machine has this name.
APP = "app"
_PLAIN = Plain()
# The range of the charts of ASTM D341 [°C]: outside it no law of an oil's viscosity means anything.
COLDEST, HOTTEST = -70.0, 370.0


@dataclass(frozen=True, kw_only=True)
class Oil(Lubricant):
    """A lubricant whose viscosity falls with temperature by one of two laws.

    Both laws have the viscosity μ_R and the slope α = −d ln μ/dT at the reference temperature. The
    exponential law keeps that slope everywhere. Walther's law, log10 log10(ν + 0.7) = A − B log10 T
    with the kinematic viscosity ν in mm²/s and T in kelvin (ASTM D341), flattens as mineral oils
    do: the oil stays thicker when hot.

    Parameters
    ----------
    reference_viscosity : float
        Viscosity at the reference temperature, μ_R [Pa·s], positive.
    reference_temperature : float
        Reference temperature, T_R [°C].
    temperature_coefficient : float
        Viscosity-temperature coefficient at the reference temperature, α [1/°C], zero or more.
    density : float
        Density, ρ [kg/m³]. It enters the film's Reynolds number, its added mass, the heat that the
        oil carries and ν = μ/ρ of Walther's law; the default is that of a mineral turbine oil.
    heat_capacity : float
        Specific heat capacity, c [J/(kg·K)]; the default is that of a mineral oil near 50 °C.
    law : str
        "exponential" or "walther".

    Raises
    ------
    ValueError
        Naming the field, its value and its bound; also where Walther's law does not apply, at a
        kinematic viscosity of 0.3 mm²/s or less.
    """

    kind: ClassVar[str] = "oil"

    reference_viscosity: Annotated[float, Bound("Pa·s", above=0.0)]
    # Absolute zero, −273.15 °C.
    reference_temperature: Annotated[float, Bound("°C", at_least=-zero_Celsius)]
    temperature_coefficient: Annotated[float, Bound("1/°C", at_least=0.0)]
    density: Annotated[float, Bound("kg/m³", above=0.0)] = 860.0
    heat_capacity: Annotated[float, Bound("J/(kg·K)", above=0.0)] = 2000.0
    law: Annotated[str, Choice(("exponential", "walther"))] = "exponential"

    def __post_init__(self) -> None:
        super().__post_init__()
        # log10(ν + 0.7) must have a logarithm, and T one too.
        if self.law == "walther" and not (
            self._shifted > 1.0 and self.reference_temperature > -zero_Celsius
        ):
            raise ValueError(
                f"reference_viscosity = {self.reference_viscosity:g} Pa·s at "
                f"{self.reference_temperature:g} °C: Walther's law needs a kinematic viscosity "
                "above 0.3 mm²/s and a temperature above absolute zero"
            )

    @property
    def _shifted(self) -> float:
        """ν + 0.7 of Walther's law at the reference temperature, ν in mm²/s."""
        return self.reference_viscosity / self.density * 1e6 + 0.7

    @property
    def _steepness(self) -> float:
        """B of Walther's law, from α = (ν + 0.7) ln(ν + 0.7) B/(ν T)."""
        z, T = self._shifted, self.reference_temperature + zero_Celsius
        return self.temperature_coefficient * (z - 0.7) * T / (z * math.log(z))

    def viscosity(self, temperature: ArrayLike) -> Array:
        """Return the viscosity, by default μ = μ_R exp(−α(T − T_R)) (sheet of the notes).

        Parameters
        ----------
        temperature : array_like, (...)
            Film temperature, T [°C].

        Returns
        -------
        array, (...)
            Viscosity, μ [Pa·s].

        Raises
        ------
        ValueError
            Where a temperature is not finite, or below absolute zero.

        Examples
        --------
        >>> oil = Oil(
        ...     reference_viscosity=0.02, reference_temperature=50.0, temperature_coefficient=0.03
        ... )
        >>> float(oil.viscosity(50.0))
        0.02
        """
        T = real_array("temperature", temperature)
        if not (np.isfinite(T) & (-zero_Celsius <= T)).all():
            problem = f"below absolute zero, {-zero_Celsius} °C"
            if not np.isfinite(T).all():
                problem = "must be finite"
            raise ValueError(f"temperature = {shown(temperature)} °C: {problem}")
        if self.law == "walther":
            ratio = (T + zero_Celsius) / (self.reference_temperature + zero_Celsius)
            # The law over its value at T_R: ln(ν + 0.7) goes as T^−B.
            with np.errstate(divide="ignore"):  # infinite at absolute zero
                z = np.exp(math.log(self._shifted) * ratio**-self._steepness)
            return np.asarray((z - 0.7) * 1e-6 * self.density)
        rise = T - self.reference_temperature
        return self.reference_viscosity * np.exp(-self.temperature_coefficient * rise)

    def thinning(self, temperature: ArrayLike) -> Array:
        """Return the relative slope of the viscosity, −d ln μ/dT.

        Parameters
        ----------
        temperature : array_like, (...)
            Temperature, T [°C].

        Returns
        -------
        array, (...)
            [1/°C]; α at the reference temperature, and everywhere by the exponential law.

        Raises
        ------
        ValueError
            As `viscosity` does.
        """
        mu = self.viscosity(temperature)
        if self.law == "exponential":
            return np.full(mu.shape, self.temperature_coefficient)
        nu = mu / self.density * 1e6
        T = real_array("temperature", temperature) + zero_Celsius
        return (nu + 0.7) * np.log(nu + 0.7) * self._steepness / (nu * T)

    def temperature(self, viscosity: ArrayLike) -> Array:
        """Return the temperature at which the oil has a viscosity.

        Parameters
        ----------
        viscosity : array_like, (...)
            Viscosity, μ [Pa·s], zero or more.

        Returns
        -------
        array, (...)
            Temperature, T [°C]; infinite where the law never falls to that viscosity.
        """
        mu = real_array("viscosity", viscosity)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            T = self._at(mu)
        # With α = 0 any temperature gives the viscosity, or none.
        return np.where(mu >= 0.0, np.where(np.isnan(T), np.inf, T), np.nan)

    def _at(self, mu: Array) -> Array:
        """Return the temperature of viscosities; NaN for 0/0, where α = 0."""
        if self.law == "walther":
            ln_z = np.log(np.maximum(mu / self.density * 1e6 + 0.7, 1.0))
            ratio = (math.log(self._shifted) / ln_z) ** (1.0 / np.float64(self._steepness))
            return (self.reference_temperature + zero_Celsius) * ratio - zero_Celsius
        thinner = np.log(self.reference_viscosity / mu)
        return self.reference_temperature + thinner / np.float64(self.temperature_coefficient)

    @property
    def volumetric_heat(self) -> float:
        """Heat that a volume takes up, ρc [J/(m³·K)]."""
        return self.density * self.heat_capacity


@dataclass(frozen=True, kw_only=True)
class Supply(Record):
    """The oil supplied to a bearing: with the film's loss it sets the film's temperature (`heat`).

    Parameters
    ----------
    temperature : float
        Temperature of the oil supplied, T_in [°C].
    flow : float
        What passes one bearing's grooves besides the side flow of its film [m³/s], zero or more.
    heat_share : float
        Share of the loss that the oil carries away [-], 0 to 1; the rest leaves by shaft and
        housing.

    Raises
    ------
    ValueError
        Naming the field, its value and its bound.
    """

    temperature: Annotated[float, Bound("°C", at_least=COLDEST)]
    flow: Annotated[float, Bound("m³/s", at_least=0.0)] = 0.0
    heat_share: Annotated[float, Bound("-", at_least=0.0)] = 1.0

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.temperature > HOTTEST:
            raise ValueError(
                f"temperature = {self.temperature:g} °C: must be at most {HOTTEST:g} °C, where "
                "the charts of ASTM D341 for the viscosity of oils end"
            )
        if self.heat_share > 1.0:
            raise ValueError(f"heat_share = {self.heat_share:g} -: must be at most 1")


@dataclass(frozen=True, kw_only=True)
class JournalBearing(BearingRecord):
    """A journal bearing.

    Parameters
    ----------
    diameter : float
        Journal diameter, D = 2R [m], positive.
    length : float
        Axial length, L [m], positive.
    radial_clearance : float
        Radial clearance, C [m], positive; in every kind of bore the machined clearance of a pad.
    geometry : Geometry
        The shape of the bore; by default a full circle.
    film : str or None
        The film model of this bearing: "short" is the short bearing in closed form, "finite"
        solves Reynolds' equation for this length, "coarse" does on a mesh so coarse that another
        bore takes a third of the time. None for the geometry's default.

    Raises
    ------
    ValueError
        Naming the field, its value and its bound; also where the geometry has no such film model.
    """

    kind: ClassVar[str] = "journal"

    diameter: Annotated[float, Bound("m", above=0.0)]
    length: Annotated[float, Bound("m", above=0.0)]
    radial_clearance: Annotated[float, Bound("m", above=0.0)]
    geometry: Geometry = _PLAIN
    film: Annotated[str | None, Choice(("short", "finite", "coarse"))] = None

    def __post_init__(self) -> None:
        super().__post_init__()
        models = self.geometry.models
        if self.model not in ((*models, "coarse") if "finite" in models else models):
            raise ValueError(
                f"film = {self.film!r}: a bearing of kind {self.geometry.kind!r} has the film "
                f"model {' or '.join(map(repr, self.geometry.models))}"
            )
        self._check_clearance()
        self.geometry.check_around(self.radius)
        if self.film == self.geometry.models[0]:
            # The default by its name is the default: equal bearings are equal records.
            object.__setattr__(self, "film", None)

    def _check_clearance(self) -> None:
        C, most = self.radial_clearance, WIDEST * self.radius
        if most < C:
            raise ValueError(
                f"radial_clearance = {C:.6g} m ({C * 1e6:.6g} µm): must be at most a tenth of the "
                f"radius, {most:.6g} m ({most * 1e6:.6g} µm); lengths are in metres, 1 µm is 1e-6"
            )

    @property
    def radius(self) -> float:
        """Journal radius, R = D/2 [m]."""
        return self.diameter / 2

    @property
    def assembled_clearance(self) -> float:
        """Radial clearance of the assembled bearing, C(1 − preload) [m]."""
        return self.radial_clearance * self.geometry.assembled_share

    @property
    def model(self) -> str:
        """Name of this bearing's film model."""
        return self.geometry.models[0] if self.film is None else self.film


Bearing: TypeAlias = JournalBearing | CoefficientTable


@dataclass(frozen=True, kw_only=True)
class Rotor(Record):
    """A symmetric rotor: a disk at midspan of a massless shaft.

    Parameters
    ----------
    mass : float
        Mass of the whole rotor, 2M [kg], positive.
    shaft_stiffness : float
        Stiffness of one side of the shaft, K_rot [N/m], positive; infinite for a rigid shaft.
    imbalance : float
        Distance of the disk's mass centre from the shaft's axis, u [m], zero or more.
    disk_damping : float
        External damping at the disk, one side, C_s [N·s/m], zero or more.
    journal_mass : float
        Mass lumped at each journal, M_j [kg], zero or more. It is taken out of the disk, which
        keeps mass/2 − journal_mass a side.

    Raises
    ------
    ValueError
        Naming the field, its value and its bound; also where the journals leave no disk.
    """

    mass: Annotated[float, Bound("kg", above=0.0)]
    shaft_stiffness: Annotated[float, Bound("N/m", above=0.0, infinite=True)] = math.inf
    imbalance: Annotated[float, Bound("m", at_least=0.0)] = 0.0
    disk_damping: Annotated[float, Bound("N·s/m", at_least=0.0)] = 0.0
    journal_mass: Annotated[float, Bound("kg", at_least=0.0)] = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.journal_mass >= self.half_mass:
            raise ValueError(
                f"journal_mass = {self.journal_mass:g} kg: must be less than half the rotor's "
                f"mass, {self.half_mass:g} kg, or no disk is left"
            )

    @property
    def half_mass(self) -> float:
        """Half the rotor's mass, M [kg], the share of one bearing."""
        return self.mass / 2

    @property
    def disk_mass(self) -> float:
        """Mass of the disk, one side, M − M_j [kg]."""
        return self.half_mass - self.journal_mass

    @property
    def is_rigid(self) -> bool:
        """Whether the shaft is rigid, K_rot = ∞."""
        return math.isinf(self.shaft_stiffness)


@dataclass(frozen=True, kw_only=True)
class Machine(Record):
    """A rotor on two identical journal bearings.

    Parameters
    ----------
    oil : Oil or Gas
        The lubricant: a gas in a foil bearing, an oil in every other. Of a bearing's own
        coefficients neither it nor its temperature changes anything.
    bearing : JournalBearing or CoefficientTable
        Either of the two bearings.
    rotor : Rotor
        The rotor.
    temperature : float or None
        Temperature of the film, T [°C], the same at every speed; None with a supply.
    load : float or None
        Static load per bearing, F_o [N], zero or more; None for half the rotor's weight.
    supply : Supply or None
        The oil supplied to each bearing, in place of the film's temperature: that then follows at
        each speed from the balance of heat (`heat`), which a table of coefficients does not know.

    Raises
    ------
    ValueError
        Naming the field, its value and its bound; also where both or neither of temperature and
        supply are given, or the temperature leaves the oil with no finite viscosity.
    """

    oil: Annotated[Oil | Gas, Lubricant]
    bearing: Annotated[Bearing, BearingRecord]
    rotor: Rotor
    temperature: Annotated[float | None, Bound("°C", at_least=-zero_Celsius)] = None
    load: Annotated[float | None, Bound("N", at_least=0.0)] = None
    supply: Supply | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        self._check_lubricant()
        if self.temperature is None and self.supply is None:
            raise ValueError(
                "temperature = None: must be a number in °C, or a supply be given from which the "
                "film's temperature follows"
            )
        if self.temperature is not None and self.supply is not None:
            raise ValueError(
                f"temperature = {self.temperature:g} °C beside a supply: the film's temperature "
                "is either given or follows from the supply; leave out one of them"
            )
        name, supply = "temperature", self.supply
        with np.errstate(over="ignore", under="ignore"):  # 0 and inf are refused in words below
            if supply is None:
                viscosity = self.viscosity
            else:
                name = "supply.temperature"
                viscosity = float(self.oil.viscosity(supply.temperature))
        if not 0.0 < viscosity < math.inf:
            given = self.temperature if supply is None else supply.temperature
            raise ValueError(
                f"{name} = {given!r} °C: gives the {self.oil.kind} a viscosity of "
                f"{viscosity} Pa·s, must be positive and finite"
            )

    def _check_lubricant(self) -> None:
        if isinstance(self.bearing, CoefficientTable):  # its coefficients may be those of any
            if self.supply is not None:
                raise ValueError(
                    "supply: sets the film's temperature by its loss, which a table of "
                    "coefficients does not know; give a temperature, which changes nothing"
                )
            return
        geometry, is_gas = self.bearing.geometry, isinstance(self.oil, Gas)
        if is_gas != (geometry.lubricant == "gas"):
            given, wanted = ("a Gas", "an Oil") if is_gas else ("an Oil", "a Gas")
            raise ValueError(f"oil = {given}: a bearing of kind {geometry.kind!r} takes {wanted}")
        if is_gas and self.supply is not None:
            raise ValueError(
                "supply: is one of oil, whose flow cools the film; a bearing on gas is cooled by "
                "other means, so give the temperature of its film"
            )

    @cached_property
    def viscosity(self) -> float:
        """Viscosity of the oil at the film's given temperature, μ [Pa·s].

        Raises
        ------
        ValueError
            With a supply, where it follows at each speed: `heat.viscosity`.
        """
        if self.temperature is None:
            raise ValueError(
                "machine: its film's temperature follows from the supply at each speed, and so "
                "does the viscosity; see heat.viscosity(machine, speed) or Sweep.viscosity"
            )
        return float(self.oil.viscosity(self.temperature))

    @property
    def static_load(self) -> float:
        """Static load per bearing, F_o [N]."""
        # With the standard g the sheet's 600 lbf rotor has its printed half mass, 136.071 kg.
        return self.rotor.half_mass * g if self.load is None else self.load

    @property
    def static_sag(self) -> float:
        """Elastic sag of the shaft at midspan, Γ = F_o/K_rot [m] (below Eq. 5.50)."""
        return self.static_load / self.rotor.shaft_stiffness

    def to_json(self) -> str:
        """Return the machine as JSON text, exact to the last bit."""
        document = {"version": FORMAT_VERSION, **to_tree(self)}
        # NaN and Infinity are not JSON; a rigid shaft's stiffness is the text "inf" (`to_tree`).
        return json.dumps(document, indent=2, allow_nan=False, ensure_ascii=False)

    @classmethod
    def from_json(cls, text: str) -> Self:
        """Return the machine that `to_json` wrote.

        Parameters
        ----------
        text : str
            JSON text.

        Returns
        -------
        Machine
            Equal to the one written.

        Raises
        ------
        ValueError
            Where the text is not JSON, a key but "app" is unknown, missing or given twice, a value
            has the wrong type or lies outside its bound, or the version is unknown.
        """
        document = parsed(text)
        version = document.pop("version", None)
        # What a program shows of the machine, such as units and speeds, is not the machine's.
        document.pop(APP, None)
        if isinstance(version, bool) or version not in (1, FORMAT_VERSION):  # True == 1
            raise ValueError(
                f"version = {shown(version)}: this program reads versions 1 and {FORMAT_VERSION}"
            )
        if version == 1:
            _drop_the_one_film(document)
        return from_tree(cls, document, where="")


def oil_of(machine: Machine) -> Oil:
    """Return a machine's oil.

    Parameters
    ----------
    machine : Machine
        The machine.

    Returns
    -------
    Oil
        Its lubricant.

    Raises
    ------
    ValueError
        Where that is a gas.
    """
    if isinstance(machine.oil, Oil):
        return machine.oil
    raise ValueError(
        "oil = a Gas: must be an Oil here; heat, density and law of viscosity are those of oils"
    )


def _drop_the_one_film(document: dict[str, Any]) -> None:
    """Remove the film's name from a document of version 1, which had one film model only."""
    if isinstance(document.get("bearing"), dict):
        bearing = cast("dict[str, Any]", document["bearing"])
        if bearing.get("film") == "short":
            del bearing["film"]
