"""The film's linear forces with inner coordinates, and their reduction to the journal alone.

A film with moving parts, tilting pads or a floating ring, reacts to a small motion q of the
journal and of its inner coordinates with −(K q + C q̇ + m q̈), in the order X, Y, inner ones. At a
single whirl frequency ω the inner coordinates can be eliminated, which leaves a 2×2 impedance Z(ω)
of the journal alone. A film with no such form, as where a foil loses the same energy in each cycle
at any frequency, is known by Z(ω) only.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, ComplexArray, real_array

# Frequencies of a whirl (...) → the journal's stiffness Re Z and damping Im Z/ω, (..., 2, 2).
Impedance: TypeAlias = Callable[[Array], tuple[Array, Array]]


@dataclass(frozen=True, eq=False)
class FilmDynamics:
    """Stiffness, damping and inertia of a film and its n inner coordinates.

    Attributes
    ----------
    stiffness : array, (..., 2+n, 2+n)
        In the order X, Y, inner coordinates; in μΩRL³/C³ from a film, in N/m from a machine.
    damping : array, (..., 2+n, 2+n)
        In μRL³/C³ from a film, in N·s/m from a machine.
    inertia : array, (n,)
        Mass of each inner coordinate, taken as a displacement [kg]; 0 where it has none.
    at : callable, optional
        Of a film that is known by its impedance alone: the journal's stiffness and damping in a
        whirl at positive frequencies, whirl ratios [-] from a film, rad/s from a machine. Then
        `stiffness` and `damping` are those in synchronous motion, and there is no `inertia`.
    """

    stiffness: Array
    damping: Array
    inertia: Array
    at: Impedance | None = None

    @property
    def inner(self) -> int:
        """Number of inner coordinates, n."""
        return len(self.inertia)

    @property
    def frequency_dependent(self) -> bool:
        """Whether the journal's stiffness and damping depend on the frequency of its whirl."""
        return self.inner > 0 or self.at is not None


# A film without inner coordinates: n = 0.
NO_INERTIA: Array = np.zeros(0)


@checked
def reduced(dynamics: FilmDynamics, frequency: ArrayLike) -> tuple[Array, Array]:
    """Return the film's stiffness and damping for a journal that whirls at one frequency.

    Z = Z_qq − Z_qi Z_ii⁻¹ Z_iq with Z = K + jωC − ω²m; then K = Re Z and C = Im Z/ω.

    Parameters
    ----------
    dynamics : FilmDynamics
        With dimensions, of leading shape (...).
    frequency : array_like, (...)
        Frequency of the whirl, ω [rad/s], positive; the running speed for synchronous motion.

    Returns
    -------
    K, C : array, (..., 2, 2)
        Stiffness [N/m] and damping [N·s/m] in X, Y.
    """
    frequencies = real_array("frequency", frequency)
    if dynamics.at is not None:
        return dynamics.at(frequencies)
    if dynamics.inner == 0:
        return dynamics.stiffness, dynamics.damping
    omega = frequencies[..., None, None]
    # Zeros in front: the film has no inertia at the journal itself, the rotor's is not its part.
    mass = np.diag(np.concatenate([np.zeros(2), dynamics.inertia]))
    Z: ComplexArray = dynamics.stiffness + 1j * omega * dynamics.damping - omega**2 * mass
    # No force acts on the inner coordinates: Z_iq q + Z_ii q_i = 0 gives q_i.
    left = Z[..., :2, :2] - Z[..., :2, 2:] @ np.linalg.solve(Z[..., 2:, 2:], Z[..., 2:, :2])
    return left.real, left.imag / omega
