"""Requests under foreign names and from foreign pages, refused on every path.

Streamlit looks at them in its websocket alone. There it accepts pages of localhost on any server,
and before it refuses another it asks a server outside, for up to two seconds in which nobody else
is answered, what its own external address is. No Origin but the app's own reaches it.
"""

from ipaddress import ip_address
from urllib.parse import urlsplit

from starlette.types import ASGIApp, Receive, Scope, Send
from streamlit import config
from streamlit.auth_util import get_secrets_auth_section
from streamlit.web.server.starlette.starlette_websocket import is_host_allowed

from ui.serving.guard.refusal import below_base, header, refuse

_LOOPBACK = {"localhost", "127.0.0.1", "::1"}
_PORTS = {"http": ":80", "https": ":443"}
# For whoever runs the server, at the replica itself and by no proxy.
_HOSTS_OWN = (
    "healthz", "_stcore/metrics", "_stcore/script-health-check", "_stcore/agent",
)  # fmt: skip
# Streamlit's login, which writes an error for each request where none is set up.
_LOGIN = ("oauth2callback", "auth/")
# Asked by whoever runs the server, and by pages.
_HEALTH = "_stcore/health"


class OwnSite:
    """Lets through who calls the server by its name, from its own pages or an allowed site's."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer as the app does, or refuse."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
        elif refusal := _refusal(scope):
            status, why = refusal
            await refuse(scope, receive, send, status=status, why=why)
        else:
            await self._app(_with_own_origin(scope), receive, send)


def is_own_name(host: str | None) -> bool:
    """Return whether visitors may call the server by a Host.

    That is server.allowedHosts where it is set. Else a server that only this machine can reach is
    called by this machine's names, and any other by any name.
    """
    if config.get_option("server.allowedHosts"):
        return is_host_allowed(host)
    listens = (config.get_option("server.address") or "").strip("[]")
    return listens not in _LOOPBACK or _is_loopback(host)


def is_own_origin(origin: str, host: str | None) -> bool:
    """Return whether a page of an Origin may ask: the Host's own, or an allowed site's."""
    if origin in (config.get_option("server.corsAllowedOrigins") or []):
        return True
    scheme, _, named = origin.partition("://")
    port = _PORTS.get(scheme)
    if host is None or port is None:
        return False
    return named.lower().removesuffix(port) == host.lower().removesuffix(port)


def _refusal(scope: Scope) -> tuple[int, str] | None:
    """Return status and reason where a request is refused."""
    host, origin, path = header(scope, "host"), header(scope, "origin"), below_base(scope)
    direct = _is_loopback(host) and _is_loopback_address(scope)
    if path.startswith(_HOSTS_OWN) and not direct:
        return 404, "Not Found"
    if path.startswith(_LOGIN) and not get_secrets_auth_section():
        return 404, "No login is set up"
    if not is_own_name(host) and not (direct and path.startswith((*_HOSTS_OWN, _HEALTH))):
        return 421, "This server has another name: see STREAMLIT_SERVER_ALLOWED_HOSTS"
    if origin is not None and not is_own_origin(origin, host):
        return 403, "This server answers its own pages only"
    return None


def _with_own_origin(scope: Scope) -> Scope:
    """Return a websocket's request as from the server's own page, which it is or may be."""
    host, origin = header(scope, "host"), header(scope, "origin")
    if scope["type"] != "websocket" or origin is None or host is None:
        return scope
    own = f"{origin.partition(':')[0]}://{host}".encode("latin-1")
    headers = [(key, own if key == b"origin" else value) for key, value in scope["headers"]]
    return {**scope, "headers": headers}


def _is_loopback(host: str | None) -> bool:
    """Return whether a Host names this machine, as only this machine calls it."""
    try:
        return host is not None and urlsplit(f"//{host}").hostname in _LOOPBACK
    except ValueError:
        return False


def _is_loopback_address(scope: Scope) -> bool:
    """Return whether a request comes from this machine, and through no proxy."""
    try:
        own = ip_address((scope.get("client") or ("", 0))[0]).is_loopback
    except ValueError:
        return False
    return own and header(scope, "x-forwarded-for") is None
