"""What moves in a mode: the rotor, or the parts of the bearing that its film carries.

A film with inner coordinates adds modes of its own: pads that tilt, a ring that floats. Which these
are, the share of the parts in the motion tells. A mode in which the disk moves far on a bending
shaft is the rotor's, whatever the parts do beside a journal that hardly moves.
"""

import numpy as np

from rotorcalc import modes
from rotorcalc.arguments import checked
from rotorcalc.arrays import BoolArray
from rotorcalc.machine import Bearing
from rotorcalc.modes import ModeShapes

# The parts' share from which on a mode is theirs: they move twice as far as the journal.
_THEIRS = 0.8
# How many times as far the disk moves as a ring where a mode is the rotor's, and parts as the disk
# where it is theirs.
_FAR = 2.0
# Beside how much of the ring's motion the journal's in the ring counts as none.
_LITTLE = 0.5
_PARTS = {"floating-ring": "ring", "tilting-pads": "pads", "foil": "foil"}


@checked
def mode_names(bearing: Bearing, shapes: ModeShapes) -> tuple[str, ...]:
    """Return what moves in each mode where it is not the rotor alone.

    Parameters
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing.
    shapes : ModeShapes
        The n modes of a rotor on it at one speed.

    Returns
    -------
    tuple of str
        n words: "ring", "pads" or another part that moves at least twice as far as the journal and
        the disk; "ring in the outer film" where the journal moves with the ring, and the disk at
        most twice as far; else "".
    """
    kind = bearing.geometry.kind
    part = _PARTS.get(kind, "bearing's parts")
    disk, parts = (np.sum(np.abs(one) ** 2, axis=-1) for one in (shapes.disk, shapes.inner))
    theirs = (modes.inner_share(shapes) > _THEIRS) & (parts > _FAR**2 * disk)
    outer = np.zeros_like(theirs)
    if kind == "floating-ring":
        outer = moves_with_ring(shapes) & (disk <= _FAR**2 * parts)
    return tuple(
        "ring in the outer film" if of_outer else part if of_part else ""
        for of_outer, of_part in zip(outer, theirs, strict=True)
    )


@checked
def moves_with_ring(shapes: ModeShapes) -> BoolArray:
    """Return whether the journal moves with a floating ring in each mode, rather than in it.

    Parameters
    ----------
    shapes : ModeShapes
        The modes, on a film whose two inner coordinates are the ring's place.

    Returns
    -------
    bool array, (..., n)
        Whether its motion in the ring is at most half of the ring's own, as in the whirl of the
        outer film; in the inner film's it does nearly all.
    """
    in_ring, of_ring = (
        np.sum(np.abs(one) ** 2, axis=-1) for one in (shapes.journal - shapes.inner, shapes.inner)
    )
    return in_ring <= _LITTLE**2 * of_ring
