"""The program checked against itself and against print: identities, limits, published numbers.

Each case computes one number now, by the code that the rest of the program uses, and sets it beside
a reference that comes another way: a quadrature, a derivative, a limit, a closed form for what is
found by eigenvalues, or a printed value, then with half a unit of its last digit as tolerance.

Source of the printed values: San Andrés, Notes 5, and its calculation sheet; Friswell, Penny,
Garvey and Lees, Dynamics of Rotating Machines, example 5.5.1. Values marked "recorded" were found
once by an independent calculation of the sheet's machine and written down.
"""

from rotorcalc.validation import film, machine
from rotorcalc.validation.case import Case

__all__ = ["Case", "validate"]


def validate() -> tuple[Case, ...]:
    """Return all cases, computed now.

    Returns
    -------
    tuple of Case
        Group by group.
    """
    return (
        *film.coefficients(),
        *film.equilibrium(),
        *film.limits(),
        *film.energy(),
        *film.threshold(),
        *machine.onset(),
        *machine.modes_and_response(),
        *machine.sheet(),
        *machine.friswell(),
    )
