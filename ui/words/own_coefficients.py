"""The tab Coefficients of Your data: a file of the visitor's own, shown before it is taken."""

from collections.abc import Callable, Sequence
from typing import TypeAlias

import numpy as np
import streamlit as st
from streamlit.delta_generator import DeltaGenerator

from rotorcalc import CoefficientTable
from rotorcalc.arrays import Array
from rotorcalc.coefficient_files import ReadTable, Scale, written
from rotorcalc.coefficient_files.axes import LOAD_AXES, TURNS
from rotorcalc.coefficient_files.handbooks import NORMALISATIONS, SOMMERFELDS
from rotorcalc.coefficient_files.numbers import AS_GIVEN
from rotorcalc.coefficient_files.units import Quantity, names
from rotorcalc.figures.coefficients import of_table
from rotorcalc.units import Unit, Units
from ui import own_file
from ui.choices import choose
from ui.computed import Computed
from ui.format import amount, digits, escaped, literal, minus
from ui.frame.page import Page
from ui.inputs import number
from ui.session import session

FORMATS = r"""
| A table of coefficients | What is read |
|---|---|
| ROSS: xls, xlsx or CSV | A header with kxx, kxy, kyx, kyy, cxx, cxy, cyx, cyy and speed or frequency, in any order, with remarks above. Without kyy it is kxx, and cross terms left out are zero, as in ROSS. |
| Text | Speed and these eight columns, with a header or in this order without one; semicolons, tabs, commas or spaces between them; decimal points or commas. Lines that begin with #, % or ! are remarks. |
| Handbooks | S, ε, φ and eight dimensionless columns, or a header that names S. Bearing, oil and load make the table real. |

**Units** are those of a column's header, Kxx [MN/m], else of the row below it. Else a cell anywhere that names lb or inches makes all stiffness lbf/in and all damping lbf·s/in, and one that names rpm the speeds, as in ROSS. What no cell names is asked, at first rad/s, N/m and N·s/m; without a header speeds are in rpm.

**Axes.** With $T$ the unit vectors of X and Y as its rows, $K_{XY\text{-axes}} = T K_{xy\text{-axes}} T^\mathsf{T}$, and damping likewise. $K_{ij} = -\partial F_i/\partial x_j$, F the film's force on the journal.

**Which S.** With N in revolutions a second, C the radial clearance, D = 2R and W the load:

| S | Definition | Speed of a row |
|---|---|---|
| classical | $S = \dfrac{\mu N D L}{W}\left(\dfrac{R}{C}\right)^2$ | $\Omega = \dfrac{2\pi S W}{\mu D L}\left(\dfrac{C}{R}\right)^2$ |
| modified | $\sigma = \dfrac{\mu\Omega L R}{4W}\left(\dfrac{L}{C}\right)^2$ | $\Omega = \dfrac{4\sigma W}{\mu L R}\left(\dfrac{C}{L}\right)^2$ |
| DIN 31652 | $So = \dfrac{W\psi^2}{D L \mu\Omega}$, $\psi = C/R$ | $\Omega = \dfrac{W\psi^2}{D L \mu\, So}$ |

Stiffness and damping are $K C/W$ and $C\,C\Omega/W$, the second C the clearance; or $K (C/R)^3/(\mu\Omega L)$ and $C (C/R)^3/(\mu L)$.

**Refused** by line and column, or by cell: what is no number, an empty cell, a formula in a text, two rows of one speed, a speed of zero or below, a comma that may be a decimal one or one of thousands. A formula in a workbook counts by the value saved with it. At most 1 MB, 5000 rows, 200 columns.
"""  # noqa: E501 - tables of Markdown have a row a line

# Speed, K and C.
Table: TypeAlias = tuple[Array, Array, Array]

_TYPES = ["csv", "txt", "dat", "tsv", "xls", "xlsx"]
_HELP = (
    "CSV, text or Excel with a header such as speed, kxx, kxy, kyx, kyy, cxx … cyy, as ROSS has "
    "it, with or without units; or speed and eight numbers a line; or a handbook's S, ε, φ and "
    "eight dimensionless numbers. At most 1 MB; no formula is run."
)
_AXES = (
    "The picture has x to the right and y upward. ROSS's tables usually have the load along −y. "
    "The program's own axes are X along the load, Y at +90° as the shaft turns."
)
_KINDS = {
    "classical": "S, μNDL/W·(R/C)²", "modified": "σ, μΩLR/(4W)·(L/C)²", "DIN": "So, Wψ²/(DLμΩ)",
}  # fmt: skip
_NORMS = {"load": "KC/W and CΩC/W", "viscosity": "K(C/R)³/(μΩL)"}
_QUANTITIES: dict[str, Quantity] = {"s": "speed", "K": "stiffness", "C": "damping"}
# Who says a unit that a visitor set.
_CHOSEN = "chosen above, as the file names none"
# Rows of the sample file.
_SAMPLE = 24


def draw(page: Page) -> None:
    """Draw the tab."""
    with st.container(key="own_ask"):
        left, middle, right = st.columns((5, 4, 3))
    with left:
        upload = st.file_uploader(
            "A file of one bearing's stiffness and damping over speed", type=_TYPES, key="own_file",
            help=_HELP,
        )  # fmt: skip
        _offer_sample(page)
    raw = upload.getvalue() if upload is not None else b""
    first = own_file.read(raw, (None, None), scale=_scale_of(page)) if upload is not None else None
    said = first.table.said_axes if first and first.table else None
    with middle:
        axes = _axes(said)
    with right:
        st.html(own_file.picture(*axes))
    if upload is None or first is None:
        _show_own(page)
    elif first.table is None:
        _refuse(left, upload.name, first.problem)
    else:
        _show(page, left, raw, axes, first.table)


def _axes(said: tuple[str, str] | None) -> tuple[str, str]:
    """Ask for load axis and sense of rotation, unless the file says them."""
    if said is not None:
        st.info(
            f"The file says that its load acts along {said[0].replace('-', '−')} and that the "
            f"shaft turns from {said[1]}."
        )
        return said
    options = sorted(LOAD_AXES, key=lambda axis: axis != "-y")
    axis = choose(
        "In the file the load acts along", options, "data_load_axis",
        format_func=lambda axis: axis.replace("-", "−"), help=_AXES,
    )  # fmt: skip
    turns = choose("and the shaft turns from", list(TURNS), "data_turns")
    return axis, turns


def _refuse(place: DeltaGenerator, name: str, problem: str) -> None:
    """Say beside the uploader why a file was refused."""
    with place:
        st.error(f"{literal(name, 80)} was not read: {literal(problem)}. The machine is as it was.")


# --- Without a file -----------------------------------------------------------------------------


def _offer_sample(page: Page) -> None:
    """Offer the machine's own coefficients as a file to learn the format from."""
    try:
        text = _own(page)
    except ValueError:  # a film without an answer: said above
        return
    st.download_button(
        "Sample file: this machine's own (CSV)", text, "coefficients.csv", "text/csv",
        key="own_sample", on_click="ignore",
    )  # fmt: skip


def _own(page: Page) -> str:
    return written(*_sample(page.computed))


def _sample(computed: Computed) -> Table:
    """Return a machine's own table, or some of its sweep; at the lowest speeds K diverges."""
    if isinstance(own := computed.machine.bearing, CoefficientTable):
        return np.array(own.speed), np.array(own.stiffness), np.array(own.damping)
    sweep = computed.sweep
    step = max(1, len(sweep.speed) // _SAMPLE)
    some = slice(2 * step - 1, None, step)
    return sweep.speed[some], sweep.stiffness[some], sweep.damping[some]


def _show_own(page: Page) -> None:
    """Show this machine's own coefficients, as the sample file has them."""
    try:
        _ = page.computed.sweep
    except ValueError:
        return
    _charts(
        page, "own_sample", _sample, "of this machine's own bearing, as in the sample file",
        "This machine's own, as the sample file has it. A file of yours is shown here before it is "
        "used.",
    )  # fmt: skip


def _charts(
    page: Page, key: str, table: Callable[[Computed], Table], alt: str, caption: str
) -> None:
    """Show stiffness and damping over speed."""
    left, right = st.columns(2)
    with left:
        page.alone().chart(
            lambda c: of_table(table(c)[0], table(c)[1], "K", c.speed, page.units), f"{key}_K",
            alt=f"Stiffness over speed {alt}.", caption=caption,
        )  # fmt: skip
    with right:
        page.alone().chart(
            lambda c: of_table(table(c)[0], table(c)[2], "C", c.speed, page.units), f"{key}_C",
            alt=f"Damping over speed {alt}.", caption="Of one bearing. Dashed: the running speed.",
        )  # fmt: skip


# --- With a file --------------------------------------------------------------------------------


def _show(
    page: Page, place: DeltaGenerator, raw: bytes, axes: tuple[str, str], first: ReadTable
) -> None:
    """Show what was read, after what the file leaves open was asked."""
    units, scale = _units(first), None
    if first.kind == "dimensionless":
        scale = _scale(page)
    found = own_file.read(raw, axes, units, scale)
    if found.table is None:
        st.error(f"{literal(found.problem)}. The machine is as it was.")
        return
    table = found.table
    is_used = page.computed.machine.bearing == table.table
    with place:
        _say(table, is_used=is_used)
        st.button(
            "In use" if is_used else "Use these coefficients", key="use_own",
            type="secondary" if is_used else "primary",
            on_click=lambda: session().set_bearing(table.table), disabled=is_used,
        )  # fmt: skip
    _doubt(table)
    _charts(
        page, "own", lambda _: (table.speed, table.stiffness, table.damping),
        "read from the file, in the program's axes",
        "As read, in the program's axes: X along the load, Y at +90° as the shaft turns.",
    )  # fmt: skip
    _numbers(table, page.units)


def _say(table: ReadTable, *, is_used: bool) -> None:
    """Say what was read, and whether the machine has it."""
    low, high = table.speed[[0, -1]]
    rpm = session().units.speed
    st.success(
        f"Read: {len(table.speed)} speeds from {amount(rpm, low)} to {amount(rpm, high)}, in lines "
        f"{min(table.lines)} to {max(table.lines)}."
        + (" In use: they are this machine's bearing. Undo takes them back." if is_used else "")
    )


def _doubt(table: ReadTable) -> None:
    """Say what looks wrong, what was assumed, and the units."""
    for words in table.warnings:
        st.warning(escaped(words))
    st.caption(" ".join([*(escaped(words) for words in table.notes), _columns(table)]))


def _columns(table: ReadTable) -> str:
    """Return in words each unit and who says it."""
    groups: dict[tuple[str, str], list[str]] = {}
    for column in sorted(table.columns, key=lambda column: column.key != "speed"):
        why = _CHOSEN if column.why == AS_GIVEN else column.why
        groups.setdefault((column.unit, why), []).append(column.key.replace("speed", "Speed"))
    for keys in groups.values():  # all four of a kind by their letter
        for letter in "KC":
            four = [key for key in keys if key[0] == letter]
            if len(four) == 4:
                keys[:] = [key for key in keys if key[0] != letter] + [letter]
    return " ".join(
        escaped(f"{', '.join(keys)} in {unit}{f' ({why})' if why else ''}.")
        for (unit, why), keys in groups.items()
        if unit != "-"
    )


def _units(first: ReadTable) -> dict[str, str]:
    """Ask for the units that a file names for no column."""
    assumed: dict[Quantity, str] = {
        _QUANTITIES[column.key[0]]: column.unit
        for column in first.columns
        if column.why.startswith("assumed") and column.key[0] in _QUANTITIES
    }
    found: dict[str, str] = {}
    for column, (quantity, unit) in zip(st.columns(3), assumed.items(), strict=False):
        with column:
            known = names(quantity)
            found[quantity] = st.selectbox(
                f"Unit of {quantity}, which the file does not name", known,
                index=known.index(unit), key=f"own_{quantity}",
            )  # fmt: skip
    return found


def _numbers(table: ReadTable, units: Units) -> None:
    """Show the table that was read."""
    columns: dict[str, Sequence[object]] = {"Line": table.lines}
    columns[f"Speed [{units.speed.name}]"] = _shown(units.speed, table.speed)
    for name, value in (("S", table.sommerfeld), ("ε", table.eccentricity_ratio)):
        if value is not None:
            columns[name] = [digits(one) for one in value.tolist()]
    for symbol, unit, values in (
        ("K", units.stiffness, table.stiffness), ("C", units.damping, table.damping)
    ):  # fmt: skip
        for i, row in enumerate("XY"):
            for j, column in enumerate("XY"):
                columns[f"{symbol}{row}{column} [{unit.name}]"] = _shown(unit, values[:, i, j])
    st.dataframe(columns, hide_index=True, height=min(36 * (len(table.speed) + 1), 330))


def _shown(unit: Unit, values: Array) -> list[str]:
    return [minus(digits(one)) for one in unit.of(values).tolist()]


# --- A dimensionless table ----------------------------------------------------------------------

_FIELDS = (
    ("diameter", "Diameter D", "length"), ("length", "Length L", "length"),
    ("radial_clearance", "Radial clearance C", "film"), ("viscosity", "Viscosity μ", "viscosity"),
    ("load", "Load W", "force"),
)  # fmt: skip


def _scale_of(page: Page) -> Scale:
    """Return the machine's own bearing, oil and load, where it has them."""
    values = session().values
    usual = {key: number(values, key) for key in ("D", "L", "C")}
    machine = page.computed.machine
    return Scale(
        diameter=usual["D"] / 1e3, length=usual["L"] / 1e3, radial_clearance=usual["C"] / 1e6,
        viscosity=machine.oil.reference_viscosity, load=machine.static_load or 1.0,
    )  # fmt: skip


def _scale(page: Page) -> Scale:
    """Ask for what makes a dimensionless table real: at first this machine's own."""
    st.markdown("The table is dimensionless. It is real with a bearing, its oil and its load:")
    usual, given = _scale_of(page), dict[str, float]()
    for column, (field, label, kind) in zip(st.columns(len(_FIELDS)), _FIELDS, strict=True):
        unit: Unit = getattr(page.units, kind)
        with column:
            shown = float(unit.of(getattr(usual, field)))
            given[field] = unit.to_si(st.number_input(
                f"{label} [{unit.name}]", min_value=shown * 1e-4, value=float(f"{shown:.6g}"),
                key=f"own_{field}_{page.units.name}", format="%.6g",
            ))  # fmt: skip
    left, right = st.columns(2)
    with left:
        kind = choose("Which S", SOMMERFELDS, "data_which_s", format_func=_KINDS.__getitem__)
    with right:
        norm = choose("Coefficients", NORMALISATIONS, "data_norm", format_func=_NORMS.__getitem__)
    return Scale(**given, sommerfeld=kind, normalised_by=norm)
