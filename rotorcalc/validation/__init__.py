"""Validation of the program: identities, limits and published numbers.

Each case computes one number by the code that the rest of the program uses, and compares it with
an independent reference: a quadrature, a derivative, a limit, a closed form for a result of
eigenvalues, or a printed value, whose tolerance is half a unit of its last digit.

Source of the printed values: San Andrés, Notes 5, and its calculation sheet; Friswell, Penny,
Garvey and Lees, Dynamics of Rotating Machines, example 5.5.1; for the film of finite length those
that `finite` names, to the tolerance of their method. Values marked "recorded" come from
a separate calculation of the sheet's machine.
"""

from rotorcalc.validation import film, finite, machine
from rotorcalc.validation.case import Case

__all__ = ["Case", "validate"]


def validate() -> tuple[Case, ...]:
    """Return all cases, computed at the call.

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
        *finite.lund_thomsen(),
        *finite.raimondi_boyd(),
        *finite.nicholas(),
        *finite.second_program(),
    )
