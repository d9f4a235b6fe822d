"""The shape of a bearing's bore, one record class per kind.

A kind of bearing is a `Geometry`: a frozen record of the bore's shape apart from diameter, length
and clearance. Its word, `kind`, is used in files and links. `models` names the film models that
apply to it; the first is the default.

Angles count from X, along the load, in the sense of rotation. The radial clearance C of a bearing
is the machined one of a pad in every kind: the radius of its curvature less the journal's.
"""

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, Self

from scipy.constants import atmosphere, degree

from rotorcalc.records import Bound, Choice, Kind

_TURN = 2.0 * math.pi
# Largest C/R accepted. Bearings have 0.0005 to 0.005, and Reynolds' equation assumes a film thin
# against the radius; a larger ratio is nearly always a clearance in the wrong unit.
WIDEST = 0.1
_BOTH, _FINITE = ("finite", "short"), ("finite",)
# Angles, shares of a length, and numbers of pads, grooves or recesses.
_Angle = Annotated[float, Bound("rad", above=0.0, below=_TURN)]
_Preload = Annotated[float, Bound("-", at_least=0.0, below=1.0)]
_Share = Annotated[float, Bound("-", above=0.0, below=1.0)]
_Number = Annotated[float, Bound("-", at_least=2.0, below=13.0, whole=True)]
_Load = Annotated[str, Choice(("on pad", "between pads"))]


@dataclass(frozen=True, kw_only=True)
class Geometry(Kind):
    """The shape of a bore; every kind of bearing is a subclass."""

    models: ClassVar[tuple[str, ...]] = ()
    # "oil", or "gas" where the film is one of gas.
    lubricant: ClassVar[str] = "oil"

    @property
    def assembled_share(self) -> float:
        """Clearance left on the lines of the pads' closest approach, over C: 1 − preload."""
        return 1.0 - float(getattr(self, "preload", 0.0))

    def implied(self, name: str, clearance: float) -> float:  # noqa: ARG002 - of some kinds' fields
        """Return the value that a field has when it is None, at a radial clearance C [m]."""
        raise ValueError(f"{name}: has no value of its own where it is None")

    @classmethod
    def around(cls, diameter: float, length: float, radial_clearance: float) -> Self:  # noqa: ARG003
        """Return a bore of the usual proportions around a journal of D, L and C [m]."""
        return cls()

    def check_around(self, radius: float) -> None:
        """Raise ValueError where the bore does not fit around a journal of a radius [m]."""


@dataclass(frozen=True, kw_only=True)
class Plain(Geometry):
    """A circular bore of 360° without a groove."""

    kind: ClassVar[str] = "plain"
    models: ClassVar[tuple[str, ...]] = ("short", "finite")


@dataclass(frozen=True, kw_only=True)
class PartialArc(Geometry):
    """A single circular pad on the loaded side; the rest of the bore is relieved.

    Parameters
    ----------
    arc : float
        Angle of the pad [rad].
    centre : float
        Angle of its middle from the load line [rad].
    """

    kind: ClassVar[str] = "partial-arc"
    models: ClassVar[tuple[str, ...]] = _BOTH

    arc: _Angle = 150 * degree
    centre: Annotated[float, Bound("rad", at_least=-math.pi, below=_TURN)] = 0.0


@dataclass(frozen=True, kw_only=True)
class AxialGrooves(Geometry):
    """A circular bore with axial grooves, which supply it at ambient pressure.

    Parameters
    ----------
    number : float
        Number of grooves, evenly spaced; a whole number.
    width : float
        Angle of each [rad].
    first : float or None
        Angle of the middle of the first groove from the load line [rad]; None for π/number, which
        puts the grooves evenly beside the load line.
    """

    kind: ClassVar[str] = "axial-grooves"
    models: ClassVar[tuple[str, ...]] = _BOTH

    number: Annotated[float, Bound("-", at_least=1.0, below=13.0, whole=True)] = 2.0
    width: _Angle = 20 * degree
    first: Annotated[float | None, Bound("rad", at_least=-_TURN, below=_TURN)] = None

    def __post_init__(self) -> None:
        super().__post_init__()
        _fits(self.number, "grooves", "width", self.width)

    def implied(self, name: str, clearance: float) -> float:
        """Return where the first groove stands when it is not given."""
        return math.pi / self.number if name == "first" else super().implied(name, clearance)


@dataclass(frozen=True, kw_only=True)
class Elliptical(Geometry):
    """Two pads whose centres of curvature are moved together along the load line.

    Parameters
    ----------
    preload : float
        Distance of each centre beyond the bore's, in C [-].
    groove_width : float
        Angle of the grooves between the pads, at ±90° [rad].
    """

    kind: ClassVar[str] = "elliptical"
    models: ClassVar[tuple[str, ...]] = _BOTH

    preload: _Preload = 0.5
    groove_width: Annotated[float, Bound("rad", at_least=0.0, below=math.pi)] = 20 * degree


@dataclass(frozen=True, kw_only=True)
class OffsetHalves(Geometry):
    """Two half bores moved sideways, each convergent over its whole length.

    Parameters
    ----------
    offset : float
        Distance of each half's centre from the bore's, in C [-]: the loaded half's against Y.
    groove_width : float
        Angle of the grooves between the halves, at ±90° [rad].
    """

    kind: ClassVar[str] = "offset-halves"
    models: ClassVar[tuple[str, ...]] = _BOTH

    offset: _Preload = 0.5
    groove_width: Annotated[float, Bound("rad", at_least=0.0, below=math.pi)] = 20 * degree


@dataclass(frozen=True, kw_only=True)
class Lobes(Geometry):
    """Equal pads whose centres of curvature are each moved towards their pad.

    Parameters
    ----------
    number : float
        Number of pads, evenly spaced; a whole number.
    arc : float
        Angle of each [rad].
    preload : float
        Distance of each centre beyond the bore's, in C [-].
    offset : float
        Where on its arc a pad comes closest to a centred journal, from its leading edge: 0.5 in its
        middle, 1 at its trailing edge [-].
    load : "on pad" or "between pads"
        Where the load line meets the bore.
    """

    kind: ClassVar[str] = "lobes"
    models: ClassVar[tuple[str, ...]] = _BOTH

    number: _Number = 3.0
    arc: _Angle = 100 * degree
    preload: _Preload = 0.5
    offset: Annotated[float, Bound("-", at_least=0.0, below=1.0 + 1e-12)] = 0.5
    load: _Load = "on pad"

    def __post_init__(self) -> None:
        super().__post_init__()
        _fits(self.number, "pads", "arc", self.arc)


@dataclass(frozen=True, kw_only=True)
class _Pocketed(Geometry):
    """A bore with pockets, whose depth follows from the clearance where it is None."""

    usual_depth: ClassVar[float]  # in C

    def implied(self, name: str, clearance: float) -> float:
        """Return the depth of a pocket that is not given [m]."""
        if name == "depth":
            return self.usual_depth * clearance
        return super().implied(name, clearance)


@dataclass(frozen=True, kw_only=True)
class PressureDam(_Pocketed):
    """Two pads with axial grooves, and a pocket in the unloaded pad that ends in a step.

    Parameters
    ----------
    pocket_arc : float
        Angle of the pocket, from the unloaded pad's leading edge to the step [rad].
    depth : float or None
        Depth of the pocket below the pad [m]; None for 2 C.
    axial_ratio : float
        Length of the pocket over that of the bearing, L_d/L [-].
    groove_width : float
        Angle of the grooves between the pads, at ±90° [rad].
    preload : float
        As of an elliptical bore [-].
    track_ratio : float
        Width of a circumferential relief track in the loaded pad over the bearing's length,
        L_t/L [-]; 0 for none.
    """

    kind: ClassVar[str] = "pressure-dam"
    models: ClassVar[tuple[str, ...]] = _FINITE
    usual_depth: ClassVar[float] = 2.0  # in C

    pocket_arc: _Angle = 130 * degree
    depth: Annotated[float | None, Bound("m", above=0.0)] = None
    axial_ratio: _Share = 0.75
    groove_width: Annotated[float, Bound("rad", at_least=0.0, below=math.pi)] = 20 * degree
    preload: _Preload = 0.0
    track_ratio: Annotated[float, Bound("-", at_least=0.0, below=1.0)] = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        _within_pad(self.pocket_arc, math.pi - self.groove_width)


@dataclass(frozen=True, kw_only=True)
class MultiDam(_Pocketed):
    """Equal circular pads, each with a pocket that ends in a step.

    Parameters
    ----------
    number : float
        Number of pads, evenly spaced; a whole number.
    arc : float
        Angle of each [rad].
    pocket_arc : float
        Angle of each pocket, from its pad's leading edge to the step [rad].
    depth : float or None
        Depth of the pockets below the pads [m]; None for 1.5 C.
    axial_ratio : float
        Length of a pocket over that of the bearing, L_d/L [-].
    load : "on pad" or "between pads"
        Where the load line meets the bore.
    """

    kind: ClassVar[str] = "multi-dam"
    models: ClassVar[tuple[str, ...]] = _FINITE
    usual_depth: ClassVar[float] = 1.5  # in C

    number: _Number = 4.0
    arc: _Angle = 75 * degree
    pocket_arc: _Angle = 55 * degree
    depth: Annotated[float | None, Bound("m", above=0.0)] = None
    axial_ratio: _Share = 0.7
    load: _Load = "between pads"

    def __post_init__(self) -> None:
        super().__post_init__()
        _fits(self.number, "pads", "arc", self.arc)
        _within_pad(self.pocket_arc, self.arc)


@dataclass(frozen=True, kw_only=True)
class FloatingRing(Geometry):
    """A ring that turns freely between two films: the journal's in it, and one around it.

    The bearing's own diameter, length and clearance are the inner film's. Both films are plain and
    at one temperature. The outer film carries the journal's load; the ring's weight, some
    hundredths of it, is left out.

    Parameters
    ----------
    outer_radius : float
        Outer radius of the ring, R_o [m]; greater than the journal's.
    outer_length : float
        Axial length of the outer film, L_o [m].
    outer_clearance : float
        Radial clearance of the outer film, C_o [m].
    viscosity_ratio : float
        Viscosity in the outer film over that in the inner one, μ_o/μ_i [-].
    ring_mass : float
        Mass of the ring [kg].
    """

    kind: ClassVar[str] = "floating-ring"
    models: ClassVar[tuple[str, ...]] = _BOTH

    outer_radius: Annotated[float, Bound("m", above=0.0)]
    outer_length: Annotated[float, Bound("m", above=0.0)]
    outer_clearance: Annotated[float, Bound("m", above=0.0)]
    viscosity_ratio: Annotated[float, Bound("-", above=0.0)] = 1.0
    ring_mass: Annotated[float, Bound("kg", at_least=0.0)] = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        C, most = self.outer_clearance, WIDEST * self.outer_radius
        if most < C:
            raise ValueError(
                f"outer_clearance = {C:.6g} m ({C * 1e6:.6g} µm): must be at most a tenth of the "
                f"outer radius, {most:.6g} m ({most * 1e6:.6g} µm)"
            )

    @classmethod
    def around(cls, diameter: float, length: float, radial_clearance: float) -> Self:
        """Return a ring of the usual proportions around a journal.

        Parameters
        ----------
        diameter, length, radial_clearance : float
            Those of the journal and its film, D, L and C [m].

        Returns
        -------
        FloatingRing
            R_o = 1.6 R, L_o = 1.2 L, C_o = 2.5 C.

        Examples
        --------
        >>> FloatingRing.around(0.010, 0.006, 20e-6).outer_radius
        0.008
        """
        usual = 0.8 * diameter, 1.2 * length, 2.5 * radial_clearance
        # As they are written in a file: without what the products add in the last digit.
        radius, length, clearance = (float(f"{value:.12g}") for value in usual)
        return cls(outer_radius=radius, outer_length=length, outer_clearance=clearance)

    def check_around(self, radius: float) -> None:
        """Raise ValueError where the ring has no wall around the journal."""
        if not self.outer_radius > radius:
            raise ValueError(
                f"outer_radius = {self.outer_radius:.6g} m ({self.outer_radius * 1e3:.6g} mm): "
                f"must be greater than the journal's radius, {radius:.6g} m ({radius * 1e3:.6g} mm)"
            )


@dataclass(frozen=True, kw_only=True)
class Hydrostatic(Geometry):
    """A circular bore with recesses that are supplied with oil through restrictors.

    The first recess stands on the load line. The recesses are so deep that each has one pressure;
    the film lies on the lands at both ends and between them.

    Parameters
    ----------
    recesses : float
        Number of recesses, N, evenly spaced; a whole number.
    land_ratio : float
        Length of the land at either end over that of the bearing, a/L [-].
    land_angle : float
        Angle of the land between two recesses [rad].
    supply_pressure : float
        Pressure above ambient before the restrictors, p_s [Pa].
    pressure_ratio : float
        Recess pressure over p_s without load and rotation, β [-]: it sizes the restrictors.
    restrictor : "capillary" or "orifice"
        How the flow into a recess depends on the drop of pressure, as itself or as its root.
    """

    kind: ClassVar[str] = "hydrostatic"
    models: ClassVar[tuple[str, ...]] = _FINITE

    recesses: Annotated[float, Bound("-", at_least=3.0, below=13.0, whole=True)] = 4.0
    land_ratio: Annotated[float, Bound("-", above=0.0, below=0.5)] = 0.25
    land_angle: _Angle = 30 * degree
    supply_pressure: Annotated[float, Bound("Pa", above=0.0)] = 2e6
    pressure_ratio: _Share = 0.5
    restrictor: Annotated[str, Choice(("capillary", "orifice"))] = "capillary"

    def __post_init__(self) -> None:
        super().__post_init__()
        # Lands that meet would leave no recess, as grooves that meet leave no pad.
        _fits(self.recesses, "recesses", "land_angle", self.land_angle)

    @property
    def recess_angle(self) -> float:
        """Angle of a recess [rad]."""
        return recess_angle(self.recesses, self.land_angle)


def recess_angle(recesses: float, land_angle: float) -> float:
    """Return the angle of each of N recesses from that of the land between two of them [rad]."""
    return _TURN / recesses - land_angle


@dataclass(frozen=True, kw_only=True)
class Foil(Geometry):
    """A bore of thin foil on a springy foundation, slit once, with a film of gas.

    Parameters
    ----------
    foundation_stiffness : float
        Pressure that presses the foil back by a unit of length, k_f [N/m³]; `usual` has one.
    loss_factor : float
        Loss factor of the foundation, η [-]: it answers a whirl with the stiffness k_f(1 + iη).
    ambient_pressure : float
        Absolute pressure around the bearing, p_a [Pa].
    slit : float
        Angle from the load line to the slit between the foil's ends, at ambient pressure [rad].
    """

    kind: ClassVar[str] = "foil"
    models: ClassVar[tuple[str, ...]] = _FINITE
    lubricant: ClassVar[str] = "gas"

    foundation_stiffness: Annotated[float, Bound("N/m³", above=0.0)]
    loss_factor: Annotated[float, Bound("-", at_least=0.0)] = 0.15
    ambient_pressure: Annotated[float, Bound("Pa", above=0.0)] = atmosphere
    slit: Annotated[float, Bound("rad", at_least=-_TURN, below=_TURN)] = 180 * degree

    @classmethod
    def around(cls, diameter: float, length: float, radial_clearance: float) -> Self:  # noqa: ARG003
        """Return the foil that is `usual` at a radial clearance C [m]."""
        return cls.usual(radial_clearance)

    @classmethod
    def usual(
        cls,
        radial_clearance: float,
        *,
        compliance: float = 1.0,
        ambient_pressure: float = atmosphere,
    ) -> Self:
        """Return a foil bearing with a compliance α = p_a/(C k_f), usually about 1.

        Parameters
        ----------
        radial_clearance : float
            C [m], positive.
        compliance : float
            Deflection of the foil under the ambient pressure over the clearance, α [-], positive.
        ambient_pressure : float
            p_a [Pa], positive.

        Returns
        -------
        Foil
            With k_f = p_a/(C α), the other fields at their defaults.

        Examples
        --------
        >>> f"{Foil.usual(30e-6).foundation_stiffness:.3e}"
        '3.378e+09'
        """
        stiffness = ambient_pressure / (radial_clearance * compliance)
        # As it is written in a file: without what the division adds in the last digit.
        return cls(
            foundation_stiffness=float(f"{stiffness:.12g}"), ambient_pressure=ambient_pressure
        )

    def compliance(self, radial_clearance: float) -> float:
        """Return α = p_a/(C k_f) [-] at a radial clearance C [m]."""
        return self.ambient_pressure / (radial_clearance * self.foundation_stiffness)


@dataclass(frozen=True, kw_only=True)
class TiltingPads(Geometry):
    """Equal pads, each of which tilts about its pivot; with a rotational stiffness a flexure's.

    Parameters
    ----------
    number : float
        Number of pads, evenly spaced; a whole number.
    arc : float
        Angle of each [rad].
    preload : float
        Distance of each pad's centre of curvature beyond the bearing's, in C, not tilted [-].
    pivot_offset : float
        The pivot's place from the leading edge, over the arc [-].
    load : "on pad" or "between pads"
        Whether the load points at a pivot or between two.
    rotational_stiffness : float
        Of each pad against a tilt about its pivot, k_θ [N·m/rad]; 0 for a free pad.
    pad_inertia : float
        Moment of inertia of each pad about its pivot, along the bearing's axis [kg·m²].
    """

    kind: ClassVar[str] = "tilting-pads"
    models: ClassVar[tuple[str, ...]] = _FINITE

    number: Annotated[float, Bound("-", at_least=3.0, below=13.0, whole=True)] = 5.0
    arc: _Angle = 60 * degree
    preload: _Preload = 0.3
    # A pad with its pivot ahead of its middle, turned the wrong way, carries hardly anything.
    pivot_offset: Annotated[float, Bound("-", at_least=0.5, below=0.8)] = 0.5
    load: _Load = "between pads"
    rotational_stiffness: Annotated[float, Bound("N·m/rad", at_least=0.0)] = 0.0
    pad_inertia: Annotated[float, Bound("kg·m²", at_least=0.0)] = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        _fits(self.number, "pads", "arc", self.arc)


def _fits(number: float, parts: str, name: str, angle: float) -> None:
    """Raise ValueError where pads overlap, or grooves leave no pad."""
    most = _TURN / number
    # Pads may meet in an edge, which is then a groove without width.
    if angle > most * (1.0 + 1e-12) or (parts != "pads" and math.isclose(angle, most)):
        raise ValueError(
            f"{name} = {angle:.6g} rad ({math.degrees(angle):.4g}°): for {number:g} {parts} it "
            f"must be less than {most:.6g} rad ({math.degrees(most):.4g}°)"
        )


def _within_pad(pocket: float, arc: float) -> None:
    if not pocket < arc:
        raise ValueError(
            f"pocket_arc = {pocket:.6g} rad ({math.degrees(pocket):.4g}°): must be less than the "
            f"pad's arc, {arc:.6g} rad ({math.degrees(arc):.4g}°)"
        )
