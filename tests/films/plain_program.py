"""A second program for finite films, plain and slow, that shares nothing with the package's.

Two-dimensional finite volumes on a uniform grid over each pad, half of its length; film at the
faces; complementarity by policy iteration with sparse LU; the force by the trapezoidal rule;
stiffness and damping by central differences of the force. A pad is (start, end, a_x, a_y) and
optionally (step, depth, axial ratio), in radians and clearances; everything is in R units.
"""

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

STILL = (0.0, 0.0)


def force(pads, ratio, position, velocity=STILL, *, grid=(160, 24)):
    """Return the force on the journal in X, Y, in μΩR³L/C²; `ratio` is L/D."""
    total = np.zeros(2)
    for pad in pads:
        beta, zeta, p = pressures(pad, ratio, (*position, *velocity), grid)
        line = np.trapezoid(p, zeta, axis=1)  # half the length, of both halves the mean
        total -= [np.trapezoid(line * n(beta), beta) for n in (np.cos, np.sin)]
    return total


def pressures(pad, ratio, motion, grid):
    """Return angles, ζ from the middle to the end, and pressures (n + 1, m + 1) of one pad."""
    (n, m), (x, y, dx, dy) = grid, motion
    beta, zeta = np.linspace(*pad[:2], n + 1), np.linspace(0.0, 1.0, m + 1)
    width = beta[1] - beta[0]
    heights = np.full(m + 1, zeta[1])
    heights[[0, -1]] /= 2

    def film(b, z):
        _, _, a_x, a_y, *pocket = pad
        h = 1.0 - (x - a_x) * np.cos(b) - (y - a_y) * np.sin(b) + 0.0 * z
        if pocket:
            step, depth, length = pocket
            h = h + depth * ((b < step) & (z < length))
        return h

    around = film((beta[:-1] + width / 2)[:, None], zeta)
    along = film(beta[:, None], zeta[:-1] + zeta[1] / 2)
    source = np.zeros((n + 1, m + 1))
    source[1:-1] -= 6.0 * np.diff(around, axis=0) * heights
    source += 12.0 * (dx * np.cos(beta) + dy * np.sin(beta))[:, None] * width * heights
    A = _operator(around**3 * heights / width, along**3 * width / zeta[1] / ratio**2)
    inner = np.zeros((n + 1, m + 1), dtype=bool)
    inner[1:-1, :-1] = True
    return beta, zeta, _complementary(A, source.ravel(), inner.ravel()).reshape(n + 1, m + 1)


def _operator(east, north):
    """Return the sparse matrix of conductances between neighbours around and along."""
    index = np.arange((north.shape[0]) * east.shape[1]).reshape(north.shape[0], east.shape[1])
    rows, columns, values = [], [], []
    for one, other, g in ((index[:-1], index[1:], east), (index[:, :-1], index[:, 1:], north)):
        for i, j in ((one, other), (other, one)):
            rows += [i.ravel(), i.ravel()]
            columns += [i.ravel(), j.ravel()]
            values += [g.ravel(), -g.ravel()]
    data = np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))
    return coo_matrix(data).tocsr()


def _complementary(A, source, inner):
    """Return p ≥ 0 with A p ≥ source and one of both equal, zero outside."""
    wet = inner.copy()
    for _ in range(200):
        p, at = np.zeros(len(source)), np.flatnonzero(wet)
        p[at] = splu(A[at][:, at].tocsc()).solve(source[at])
        after = np.where(wet, p > 0.0, source - A @ p > 0.0) & inner
        if np.array_equal(after, wet):
            return p
        wet = after
    raise RuntimeError("no active set")


def coefficients(pads, ratio, position, *, grid=(160, 24), step=2e-3):
    """Return stiffness and damping by central differences, (2, 2) each."""
    sides = []
    for direction in np.eye(2):
        d = step * direction
        moved = [force(pads, ratio, position + s * d, grid=grid) for s in (1, -1)]
        pushed = [force(pads, ratio, position, s * d, grid=grid) for s in (1, -1)]
        sides.append([(b - a) / (2 * step) for a, b in (moved, pushed)])
    K, C = np.moveaxis(np.array(sides), 1, 0)
    return K.T, C.T
