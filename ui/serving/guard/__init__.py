"""What stands before Streamlit: who may ask, how much, and what every answer says.

Streamlit sees only what has passed here. A host's proxy does some of it too; this holds without
one, and where no proxy can look, which is inside a websocket.
"""

from starlette.middleware import Middleware

from ui.serving import settings
from ui.serving.guard.answers import Answers
from ui.serving.guard.bounds import Bounds
from ui.serving.guard.browsers import OwnBrowser
from ui.serving.guard.strangers import OwnSite


def middleware() -> list[Middleware]:
    """Return the guard's layers, outermost first."""
    return [
        Middleware(Answers),
        Middleware(OwnSite),
        Middleware(Bounds, limits=settings.limits()),
        Middleware(OwnBrowser),
    ]
