"""The film's units: the scales between dimensionless results and a bearing at a speed.

Position and thickness in C, force in μΩRL³/C², stiffness in μΩRL³/C³, damping in μRL³/C³, pressure
in μΩ(L/C)², flow in ΩRLC, torque in μΩR³L/C, added mass in ρRL³/(12C). A table of coefficients has
its own in N/m and N·s/m, and no other unit. σ = μΩRL³/C²/(4F_o) is a
quarter of the unit of force over the load (Eq. 5.8).
"""

from dataclasses import dataclass

from rotorcalc.arrays import Array
from rotorcalc.coefficient_table import CoefficientTable
from rotorcalc.machine import Bearing


@dataclass(frozen=True, eq=False)
class FilmUnits:
    """The units of one bearing's film.

    Attributes
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing.
    viscosity : array or float, (...)
        Viscosity of the oil in the film, μ [Pa·s].
    speed : array or float, (...)
        Running speed, Ω [rad/s].
    """

    bearing: Bearing
    viscosity: Array | float
    speed: Array | float

    @property
    def damping(self) -> Array | float:
        """μRL³/C³ [N·s/m]."""
        if isinstance(self.bearing, CoefficientTable):
            return 1.0
        one = self.bearing
        return self.viscosity * one.radius * one.length**3 / one.radial_clearance**3

    @property
    def stiffness(self) -> Array | float:
        """μΩRL³/C³ [N/m]."""
        if isinstance(self.bearing, CoefficientTable):
            return 1.0
        return self.damping * self.speed

    @property
    def force(self) -> Array | float:
        """μΩRL³/C² [N]."""
        one = self.bearing
        return self.viscosity * self.speed * one.radius * one.length**3 / one.radial_clearance**2

    @property
    def pressure(self) -> Array | float:
        """μΩ(L/C)² [Pa]."""
        ratio = self.bearing.length / self.bearing.radial_clearance
        return self.viscosity * self.speed * ratio**2

    @property
    def flow(self) -> Array | float:
        """ΩRLC [m³/s]."""
        one = self.bearing
        return self.speed * one.radius * one.length * one.radial_clearance

    @property
    def torque(self) -> Array | float:
        """μΩR³L/C [N·m]."""
        one = self.bearing
        return self.viscosity * self.speed * one.radius**3 * one.length / one.radial_clearance

    def added_mass(self, density: float) -> float:
        """Return ρRL³/(12C) [kg] of an oil's density [kg/m³]."""
        one = self.bearing
        return density * one.radius * one.length**3 / (12.0 * one.radial_clearance)
