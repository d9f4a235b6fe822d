"""Cases: machines that a visitor has named, each in a colour of its own, beside the live one."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass, replace

from rotorcalc.figures import Chart, widened, with_cases
from rotorcalc.figures import cases as figures
from rotorcalc.figures.cases import COLOURS
from ui.bores import Values
from ui.computed import Computed, answered_from

Draw = Callable[[Computed], Chart]
# A machine with results, and the name and colour under which a chart draws it behind another.
Ghost = tuple[str, str, Computed]

MOST = len(COLOURS)
_SHORT_PLAIN = ("short plain bearing", figures.OF_THE_NOTES)
_LONGEST = 24
# In charts, tables and links a name is text and nothing else, whatever these take for markup.
_ALLOWED = frozenset(" .,;:+-−=()/%°'")
_RULE = f"up to {_LONGEST} letters, digits, spaces and {' '.join(sorted(_ALLOWED - {' '}))}"


@dataclass(frozen=True)
class Case:
    """A named machine with its speeds, and its colour in every chart."""

    name: str
    values: Values
    colour: str

    def __post_init__(self) -> None:
        """Check the name, which may come with a link, or raise ValueError."""
        known = all(letter.isalnum() or letter in _ALLOWED for letter in self.name)
        if not (known and 0 < len(self.name) <= _LONGEST and self.name == self.name.strip()):
            raise ValueError(f"a case's name has {_RULE}")


@dataclass(frozen=True)
class Shown:
    """A case and its results."""

    case: Case
    computed: Computed


def added(cases: tuple[Case, ...], name: str, values: Values, number: str = "") -> tuple[Case, ...]:
    """Return cases and one more, or raise ValueError.

    `number` is that of its colour, from 1, as a link has it; else it is the first that is free.
    """
    if len(cases) >= MOST:
        raise ValueError(f"there are {MOST} cases already")
    taken = {case.colour for case in cases}
    wanted = {f"{place}": colour for place, colour in enumerate(COLOURS, 1)}.get(number)
    free = next(colour for colour in COLOURS if colour not in taken)
    colour = free if wanted in (None, *taken) else wanted
    return _distinct((*cases, Case(name.strip(), dict(values), colour)))


def renamed(cases: tuple[Case, ...], place: int, name: str) -> tuple[Case, ...]:
    """Return cases of which one has another name, or raise ValueError."""
    case = replace(cases[place], name=name.strip())
    return _distinct((*cases[:place], case, *cases[place + 1 :]))


def _distinct(cases: tuple[Case, ...]) -> tuple[Case, ...]:
    """Return cases, or raise ValueError where two have one name."""
    names = [case.name for case in cases]
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"there is a case {name} already")
    return cases


def next_name(cases: Iterable[Case]) -> str:
    """Return the first letter that names no case."""
    taken = {case.name for case in cases}
    return next(letter for letter in "ABCDEFGHI" if letter not in taken)


def computed(cases: Iterable[Case]) -> tuple[tuple[Shown, ...], list[str]]:
    """Return the cases that have results, and why others have none."""
    shown: list[Shown] = []
    problems: list[str] = []
    for case in cases:
        try:
            found = answered_from(case.values)
        except ValueError as error:
            problems.append(f"Case {case.name} is not shown: {error}.")
        else:
            shown.append(Shown(case, found))
    return tuple(shown), problems


def compared(draw: Draw, cases: Iterable[Shown], *, with_notes: bool = False) -> Draw:
    """Return what draws a chart of the live machine with the same of cases behind it.

    With the notes it also has the machine on their own bearing, short and plain, behind.
    """
    # Drawn once: while a slider is dragged they stay as they are.
    ghosts = [(shown.case.name, shown.case.colour, shown.computed) for shown in cases]
    behind = list(_drawn(draw, ghosts))

    def drawn(computed: Computed) -> Chart:
        plain = computed.short_plain if with_notes else None
        first = [] if plain is None else _drawn(draw, [(*_SHORT_PLAIN, plain)])
        return with_cases(draw(computed), [*first, *behind])

    return drawn


def on_axes_of(draw: Draw, others: Iterable[Computed]) -> Draw:
    """Return what draws a chart on axes that have room for the charts of other machines too.

    So a change from one of them to another is seen on the same axes.
    """
    layouts = [case.chart["layout"] for case in _drawn(draw, [("", "", one) for one in others])]

    def drawn(computed: Computed) -> Chart:
        chart = draw(computed)
        return {**chart, "layout": widened(chart["layout"], layouts)}

    return drawn if layouts else draw


def _drawn(draw: Draw, ghosts: Iterable[Ghost]) -> Iterator[figures.Case]:
    """Yield what a chart draws of machines, as far as their films give it."""
    for name, colour, computed in ghosts:
        with suppress(ValueError):
            yield figures.Case(name, colour, draw(computed))
