"""Files to take along: the sweep as CSV, the machine as JSON, K and C for ROSS.

Each function returns a whole file and is called only when the file is asked for.
"""

import csv
import io
from collections.abc import Iterator
from typing import TypeAlias

import numpy as np

from rotorcalc import CoefficientTable, orbit_ellipse
from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.coefficient_files import written
from rotorcalc.figures.recesses import names
from rotorcalc.recesses import RecessEquilibrium
from rotorcalc.root_locus import Locus
from rotorcalc.ross_rotor import ross_axes, ross_rotor
from rotorcalc.unbalance_response import phase_lag
from rotorcalc.units import Unit, Units
from ui import comparison, ring
from ui.bearing import fields_of, film_name
from ui.bores import KIND, name_of
from ui.computed import Computed
from ui.format import without_noise
from ui.inputs import INPUTS, applies, law_of, values_of
from ui.sharing import xlsx
from ui.words import validity

# Words, unit and SI values of a column.
Column: TypeAlias = tuple[str, Unit, Array]

ROSS_NAME, ROSS_MIME = "ross_bearing.xlsx", xlsx.MIME

ROTOR_NAME = "ross_rotor.toml"

ROSS_NOTE = (
    "ROSS rotor: `rs.Rotor.load('ross_rotor.toml')` reads the whole machine, on three nodes. "
    "ROSS table: `rs.BearingElement.from_table(n=0, file='ross_bearing.xlsx')` reads it. One "
    "bearing, K in N/m, C in N·s/m, speed in rad/s. ROSS's x is horizontal, its y up, the shaft "
    "turning from x to y; X here points down along the load, Y at +90° in the sense of rotation. "
    "So x = Y and y = −X, a rotation by −90°: $k_{xx} = K_{YY}$, $k_{xy} = −K_{YX}$, "
    "$k_{yx} = −K_{XY}$, $k_{yy} = K_{XX}$, and c likewise. Signs are the same in both, "
    "Kᵢⱼ = −∂Fᵢ/∂Xⱼ. Between the speeds ROSS "
    "interpolates by PCHIP, monotonic cubics. A phase counts there from x, here from X."
)

# ROSS looks for inches, pounds and revolutions a minute in every text of the sheet and converts
# where it finds them, so these lines name none of the three.
_ROSS_HEAD = (
    ("Stiffness and damping of one journal bearing over running speed, for ROSS.",),
    ("Read with rs.BearingElement.from_table(n=0, file=...). SI units, as below.",),
    ("Axes: ROSS's, x horizontal, y upward, rotation from x to y. The load acts along -y.",),
    ("From X along the load, Y at +90 degrees in the sense of rotation: x = Y, y = -X;",),
    ("kxx = K_YY, kxy = -K_YX, kyx = -K_XY, kyy = K_XX, and c likewise.",),
    ("Signs: k_ij = -dF_i/dx_j, F the film's force on the journal.",),
)
_ROSS_COLUMNS = ("kxx", "kxy", "kyx", "kyy", "cxx", "cxy", "cyx", "cyy")


def sweep_csv(computed: Computed, units: Units) -> bytes:
    """Return the sweep over speed as CSV, a row a speed, in the units shown.

    It begins with the mark by which Excel knows UTF-8; Python reads it as "utf-8-sig". Lines before
    the table begin with #: the inputs and the onset. Modes have the numbers of the page; of two
    that are mirror images the one with Im λ ≥ 0 is in it. Numbers have ten digits; "inf" is where
    there is no limit, "nan" where there is no number.
    """
    columns = list(_columns(computed, units))
    numbers = np.stack([unit.of(values) for _, unit, values in columns], axis=-1)
    file = io.StringIO(newline="")
    writer = csv.writer(file)
    writer.writerows(head(computed, units))
    writer.writerow(f"{words} [{unit.name}]" for words, unit, _ in columns)
    writer.writerows([f"{number:.10g}" for number in row] for row in numbers.tolist())
    return file.getvalue().encode("utf-8-sig")


def ross_table(computed: Computed) -> bytes:
    """Return K and C over speed as the workbook that ROSS's `BearingElement.from_table` reads."""
    sweep = computed.sweep
    K, C = (ross_axes(matrix).reshape(-1, 4) for matrix in (sweep.stiffness, sweep.damping))
    rows = np.column_stack([sweep.speed, K, C]).tolist()
    units = ("rad/s", *["N/m"] * 4, *["N*s/m"] * 4)
    return xlsx.workbook("Bearing", [*_ROSS_HEAD, ("speed", *_ROSS_COLUMNS), units, *rows])


def ross_file(computed: Computed) -> bytes:
    """Return the machine as the rotor's file that ROSS's `Rotor.load` reads."""
    return ross_rotor(computed.sweep).encode()


def coefficients_csv(computed: Computed) -> bytes:
    """Return K and C in SI units: the rows of own coefficients, else those of the sweep."""
    bearing = computed.machine.bearing
    source = bearing if isinstance(bearing, CoefficientTable) else computed.sweep
    return written(source.speed, source.stiffness, source.damping).encode()


def head(computed: Computed, units: Units) -> Iterator[tuple[str, str]]:
    """Yield the lines before a table: inputs, onset and modes."""
    yield from inputs(computed, units)
    yield "# Model at the running speed", validity.headline(computed)
    onset = computed.onset
    for words, speed in (
        ("Onset of whirl", onset.speed),
        ("Whirl frequency at the onset", onset.whirl_frequency),
    ):
        yield f"# {words} [{units.speed.name}]", f"{float(units.speed.of(speed)):.10g}"
    if not computed.machine.rotor.is_rigid:
        yield from _parts_moving("Mode", computed.locus(True))
    yield from _parts_moving("Rigid rotor, mode", computed.locus(False))


def inputs(computed: Computed, units: Units) -> Iterator[tuple[str, str]]:
    """Yield the lines of a machine's inputs."""
    values = values_of(computed.machine, computed.speed, computed.top_speed)
    by_weight = values["load"] is None
    values["load"] = computed.machine.static_load  # a number all the same
    for key, item in INPUTS.items():
        if not applies(key, values):
            continue
        yield f"# {item.name(units)}", comparison.written(key, values, units)
        if key == "load" and by_weight:
            yield "# The load is", "half the weight"
    if not computed.has_own:
        yield "# Viscosity law", law_of(values)
    yield "# Bearing", name_of(values[KIND])
    yield "# Film", film_name(values)
    for field in fields_of(values[KIND]).values():
        yield f"# {field.name_in(units)}", field.shown(values.get(field.key), units)


def _parts_moving(words: str, locus: Locus) -> Iterator[tuple[str, str]]:
    """Yield the modes in which more than the rotor moves."""
    for number, part in enumerate(locus.moving, start=1):
        if part:
            yield f"# {words} {number} at the running speed", part


def _columns(computed: Computed, units: Units) -> Iterator[Column]:
    sweep = computed.sweep
    yield "Running speed Ω", units.speed, sweep.speed
    yield "Film temperature T", units.temperature, sweep.temperature
    if computed.machine.supply is not None:
        yield "Outlet temperature T_out", units.temperature, sweep.outlet_temperature
    yield "Viscosity μ", units.viscosity, sweep.viscosity
    yield "Modified Sommerfeld number σ", units.number, sweep.sommerfeld
    yield "Eccentricity ratio ε", units.number, sweep.eccentricity_ratio
    yield "Attitude angle φ", units.angle, sweep.attitude_angle
    yield "Smallest film h_min", units.film, sweep.minimum_film_thickness
    yield "Power loss per bearing P", units.power, sweep.power_loss
    yield "Side flow per bearing Q", units.flow, sweep.side_flow
    if computed.has_recesses:
        yield from _recesses(computed.recesses, units)
    if ring.has_ring(computed):
        yield from _of_ring(computed, units)
    yield from _matrix("Stiffness K", units.stiffness, sweep.stiffness)
    yield from _matrix("Damping C", units.damping, sweep.damping)
    yield "Equivalent stiffness K_eq", units.stiffness, sweep.equivalent_stiffness
    yield "Whirl ratio of the film ω_s/Ω_s", units.number, sweep.whirl_ratio
    yield "Critical mass per bearing of the rigid rotor M_c", units.mass, sweep.critical_mass
    yield "Threshold of the rigid rotor Ω_s", units.speed, sweep.rigid_threshold
    yield "Threshold of the flexible rotor Ω_sf", units.speed, sweep.flexible_threshold
    if not computed.machine.rotor.is_rigid:
        yield from _eigenvalues("Mode", units.growth, computed.locus(True).branches)
    yield from _eigenvalues("Rigid rotor, mode", units.growth, computed.locus(False).branches)
    yield from _orbit("Disk", units, sweep.disk_response)
    yield from _orbit("Journal", units, sweep.journal_response)


def _recesses(found: RecessEquilibrium, units: Units) -> Iterator[Column]:
    """Yield the pump's power, and pressure and flow of each recess by its angle from the load."""
    yield "Pump power per bearing", units.power, found.pump_power
    yield "Lowest film pressure", units.pressure, found.lowest_pressure
    for k, name in enumerate(names(found.pressure.shape[1])):
        yield f"Recess {name}: pressure", units.pressure, found.pressure[:, k]
        yield f"Recess {name}: flow", units.flow, found.recess_flow[:, k]


def _of_ring(computed: Computed, units: Units) -> Iterator[Column]:
    found = ring.over_speed(computed)
    yield "Ring's speed", units.speed, found.ring_speed
    for words, film in (("Inner film", found.inner), ("Outer film", found.outer)):
        yield f"{words}: eccentricity ratio ε", units.number, film.eccentricity_ratio
        yield f"{words}: smallest film h_min", units.film, film.minimum_film_thickness


def _matrix(words: str, unit: Unit, matrix: Array) -> Iterator[Column]:
    for i, row in enumerate("XY"):
        for j, column in enumerate("XY"):
            yield f"{words}_{row}{column}", unit, without_noise(matrix)[:, i, j]


def _eigenvalues(words: str, unit: Unit, branches: ComplexArray) -> Iterator[Column]:
    for number, branch in enumerate(branches.T, start=1):
        yield f"{words} {number}: growth rate Re λ", unit, branch.real
        yield f"{words} {number}: whirl frequency Im λ", unit, branch.imag


def _orbit(words: str, units: Units, response: ComplexArray) -> Iterator[Column]:
    amplitude = np.abs(response)
    # Where nothing moves nothing lags.
    lag = np.where(amplitude > 0.0, phase_lag(response), np.nan)
    for i, axis in enumerate("XY"):
        yield f"{words}: amplitude |{axis}|", units.amplitude, amplitude[:, i]
        yield f"{words}: phase lag of {axis}", units.angle, lag[:, i]
    ellipse = orbit_ellipse(response)
    yield f"{words}: semi-major axis", units.amplitude, ellipse.semi_major
    yield f"{words}: semi-minor axis (negative: backward)", units.amplitude, ellipse.semi_minor
