"""The short film under a moving journal, point by point: what a time integration asks of it.

The same force as `short.film_force`, in plain floats: an integration asks one point at a time,
thousands of times, and NumPy's overhead would be all its cost. The film's force is linear in the
size V of the journal's velocity relative to half speed whirl, so it is V times an impedance (g_a,
g_b) that depends on that velocity's direction only; and its inverse, the velocity for a force, is
one equation for that direction.

Units and axes as in `short`: position in C, velocity in CΩ, force in μΩRL³/C².
"""

import math

# Closer to the wall than this the force is that of this distance: only a trial step that an
# integrator then takes back comes there.
_LEAST_KAPPA2 = 1e-10
_SERIES = tuple(range(2, 16))
_SLACK = 0.2
_MOST_ITERATIONS = 120
_TOLERANCE = 4e-15
# After a step of Newton's as short as this, the next one would be a rounding error.
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
    V = math.hypot(A, B)
    if V == 0.0:
        return 0.0, 0.0
    sin, cos = A / V, -B / V
    g_a, g_b = _impedance(x * cos + y * sin, -x * sin + y * cos, _kappa2(x, y))
    return V * (g_a * cos - g_b * sin), V * (g_a * sin + g_b * cos)


def velocity(
    x: float, y: float, f_x: float, f_y: float, near: tuple[float, float] = (0.0, 0.0)
) -> tuple[float, float]:
    """Return the velocity at which the film's force on the journal is the given one.

    Parameters
    ----------
    x, y : float
        Journal centre from the bearing's centre, in C.
    f_x, f_y : float
        Force of the film in X and Y, in μΩRL³/C².
    near : (float, float)
        A velocity at which the search begins, in CΩ; the nearer the sooner it ends.

    Returns
    -------
    (float, float)
        Velocity in X and Y, in CΩ.

    Raises
    ------
    ArithmeticError
        Where the search does not end, as for a force that is no number.

    Notes
    -----
    Force and impedance are at the same angle: arg f = α + arg(g_a + j g_b), with α that of the axis
    a. As g_b is positive α lies within π below arg f; Newton's steps that leave the bracket or do
    not halve the last step give way to halving the bracket.
    """
    size = math.hypot(f_x, f_y)
    if size == 0.0:
        return -0.5 * y, 0.5 * x
    kappa2, towards = _kappa2(x, y), math.atan2(f_y, f_x)
    low, high = towards - math.pi, towards
    alpha = towards - (towards - math.atan2(near[0] + 0.5 * y, 0.5 * x - near[1])) % math.pi
    last = math.pi
    for _ in range(_MOST_ITERATIONS):
        cos, sin = math.cos(alpha), math.sin(alpha)
        a, b = x * cos + y * sin, -x * sin + y * cos
        g_a, g_b, slope_a, slope_b = _impedance_and_slope(a, b, kappa2)
        size2 = g_a * g_a + g_b * g_b
        error = alpha + math.atan2(g_b, g_a) - towards
        step = -error / (1.0 + (g_a * slope_b - g_b * slope_a) / size2)
        low, high = (low, alpha) if error > 0.0 else (alpha, high)
        if abs(step) <= _LAST_STEP or high - low <= _TOLERANCE:
            alpha += step
            V = size / math.hypot(g_a + step * slope_a, g_b + step * slope_b)
            return V * math.sin(alpha) - 0.5 * y, -V * math.cos(alpha) + 0.5 * x
        if not low < alpha + step < high or abs(step) > 0.5 * last:
            step = 0.5 * (low + high) - alpha
        alpha, last = alpha + step, abs(step)
    raise ArithmeticError(f"no velocity found for the film force ({f_x}, {f_y}) at ({x}, {y})")


def _kappa2(x: float, y: float) -> float:
    return max(1.0 - x * x - y * y, _LEAST_KAPPA2)


def _impedance(a: float, b: float, kappa2: float) -> tuple[float, float]:
    """Return g_a and g_b: the force along the axes a and b at V = 1."""
    kappa = math.sqrt(kappa2)
    if b > 0.0 and kappa < _SLACK * b:  # both are small differences there: by their series
        t2 = kappa2 / (b * b)
        g_a = g_b = 0.0
        for n in reversed(_SERIES):
            g_a = (6.0 / (2 * n + 1) - 2.0) - t2 * g_a
            g_b = (3.0 / (2 * n + 1) - 1.0 / (2 * n - 1)) - t2 * g_b
        return 0.5 * a * g_a / b**4, g_b / b**3
    G = 2.0 / kappa * math.atan2(kappa, b)
    g_a = 0.5 * a * (3.0 * b * G - 4.0 - 2.0 * b * b / (kappa2 + b * b)) / (kappa2 * kappa2)
    g_b = 0.5 * (G / kappa2 + 3.0 * b * (b * G - 2.0) / (kappa2 * kappa2))
    return g_a, g_b


def _impedance_and_slope(a: float, b: float, kappa2: float) -> tuple[float, float, float, float]:
    """Return g_a and g_b, and their derivatives by α, where da/dα = b and db/dα = −a."""
    kappa, b2 = math.sqrt(kappa2), b * b
    wide = kappa2 + b2  # 1 − a²
    G = 2.0 / kappa * math.atan2(kappa, b)
    ratio, slack, half = a / wide, b * G - 2.0, 0.5 / (kappa2 * kappa2)
    bracket = 3.0 * b * G - 4.0 - 2.0 * b2 / wide
    d_slack = 2.0 * b * ratio - a * G
    d_bracket = 3.0 * d_slack + 4.0 * b * ratio * (1.0 - b2 / wide)
    d_g_a = half * (b * bracket + a * d_bracket)
    d_g_b = half * (2.0 * ratio * kappa2 + 3.0 * (b * d_slack - a * slack))
    if b > 0.0 and kappa < _SLACK * b:
        return *_impedance(a, b, kappa2), d_g_a, d_g_b
    return half * a * bracket, half * (G * kappa2 + 3.0 * b * slack), d_g_a, d_g_b
