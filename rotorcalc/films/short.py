"""The short journal bearing in closed form.

Model: Reynolds' equation without its circumferential pressure flow (Ocvirk), so for L/D of about a
half and less; laminar, isoviscous, incompressible oil; aligned, rigid and circular surfaces;
ambient pressure at both ends. The film carries over half the circumference: 0 ≤ θ ≤ π behind the
thickest film, and with a moving journal the half that its motion puts under pressure.

Axes: X along the static load, Y at +90° in the sense of rotation; r along the line of centres, t
at +90° from it. θ runs in the sense of rotation from the thickest film, which lies opposite to r.

Units: ε, x, y and film thickness in the radial clearance C; forces in μΩRL³/C²; stiffness in
μΩRL³/C³ and damping in μRL³/C³ ("film units"), or k and c of Eq. 5.32 where a docstring says so.

Source: San Andrés, Notes 5, Eqs. 5.5 to 5.37. Misprints of the source that are corrected here:
the sign in Eq. 5.7, and f_r² printed for f_t² in k_YY and c_YY of Eq. 5.35.
"""

import functools

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.films.state import FilmField, FilmState
from rotorcalc.frames import matrix, rotate, vector
from rotorcalc.machine import JournalBearing
from rotorcalc.typing import Array, real_array

# ln(ε/s) between which the search for ε begins. From the last but one at either end on, the curve
# is straight, past the largest and the smallest of numbers.
_LN_W = np.concatenate([[-800.0], np.linspace(-12.0, 12.0, 2401), [200.0]])
# The change of ln(ε/s) that ends it: the error that is left is less than 12 times its square.
_TOLERANCE = 1e-8
_MOST_ITERATIONS = 50


def state(bearing: JournalBearing, sommerfeld: ArrayLike) -> FilmState:
    """Return the short bearing's film in static equilibrium, dimensionless.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing; only L/D enters, and only the drag.
    sommerfeld : array_like, (...)
        Modified Sommerfeld number, σ [-], positive; infinite without load.

    Returns
    -------
    FilmState
        Its fields have the leading shape (...).

    Raises
    ------
    ValueError
        Where σ is not positive, or so small that the film is thinner than the arithmetic can tell.
    """
    eps = _afloat(sommerfeld)
    phi = attitude_angle(eps)
    return FilmState(
        sommerfeld=np.asarray(sommerfeld, dtype=float),
        position=vector(eps * np.cos(phi), eps * np.sin(phi)),
        attitude_angle=phi,
        minimum_thickness=1.0 - eps,
        stiffness=film_stiffness(eps),
        damping=film_damping(eps),
        side_flow=side_flow(eps),
        drag=drag(eps, length_to_radius=bearing.length / bearing.radius),
        peak_pressure=peak_pressure(eps),
        peak_angle=phi + np.pi + peak_position(eps),
    )


def coefficients(
    bearing: JournalBearing,  # noqa: ARG001 - other film models need it
    sommerfeld: ArrayLike,
) -> tuple[Array, Array]:
    """Return the short bearing's stiffness and damping in static equilibrium, in film units.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing; nothing of it enters.
    sommerfeld : array_like, (...)
        Modified Sommerfeld number, σ [-], positive; infinite without load.

    Returns
    -------
    stiffness, damping : array, (..., 2, 2)
        As `state` gives them, without the rest.

    Raises
    ------
    ValueError
        As in `state`.
    """
    eps = _afloat(sommerfeld)
    s2 = _s2(eps)
    units = _film_units(eps, s2)
    return _xy_stiffness(eps, s2, *units), _xy_damping(eps, s2, *units)


def field(
    bearing: JournalBearing,  # noqa: ARG001 - other film models need it
    sommerfeld: ArrayLike,
    *,
    angle: ArrayLike,
    zeta: ArrayLike,
) -> FilmField:
    """Return the short bearing's film thickness and pressure in static equilibrium, dimensionless.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing; nothing of it enters.
    sommerfeld : array_like, (...)
        Modified Sommerfeld number, σ [-], positive; infinite without load.
    angle : array_like, (...)
        Angle Θ around the bearing from X in the sense of rotation [rad].
    zeta : array_like, (...)
        Axial position from the bearing's middle, ζ = z/L [-], −1/2 ≤ ζ ≤ 1/2.

    Returns
    -------
    FilmField
        Its fields have the shape that σ, angle and ζ give together.

    Raises
    ------
    ValueError
        Where σ is not positive or ζ lies outside the bearing.
    """
    eps, angle, zeta = np.broadcast_arrays(eccentricity_ratio(sommerfeld), angle, zeta)
    # The thickest film lies opposite to the line of centres.
    theta = angle - attitude_angle(eps) - np.pi
    return FilmField(
        angle=angle,
        zeta=zeta,
        thickness=film_thickness(eps, theta),
        pressure=pressure(eps, theta, zeta),
        cavitated=np.sin(theta) < -1e-12,  # θ = 0 and π, as they round, belong to the full film
    )


def gap(position: ArrayLike) -> Array:
    """Return the thinnest film around a journal wherever it is, 1 − ε (Eq. 5.19).

    Parameters
    ----------
    position : array_like, (..., 2)
        Journal centre in X, Y from the bearing's centre, in C.

    Returns
    -------
    array, (...)
        Smallest film thickness, in C.
    """
    place = np.asarray(position, dtype=float)
    return 1.0 - np.hypot(place[..., 0], place[..., 1])


def modified_sommerfeld(eps: ArrayLike) -> Array:
    """Return the modified Sommerfeld number at which the journal sits at ε (Eq. 5.8).

    σ = μΩLR/(4F_o)·(L/C)² = (1−ε²)²/(ε√(16ε² + π²(1−ε²)))

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε ≤ 1.

    Returns
    -------
    array, (...)
        Modified Sommerfeld number, σ [-]; infinite at ε = 0, zero at ε = 1.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1].

    Examples
    --------
    >>> round(float(modified_sommerfeld(0.5)), 6)
    0.333164
    """
    eps = _checked_eccentricity(eps)
    s2 = _s2(eps)
    with np.errstate(divide="ignore"):
        return s2**2 / (eps * np.sqrt(_load_square(eps, s2)))


def eccentricity_ratio(sigma: ArrayLike) -> Array:
    """Return the eccentricity ratio at a modified Sommerfeld number: Eq. 5.8 solved for ε.

    Parameters
    ----------
    sigma : array_like, (...)
        Modified Sommerfeld number, σ [-], zero or more; infinite without load.

    Returns
    -------
    array, (...)
        Eccentricity ratio, ε [-]. σ(ε) returns σ to 1e-12 relative over σ = 1e-6 … 1e6.

    Raises
    ------
    ValueError
        Where σ is negative or not a number.
    RuntimeError
        Where the search does not end.

    Notes
    -----
    With w = ε/s, s² = 1 − ε², Eq. 5.8 reads g(ln w) = 0,

        g = ln w + ln((1+w²)√(π²+16w²)) + ln σ.

    g is convex and rises with a slope between 1 and 4. So wherever Newton's tangents begin, they
    are right of the root from the first on and fall towards it, and a residual g brackets it: it
    lies between ln w and ln w − g. They begin on a chord of the curve.

    Examples
    --------
    >>> round(float(eccentricity_ratio(0.333164)), 6)
    0.5
    """
    sigma = real_array("sigma", sigma)
    if sigma.size and not sigma.min() >= 0.0:
        worst = sigma[~(sigma >= 0.0)].flat[0]
        raise ValueError(f"sigma = {worst}: must be zero or positive")
    curve = _curve()
    with np.errstate(divide="ignore"):  # at the curve's ends ε rounds to 0 and 1
        ln_load = np.minimum(np.maximum(-np.log(sigma), curve[0]), curve[-1])
    ln_w = np.interp(ln_load, curve, _LN_W)
    for _ in range(_MOST_ITERATIONS):
        value, slope = _ln_load(ln_w)
        step = (value - ln_load) / slope
        ln_w = ln_w - step
        if np.all(np.abs(step) <= _TOLERANCE):
            w = np.exp(ln_w)
            return w / np.sqrt(1.0 + w * w)
    raise RuntimeError(f"no eccentricity ratio found within {_MOST_ITERATIONS} iterations")


def attitude_angle(eps: ArrayLike) -> Array:
    """Return the attitude angle, tan φ = π√(1−ε²)/(4ε) (Eq. 5.7, its sign corrected).

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε ≤ 1.

    Returns
    -------
    array, (...)
        Attitude angle, φ [rad], from the load line to the line of centres in the sense of rotation.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1].
    """
    eps = _checked_eccentricity(eps)
    return np.arctan2(np.pi * np.sqrt(_s2(eps)), 4.0 * eps)


def static_force(eps: ArrayLike) -> Array:
    """Return the static force of the film on the journal in (r, t) (Eq. 5.5).

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.

    Returns
    -------
    array, (..., 2)
        (f_r, f_t) in μΩRL³/C²; f_r < 0 pushes the journal back to the centre, f_t > 0 forward.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1).
    """
    eps, s2 = _open(eps)
    return vector(-(eps**2) / s2**2, np.pi * eps / (4.0 * s2**1.5))


def stiffness(eps: ArrayLike) -> Array:
    """Return the dimensionless stiffness k = K·C/F_o in X, Y (Eq. 5.35, k_YY corrected).

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.

    Returns
    -------
    array, (..., 2, 2)
        k [-]. At ε = 0 the direct terms take their limits 4/π and 8/π, the others are infinite.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1).

    Examples
    --------
    >>> stiffness(0.5).round(4)
    array([[ 2.9233,  3.9766],
           [-0.8577,  2.2099]])
    """
    eps, s2 = _open(eps)
    return _xy_stiffness(eps, s2, *_load_units(eps, s2))


def damping(eps: ArrayLike) -> Array:
    """Return the dimensionless damping c = C·ΩC/F_o in X, Y (Eq. 5.35, c_YY corrected).

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.

    Returns
    -------
    array, (..., 2, 2)
        c [-]. At ε = 0 the cross terms take their limit 8/π, the direct ones are infinite.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1).
    """
    eps, s2 = _open(eps)
    return _xy_damping(eps, s2, *_load_units(eps, s2))


def film_stiffness(eps: ArrayLike) -> Array:
    """Return the stiffness in X, Y in film units (Eq. 5.35, k_YY corrected).

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.

    Returns
    -------
    array, (..., 2, 2)
        K in μΩRL³/C³. At ε = 0 only the cross terms remain, ±π/4 (Eq. 5.37).

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1).
    """
    eps, s2 = _open(eps)
    return _xy_stiffness(eps, s2, *_film_units(eps, s2))


def film_damping(eps: ArrayLike) -> Array:
    """Return the damping in X, Y in film units (Eq. 5.35, c_YY corrected).

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.

    Returns
    -------
    array, (..., 2, 2)
        C in μRL³/C³. At ε = 0 only the direct terms remain, π/2 (Eq. 5.37).

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1).
    """
    eps, s2 = _open(eps)
    return _xy_damping(eps, s2, *_film_units(eps, s2))


def radial_stiffness(eps: ArrayLike) -> Array:
    """Return the stiffness in (r, t) in film units (Eq. 5.30).

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.

    Returns
    -------
    array, (..., 2, 2)
        [[K_rr, K_rt], [K_tr, K_tt]] in μΩRL³/C³.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1).
    """
    eps, s2 = _open(eps)
    K_rr = 2.0 * eps * (1.0 + eps**2) / s2**3
    K_rt = np.pi / (4.0 * s2**1.5)
    K_tr = -np.pi * (1.0 + 2.0 * eps**2) / (4.0 * s2**2.5)
    K_tt = eps / s2**2
    return matrix(K_rr, K_rt, K_tr, K_tt)


def radial_damping(eps: ArrayLike) -> Array:
    """Return the damping in (r, t) in film units (Eq. 5.31).

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.

    Returns
    -------
    array, (..., 2, 2)
        [[C_rr, C_rt], [C_tr, C_tt]] in μRL³/C³.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1).
    """
    eps, s2 = _open(eps)
    C_rr = np.pi * (1.0 + 2.0 * eps**2) / (2.0 * s2**2.5)
    C_rt = -2.0 * eps / s2**2
    C_tt = np.pi / (2.0 * s2**1.5)
    return matrix(C_rr, C_rt, C_rt, C_tt)


def film_thickness(eps: ArrayLike, theta: ArrayLike) -> Array:
    """Return the film's thickness, H = 1 + ε cos θ (Eq. 5.19).

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-].
    theta : array_like, (...)
        Angle from the thickest film in the sense of rotation, θ [rad].

    Returns
    -------
    array, (...)
        Film thickness, H = h/C [-].

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1].
    """
    return 1.0 + _checked_eccentricity(eps) * np.cos(theta)


def pressure(eps: ArrayLike, theta: ArrayLike, zeta: ArrayLike = 0.0) -> Array:
    """Return the film's pressure above ambient in static equilibrium (Eq. 5.25).

    p = 3ε sin θ/H³·(1/4 − ζ²) over 0 ≤ θ ≤ π; the cavitated half is at ambient pressure.

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.
    theta : array_like, (...)
        Angle from the thickest film in the sense of rotation, θ [rad].
    zeta : array_like, (...)
        Axial position from the bearing's middle, ζ = z/L [-], −1/2 ≤ ζ ≤ 1/2.

    Returns
    -------
    array, (...)
        Pressure, p in μΩ(L/C)².

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1) or ζ outside the bearing.
    """
    eps, _ = _open(eps)
    zeta = np.asarray(zeta, dtype=float)
    if not np.all(np.abs(zeta) <= 0.5):
        raise ValueError("zeta = z/L: must lie within the bearing, -0.5 to 0.5")
    H = film_thickness(eps, theta)
    wedge = np.maximum(np.sin(theta), 0.0)  # cavitated where the film diverges
    return 3.0 * eps * wedge / H**3 * (0.25 - zeta**2)


def peak_position(eps: ArrayLike) -> Array:
    """Return where the pressure is highest: cos θ = −6ε/(1 + √(1+24ε²)).

    Source: Eq. 5.25 with ∂p/∂θ = 0, H cos θ + 3ε sin²θ = 0.

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε ≤ 1.

    Returns
    -------
    array, (...)
        Angle from the thickest film in the sense of rotation, θ [rad], from π/2 at ε = 0 to π.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1].
    """
    eps = _checked_eccentricity(eps)
    return np.arccos(-6.0 * eps / (1.0 + np.sqrt(1.0 + 24.0 * eps**2)))


def peak_pressure(eps: ArrayLike) -> Array:
    """Return the highest pressure of the film above ambient, in its middle plane (Eq. 5.25).

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.

    Returns
    -------
    array, (...)
        Pressure, p in μΩ(L/C)².

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1).
    """
    return pressure(eps, peak_position(eps))


def side_flow(eps: ArrayLike) -> Array:
    """Return the oil that leaves at both ends together: ε, in ΩRLC.

    The converging film takes in ½ΩRL·C(1+ε) at θ = 0 and hands on ½ΩRL·C(1−ε) at θ = π; the
    difference leaves at the ends. Source: continuity with the flow of Eq. 5.22.

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε ≤ 1.

    Returns
    -------
    array, (...)
        Side flow in ΩRLC.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1].
    """
    return _checked_eccentricity(eps)


def drag(eps: ArrayLike, *, length_to_radius: float) -> Array:
    """Return the film's torque on the journal: 2π/s + ½ε f_t (L/R)², in μΩR³L/C.

    The first term is the shear of the turning surface, over the whole circumference; the second
    is half the couple of the load, ½e·F_o sin φ, which the pressure flow takes. Torque times
    speed is all the energy that the film turns into heat.

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.
    length_to_radius : float
        Length over radius, L/R [-].

    Returns
    -------
    array, (...)
        Drag torque in μΩR³L/C.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1).
    """
    eps, s2 = _open(eps)
    shear = 2.0 * np.pi / np.sqrt(s2)
    couple = 0.5 * eps * static_force(eps)[..., 1]
    return shear + couple * length_to_radius**2


def added_mass(eps: ArrayLike) -> Array:
    """Return the film's added mass in X, Y: the integrals I_ij of temporal fluid inertia.

    I_rr = (π/ε²)(1/s − 1), I_tt = (π/ε²)(1 − s), I_rt = I_tr = 2/ε − ln((1+ε)/(1−ε))/ε².
    The added mass is M_ij = α_m ρRL³/(12C)·I_ij, with α_m = 6/5 at low Reynolds number and 1 in
    bulk flow. Source: temporal inertia of the film integrated over the full half film.

    Parameters
    ----------
    eps : array_like, (...)
        Eccentricity ratio, ε [-], 0 ≤ ε < 1.

    Returns
    -------
    array, (..., 2, 2)
        I_ij [-]; π/2 times the identity at ε = 0.

    Raises
    ------
    ValueError
        Where ε lies outside [0, 1).
    """
    eps, s2 = _open(eps)
    s = np.sqrt(s2)
    I_rr = np.pi / (s * (1.0 + s))  # (1/s − 1)/ε² with ε² = (1−s)(1+s), so no difference is lost
    I_tt = np.pi / (1.0 + s)
    return rotate(matrix(I_rr, _inertia_cross(eps), _inertia_cross(eps), I_tt), attitude_angle(eps))


def inertia(bearing: JournalBearing, sommerfeld: ArrayLike) -> Array:  # noqa: ARG001 - the seam's
    """Return the film's added mass in X, Y in static equilibrium: `added_mass` at a σ.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing; the short bearing's integrals do not ask for its shape.
    sommerfeld : array_like, (...)
        Modified Sommerfeld number, σ [-], positive; infinite without load.

    Returns
    -------
    array, (..., 2, 2)
        I_ij [-], in ρRL³/(12C).

    Raises
    ------
    ValueError
        Where σ is negative, or so small that the film's thickness rounds to zero.
    """
    return added_mass(eccentricity_ratio(sommerfeld))


def film_force(position: ArrayLike, velocity: ArrayLike) -> Array:
    """Return the nonlinear force of the film on the journal in X, Y.

    The film carries over the half circumference that the journal's rotation and motion together
    put under pressure. With x, y in C and ' = d/d(Ωt): A = x' + y/2, B = y' − x/2,
    V = √(A² + B²); a and b are the position along and across the axis on which that half film is
    centred. The force vanishes with V: at half speed whirl about the centre.

    Parameters
    ----------
    position : array_like, (..., 2)
        Journal centre from the bearing's centre, (x, y) in C, inside the clearance circle.
    velocity : array_like, (..., 2)
        Its velocity, (x', y') in CΩ.

    Returns
    -------
    array, (..., 2)
        Force in μΩRL³/C².

    Raises
    ------
    ValueError
        Where the position lies outside the clearance circle or the velocity is not finite.

    Notes
    -----
    Source: Eq. 5.25 integrated over its positive half, 0 < z' < π, for any velocity; its value at
    rest is Eq. 5.5 and its derivatives are Eqs. 5.30 and 5.31.
    """
    x, y = np.moveaxis(real_array("position", position), -1, 0)
    dx, dy = np.moveaxis(real_array("velocity", velocity), -1, 0)
    kappa2 = 1.0 - x**2 - y**2
    if not np.all(kappa2 > 0.0):
        raise ValueError("position: must lie inside the clearance circle, x² + y² < 1")
    A, B = dx + y / 2.0, dy - x / 2.0
    V = np.hypot(A, B)
    if not np.all(np.isfinite(V)):
        raise ValueError("velocity: must be finite")
    still = V == 0.0
    sin, cos = A / np.where(still, 1.0, V), -B / np.where(still, 1.0, V)
    a, b = x * cos + y * sin, -x * sin + y * cos
    kappa = np.sqrt(kappa2)
    G = 2.0 / kappa * np.arctan2(kappa, b)  # π/2 − atan(b/κ)
    F_a = V / 2.0 * a * (3.0 * b * G - 4.0 - 2.0 * b**2 / (1.0 - a**2)) / kappa2**2
    F_b = V / 2.0 * (G / kappa2 + 3.0 * b * (b * G - 2.0) / kappa2**2)
    return vector(F_a * cos - F_b * sin, F_a * sin + F_b * cos)


def _afloat(sommerfeld: ArrayLike) -> Array:
    """Return ε where it is less than 1."""
    sigma = real_array("sommerfeld", sommerfeld)
    eps = eccentricity_ratio(sigma)
    if eps.size and eps.max() == 1.0:
        raise ValueError(
            f"sommerfeld = {np.min(sigma):.3g}: too small, the film's thickness rounds to zero"
        )
    return eps


@functools.cache
def _curve() -> Array:
    return _ln_load(_LN_W)[0]


def _ln_load(ln_w: Array) -> tuple[Array, Array]:
    """Return ln(1/σ) of Eq. 5.8 and its slope over ln w, w = ε/s."""
    w2 = np.exp(2.0 * ln_w)
    a, b = 1.0 + w2, np.pi**2 + 16.0 * w2
    return ln_w + np.log(a * np.sqrt(b)), 4.0 - 2.0 / a - np.pi**2 / b


def _checked_eccentricity(eps: ArrayLike) -> Array:
    eps = real_array("eps", eps)
    if eps.size and not (eps.min() >= 0.0 and eps.max() <= 1.0):
        worst = eps[~((eps >= 0.0) & (eps <= 1.0))].flat[0]
        raise ValueError(f"eps = {worst}: the eccentricity ratio must lie between 0 and 1")
    return eps


def _open(eps: ArrayLike) -> tuple[Array, Array]:
    """Return ε and s² = 1 − ε² where ε < 1, as the forces need it."""
    eps = _checked_eccentricity(eps)
    if eps.size and eps.max() == 1.0:
        raise ValueError("eps = 1: the journal touches the wall, the film's force is infinite")
    return eps, _s2(eps)


def _s2(eps: Array) -> Array:
    return (1.0 - eps) * (1.0 + eps)


def _load_square(eps: Array, s2: Array) -> Array:
    """Return 16ε² + π²(1−ε²), whose root Eqs. 5.6 to 5.8 share."""
    return 16.0 * eps**2 + np.pi**2 * s2


def _load_units(eps: Array, s2: Array) -> tuple[Array, Array]:
    """Return f_r/ε and f_t/ε of Eq. 5.33, which scale Eq. 5.35 to k and c of Eq. 5.32."""
    root = np.sqrt(_load_square(eps, s2))
    with np.errstate(divide="ignore"):
        return 4.0 / root, np.pi * np.sqrt(s2) / (eps * root)


def _film_units(eps: Array, s2: Array) -> tuple[Array, Array]:
    """Return the same times F_o, in film units: ε/s⁴ and π/(4s³)."""
    return eps / s2**2, np.pi / (4.0 * s2**1.5)


def _xy_stiffness(eps: Array, s2: Array, radial: Array, tangential: Array) -> Array:
    """Return Eq. 5.35 for K, scaled by `radial` and `tangential`."""
    fr2, ft2 = _direction(eps, s2)
    K_XX = radial / s2 * (fr2 + 1.0 + 2.0 * eps**2)
    K_XY = tangential / s2 * (fr2 + 1.0 + 2.0 * eps**2)
    K_YX = tangential / s2 * (fr2 - s2)
    K_YY = radial / s2 * (ft2 + s2)  # the source prints f_r²
    return matrix(K_XX, K_XY, K_YX, K_YY)


def _xy_damping(eps: Array, s2: Array, radial: Array, tangential: Array) -> Array:
    """Return Eq. 5.35 for C, scaled by `radial` and `tangential`."""
    fr2, ft2 = _direction(eps, s2)
    C_XX = 2.0 * tangential / s2 * ((2.0 + eps**2) * fr2 + s2)
    C_XY = 2.0 * radial / s2 * ((2.0 + eps**2) * ft2 - s2)
    C_YY = 2.0 * tangential / s2 * ((2.0 + eps**2) * ft2 - s2)  # the source prints f_r²
    return matrix(C_XX, C_XY, C_XY, C_YY)


def _direction(eps: Array, s2: Array) -> tuple[Array, Array]:
    """Return cos²φ and sin²φ, the squares of f_r and f_t of Eq. 5.33."""
    load2 = _load_square(eps, s2)
    return 16.0 * eps**2 / load2, np.pi**2 * s2 / load2


def _inertia_cross(eps: Array) -> Array:
    """Return I_rt = 2/ε − ln((1+ε)/(1−ε))/ε², by its series −2Σ ε^(2n−1)/(2n+1) for small ε."""
    n = np.arange(1, 8)
    small = -2.0 * np.sum(eps[..., None] ** (2 * n - 1) / (2 * n + 1), axis=-1)
    safe = np.where(eps < 0.1, 0.5, eps)
    closed = 2.0 / safe - 2.0 * np.arctanh(safe) / safe**2
    return np.where(eps < 0.1, small, closed)
