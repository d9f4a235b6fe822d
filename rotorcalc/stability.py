"""The name under which notebooks know `rotorcalc.onset`."""

from rotorcalc.onset import Onset, WhirlOnset, flexible_threshold, onset_speed, whirl_onset

__all__ = ["Onset", "WhirlOnset", "flexible_threshold", "onset_speed", "whirl_onset"]
