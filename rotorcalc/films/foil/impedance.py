"""A gas film's stiffness and damping in a small whirl: the impedance Z over the whirl ratio ν.

With p = p₀ + P e^{iντ} and a displacement X e^{iντ} the pressures P follow from the linearised
Reynolds' equation with the storage 2Λ ∂(p h)/∂τ, for unit displacements along X and Y. The foil
loses energy in each cycle: it answers with the compliance α/(1 + iη).

The linearised equation is solved at a few ν, and between them on the space of those solutions
(Galerkin's method), which is much smaller: a rational function of ν that passes through them, and
follows the waves which the gas carries around the bore at half speed, ν = ½.
"""

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.films.foil.bands import Band, applied, solved
from rotorcalc.films.foil.reynolds import Films

# Whirl ratios of the solutions: close about half speed, and up to a gas that has no time to flow.
SOLVED = (0.0, 0.2, 0.4, 0.5, 0.6, 0.8, 1.2, 3.0, 15.0, 300.0)


def impedance(found: Films, whirl_ratio: float, loss_factor: float) -> ComplexArray:
    """Return Z at one whirl ratio, zero or more, from its own solution.

    Parameters
    ----------
    found : Films
        The films in equilibrium at P points.
    whirl_ratio : float
        ν [-].
    loss_factor : float
        η [-].

    Returns
    -------
    complex array, (P, 2, 2)
        Z in p_a R L/C: stiffness is its real part, damping times ν its imaginary one.
    """
    foil = _answering(found, loss_factor)
    answer = _answer(found, whirl_ratio, foil, found.jacobian(foil))
    return _force(found, answer) + found.load_by_position(foil)


def impedances(found: Films, whirl_ratios: Array, loss_factor: float) -> ComplexArray:
    """Return Z at k whirl ratios, (P, k, 2, 2), from the solutions at `SOLVED`."""
    foil = _answering(found, loss_factor)
    P, n, m = found.pressure.shape
    still = found.jacobian(foil)
    answers = [_answer(found, nu, foil, still) for nu in SOLVED]
    basis = np.linalg.qr(np.concatenate(answers, axis=-1).reshape(P, n * m, -1)).Q
    on_basis = np.conj(np.swapaxes(basis, 1, 2))
    fields = basis.reshape(P, n, m, -1)
    storage = found.storage(foil)[..., None]

    def projected(values: NDArray[Any]) -> NDArray[Any]:
        return on_basis @ values.reshape(P, n * m, -1)

    J, S = projected(applied(still, fields)), projected(storage * fields)
    b, c = projected(found.by_position + 0j), projected(found.storage_by_position + 0j)
    inu = 1j * whirl_ratios[:, None, None]
    small = np.linalg.solve(J[:, None] + inu * S[:, None], b[:, None] + inu * c[:, None])
    return found.load_by_position(foil)[:, None] - _force(found, fields)[:, None] @ small


def _answering(found: Films, loss_factor: float) -> complex:
    """Return the compliance with which the foil answers a whirl."""
    return found.compliance / (1.0 + 1j * loss_factor)


def _answer(found: Films, nu: float, foil: complex, still: Band) -> ComplexArray:
    """Return the pressures P of unit displacements along X and Y, (P, n, m, 2)."""
    band = replace(still, here=still.here + 1j * nu * found.storage(foil))
    return solved(band, -(found.by_position + 1j * nu * found.storage_by_position))


def _force(found: Films, pressures: ComplexArray) -> ComplexArray:
    """Return minus the forces of k fields of pressures (P, n, m, k) on the journal, (P, 2, k)."""
    P = len(found.number)
    weights = np.swapaxes(found.load_in_whirl.reshape(P, -1, 2), 1, 2)
    return weights @ pressures.reshape(P, -1, pressures.shape[-1])
