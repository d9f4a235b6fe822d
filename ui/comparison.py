"""The live machine and the cases side by side: inputs that differ, main results, differences.

Differences are from the first case, in the unit of the quantity.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape

from rotorcalc.figures import style
from rotorcalc.units import Units
from ui.bearing import fields_of, film_name
from ui.bores import KIND, Values, name_of
from ui.cases import Shown
from ui.computed import Computed
from ui.format import minus, powers
from ui.inputs import INPUTS, LAW, law_of, number, values_of
from ui.results.table import RESULTS

LIVE = "Now"
# What stands for a value that is not given; of a machine without a supply, nothing.
_FOLLOWS = {"load": "half the weight", "T": "from the supply"}
MAIN = (
    "onset_speed", "margin", "whirl_frequency", "damping_ratio", "eccentricity_ratio",
    "minimum_film_thickness", "power_loss", "disk_amplitude",
)  # fmt: skip


@dataclass(frozen=True)
class Row:
    """A quantity of each machine: its texts, and by how much they differ from the first case's."""

    label: str
    texts: tuple[str, ...]
    changes: tuple[str, ...] = ()


def inputs(machines: Sequence[Values], units: Units) -> Iterator[Row]:
    """Yield the inputs in which machines differ."""
    for key, item in INPUTS.items():
        if _differ(machines, key):
            yield Row(item.name(units), tuple(shown(key, values, units) for values in machines))
    if _differ(machines, LAW):
        yield Row("Viscosity law", tuple(law_of(values) for values in machines))
    if _differ(machines, KIND):
        yield Row("Bearing", tuple(name_of(values[KIND]) for values in machines))
    films = tuple(film_name(values) for values in machines)
    if len(set(films)) > 1:
        yield Row("Film", films)
    # Bearings of two kinds have different fields: one that is missing is shown as a dash.
    fields = {key: field for values in machines for key, field in fields_of(values[KIND]).items()}
    for key, field in fields.items():
        if _differ(machines, key):
            texts = (field.shown(values.get(key), units) for values in machines)
            yield Row(field.name_in(units), tuple(texts))


def results(machines: Sequence[Computed], units: Units) -> Iterator[Row]:
    """Yield the main results of machines, of which the second is the first case."""
    reference = machines[1]
    for result in (RESULTS[key] for key in MAIN):
        texts = tuple(result.shown(computed, units) for computed in machines)
        changes = (
            "" if computed is reference else result.change(computed, reference, units)
            for computed in machines
        )
        yield Row(result.label, texts, tuple(changes))


def shown(key: str, values: Values, units: Units) -> str:
    """Return an input's value as it is read."""
    return minus(powers(written(key, values, units)))


def written(key: str, values: Values, units: Units) -> str:
    """Return an input's value as text that a program reads too."""
    if values.get(key) is None:
        return _FOLLOWS.get(key, "–")
    item, value = INPUTS[key], number(values, key)
    return item.infinite if math.isinf(value) else f"{item.shown(value, units):.6g}"


def table(computed: Computed, cases: Sequence[Shown], units: Units) -> str:
    """Return the live machine and cases, of which there is one at least, as a table in HTML."""
    machines = (computed, *(shown.computed for shown in cases))
    values = [values_of(one.machine, one.speed, one.top_speed) for one in machines]
    names = [LIVE, *(shown.case.name for shown in cases)]
    colours = (style.HERE, *(shown.case.colour for shown in cases))
    head = "".join(
        f'<th scope="col"><span class="swatch" style="background:{colour}"></span>'
        f"{escape(name)}</th>"
        for name, colour in zip(names, colours, strict=True)
    )
    rows = (*inputs(values, units), *results(machines, units))
    body = "".join(_row(row, names) for row in rows)
    return (
        f'<table class="cases"><caption>Differences are from {escape(names[1])}.</caption>'
        f"<thead><tr><td></td>{head}</tr></thead><tbody>{body}</tbody></table>"
    )


def _row(row: Row, names: Sequence[str]) -> str:
    changes = row.changes or ("",) * len(names)
    cells = "".join(
        f'<td data-case="{escape(name)}">{escape(text)}'
        f"{f'<small>{escape(change)}</small>' if change else ''}</td>"
        for name, text, change in zip(names, row.texts, changes, strict=True)
    )
    return f'<tr><th scope="row">{escape(row.label)}</th>{cells}</tr>'


def _differ(machines: Sequence[Values], key: str) -> bool:
    return any(values.get(key) != machines[0].get(key) for values in machines)
