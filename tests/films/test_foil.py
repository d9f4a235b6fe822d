"""The gas film of a foil bearing: limits, identities, a second program, tables, refusals."""

import math
from dataclasses import replace

import numpy as np
import pytest

import rotorcalc as rc
from rotorcalc import analyse, onset_speed
from rotorcalc.coefficients import dynamics, film_field, middle_pressure
from rotorcalc.design import inputs_of
from rotorcalc.films import FilmUnits, film_of, film_state, reduced, turning_bounds
from rotorcalc.films.foil.equilibrium import raised, settled
from rotorcalc.films.foil.impedance import impedance, impedances
from rotorcalc.films.foil.mesh import mesh
from rotorcalc.films.foil.results import peak
from rotorcalc.films.foil.table import FoilShape, over_speed
from rotorcalc.films.state import OperatingPoints
from rotorcalc.onset.judge import is_unstable
from tests.films.plain_gas import Gas as PlainGas
from tests.onset.test_impedance import balance

AMBIENT = 101325.0
UPRIGHT = np.pi  # the slit opposite to the load


def films(number, load, *, compliance=1.0, slit=UPRIGHT, ratio=1.0, grid=(112, 6)):
    """Return the package's films at loads, F/(p_a D L), on a mesh of its own."""
    number, load = np.broadcast_arrays(np.atleast_1d(number).astype(float), load)
    on_the_way = raised(mesh(ratio**2, slit, *grid), compliance, number, load.astype(float), 0.0)
    assert on_the_way.good.all()
    found = settled(on_the_way.films, load.astype(float))
    assert found.good.all()
    return found.films


def machine_of(number=1.0, load=0.15, *, ratio=1.0, speed=3000.0, mass=5.0, **shape):
    """Return a machine with these Λ, at a speed, and F/(p_a D L); by default α = 1."""
    D, C = 0.040, 30e-6
    geometry = rc.Foil.usual(C, compliance=shape.pop("compliance", 1.0))
    bearing = rc.JournalBearing(
        diameter=D, length=D / ratio, radial_clearance=C, geometry=replace(geometry, **shape)
    )
    mu = number * AMBIENT / (6.0 * speed) * (2.0 * C / D) ** 2
    gas = rc.Gas(reference_viscosity=mu, reference_temperature=20.0)
    F = load * AMBIENT * D * D / ratio
    return rc.Machine(oil=gas, bearing=bearing, rotor=rc.Rotor(mass=mass), temperature=20.0, load=F)


MACHINE = machine_of()


# --- Limits ----------------------------------------------------------------------------------


def test_a_long_rigid_film_about_the_centre_is_the_closed_form():
    """F/(p_a R L) = πεΛ/√(1 + Λ²) and tan φ = 1/Λ, of which half the bore, p > 1, is half.

    With one pressure along half the bearing the ends, ambient, stand for a third of its length.
    """
    number, load = np.array([0.2, 1.0, 3.0]), 1e-6
    # Along the load the pressure is a cosine: at 90° the slit's ambient pressure is the film's own.
    found = films(number, load * 2 / 3, compliance=1e-6, slit=np.pi / 2, ratio=1e-4, grid=(720, 1))
    eps, phi = np.hypot(*found.position.T), np.arctan2(*found.position.T[::-1])
    expected = 0.5 * np.pi * number / np.sqrt(1.0 + number**2)
    assert 2.0 * load / eps == pytest.approx(expected, rel=1e-4)
    assert np.tan(phi) == pytest.approx(1.0 / number, rel=1e-4)


def test_a_slow_long_rigid_film_is_the_incompressible_half_film():
    """Sommerfeld's pressure where it is above ambient, with its forces in closed form."""
    eps, number = 0.5, 1e-4
    phi = math.atan(math.pi / 2.0 * math.sqrt(1.0 - eps**2) / eps)
    below = (2.0 + eps**2) * (1.0 - eps**2)
    force = 6.0 * eps * math.hypot(2.0 * eps, math.pi * math.sqrt(1.0 - eps**2)) / below
    load = 0.5 * force * number / 6.0
    found = films(
        number, load * 2 / 3, compliance=1e-9, slit=phi + np.pi, ratio=1e-4, grid=(360, 1)
    )
    place = eps * np.array([math.cos(phi), math.sin(phi)])
    assert found.position[0] == pytest.approx(place, abs=1e-4)


def test_without_load_a_slow_film_has_the_coefficients_of_no_compression():
    """K and C in film units do not depend on the speed, and the journal is centred."""
    slow, slower = (film_state(MACHINE.bearing, np.inf, viscosity=2e-5, speed=w) for w in (1, 0.01))
    assert slow.position.tolist() == [0.0, 0.0]
    assert slow.stiffness == pytest.approx(slower.stiffness, rel=1e-3, abs=1e-3)
    assert slow.damping == pytest.approx(slower.damping, rel=1e-3, abs=1e-3)


def test_at_a_very_high_frequency_the_gas_has_no_time_to_flow():
    """p h is then constant: the film's rigidity is that of its compression, in phase."""
    found = films(0.5, 0.1, compliance=1e-6)
    Z = impedance(found, 1e5, 0.0)[0]
    p, h = 1.0 + found.rise[0], found.thickness[0]
    pressed = (found.rise[0] > 0.0) * (p / h) * found.mesh.weights * found.mesh.step
    n = np.stack([np.cos(found.mesh.angle), np.sin(found.mesh.angle)])
    expected = np.einsum("nm,in,jn->ij", pressed[:, :-1], n, n)
    # The last node of the axis stays ambient, and the edge of the pressed part is one of cells.
    assert Z.real == pytest.approx(expected, abs=0.01 * expected.max())
    assert np.abs(Z.imag).max() < 0.01 * np.abs(Z).max()


# --- A second program --------------------------------------------------------------------------

# D/L, α, Λ, F/(p_a D L), slit, steps of the load: light, usual, heavy and very heavy ones.
STATES = [
    (1.0, 1.0, 0.1, 0.05, UPRIGHT, 1),
    (2.0, 0.1, 0.8, 0.30, 1.5 * UPRIGHT, 3),
    (1.0, 1.0, 1.0, 0.60, UPRIGHT, 3),
    (1.0, 0.5, 5.0, 1.50, UPRIGHT, 6),
    (0.7, 1.0, 2.0, 1.50, 0.8 * UPRIGHT, 6),
]


@pytest.mark.parametrize("state", STATES)
def test_a_second_program_finds_the_same_film(state):
    ratio, compliance, number, load, slit, steps = state
    plain = PlainGas(ratio, compliance, number, slit, 100, 40)
    p, q = plain.equilibrium(load, steps)
    machine = machine_of(
        number, load, ratio=ratio, compliance=compliance, slit=slit, loss_factor=0.15
    )
    state, film = analyse(machine, 3000.0), dynamics(machine, 3000.0)
    place = state.journal_position / machine.bearing.radial_clearance
    assert place == pytest.approx(q, abs=4e-3 * max(1.0, np.hypot(*q)))
    assert float(state.peak_pressure) == pytest.approx((p.max() - 1.0) * AMBIENT, rel=0.01)
    bearing = machine.bearing
    units = FilmUnits(bearing, machine.viscosity, 3000.0)
    if np.hypot(*q) < 1.0:  # towards closed ends the plain program's shear converges slowly
        assert float(state.drag_torque) == pytest.approx(plain.drag(p, q) * units.torque, rel=0.01)
    assert float(state.side_flow) == pytest.approx(plain.side_flow(p, q) * units.flow, rel=0.02)
    unit = AMBIENT * bearing.radius * bearing.length / bearing.radial_clearance
    for nu in (0.3, 1.0):
        K, C = reduced(film, np.array(3000.0 * nu))
        Z = plain.impedance(p, q, nu, loss=0.15)
        assert (K + 3000.0j * nu * C) / unit == pytest.approx(Z, abs=0.01 * np.abs(Z).max())


def test_the_worked_case():
    """L/D 1, α 1, Λ 1, F/(p_a D L) 0.15, no loss: from a program on another mesh, to 1 %."""
    machine = machine_of(loss_factor=0.0)
    found = analyse(machine, 3000.0)
    C = machine.bearing.radial_clearance
    assert found.journal_position / C == pytest.approx([0.511, 0.348], abs=1e-3)
    assert float(found.minimum_film_thickness) / C == pytest.approx(0.382, rel=0.01)
    unit = AMBIENT * machine.bearing.radius * machine.bearing.length / C
    stiffness, damping = found.stiffness.ravel() / unit, found.damping.ravel() * 3000.0 / unit
    assert stiffness == pytest.approx([0.752, 0.145, 0.111, 0.604], abs=0.01 * 0.752)
    assert damping == pytest.approx([0.204, -0.091, 0.117, 0.248], abs=0.01 * 0.248)


# --- Identities --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("number", "load", "compliance"), [(1.0, 0.15, 1.0), (0.2, 0.8, 1.0), (4.0, 0.4, 0.05)]
)
def test_the_slowest_whirl_meets_the_static_stiffness(number, load, compliance):
    """K at ν → 0 against two more loads, one heavier, one turned, of a foil without loss."""
    step, fine = 0.02, {"compliance": compliance, "grid": (224, 6)}

    def place(W, turned=0.0):
        # A load turned by an angle is one along X with the slit turned back.
        x = films(number, W, slit=UPRIGHT - turned, **fine).position[0]
        c, s = math.cos(turned), math.sin(turned)
        return np.array([[c, -s], [s, c]]) @ x

    K = impedance(films(number, load, **fine), 0.0, 0.0)[0].real
    heavier = (place((1 + step) * load) - place((1 - step) * load)) / (2 * step)
    turned = (place(load, step) - place(load, -step)) / (2 * step)
    assert K @ heavier == pytest.approx([2.0 * load, 0.0], abs=0.01 * load)
    assert K @ turned == pytest.approx([0.0, 2.0 * load], abs=0.01 * load)


def test_a_loss_factor_turns_the_stiffness_of_the_foil():
    """Of a foil so soft that it alone gives way, Z is in proportion to 1 + iη."""
    found = films(3.0, 0.8, compliance=5.0)
    still, lossy = (impedance(found, 1e-4, eta)[0] for eta in (0.0, 0.2))
    assert np.abs(still.imag).max() < 1e-3 * np.abs(still).max()
    turn = np.trace(lossy) / np.trace(still)
    assert 0.1 < turn.imag / turn.real < 0.2
    for nu in (0.3, 1.0, 3.0):
        calm, damped = (np.trace(impedance(found, nu, eta)[0].imag) for eta in (0.0, 0.2))
        assert damped > calm


def test_the_pressures_of_the_field_carry_the_load():
    angle = np.linspace(0.0, 2.0 * np.pi, 721)[:-1]
    zeta, weights = np.polynomial.legendre.leggauss(12)
    points = OperatingPoints.of(
        MACHINE.bearing, viscosity=MACHINE.viscosity, speed=3000.0, load=MACHINE.static_load
    )
    found = film_of(MACHINE.bearing).field(points, angle=angle[:, None], zeta=0.5 * zeta)
    unit = FilmUnits(MACHINE.bearing, MACHINE.viscosity, 3000.0)
    line = np.maximum(found.pressure, 0.0) @ weights / 2.0 * unit.pressure
    area = MACHINE.bearing.radius * MACHINE.bearing.length * (angle[1] - angle[0])
    assert area * line @ np.cos(angle) == pytest.approx(MACHINE.static_load, rel=3e-3)
    assert area * line @ np.sin(angle) == pytest.approx(0.0, abs=3e-3 * MACHINE.static_load)


def test_the_film_is_the_gap_and_the_foils_deflection():
    theta = np.linspace(0.0, 2.0 * np.pi, 73)
    found = film_field(MACHINE, 3000.0, theta=theta, zeta=(0.0, 0.3))
    sweep = analyse(MACHINE, 3000.0)
    angle = theta + float(sweep.attitude_angle) + np.pi
    x, y = sweep.journal_position
    rigid = MACHINE.bearing.radial_clearance - x * np.cos(angle) - y * np.sin(angle)
    pressed = rc.foil_deflection(MACHINE, 3000.0, angle)
    assert found.thickness == pytest.approx(rigid + pressed, abs=1e-3 * 30e-6)
    k_f = MACHINE.bearing.geometry.foundation_stiffness
    assert pressed == pytest.approx(np.maximum(found.pressure[:, 0], 0.0) / k_f, abs=1e-12)
    assert found.pressure.max() == pytest.approx(float(sweep.peak_pressure), rel=5e-3)
    assert rc.foil_deflection(MACHINE, 3000.0, angle, zeta=0.5) == pytest.approx(0.0)
    around = middle_pressure(MACHINE, [2000.0, 3000.0], angle=angle)
    assert around[1] == pytest.approx(found.pressure[:, 0])


# --- Tables ------------------------------------------------------------------------------------


@pytest.mark.parametrize(("compliance", "load"), [(1.0, 0.15), (0.1, 0.5), (1.0, 1.5)])
def test_a_table_holds_between_its_places_what_is_solved_there(compliance, load):
    foil = FoilShape(slenderness=1.0, compliance=compliance, loss_factor=0.15, slit=UPRIGHT)
    table = over_speed(foil, load)
    place = np.linspace(table.place[0], math.log(20.0), 9)[1:] - 0.05
    found = films(np.exp(place), load, compliance=compliance)
    assert table.row(place).position == pytest.approx(found.position, abs=2e-3)
    whirl = table.whirl.at(place)
    for nu in (0.07, 0.37, 0.52, 0.9, 1.0, 1.7, 25.0):
        K, C = whirl(np.full(8, nu))
        Z = impedance(found, nu, 0.15)
        size = np.abs(Z).max(axis=(1, 2))
        assert np.abs(K + 1j * nu * C - Z).max(axis=(1, 2)) / size == pytest.approx(0.0, abs=5e-3)


def test_the_impedance_between_the_solved_whirls_is_that_of_its_own_solution():
    found = films([0.1, 1.0, 10.0, 25.0], 0.15)
    nu = np.array([0.0, 0.1, 0.3, 0.45, 0.55, 0.7, 1.0, 2.0, 8.0, 100.0])
    Z = impedances(found, nu, 0.15)
    for i, one in enumerate(nu):
        apart = np.abs(Z[:, i] - impedance(found, one, 0.15)).max(axis=(1, 2))
        assert apart / np.abs(Z[:, i]).max(axis=(1, 2)) == pytest.approx(0.0, abs=0.01)


@pytest.mark.parametrize("load", [0.02, 0.15, 1.0])
def test_a_mesh_twice_as_fine_moves_the_film_little(load):
    unit = 1.0 / 12.0  # σ of Λ = 1 and a load of 1 at L/D = 1
    found = film_of(MACHINE.bearing).accuracy(unit / load)
    assert found.place < 5e-3
    assert found.stiffness < 0.01
    assert found.damping < 0.015
    assert "112 cells" in found.mesh


def test_curves_over_load_are_the_machines_own_at_each_load():
    """Many loads at one speed have one table, few loads one over speed each."""
    loads = np.geomspace(0.02, 0.9, 12)
    sigma = 1.0 / (12.0 * loads)
    many = film_state(MACHINE.bearing, sigma, viscosity=MACHINE.viscosity, speed=3000.0)
    for i in (0, 5, 11):
        own = film_state(MACHINE.bearing, sigma[i], viscosity=MACHINE.viscosity, speed=3000.0)
        size = np.abs(own.stiffness).max()
        assert many.position[i] == pytest.approx(own.position, abs=1e-3)
        assert many.stiffness[i] == pytest.approx(own.stiffness, abs=3e-3 * size)
        assert many.drag[i] == pytest.approx(own.drag, rel=5e-3)
        assert many.side_flow[i] == pytest.approx(own.side_flow, rel=5e-3)
        assert many.peak_pressure[i] == pytest.approx(own.peak_pressure, rel=5e-3)


def test_under_a_vanishing_load_the_film_is_in_proportion_to_it():
    """Of many loads at one speed the lightest lie below the table."""
    loads = np.geomspace(1e-6, 0.1, 12)
    found = film_state(
        MACHINE.bearing, 1.0 / (12.0 * loads), viscosity=MACHINE.viscosity, speed=3000.0
    )
    light = slice(0, 4)
    for values in (*found.position.T, found.side_flow, found.peak_pressure):
        assert (values / loads)[light] == pytest.approx(values[0] / loads[0], rel=1e-2)
    unloaded = film_state(MACHINE.bearing, np.inf, viscosity=MACHINE.viscosity, speed=3000.0)
    assert found.stiffness[0] == pytest.approx(unloaded.stiffness, abs=0.01)
    assert found.attitude_angle[0] == pytest.approx(float(unloaded.attitude_angle), abs=0.01)


def test_the_highest_pressure_does_not_depend_on_where_the_nodes_lie():
    cell = 2.0 * np.pi / 56
    found = [
        peak(films(1.0, 0.15, grid=(56, 5), slit=UPRIGHT + share * cell))
        for share in (0, 0.25, 0.5)
    ]
    highest, angle = np.squeeze(found).T
    assert np.ptp(highest) < 3e-4 * highest[0]
    assert np.ptp(angle) < 2e-3


def test_a_draft_is_near():
    whole, rough = (
        analyse(replace(MACHINE, bearing=replace(MACHINE.bearing, film=film)), 3000.0)
        for film in ("finite", "coarse")
    )
    size = np.abs(whole.stiffness).max()
    assert rough.stiffness == pytest.approx(whole.stiffness, abs=0.03 * size)


# --- Machines ----------------------------------------------------------------------------------


def growing_modes(machine, speed):
    """Return how many modes grow, by Nyquist's curve of the determinant from ω = 0 to ∞."""
    omega = np.geomspace(1e-5, 900.0, 60_001) * speed
    det = np.linalg.det(balance(machine, speed, 1j * omega, omega))
    turned = np.unwrap(np.angle(det))
    # A gas film is a spring at very high frequencies: only the rotor's masses count then.
    masses = 4 if machine.rotor.is_rigid or not machine.rotor.journal_mass else 8
    return round((masses * np.pi / 2.0 - (turned[-1] - turned[0])) / np.pi)


ROTORS = {
    "rigid": rc.Rotor(mass=5.0),
    "flexible": rc.Rotor(mass=5.0, shaft_stiffness=1e7),
    "with journals": rc.Rotor(mass=5.0, shaft_stiffness=1e7, journal_mass=0.25),
}


@pytest.mark.parametrize("rotor", ROTORS)
def test_nyquist_tells_the_same_of_both_sides_of_the_onset(rotor):
    machine = replace(MACHINE, rotor=ROTORS[rotor])
    onset = onset_speed(machine)
    assert onset.method == "eigenvalues"
    for share in (0.6, 0.99, 1.01, 1.5):
        grows = growing_modes(machine, share * onset.speed)
        assert (grows > 0) == (share > 1.0) == bool(is_unstable(machine, share * onset.speed))
    omega = np.array(onset.whirl_frequency)
    W = balance(machine, onset.speed, 1j * omega, omega)
    assert abs(np.linalg.det(W)) < 1e-6 * np.linalg.norm(W) ** 2


# Two whirls of light journals come so close that one is followed into the other.
CLOSE = machine_of(1.506, 0.24783666, ratio=1.400822, compliance=0.478902)
CLOSE = replace(CLOSE, rotor=rc.Rotor(mass=0.5, shaft_stiffness=1e6, journal_mass=0.05))


@pytest.mark.parametrize(
    "machine",
    [*(replace(MACHINE, rotor=rotor) for rotor in ROTORS.values()), CLOSE],
    ids=[*ROTORS, "close"],
)
def test_each_mode_is_another_one(machine):
    """Forward and backward whirl have nearly one frequency, far below the running speed."""
    sweep = analyse(machine, np.linspace(1000.0, 50e3, 60))
    values = sweep.flexible_eigenvalues
    assert np.all(np.isfinite(values))
    apart = np.abs(values[:, :, None] - values[:, None, :]) / np.abs(values[:, :, None])
    assert (apart + np.eye(values.shape[1])).min() > 1e-6


def test_loss_in_the_foil_raises_the_onset():
    speeds = [onset_speed(machine_of(loss_factor=eta)).speed for eta in (0.0, 0.15, 0.4)]
    assert speeds[0] < speeds[1] < speeds[2]


def test_a_film_lifts_at_its_lift_off_speed():
    lift = rc.lift_off_speed(MACHINE)
    assert turning_bounds(MACHINE.bearing, MACHINE.static_load)[0] == lift * MACHINE.viscosity
    found = analyse(MACHINE, 1.001 * lift)
    assert np.all(np.isfinite(found.stiffness))
    thinnest = film_field(MACHINE, 1.001 * lift, theta=np.linspace(0.0, 2 * np.pi, 361))
    assert thinnest.thickness.min() == pytest.approx(0.05 * 30e-6, rel=0.25)
    with pytest.raises(ValueError, match=r"^speed = .*: below the lift-off speed of this load"):
        analyse(MACHINE, 0.999 * lift)
    assert rc.lift_off_speed(replace(MACHINE, load=0.0)) == 0.0
    assert rc.heat.has_film(MACHINE, [0.999 * lift, 1.001 * lift, 1e6]).tolist() == [
        False, True, False
    ]  # fmt: skip


def test_foil_bearings_are_compared_and_varied():
    draft = replace(MACHINE, bearing=replace(MACHINE.bearing, film="coarse"))
    (usual,) = rc.compare_bearings(MACHINE, speed=3000.0)
    assert usual.bearing.geometry == MACHINE.bearing.geometry
    assert usual.onset == pytest.approx(onset_speed(MACHINE).speed)
    assert usual.refusal == ""
    found = rc.sensitivities(draft, inputs=["foundation_stiffness", "sutherland_temperature"])
    assert [one.field.rpartition(".")[2] for one in found.inputs] == [
        "foundation_stiffness", "sutherland_temperature"
    ]  # fmt: skip
    assert "oil.sutherland_temperature" in inputs_of(MACHINE)


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        (lambda: analyse(MACHINE, 1e5), r"^speed = 100000 rad/s: .* compressibility number"),
        (lambda: analyse(machine_of(load=2.1), 3000.0), r"^load: 2\.1 of the ambient pressure"),
        (lambda: rc.foil_deflection(MACHINE, 3000.0, 0.0, zeta=0.6), "^zeta = z/L"),
        (
            lambda: film_state(MACHINE.bearing, np.geomspace(0.01, 1, 12), viscosity=2e-5, speed=9),
            "^sommerfeld = .*: must be at least",
        ),
    ],
)
def test_what_the_film_cannot_answer_is_refused_in_words(asked, words):
    with pytest.raises(ValueError, match=words):
        asked()


def test_other_bearings_have_no_foil():
    oiled = rc.PRESETS["sheet-1e8"].machine
    for asked in (lambda: rc.foil_deflection(oiled, 900.0, 0.0), lambda: rc.lift_off_speed(oiled)):
        with pytest.raises(ValueError, match=r"^bearing = plain: has no foil"):
            asked()
