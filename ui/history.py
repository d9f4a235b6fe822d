"""The states of a session's work in order: what undo goes back to, and redo forward to."""

from typing import Generic, TypeVar

State = TypeVar("State")

# A held key makes ten states a second; each is a dictionary of some twenty numbers.
_MOST = 200


class History(Generic[State]):
    """States in order, of which one is the present.

    A state is recorded where it differs from the present one, and ends what could be redone.
    """

    def __init__(self, first: State) -> None:
        self._states = [first]
        self._at = 0

    @property
    def can_undo(self) -> bool:
        """Whether there is an earlier state."""
        return self._at > 0

    @property
    def can_redo(self) -> bool:
        """Whether a state was undone, and none recorded since."""
        return self._at + 1 < len(self._states)

    def record(self, state: State) -> None:
        """Take a state for the present; where it differs, as one more."""
        if state == self._states[self._at]:
            # An equal one may hold more that undo brings back, and is not compared.
            self._states[self._at] = state
            return
        # The oldest states are forgotten.
        self._states = [*self._states[: self._at + 1], state][-_MOST:]
        self._at = len(self._states) - 1

    def undo(self) -> State:
        """Return the state before the present one, which it then is; the first stays."""
        self._at = max(self._at - 1, 0)
        return self._states[self._at]

    def redo(self) -> State:
        """Return the state that was undone last, which is then the present; the last stays."""
        self._at = min(self._at + 1, len(self._states) - 1)
        return self._states[self._at]
