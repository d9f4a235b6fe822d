"""Where in the code an exception came from, in both processes."""

import traceback


def places(error: BaseException) -> list[str]:
    """Return an exception's stack in both processes, outermost frame first."""
    frames = traceback.extract_tb(error.__traceback__)
    here = [f"{frame.filename}:{frame.lineno} {frame.name}" for frame in frames]
    return here + error.__dict__.get("places", [])
