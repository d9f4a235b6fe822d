"""The command line, `python -m rotorcalc`: machines from a file, results into another.

It ends with 0 where every machine has its results, with 1 where some line has a problem, which the
results name too, and with 2 where the file or the command cannot be used.
"""

import argparse
import math
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import AbstractContextManager, nullcontext
from dataclasses import replace
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import cast

from rotorcalc.arrays import shown
from rotorcalc.batch.columns import column_of
from rotorcalc.batch.reading import MOST_BYTES, Case, MachineFile, read_machines
from rotorcalc.batch.results import CaseResult, Spread, results, table, tolerance_result, within
from rotorcalc.batch.writing import FORMATS
from rotorcalc.machine import Machine
from rotorcalc.records import parsed
from rotorcalc.units import Unit, rpm

DONE, PROBLEMS, UNUSABLE, INTERRUPTED = 0, 1, 2, 130
# Inputs of the machine itself, beside which a table has columns of its own.
_LONE = ("temperature", "load")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line.

    Parameters
    ----------
    arguments : sequence of str, optional
        Without the program's name; by default those it was started with.

    Returns
    -------
    int
        The exit code.
    """
    given = _parser().parse_args(arguments)
    try:
        return _run(given)
    except (ValueError, OSError) as error:
        sys.stderr.write(f"rotorcalc: {error}\n")
        return UNUSABLE
    except KeyboardInterrupt:
        sys.stderr.write("\nrotorcalc: interrupted\n")
        return INTERRUPTED


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m rotorcalc",
        description="Computes sheet, onset and criteria of the machines of a file.",
        epilog="Exit code 0: all done; 1: some lines have a problem; 2: nothing could be used.",
    )
    add = parser.add_argument
    add("file", help="machines: JSON, or a table with units in its header; - for standard input")
    add("--out", metavar="FILE", help="where the results go; by default to standard output")
    add("--format", choices=list(FORMATS), help="by default that of the file's name, or csv")
    add("--speed", type=_positive, metavar="RPM", help="of machines that give none")
    add("--base", metavar="FILE", help="a machine in JSON that has what a table leaves out")
    add("--tolerance", metavar="FILE", help='spreads in JSON: {"load [N]": ["uniform", 1, 2]}')
    add("--samples", type=_whole, default=10_000, help="of a tolerance, by default 10000")
    add("--seed", type=int, default=0, help="of a tolerance, by default 0")
    add("--processes", type=_whole, default=1, help="at the same time, by default 1")
    add("--seconds", type=_positive, default=math.inf, help="after which no machine is begun")
    add("--quiet", action="store_true", help="no progress and no problems on the terminal")
    return parser


def _positive(text: str) -> float:
    value = float(text)
    if not 0.0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"{text}: must be positive and finite")
    return value


def _whole(text: str) -> int:
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError(f"{text}: must be at least 1")
    return value


def _run(given: argparse.Namespace) -> int:
    base = None if given.base is None else Machine.from_json(_text(given.base))
    spread = None if given.tolerance is None else _spread(given)
    write = FORMATS[given.format or _format_of(given.out)]
    found = read_machines(_bytes(given.file), base)
    cases = [_with_speed(case, given.speed) for case in found.cases]
    if given.out is not None:
        # Before anything is computed: what cannot be written would be lost.
        Path(given.out).open("a", encoding="utf-8").close()
    progress = None if given.quiet or not sys.stderr.isatty() else _progress
    with _pool(given.processes) as pool:
        if spread is None:
            computed = results(cases, executor=pool, seconds=given.seconds, progress=progress)
        else:
            computed = _tolerances(cases, spread, given.seconds, pool, progress)
    if progress is not None:
        sys.stderr.write("\n")
    _write(given.out, write(table(computed, found.problems)))
    return _summary(computed, found, quiet=given.quiet)


def _tolerances(
    cases: Sequence[Case],
    spread: Spread,
    seconds: float,
    pool: Executor | None,
    progress: Callable[[float], object] | None,
) -> list[CaseResult]:
    """Return the tolerances of machines, one after the other: a pool computes the samples."""

    def each() -> Iterator[CaseResult]:
        for place, case in enumerate(cases):
            told = progress and partial(_share_of_all, progress, place, len(cases))
            yield tolerance_result(case, spread, pool, told)

    return within(each(), cases, seconds=seconds)


def _share_of_all(
    progress: Callable[[float], object], place: int, number: int, share: float
) -> None:
    progress((place + share) / number)


def _pool(processes: int) -> AbstractContextManager[Executor | None]:
    if processes == 1:
        return nullcontext()
    # Spawned on every system, so that a pool behaves alike on all.
    return ProcessPoolExecutor(processes, get_context("spawn"))


def _summary(computed: Sequence[CaseResult], found: MachineFile, *, quiet: bool) -> int:
    wrong = [f"line {one.line}: {one.refusal}" for one in computed if one.refusal]
    words = [*map(str, found.problems), *wrong]
    if not quiet:
        sys.stderr.writelines(f"{line}\n" for line in words)
    if not computed:
        return UNUSABLE
    return PROBLEMS if words else DONE


def _with_speed(case: Case, speed: float | None) -> Case:
    if speed is None or not math.isnan(case.speed):
        return case
    return replace(case, speed=speed * rpm)


def _progress(share: float) -> None:
    sys.stderr.write(f"\r{100.0 * share:3.0f} % done")
    sys.stderr.flush()


def _bytes(name: str) -> bytes:
    """Return what a file holds, one byte more than is admitted at most."""
    if name == "-":
        return sys.stdin.buffer.read(MOST_BYTES + 1)
    with Path(name).open("rb") as file:
        return file.read(MOST_BYTES + 1)


def _text(name: str) -> str:
    return _bytes(name).decode("utf-8-sig")


def _write(name: str | None, text: str) -> None:
    # The lines of a table already end as they must, so nothing may be changed on the way. JSON may
    # hold halves of characters, which no encoding has.
    raw = text.encode("utf-8", "backslashreplace")
    if name is None:
        sys.stdout.buffer.write(raw)
        sys.stdout.buffer.flush()
    else:
        Path(name).write_bytes(raw)


def _format_of(name: str | None) -> str:
    suffix = Path(name or "").suffix.lower()
    return {".json": "json", ".txt": "report"}.get(suffix, "csv")


def _spread(given: argparse.Namespace) -> Spread:
    document = parsed(_text(given.tolerance))
    spreads: dict[str, object] = {}
    for header, spread in document.items():
        column = column_of(header)
        if column.unit is None or (len(column.path) == 1 and column.path[0] not in _LONE):
            raise ValueError(f"{header}: is no number of a machine that could spread")
        spreads[".".join(column.path)] = _in_si(header, spread, column.unit)
    return Spread(spreads, given.samples, given.seed)


def _in_si(header: str, spread: object, unit: Unit) -> tuple[object, ...]:
    """Return a spread with its numbers in SI; differences have no offset, ratios no unit."""
    given_as = shown(spread)
    if not isinstance(spread, list) or not spread:
        raise ValueError(f'{header}: {given_as}: must be a list, as ["uniform", 1, 2]')
    word, *numbers = cast("list[object]", spread)
    values = [value for value in numbers if isinstance(value, float)]
    if len(values) < len(numbers):
        raise ValueError(f"{header}: {given_as}: must have numbers after its name")
    si: list[float] = [unit.to_si(value) for value in values]
    if len(values) > 1 and word == "normal":
        si[1] = unit.to_si(values[1]) - unit.to_si(0.0)
    if len(values) > 1 and word == "lognormal":
        si[1] = values[1]
    return (word, *si)
