"""A server without a proxy: refused requests, headers of every answer, and floods."""

import asyncio
import re
import time
from collections.abc import Iterable, Iterator
from contextlib import AsyncExitStack, closing
from dataclasses import dataclass
from http.client import HTTPConnection, HTTPMessage
from pathlib import Path

import pytest
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import InvalidStatus

from tests.deploy import audit
from tests.deploy.test_replicas import awaited
from tests.load.client import Visitor
from tests.load.flood import MARK, flooded
from tests.load.replicas import ROOT, Replica
from tests.waiting import until
from ui.serving.guard import answers, browsers
from ui.serving.settings import Limits

PATIENCE = 5.0  # seconds in which a flooded server ends
SOCKETS = 30  # that one address gets
PATHS = [
    "", "Stability", "nothing-here", "static/none.js", "app/static/none.js", "media/none",
    "_stcore/health", "_stcore/host-config", "_stcore/metrics", "healthz", "preview",
]  # fmt: skip


@dataclass
class Answer:
    """An answer that has been read."""

    status: int
    body: bytes
    headers: HTTPMessage


class Server(Replica):
    """A server started as `make run` starts it, and what it has asked of others."""

    def __init__(self, folder: Path, **environment: str) -> None:
        self.folder = folder
        super().__init__(**audit.environment(folder), **environment)

    def get(self, path: str, method: str = "GET", body: bytes = b"", **headers: str) -> Answer:
        """Ask for a path; underscores in a header's name stand for hyphens."""
        named = {key.replace("_", "-"): value for key, value in headers.items()}
        with closing(HTTPConnection("127.0.0.1", self.port, timeout=30)) as connection:
            connection.request(method, f"/{path}", body or None, headers=named)
            answer = connection.getresponse()
            return Answer(answer.status, answer.read(), answer.headers)

    def socket(self, *session: str, host: str = "", **headers: str) -> connect:
        """Return a websocket to be opened, of a page of this server where no Origin is named."""
        own = f"127.0.0.1:{self.port}"
        named = {key.replace("_", "-"): value for key, value in headers.items()}
        return connect(
            f"ws://{host or own}/_stcore/stream", host="127.0.0.1", port=self.port, proxy=None,
            origin=named.pop("Origin", f"http://{host or own}"),
            subprotocols=["streamlit", "-", *session], additional_headers=named,
        )  # type: ignore[arg-type] # fmt: skip


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    server = Server(
        tmp_path_factory.mktemp("audit"),
        ROTORCALC_LOG="json",
        ROTORCALC_MAX_SOCKETS_ADDRESS=str(SOCKETS),
        ROTORCALC_MAX_UPLOAD_SESSION="2",
        ROTORCALC_MAX_UPLOAD="3",
        STREAMLIT_SERVER_CORS_ALLOWED_ORIGINS="https://friend.example",
    )
    server.wait()
    yield server
    server.stop()


async def _status(opening: connect) -> int:
    """Return the status with which a websocket is refused, or 101."""
    try:
        async with opening:
            return 101
    except InvalidStatus as refused:
        return refused.response.status_code


# --- Who is let in ----------------------------------------------------------------------------


def test_the_server_listens_on_this_machine_only(server: Server) -> None:
    port, listening = f"{server.port:04X}", []
    for table in ("tcp", "tcp6"):
        for line in Path(f"/proc/net/{table}").read_text().splitlines()[1:]:
            address, state = line.split()[1], line.split()[3]
            if address.endswith(f":{port}") and state == "0A":
                listening.append(address.split(":")[0])
    assert listening == ["0100007F"]


@awaited
async def test_a_foreign_host_is_refused_on_every_path(server: Server) -> None:
    foreign = f"evil.example:{server.port}"
    for path in PATHS:
        assert server.get(path, Host=foreign).status in (404, 421), path
    assert server.get("", Host=foreign).status == 421
    assert await _status(server.socket(host=foreign)) == 421
    assert await _status(server.socket(host=f"localhost:{server.port}")) == 101


@awaited
async def test_a_foreign_origin_is_refused_on_every_path(server: Server) -> None:
    for origin in (
        "http://evil.example",
        "http://localhost:1",
        "http://127.0.0.1",
        "null",
        "http://[",
    ):
        for path in PATHS:
            assert server.get(path, Origin=origin).status == 403, (origin, path)
        assert await _status(server.socket(Origin=origin)) == 403
    assert server.get("", Origin=f"http://127.0.0.1:{server.port}").status == 200


@awaited
async def test_no_other_machine_is_contacted_at_start_or_for_any_origin(server: Server) -> None:
    for origin in ("http://evil.example", "http://198.51.100.7", "https://friend.example"):
        await _status(server.socket(Origin=origin))
    async with Visitor(server.address) as visitor:
        await visitor.open(Origin="https://friend.example")
        await visitor.slide("Radial clearance", 83)
    assert audit.asked(server.folder) == []


def test_health_and_metrics_are_for_this_machine(server: Server) -> None:
    for path in ("healthz", "_stcore/metrics"):
        assert server.get(path).status == 200
        assert server.get(path, X_Forwarded_For="192.0.2.1").status == 404
    assert server.get("_stcore/health", X_Forwarded_For="192.0.2.1").status == 200


@pytest.mark.parametrize("path", ["oauth2callback", "auth/login", "auth/logout"])
def test_where_no_login_is_set_up_its_paths_are_not_found(server: Server, path: str) -> None:
    """Streamlit would write an error for each request."""
    for _ in range(3):
        assert server.get(f"{path}?error={MARK}").status == 404
    assert "redirect_uri" not in server.log.read_text()
    assert MARK not in server.log.read_text()


# --- What every answer says -------------------------------------------------------------------


@pytest.mark.parametrize("path", PATHS)
def test_every_answer_has_the_security_headers(server: Server, path: str) -> None:
    for headers in ({}, {"Host": "evil.example"}, {"Origin": "http://evil.example"}):
        answer = server.get(path, **headers)
        for name, value in answers.headers():
            assert answer.headers.get_all(name) == [value], name


def test_the_proxy_sets_the_same_headers() -> None:
    text = (ROOT / "deploy/nginx.conf").read_text()
    assert f'default "{answers.policy()}";' in text, "Streamlit has changed: its script's hash"
    for name, value in answers.headers()[1:]:
        assert re.search(rf'add_header {name} "?{re.escape(value)}"? always;', text), name
        assert f"proxy_hide_header {name};" in text


@pytest.mark.parametrize("path", ["static/js/none.js", "static/none", "none.map", "x/y.css"])
def test_a_file_that_is_not_there_is_not_found(server: Server, path: str) -> None:
    answer = server.get(path)
    assert answer.status == 404
    assert b"<html" not in answer.body


def test_files_and_pages_that_are_there_are_found(server: Server) -> None:
    page = server.get("Stability")
    scripts = re.findall(rb'src="\./(static/[^"]+\.js)"', page.body)
    assert scripts
    for path in ["index.html", "favicon.png", *(script.decode() for script in scripts)]:
        assert server.get(path).status == 200, path


# --- Whose a session is -----------------------------------------------------------------------


@awaited
async def test_a_session_is_only_its_own_browsers(server: Server) -> None:
    async with Visitor(server.address) as owner, Visitor(server.address) as thief:
        await owner.open(query="C=81.5")
        known = owner.session_id
        assert re.fullmatch("[0-9a-f-]{36}", known)
        thief.session_id = known
        await thief.open()
        assert thief.session_id != known
        await owner.slide("Length", 50)
        await owner.close()
        thief.session_id = known
        await thief.reconnect()
        assert thief.session_id != known
        await owner.reconnect()
        assert owner.session_id == known


def test_a_browsers_secret_is_kept_from_scripts_and_other_sites(server: Server) -> None:
    (cookie,) = (
        value for value in server.get("").headers.get_all("Set-Cookie") if browsers.COOKIE in value
    )
    assert re.fullmatch(
        rf"{browsers.COOKIE}=[A-Za-z0-9_-]{{43}}; Path=/; HttpOnly; SameSite=Lax", cookie
    )
    told = cookie.split(";")[0]
    assert browsers.COOKIE not in str(server.get("", Cookie=told).headers.get_all("Set-Cookie"))
    assert (
        "Secure"
        in server.get("", X_Forwarded_For="192.0.2.1", X_Forwarded_Proto="https").headers[
            "Set-Cookie"
        ]
    )


# --- What there is room for -------------------------------------------------------------------


def _upload(
    server: Server, visitor: Visitor, number: int, size: int = 1_000_000, *, chunked: bool = False
) -> int:
    xsrf = "2|0|0|0"
    for value in server.get("_stcore/health").headers.get_all("Set-Cookie"):
        if value.startswith("_streamlit_xsrf="):
            xsrf = value.split(";")[0].partition("=")[2].strip('"')
    cookies = visitor.cookies | {"_streamlit_xsrf": xsrf}
    body = (
        b'--x\r\nContent-Disposition: form-data; name="file"; filename="machine.json"\r\n'
        b"Content-Type: application/json\r\n\r\n" + bytes(size) + b"\r\n--x--\r\n"
    )
    measured: dict[str, str] = {}
    if chunked:  # of a million bytes, by a request that names a length of five
        body = b"%x\r\n%b\r\n0\r\n\r\n" % (len(body), body)
        measured = {"Transfer_Encoding": "chunked", "Content_Length": "5"}
    return server.get(
        f"_stcore/upload_file/{visitor.session_id}/{number}", "PUT", body,
        Content_Type="multipart/form-data; boundary=x", X_Xsrftoken=xsrf,
        Cookie="; ".join(f"{key}={value}" for key, value in cookies.items()), **measured,
    ).status  # fmt: skip


@awaited
async def test_uploaded_files_are_bounded_in_bytes_per_page_and_in_all(server: Server) -> None:
    async with Visitor(server.address) as one, Visitor(server.address) as other:
        await one.open()
        await other.open()
        at_once = (asyncio.to_thread(_upload, server, one, i, chunked=True) for i in range(12))
        assert set(await asyncio.gather(*at_once)) == {400}
        assert [_upload(server, one, i) for i in range(4)] == [204, 204, 413, 413]
        assert [_upload(server, other, i) for i in range(3)] == [204, 413, 413]
        assert _upload(server, one, 9, size=100) == 204
        one.cookies = other.cookies
        assert _upload(server, one, 5, size=100) == 403


@awaited
async def test_open_pages_are_bounded_per_address(server: Server) -> None:
    async with AsyncExitStack() as stack:
        opened: list[ClientConnection] = []
        refused = 0
        for _ in range(SOCKETS + 5):
            try:
                opening = server.socket(X_Forwarded_For="192.0.2.7")
                opened.append(await stack.enter_async_context(opening))
            except InvalidStatus as error:
                refused = error.response.status_code
        assert len(opened) == SOCKETS
        assert refused == 429
        assert await _status(server.socket(X_Forwarded_For="192.0.2.8")) == 101


def test_a_replicas_files_and_threads_suffice_for_its_limits() -> None:
    limits = Limits()
    files, threads = 4 * limits.sockets + 3 * 128 + 200, 2 * limits.sockets + 100
    unit = (ROOT / "deploy/rotorcalc@.service").read_text()
    compose = (ROOT / "deploy/compose.yaml").read_text()
    for text, named in [(unit, "LimitNOFILE="), (compose, "nofile: ")]:
        assert int(re.findall(rf"{named}(\d+)", text)[0]) >= files
    for text, named in [(unit, "TasksMax="), (compose, "pids_limit: ")]:
        assert int(re.findall(rf"{named}(\d+)", text)[0]) >= threads


# --- A flood, and the end ---------------------------------------------------------------------


async def _costs(server: Server, visitor: Visitor, values: Iterable[int]) -> list[float]:
    """Move a slider; return how long the server computes from each move to its answer [s].

    It is the server's processor time, whoever it computes for: what a visitor waits for where
    nothing else runs on the machine, and no more where much does.
    """
    costs = []
    for value in values:
        before = server.seconds()
        await visitor.slide("Radial clearance", value)
        costs.append(server.seconds() - before)
    return costs


def _threads(server: Server) -> int:
    return len(list(Path(f"/proc/{server.process.pid}/task").iterdir()))


async def _idles(server: Server) -> bool:
    """Return whether the server comes to rest within some seconds."""
    for _ in range(20):
        before = server.seconds()
        await asyncio.sleep(1)
        if server.seconds() - before < 0.1:
            return True
    return False


@awaited
async def test_a_flood_of_pages_neither_delays_another_visitor_nor_fills_the_server(
    server: Server,
) -> None:
    async with Visitor(server.address) as visitor:
        await visitor.open("Equilibrium", X_Forwarded_For="192.0.2.9")
        quiet = sum(await _costs(server, visitor, range(75, 95))) / 20
        with flooded(server.address, sessions=20):
            await asyncio.to_thread(_has_come, server)
            costs = await _costs(server, visitor, range(95, 115))
            most = _threads(server)
        # 95 % of them; 0.02 s are quiet, and some 0.08 s beside a flood.
        assert sorted(costs)[-2] < 20 * quiet
        assert most < 60
        assert server.memory() < 500
        assert await _idles(server)
        log = server.log.read_text()
        assert "refused" in log
        assert MARK not in log
        assert visitor.session_id not in log


def _has_come(server: Server) -> None:
    """Wait until a flood has come, which the server's processor time tells."""
    before = server.seconds()
    until(lambda: server.seconds() >= before + 0.5)


def test_a_flooded_server_stops_on_request_without_errors(server: Server) -> None:
    with flooded(server.address, sessions=20):
        _has_come(server)
        time.sleep(3)
        server.process.terminate()
        server.process.wait(PATIENCE)
    lines = server.log.read_text().splitlines()
    assert '"event": "stop"' in lines[-1]
    assert [line for line in lines if '"error"' in line or "Traceback" in line] == []
