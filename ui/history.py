"""The states of a session's work in order: what undo goes back to, and redo forward to."""

from collections.abc import Sequence
from typing import Generic, TypeVar

State = TypeVar("State")

# A held key makes ten states a second; each is a dictionary of some twenty numbers.
_MOST = 200
# So many states before and after the present one, and that one: the browser keeps these, and gets
# them with each run.
_NEAR = 50
MOST_NEAR = 2 * _NEAR + 1


class History(Generic[State]):
    """States in order, of which one is the present.

    A state is recorded where it differs from the present one, and ends what could be redone.
    """

    def __init__(self, *states: State, at: int = 0) -> None:
        """Begin with some states, one at least, of which one is the present."""
        self._states = list(states)
        self._at = at

    @property
    def can_undo(self) -> bool:
        """Whether there is an earlier state."""
        return self._at > 0

    @property
    def can_redo(self) -> bool:
        """Whether a state was undone, and none recorded since."""
        return self._at + 1 < len(self._states)

    def near(self) -> tuple[Sequence[State], int]:
        """Return the states nearest to the present one, and its place among them."""
        first = max(self._at - _NEAR, 0)
        return self._states[first : self._at + _NEAR + 1], self._at - first

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
