"""The short film's force on a moving journal, one point at a time, for time integration.

The same force as `short.film_force`, in plain floats: an integration evaluates single points,
thousands of times, and NumPy's overhead would dominate. The film's force is linear in the
magnitude V of the journal's velocity relative to half-speed whirl, so it is V times an impedance
(g_a, g_b) that depends on that velocity's direction only; and its inverse, the velocity for a
given force, is one equation for that direction.

The power that the film absorbs is V² g_b, and its force is the gradient of half of that with
respect to velocity (c_ij = c_ji at any position), so W = g_b, a function of b alone, gives both:

    g_a = (a/2) W',    dg_b/dα = −a W' = −2 g_a,    dg_a/dα = (b W' − a² W'')/2.

With a and b in κ = √(1 − x² − y²) and the force in κ⁻³ no other variable than t = b/κ is left:

    W = (1 + 3t²) arccot t − 3t.

Units and axes as in `short`: position in C, velocity in CΩ, force in μΩRL³/C².
"""

from math import atan2, cos, hypot, pi, sin, sqrt

from rotorcalc.films.convex import Answer

# Closer to the wall than κ² = 1 − x² − y² = 1e-10 the force is held at its value there: only trial
# steps come there, which the integrator then rejects.
_LEAST_KAPPA2 = 1e-10
# The n-th coefficients of W'/2 and of W in powers of 1/t², from the highest down (Horner).
_SERIES = tuple((3.0 / (2 * n + 1) - 1.0, 3.0 / (2 * n + 1) - 1.0 / (2 * n - 1), n)
                for n in reversed(range(2, 16)))  # fmt: skip
# t above which W is summed as a series: there the closed form suffers cancellation (it errs by
# 1e-12 at 5, by 1e-8 at 50), and the terms omitted are below rounding.
_SLACK = 5.0
# Halving alone takes 50 steps from π down to the tolerance, some ten roundings of π.
_MOST_ITERATIONS, _TOLERANCE = 120, 4e-15
# Newton's method converges quadratically: after a step of √1e-15 the next is a rounding error.
_LAST_STEP = 3e-8


def force(x: float, y: float, dx: float, dy: float) -> tuple[float, float]:
    """Return the film's force on a moving journal.

    Parameters
    ----------
    x, y : float
        Journal centre from the bearing's centre, in C.
    dx, dy : float
        Its velocity, in CΩ.

    Returns
    -------
    (float, float)
        Force in X and Y, in μΩRL³/C²; as `short.film_force` gives it.
    """
    A, B = dx + 0.5 * y, dy - 0.5 * x
    V = hypot(A, B)
    if V == 0.0:  # half-speed whirl about the centre: no wedge, no squeeze
        return 0.0, 0.0
    kappa2 = 1.0 - x * x - y * y
    kappa = sqrt(kappa2 if kappa2 > _LEAST_KAPPA2 else _LEAST_KAPPA2)  # noqa: FURB136 - max is slow
    W, half_slope, _ = _impedance(-(x * A + y * B) / (V * kappa))
    unit = 1.0 / (kappa * kappa * kappa)
    g_a, g_b = (y * A - x * B) / (V * kappa) * half_slope * unit, W * unit
    return -g_a * B - g_b * A, g_a * A - g_b * B


def answer(x: float, y: float, dx: float, dy: float) -> Answer:
    """Return the force, its derivatives by velocity and its potential Φ = V²W/2.

    Parameters
    ----------
    x, y, dx, dy : float
        As of `force`.

    Returns
    -------
    Answer
        Force, damping C_ij = −∂F_i/∂v_j and Φ, in film units.

    Notes
    -----
    Along n, the direction of (A, B), and t at +90° from it, ∂b/∂α = −a and ∂a/∂α = b give
    C_nn = W, C_nt = C_tn = −g_a and C_tt = W − bW'/2 + a²W''/2.
    """
    A, B = dx + 0.5 * y, dy - 0.5 * x
    V = hypot(A, B)
    n_x, n_y = (A / V, B / V) if V > 0.0 else (1.0, 0.0)
    kappa2 = 1.0 - x * x - y * y
    kappa = sqrt(kappa2 if kappa2 > _LEAST_KAPPA2 else _LEAST_KAPPA2)  # noqa: FURB136 - max is slow
    a, t = (y * n_x - x * n_y) / kappa, -(x * n_x + y * n_y) / kappa
    unit = 1.0 / (kappa * kappa * kappa)
    g_b, half_slope, bend = _impedance(t)
    g_a = unit * a * half_slope
    nn, tt = unit * g_b, unit * (g_b - t * half_slope + 0.5 * a * a * bend)
    cross, turn = n_x * n_y, g_a * (n_x * n_x - n_y * n_y)
    xy = (nn - tt) * cross - turn
    return Answer(
        -V * (g_a * n_y + nn * n_x), V * (g_a * n_x - nn * n_y),
        nn * n_x * n_x + 2.0 * g_a * cross + tt * n_y * n_y, xy,
        xy, nn * n_y * n_y - 2.0 * g_a * cross + tt * n_x * n_x,
        0.5 * V * V * nn,
    )  # fmt: skip


def velocity(
    x: float, y: float, f_x: float, f_y: float, near: list[float] | None = None
) -> tuple[float, float]:
    """Return the velocity at which the film's force on the journal is the given one.

    Parameters
    ----------
    x, y : float
        Journal centre from the bearing's centre, in C.
    f_x, f_y : float
        Force of the film in X and Y, in μΩRL³/C².
    near : list or None
        Solution of the last search, from which this one starts and which it replaces; empty at
        first. The closer the two points, the fewer steps are needed.

    Returns
    -------
    (float, float)
        Velocity in X and Y, in CΩ.

    Raises
    ------
    ArithmeticError
        Where the search does not converge, as for a force of NaN.

    Notes
    -----
    The unknown is the angle ψ = arg f − α from the axis a to the force, at which g_a and g_b are in
    the ratio of cos ψ and sin ψ. As g_b is positive, ψ lies between 0 and π; a Newton step that
    leaves the bracket or is longer than half the last one is replaced by bisection. In the course
    of a motion ψ changes more slowly than either direction, so ψ is what `near` keeps.
    """
    size = hypot(f_x, f_y)
    if size == 0.0:  # half-speed whirl about the centre, A = B = 0
        return -0.5 * y, 0.5 * x
    kappa2 = 1.0 - x * x - y * y
    kappa = sqrt(kappa2 if kappa2 > _LEAST_KAPPA2 else _LEAST_KAPPA2)  # noqa: FURB136 - max is slow
    unit = size * kappa
    along, beside = (x * f_x + y * f_y) / unit, (y * f_x - x * f_y) / unit
    low, high, last = 0.0, pi, pi
    psi = near[0] if near else 0.5 * pi
    for _ in range(_MOST_ITERATIONS):
        c, s = cos(psi), sin(psi)
        a, t = along * c - beside * s, along * s + beside * c
        W, half_slope, bend = _impedance(t)
        g_a, slope_a = a * half_slope, 0.5 * a * a * bend - t * half_slope  # its slope by ψ
        error = W * c - g_a * s
        step = error / ((W + slope_a) * s - g_a * c)
        if -_LAST_STEP <= step <= _LAST_STEP or high - low <= _TOLERANCE:
            if near is not None:
                near[:] = (psi + step,)
            # The last step to first order in all that depends on ψ, instead of one more evaluation.
            c, s = c - step * s, s + step * c
            g = hypot(g_a + step * slope_a, W + step * 2.0 * g_a) / (kappa * kappa * kappa)
            return (f_y * c - f_x * s) / g - 0.5 * y, 0.5 * x - (f_x * c + f_y * s) / g
        if error > 0.0:
            low = psi
        elif error <= 0.0:  # NaN moves neither end, so that the search ends in the error below
            high = psi
        if not low < psi + step < high or abs(step) > 0.5 * last:
            step = 0.5 * (low + high) - psi
        psi, last = psi + step, abs(step)
    raise ArithmeticError(f"no velocity found for the film force ({f_x}, {f_y}) at ({x}, {y})")


def _impedance(t: float) -> tuple[float, float, float]:
    """Return W, W'/2 and W'' at t = b/κ, in κ⁻³, κ⁻⁴ and κ⁻⁵."""
    if t > _SLACK:
        return _slack_impedance(t)
    G = atan2(1.0, t)  # half of κ ∫ dz'/H over the half film
    q, s = 1.0 / (1.0 + t * t), 3.0 * (t * G - 1.0)
    return G + t * s, s + q, 6.0 * G - t * q * (6.0 + 4.0 * q)


def _slack_impedance(t: float) -> tuple[float, float, float]:
    """Return the same for κ ≪ b as power series in κ²/b²."""
    value = half_slope = bend = 0.0
    u = 1.0 / (t * t)
    for slope_n, value_n, n in _SERIES:
        value = value_n - u * value
        half_slope = slope_n - u * half_slope
        bend = -4.0 * n * slope_n - u * bend
    return value / t**3, half_slope / t**4, bend / t**5
