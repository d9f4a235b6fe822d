"""Residual unbalance by the grades of ISO 21940-11 and by API's 4W/N.

A grade G limits the speed at which the mass centre of the whole rotor goes round the shaft's axis,
e Ω, in mm/s (ISO 21940-11, formerly ISO 1940-1: G = e_per Ω). API allows 4W/N oz·in at each
bearing, W the static weight on that journal in lb and N the highest continuous speed in rpm. An
ounce is a sixteenth of a pound, so this is e = 6.35 mm/N, in SI units 6350 W/N g·mm with W in kg,
and at every speed e Ω = 0.665 mm/s.

In this program's rotor the whole unbalance sits at the disk: u is the disk's, e that of the rotor,
and m_d u = M e.

Source, for the grades: hofmann-global.com, "ISO 21940-11 Balancing grades", and vibromera.eu,
"Balancing grade". For 4W/N: kanesdictionary.com, "Rotor balance standard" (API 610), and
energy-tech.com, article 18389 (API 617), which compares both on a rotor of 1000 lb.
"""

from typing import Annotated

from numpy.typing import ArrayLike
from scipy.constants import inch

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, checked_speed
from rotorcalc.machine import Rotor
from rotorcalc.records import Choice
from rotorcalc.units import rpm

API_RESIDUAL = "4W/N"
# e Ω of each grade [m/s]. 4 oz·in per lb and rpm are a quarter of an inch times a rpm.
GRADES: dict[str, float] = {
    API_RESIDUAL: inch / 4.0 * rpm,
    "G 0.4": 0.4e-3,
    "G 1": 1e-3,
    "G 2.5": 2.5e-3,
    "G 6.3": 6.3e-3,
    "G 16": 16e-3,
    "G 40": 40e-3,
}


@checked
def permissible_eccentricity(
    grade: Annotated[str, Choice(tuple(GRADES))], *, speed: ArrayLike
) -> Array:
    """Return the distance of a rotor's mass centre from its axis that a grade permits, e = G/Ω.

    Parameters
    ----------
    grade : str
        "G 0.4", "G 1", "G 2.5", "G 6.3", "G 16", "G 40" (ISO 21940-11) or "4W/N" (API).
    speed : array_like, (...)
        Highest running speed, Ω [rad/s].

    Returns
    -------
    array, (...)
        e [m]; the permissible residual unbalance of a rotor of mass m is m e [kg·m].

    Raises
    ------
    ValueError
        Where the grade is none of these, or a speed is not positive and finite.

    Examples
    --------
    >>> from rotorcalc import rpm
    >>> print(f"{permissible_eccentricity('G 2.5', speed=3000 * rpm):.3g}")
    7.96e-06
    """
    return GRADES[grade] / checked_speed(speed)


@checked
def imbalance_of_grade(
    grade: Annotated[str, Choice(tuple(GRADES))], *, rotor: Rotor, speed: ArrayLike
) -> Array:
    """Return the imbalance at the disk that a grade permits.

    Parameters
    ----------
    grade : str
        As in `permissible_eccentricity`.
    rotor : Rotor
        The rotor; its own imbalance does not enter.
    speed : array_like, (...)
        Highest running speed, Ω [rad/s].

    Returns
    -------
    array, (...)
        u [m], for `Rotor.imbalance`: e of the whole rotor, M e/m_d of its disk.

    Raises
    ------
    ValueError
        As `permissible_eccentricity` does.
    """
    return permissible_eccentricity(grade, speed=speed) * (rotor.half_mass / rotor.disk_mass)


@checked
def balance_quality(rotor: Rotor, *, speed: ArrayLike) -> Array:
    """Return the balance quality of a rotor's own imbalance, e Ω.

    Parameters
    ----------
    rotor : Rotor
        The rotor.
    speed : array_like, (...)
        Running speed, Ω [rad/s].

    Returns
    -------
    array, (...)
        e Ω [m/s]; a thousand times that is the number of a grade G.

    Raises
    ------
    ValueError
        Where a speed is not positive and finite.
    """
    e = rotor.imbalance * (rotor.disk_mass / rotor.half_mass)
    return e * checked_speed(speed)


@checked
def grade_of_imbalance(rotor: Rotor, *, speed: float) -> str | None:
    """Return the finest grade that a rotor's own imbalance meets.

    Parameters
    ----------
    rotor : Rotor
        The rotor.
    speed : float
        Highest running speed, Ω [rad/s].

    Returns
    -------
    str or None
        A grade of ISO 21940-11; None where the imbalance is above G 40.

    Raises
    ------
    ValueError
        Where the speed is not positive and finite.
    """
    quality = float(balance_quality(rotor, speed=speed))
    # A rotor set to the limit of a grade meets it, whatever rounding says.
    met = [name for name, G in GRADES.items() if quality <= G * (1.0 + 1e-9)]
    return next((name for name in met if name != API_RESIDUAL), None)
