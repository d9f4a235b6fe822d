"""Where whirl sets in: the film's threshold, and the onset speed of a machine or of many."""

from rotorcalc.onset.search import Onset, onset_speed
from rotorcalc.onset.whirl import WhirlOnset, flexible_threshold, whirl_onset

__all__ = ["Onset", "WhirlOnset", "flexible_threshold", "onset_speed", "whirl_onset"]
