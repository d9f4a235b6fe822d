"""The characteristic polynomial of a machine: in floats over speed, in sixty digits at one speed.

On a lightly loaded film, σ ≫ 1, or a soft shaft the growth rate of whirl is smaller than the film's
own rates by factors 1/σ and K_rot/K_eq. Where both are small, sixteen digits do not resolve it.
"""

import functools
import math
from collections.abc import Callable
from decimal import MAX_EMAX, MIN_EMIN, Context, Decimal, localcontext
from typing import Any, ParamSpec, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rotorcalc import heat, modes
from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.coefficients import stiffness_and_damping
from rotorcalc.films import film_of
from rotorcalc.films.short import exact
from rotorcalc.machine import Machine, Rotor
from rotorcalc.numerics import routh
from rotorcalc.numerics.polynomial_roots import exact_roots

# A division by zero gives infinity as in NumPy, not an error.
_DIGITS = Context(prec=60, Emax=MAX_EMAX, Emin=MIN_EMIN, traps=[])
_DECIMALS: Callable[[Any], Any] = np.frompyfunc(Decimal, 1, 1)
# Secant steps to a zero, and the relative distance of the second starting point. Errors multiply:
# from 1e-9 and a float's 1e-14 four steps exceed sixty digits.
_SECANTS, _ASIDE = 4, Decimal("1e-9")

P = ParamSpec("P")
T = TypeVar("T")


def many_digits(function: Callable[P, T]) -> Callable[P, T]:
    """Have a function compute with `Decimal` in sixty digits."""

    @functools.wraps(function)
    def computed(*args: P.args, **kwargs: P.kwargs) -> T:
        with localcontext(_DIGITS):
            return function(*args, **kwargs)

    return computed


def polynomial(machine: Machine, speed: ArrayLike, flexible: bool) -> Array:
    """Return the characteristic polynomials of a machine at speeds (...), floats (..., n+1)."""
    return polynomial_on(stiffness_and_damping(machine, speed), machine.rotor, flexible)


def polynomial_on(film: tuple[Array, Array], rotor: Rotor, flexible: bool) -> Array:
    """Return the characteristic polynomials of a rotor on a film's K and C (..., 2, 2)."""
    return modes.film_terms(*film) @ _rotor_terms(rotor, flexible)


@functools.lru_cache(maxsize=64)
def _rotor_terms(rotor: Rotor, flexible: bool) -> Array:
    return modes.rotor_terms(rotor, flexible=flexible)


class ExactPolynomial:
    """The characteristic polynomial of one machine in sixty digits, its inputs taken as exact.

    So are the coefficients of a short film; those of another model are floats.
    """

    @many_digits
    def __init__(self, machine: Machine, flexible: bool) -> None:
        self._machine, self._is_short = machine, film_of(machine.bearing).curve == "short"
        self._rotor = modes.rotor_terms(machine.rotor, flexible=flexible, number=Decimal)

    def margins(self, speeds: Array) -> Array:
        """Return `routh.margin` at speeds (n,)."""
        return np.array([self._ask(routh.margin, speed) for speed in speeds.tolist()])

    def determinant(self, speed: float) -> float:
        """Return `routh.determinant` at a speed."""
        return self._ask(routh.determinant, speed)

    @many_digits
    def roots(self, speed: float, start: ComplexArray) -> ComplexArray:
        """Return the eigenvalues at a speed, (n,) [1/s], from values near them."""
        return exact_roots(self._at(Decimal(speed)), start)

    @many_digits
    def sharpened(self, speed: float) -> tuple[float, float]:
        """Return a zero of the determinant in more digits, and ω of the roots ±jω there [rad/s].

        Secant steps from a speed that is the zero to a float's digits: ω from Routh's scheme can
        change millions of times as fast as the speed. NaN where the film has no more digits.
        """
        before, here = Decimal(speed) * (1 + _ASIDE), Decimal(speed)
        # At the viscosity of this speed: so near, the oil's own change is below a float's digits.
        mu = self._viscosity(here)
        if not self._is_short:
            # A film known in floats only: more digits of its polynomial would be noise.
            return speed, math.nan
        value = self._determinant(before, mu)
        for _ in range(_SECANTS):
            there = self._determinant(here, mu)
            if there == value:  # both at rounding: a further secant would divide by zero
                break
            before, here, value = here, here - there * (here - before) / (there - value), there
        return float(here), float(routh.axis_frequency(self._at(here, mu)))

    @many_digits
    def _ask(self, question: Callable[[NDArray[Any]], Array], speed: float) -> float:
        return float(question(self._at(Decimal(speed))))

    def _determinant(self, speed: Decimal, mu: Decimal) -> Decimal:
        return routh.exact_determinant(self._at(speed, mu))

    def _viscosity(self, speed: Decimal) -> Decimal:
        # `Decimal` takes over every bit of a float, not its rounded digits.
        return Decimal(float(heat.viscosity(self._machine, float(speed))))

    def _at(self, speed: Decimal, mu: Decimal | None = None) -> NDArray[np.object_]:
        machine = self._machine
        if not self._is_short:
            K, C = stiffness_and_damping(machine, float(speed))
            return modes.film_terms(_DECIMALS(K), _DECIMALS(C)) @ self._rotor
        mu = self._viscosity(speed) if mu is None else mu
        bearing = machine.bearing
        D, L, gap = map(Decimal, (bearing.diameter, bearing.length, bearing.radial_clearance))
        damping = mu * D / 2 * (L / gap) ** 3
        # Eq. 5.8; the unit of damping times ΩC is that of force.
        k, c = exact.coefficients(damping * gap * speed / (4 * Decimal(machine.static_load)))
        film = modes.film_terms(k * (damping * speed), c * damping)
        return film @ self._rotor
