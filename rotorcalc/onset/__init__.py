"""Where whirl sets in: the film's threshold, and the onset speed of a machine.

`onset_speed` chooses the method: the closed form for an undamped rotor, else the characteristic
polynomial in floats, and in sixty digits where floats are not conclusive.
"""

from rotorcalc.arguments import checked
from rotorcalc.machine import Machine
from rotorcalc.onset.closed_form import closed_form_onset, covers
from rotorcalc.onset.ring_modes import ModeOnset, RingWhirl, mode_onsets, ring_whirl
from rotorcalc.onset.search import searched_onset
from rotorcalc.onset.whirl import Method, Onset, WhirlOnset, flexible_threshold, whirl_onset

__all__ = [
    "Method",
    "ModeOnset",
    "Onset",
    "RingWhirl",
    "WhirlOnset",
    "flexible_threshold",
    "mode_onsets",
    "onset_speed",
    "ring_whirl",
    "whirl_onset",
]


@checked
def onset_speed(machine: Machine, flexible: bool = True) -> Onset:
    """Return the lowest speed at which the machine itself becomes unstable.

    Each speed has its own equilibrium, so without midspan damping and journal mass it is where
    Ω = Ω_sf(ε(Ω)) of Eqs. 5.45 to 5.50; both are allowed here.

    Parameters
    ----------
    machine : Machine
        The machine.
    flexible : bool
        Whether the shaft bends; a rigid shaft never does.

    Returns
    -------
    Onset
        Speed, whirl frequency and eccentricity ratio at the onset, and how it was found. In a plain
        bore without load the direct stiffness vanishes (Eq. 5.37), and the onset is at speed 0: the
        machine whirls at any speed.

    Raises
    ------
    ValueError
        Where `flexible` is neither True nor False.
    """
    # First, as it errs by rounding alone at any load and takes 0.3 ms; the search takes 1.2 ms.
    if covers(machine):
        return closed_form_onset(machine, flexible=bool(flexible))
    return searched_onset(machine, bool(flexible))
