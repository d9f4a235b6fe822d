"""Checks of whole machines: onset, modes, response, and the published examples."""

import math
from dataclasses import replace

import numpy as np
from scipy.optimize import brentq

from rotorcalc import modes
from rotorcalc.analysis import analyse
from rotorcalc.coefficients import equilibrium
from rotorcalc.films import short
from rotorcalc.machine import Machine
from rotorcalc.onset import search, whirl
from rotorcalc.presets import PRESETS
from rotorcalc.unbalance_response import orbit_ellipse, synchronous_response
from rotorcalc.units import rpm
from rotorcalc.validation.case import Case, alike


def onset() -> list[Case]:
    """Return the checks of the onset speed."""
    group = "Onset of a machine: eigenvalues and closed form"
    cases: list[Case] = []
    for key, flexible, name in (
        ("sheet-1e8", False, "sheet's rotor, rigid"),
        ("sheet-1e8", True, "sheet's rotor, K_rot = 10⁸ N/m"),
        ("sheet-1e7", True, "sheet's rotor, K_rot = 10⁷ N/m"),
        ("friswell-5-5-1", True, "Friswell's bearing"),
    ):
        machine = PRESETS[key].machine
        found, closed = search.searched_onset(machine, flexible), _closed_onset(machine, flexible)
        cases.append(
            Case(
                group, f"Onset, {name}", found.speed / rpm, closed / rpm, 1e-9 * closed / rpm,
                "Eqs. 5.8, 5.45, 5.46" + (" and 5.50" if flexible else ""), "rpm",
            )
        )  # fmt: skip
        sweep = analyse(machine, found.speed)
        there = float(sweep.flexible_threshold if flexible else sweep.rigid_threshold)
        cases.append(
            Case(
                group, f"Threshold speed there, {name}", there / rpm, found.speed / rpm,
                1e-9 * closed / rpm, "Ω = Ω_sf(ε(Ω))" if flexible else "Ω = Ω_s(ε(Ω))", "rpm",
            )
        )  # fmt: skip
    machine = PRESETS["sheet-1e8"].machine
    found = search.searched_onset(machine, flexible=False)
    state = equilibrium(machine, found.speed)
    values = modes.eigenvalues(machine.rotor, state.stiffness, state.damping, flexible=False)
    crossing = values[np.argmax(values.real)]
    ratio = float(analyse(machine, found.speed).whirl_ratio)
    growth = float(crossing.real) / found.speed
    axis = "an eigenvalue lies on the imaginary axis"
    bare = search.searched_onset(_unloaded(machine), flexible=False)
    return [
        *cases,
        Case(group, "Re λ/Ω at the rigid onset", growth, 0.0, 1e-9, axis),
        Case(
            group,
            "|Im λ|/Ω there",
            float(abs(crossing.imag)) / found.speed,
            ratio,
            1e-9,
            "Eq. 5.46",
        ),
        Case(group, "Onset without load", bare.speed / rpm, 0.0, 0.0, "below Eq. 5.48", "rpm"),
    ]


def _closed_onset(machine: Machine, flexible: bool) -> float:
    """Return the onset from the closed forms alone: the ε at which Ω_sf(ε) = Ω(ε)."""
    b, M, F = machine.bearing, machine.rotor.half_mass, machine.static_load
    sag = machine.static_sag / b.radial_clearance if flexible else 0.0
    aspect = (b.length / b.radial_clearance) ** 2

    # Solved in ε, independently of `onset.closed_form`, which solves in σ.
    def excess(eps: float) -> float:
        onset = whirl.whirl_onset(short.stiffness(eps), short.damping(eps))
        softened = onset.critical_mass / (1.0 + onset.equivalent_stiffness * sag)
        threshold = math.sqrt(float(softened) * F / (M * b.radial_clearance))
        return math.log(threshold / speed(eps))

    def speed(eps: float) -> float:
        load = 4.0 * float(short.modified_sommerfeld(eps)) * F
        return load / (machine.viscosity * b.length * b.radius * aspect)

    # Whirl ends at ε = 0.756, where the threshold is infinite.
    return speed(float(brentq(excess, 1e-4, 0.75, xtol=1e-15, rtol=1e-14)))


def _unloaded(machine: Machine) -> Machine:
    return replace(machine, load=0.0)


def modes_and_response() -> list[Case]:
    """Return the checks of modes, response, ellipses and files."""
    group = "Modes and response"
    preset = PRESETS["sheet-1e8"]
    machine = preset.machine
    rotors = (
        ("6 states", machine.rotor),
        ("8 states", replace(machine.rotor, journal_mass=20.0, disk_damping=500.0)),
    )
    state = equilibrium(machine, preset.speed)
    K, C, speed = state.stiffness, state.damping, preset.speed
    cases: list[Case] = []
    for name, rotor in rotors:
        A = modes.state_matrix(rotor, K, C)
        shapes = modes.mode_shapes(rotor, K, C)
        moved, scaled = (A @ shapes.vectors).T, (shapes.eigenvalues * shapes.vectors).T
        cases.append(
            alike(group, f"A v and λ v, {name}", (moved, scaled), "every mode", tolerance=1e-10)
        )
        # The imbalance accelerates the disk: u Ω² over its mass, among the velocities.
        push = np.zeros(len(A), dtype=complex)
        push[len(A) - (4 if rotor.journal_mass else 2) :][:2] = (
            rotor.imbalance * speed**2 * np.array([1.0, -1.0j])
        )
        swing = np.linalg.solve(1j * speed * np.eye(len(A)) - A, push).astype(complex)
        answer = np.stack(synchronous_response(rotor, K, C, np.float64(speed)))
        title = f"Imbalance response and (jΩ − A)⁻¹ b, {name}"
        cases.append(alike(group, title, (answer, swing[:4].reshape(2, 2)), "the state matrix"))
    return [*cases, *_ellipse(), _round_trips()]


def _ellipse() -> list[Case]:
    """Return the checks of an ellipse against the sampled orbit of its phasors."""
    group, x, y = "Modes and response", 1.3 - 0.4j, 0.2 - 0.9j
    orbit = orbit_ellipse(x, y)
    turn = np.exp(2j * np.pi * np.arange(64) / 64)
    X, Y = np.real(x * turn), np.real(y * turn)
    dX, dY = np.real(1j * x * turn), np.real(1j * y * turn)
    a, b = float(orbit.semi_major), float(orbit.semi_minor)
    # ½∮(x dy − y dx); the mean over even steps is exact for integrands of so few harmonics.
    area = math.pi * float(np.mean(X * dY - Y * dX))
    spread = 2.0 * float(np.mean(X**2 + Y**2))
    return [
        Case(
            group, "Ellipse: π a b and the area enclosed", math.pi * a * b, area, 1e-12, "sampled"
        ),
        Case(
            group, "Ellipse: a² + b² and twice the mean r²", a**2 + b**2, spread, 1e-12, "sampled"
        ),
    ]


def _round_trips() -> Case:
    machines = [preset.machine for preset in PRESETS.values()]
    lost = sum(Machine.from_json(machine.to_json()) != machine for machine in machines)
    return Case(
        "Modes and response", "Presets that a JSON file changes", float(lost), 0.0, 0.0,
        "exact to the last bit", "machines",
    )  # fmt: skip


def sheet() -> list[Case]:
    """Return the numbers of the calculation sheet's machine."""
    group = "The calculation sheet's 600 lbf rotor"
    stiff, soft = PRESETS["sheet-1e8"].machine, PRESETS["sheet-1e7"].machine
    clearance, M = stiff.bearing.radial_clearance, stiff.rotor.half_mass
    point = analyse(stiff, 6000.0 * rpm)
    onsets = (
        ("rigid", search.searched_onset(stiff, flexible=False), 10651.9, 5332.6),
        ("K_rot = 10⁸ N/m", search.searched_onset(stiff), 8919.3, None),
        ("K_rot = 10⁷ N/m", search.searched_onset(soft), 4627.1, None),
    )
    alone = [
        float(modes.undamped_frequency(m.rotor.shaft_stiffness, M)) / rpm for m in (stiff, soft)
    ]
    printed = "calculation sheet, printed"
    rows = [
        ("Half mass M", M, 136.071, 5e-4, printed, "kg"),
        ("Viscosity at 60 °C", stiff.viscosity, 0.013, 5e-4, printed, "Pa·s"),
        ("Viscosity at 60 °C", stiff.viscosity, 0.012769, 5e-7, "recorded", "Pa·s"),
        ("Γ/C, K_rot = 10⁸ N/m", stiff.static_sag / clearance, 0.222, 5e-4, printed, "-"),
        ("Γ/C, K_rot = 10⁷ N/m", soft.static_sag / clearance, 2.224, 5e-4, printed, "-"),
        ("√(K_rot/M), K_rot = 10⁸ N/m", alone[0], 8186.0, 0.5, printed, "rpm"),
        ("√(K_rot/M), K_rot = 10⁷ N/m", alone[1], 2589.0, 0.5, printed, "rpm"),
        ("σ at 6000 rpm", float(point.sommerfeld), 3.91447, 5e-6, "recorded", "-"),
        ("ε at 6000 rpm", float(point.eccentricity_ratio), 0.080116, 5e-7, "recorded", "-"),
        ("Side flow at 6000 rpm", float(point.side_flow) * 6e4, 0.67957, 5e-6, "recorded", "l/min"),
        ("Power at 6000 rpm", float(point.power_loss) / 1e3, 11.1735, 5e-5, "recorded", "kW"),
    ]
    for name, onset, speed, frequency in onsets:
        rows.append((f"Onset, {name}", onset.speed / rpm, speed, 0.05, "recorded", "rpm"))
        if frequency is not None:
            rows.append(
                (f"Whirl, {name}", onset.whirl_frequency / rpm, frequency, 0.05, "recorded", "rpm")
            )
    return [Case(group, *row) for row in rows]


def friswell() -> list[Case]:
    """Return the numbers of the textbook example."""
    group = "Friswell et al., example 5.5.1"
    preset = PRESETS["friswell-5-5-1"]
    point = analyse(preset.machine, preset.speed)
    K = point.stiffness / 1e6
    printed = "printed, axes X along the load"
    eps = float(point.eccentricity_ratio)
    return [
        Case(group, "ε", eps, 0.2663, 5e-5, "printed"),
        Case(group, "K_XX", float(K[0, 0]), 8.815, 5e-4, printed, "MN/m"),
        Case(group, "K_XY", float(K[0, 1]), 25.06, 5e-3, printed, "MN/m"),
        Case(group, "K_YX", float(K[1, 0]), -16.39, 5e-3, printed, "MN/m"),
        Case(group, "K_YY", float(K[1, 1]), 12.81, 5e-3, printed, "MN/m"),
    ]
