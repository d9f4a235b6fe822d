"""The machines of a study as a table, and as a file to take along."""

import csv
import io
import math
from collections.abc import Iterator, Mapping, Sequence

from rotorcalc import Machine, Tolerance
from rotorcalc.figures.design import Quantity
from rotorcalc.units import Units
from ui.computed import Computed
from ui.sharing import export

Spreads = Sequence[tuple[str, Sequence[str | float]]]


def columns(
    found: Tolerance, quantities: Mapping[str, Quantity], units: Units, first: int | None = None
) -> dict[str, list[float | None]]:
    """Return the columns of a table by their heads: inputs, onset, margin, stability.

    `quantities` are the inputs by the core's names; `first` bounds the rows. None stands where a
    machine has no number: no onset was found, or it has no answer.
    """
    drawn = {
        _head(quantities[field]): quantities[field].unit.of(found.values[:first, i])
        for i, field in enumerate(found.fields)
    }
    drawn[f"Onset [{units.speed.name}]"] = units.speed.of(found.onset[:first])
    drawn[f"Margin [{units.percent.name}]"] = units.percent.of(found.margin[:first])
    return {
        head: [value if math.isfinite(value) else None for value in values.tolist()]
        for head, values in drawn.items()
    }


def state(found: Tolerance, first: int | None = None) -> list[str]:
    """Return whether each machine is stable at the running speed, in a word."""
    pairs = zip(found.unstable[:first].tolist(), found.answered[:first].tolist(), strict=True)
    return [("unstable" if bad else "stable") if known else "no answer" for bad, known in pairs]


def drawn_csv(
    found: Tolerance, spreads: Spreads, quantities: Mapping[str, Quantity], units: Units
) -> bytes:
    """Return the machines drawn as CSV, one a row, in the units shown.

    Lines before the table begin with #: the machine's inputs, the spreads, in SI, and the seed, by
    which `rotorcalc.tolerance` draws the same machines.
    """
    file = io.StringIO(newline="")
    writer = csv.writer(file)
    writer.writerows(_lines(found.machine, found, spreads, units))
    values = columns(found, quantities, units)
    writer.writerow([*values, "At the running speed"])
    for *numbers, word in zip(*values.values(), state(found), strict=True):
        writer.writerow([*("" if one is None else f"{one:.10g}" for one in numbers), word])
    return file.getvalue().encode("utf-8-sig")


def _lines(
    machine: Machine, found: Tolerance, spreads: Spreads, units: Units
) -> Iterator[tuple[str, str]]:
    yield from export.inputs(Computed(machine, found.speed, found.speed), units)
    for field, (word, *numbers) in spreads:
        yield f"# Spread of {field}, in SI", f"{word} {' '.join(f'{n:.10g}' for n in numbers)}"
    yield "# Machines drawn", f"{len(found.onset)}"
    yield "# Seed", f"{found.seed}"


def _head(quantity: Quantity) -> str:
    unit = quantity.unit.name
    words = f"{quantity.words} {quantity.symbol}".rstrip()
    return words + ("" if unit == "-" else f" [{unit}]")
