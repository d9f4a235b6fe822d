"""Requests that nginx admits and refuses, and the headers of its answers."""

import asyncio
import gzip
import json
import re
import subprocess
import sys
from collections.abc import Iterator
from contextlib import AsyncExitStack, closing
from http.client import HTTPConnection
from urllib.request import urlopen

import pytest
from playwright.sync_api import BrowserContext, BrowserType, expect
from starlette.requests import Request
from streamlit.web.server.starlette.starlette_routes import create_host_config_routes
from websockets.asyncio.client import connect
from websockets.exceptions import InvalidStatus

from tests.browser.app_page import AppPage
from tests.browser.conftest import CHROMIUM_ARGS, DESK, chromium
from tests.deploy.conftest import HOST, OUTER, Site
from tests.deploy.test_replicas import awaited
from tests.load.client import Visitor
from tests.load.replicas import ROOT
from tests.waiting import finished, until
from ui.serving import own_origin
from ui.serving.guard import browsers

__all__ = ["chromium"]

PAGES = ["/rotorcalc/", "/rotorcalc/Stability", "/rotorcalc/nothing-here", "/nothing-here"]
HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "SAMEORIGIN",
    "Referrer-Policy": "same-origin",
}


@pytest.mark.parametrize("path", [*PAGES, "/rotorcalc/_stcore/health", "/rotorcalc/healthz"])
def test_every_answer_has_the_security_headers(site: Site, path: str) -> None:
    headers = site.get(path).headers
    for name, value in HEADERS.items():
        assert headers.get_all(name) == [value], name
    policy = dict(
        part.strip().split(" ", 1) for part in headers["Content-Security-Policy"].split(";")
    )
    assert policy["default-src"] == policy["connect-src"] == "'self'"
    assert policy["frame-ancestors"] == "'self'"
    assert "'unsafe-inline'" not in policy["script-src"]
    assert "'unsafe-eval'" not in policy["script-src"]
    assert headers["Server"] == "nginx"
    assert headers["X-Rotorcalc-Replica"] is None


@pytest.mark.parametrize("host", ["evil.example", "127.0.0.1", "rotor.example.org.evil.example"])
def test_a_foreign_host_is_turned_away(site: Site, host: str) -> None:
    assert site.get("/rotorcalc/", Host=host).status == 421


def _opened(visitor: Visitor, **headers: str) -> None:
    async def go() -> None:
        async with visitor:
            await visitor.open(**headers)

    finished(go())


@pytest.mark.parametrize(
    "origin",
    ["https://evil.example", "http://rotor.example.org.evil.example", "http://localhost:8501"],
)
def test_another_sites_page_gets_no_websocket(site: Site, origin: str) -> None:
    with pytest.raises(InvalidStatus) as refused:
        _opened(site.visitor(), Origin=origin)
    assert refused.value.response.status_code == 403
    answer = site.get("/rotorcalc/", Origin=origin)
    assert answer.status == 403
    assert "Access-Control-Allow-Origin" not in answer.headers


@pytest.mark.parametrize("host", ["evil.example", "localhost"])
def test_a_replica_itself_refuses_a_foreign_host(site: Site, host: str) -> None:
    port = site.replicas["1"].port
    with pytest.raises(InvalidStatus) as refused:
        _opened(Visitor(f"http://{host}:{port}/rotorcalc", port=port))
    assert refused.value.response.status_code == 421
    with closing(HTTPConnection("127.0.0.1", port, timeout=30)) as connection:
        connection.request("GET", "/rotorcalc/", headers={"Host": f"{host}:{port}"})
        assert connection.getresponse().status == 421


@pytest.mark.parametrize(
    "path", ["healthz", "_stcore/metrics", "_stcore/script-health-check", "_stcore/agent/interact"]
)
def test_health_and_metrics_are_closed_to_visitors(site: Site, path: str) -> None:
    for spelling in (path, path.replace("_", "%5f"), f"x/../{path}", f"/{path}"):
        answer = site.get(f"/rotorcalc/{spelling}")
        assert answer.status == 404 or b"# TYPE" not in answer.body, spelling
    assert site.get(f"/rotorcalc/{path}").status == 404


def test_the_host_reads_metrics_and_health_at_the_replica(site: Site) -> None:
    address = site.replicas["1"].address
    with urlopen(f"{address}/_stcore/metrics") as answer:
        assert b"active_sessions" in answer.read()
    command = [sys.executable, "-m", "ui.serving.health", f"{address}/healthz"]
    assert subprocess.run(command, cwd=ROOT, check=False).returncode == 0
    command[-1] = f"{address}/no-such-page-at-all"
    assert subprocess.run(command, cwd=ROOT, check=False, capture_output=True).returncode == 1


def test_files_come_compressed_from_the_disk_and_are_kept_for_a_year(site: Site) -> None:
    bundle = next((site.folder / "www/rotorcalc/app/static").glob("plotly-*.min.js"))
    answer = site.get(f"/rotorcalc/app/static/{bundle.name}", Accept_Encoding="gzip")
    assert answer.headers["Content-Encoding"] == "gzip"
    assert answer.headers["X-Content-Type-Options"] == "nosniff"
    assert "max-age=31536000" in answer.headers["Cache-Control"]
    assert len(answer.body) < 1.6e6
    assert gzip.decompress(answer.body) == bundle.read_bytes()


@pytest.mark.parametrize("path", ["../app.py", "..%2f..%2fapp.py", "%2e%2e/%2e%2e/app.py"])
def test_no_file_beside_the_served_ones_is_sent(site: Site, path: str) -> None:
    for folder in ("static", "app/static", "media"):
        assert b"import streamlit" not in site.get(f"/rotorcalc/{folder}/{path}").body


@pytest.mark.parametrize("path", ["static/js/none.js", "app/static/none-0123456789ab.js"])
def test_a_script_that_is_not_there_is_not_found(site: Site, path: str) -> None:
    assert site.get(f"/rotorcalc/{path}").status == 404


def test_an_upload_that_is_too_large_is_refused(site: Site) -> None:
    connection = HTTPConnection("127.0.0.1", site.port, timeout=30)
    connection.request(
        "PUT",
        "/rotorcalc/_stcore/upload_file/a/b",
        headers={"Host": HOST, "Content-Length": "9999999"},
    )
    assert connection.getresponse().status == 413
    connection.close()


def test_every_request_to_a_replica_is_bounded_in_number_and_time() -> None:
    text = (ROOT / "deploy/nginx.conf").read_text()
    passed = [
        (where, body)
        for where, body in re.findall(r"location ([^{]+) \{(.*?)\n    \}", text, re.DOTALL)
        if "proxy_pass" in body
    ]
    assert len(passed) == 5
    for where, body in passed:
        assert "limit_req zone=" in body, where
        waits = [int(seconds) for seconds in re.findall(r"read_timeout (\d+)s;", body)]
        assert where.endswith("/stream") or all(wait <= 5 for wait in waits), where


def test_a_trusted_proxys_visitors_keep_their_addresses_and_their_scheme(site: Site) -> None:
    said = {"X_Forwarded_For": "192.0.2.55", "X_Forwarded_Proto": "https"}
    secure = {}
    for source in (OUTER, "127.0.0.1"):
        cookies = site.get("/rotorcalc/", source=source, **said).headers.get_all("Set-Cookie")
        (cookie,) = (value for value in cookies if browsers.COOKIE in value)
        secure[source] = "Secure" in cookie
    assert secure == {OUTER: True, "127.0.0.1": False}
    log = site.folder / "access.log"
    until(lambda: '"address":"192.0.2.55"' in log.read_text())
    assert f'"address":"{OUTER}"' not in log.read_text()


@awaited
async def test_one_address_with_all_its_pages_leaves_room_for_another(site: Site) -> None:
    """A websocket takes two of nginx's connections, and here there is one worker."""
    async with AsyncExitStack() as stack:
        address = f"ws://{HOST}:{site.port}/rotorcalc/_stcore/stream"

        def socket(source: str) -> connect:
            return connect(
                address, host="127.0.0.1", port=site.port, local_addr=(source, 0), proxy=None,
                origin=f"http://{HOST}:{site.port}", open_timeout=60, compression=None,
                subprotocols=["streamlit", "-"],
            )  # type: ignore[arg-type] # fmt: skip

        for _ in range(40):
            await asyncio.gather(
                *(stack.enter_async_context(socket("127.0.0.20")) for _ in range(10))
            )
        with pytest.raises(InvalidStatus) as refused:
            await stack.enter_async_context(socket("127.0.0.20"))
        assert refused.value.response.status_code == 429
        await stack.enter_async_context(socket("127.0.0.21"))
        answer = await asyncio.to_thread(site.get, "/rotorcalc/", source="127.0.0.21")
        assert answer.status == 200


def test_the_sub_path_is_found_without_its_slash_and_from_the_root(site: Site) -> None:
    assert site.get("/rotorcalc?C=80").headers["Location"] == "/rotorcalc/?C=80"
    assert site.get("/").headers["Location"] == "/rotorcalc/"


def test_no_log_holds_a_machine_or_a_session(site: Site) -> None:
    session = "0f1e2d3c-81.2345"
    came_from = f"http://{HOST}/rotorcalc/Stability?C=81.2345"
    for path in ("Stability?C=81.2345", "C=81.2345", "static/81.2345.js", "preview?value=81.2345"):
        site.get(f"/rotorcalc/{path}", Referer=came_from)
    site.get("/81.2345", Host="evil.example", Referer=came_from)
    with closing(HTTPConnection("127.0.0.1", site.port, timeout=30)) as connection:
        # nginx writes an error of its own about what is too large.
        path, headers = f"/rotorcalc/_stcore/upload_file/{session}/1", {"Referer": came_from}
        connection.request(
            "PUT", path, headers=headers | {"Host": HOST, "Content-Length": "9999999"}
        )
        assert connection.getresponse().status == 413
    logs = [*site.folder.glob("*.log"), *(replica.log for replica in site.replicas.values())]
    assert len(logs) >= 4
    for log in logs:
        assert "81.2345" not in log.read_text()
    paths = re.findall('"path":"(.*?)"', (site.folder / "access.log").read_text())
    assert {"/rotorcalc/Stability", "/rotorcalc/_stcore/upload_file", "other"} <= set(paths)


def test_the_log_knows_every_page(site: Site) -> None:
    names = {path.stem.partition("_")[2] for path in (ROOT / "pages").glob("*.py")}
    assert len(names) > 5
    for name in names:
        site.get(f"/rotorcalc/{name}")
    # nginx writes its log when an answer has gone out.
    until(
        lambda: all(
            f'"path":"/rotorcalc/{name}"' in (site.folder / "access.log").read_text()
            for name in names
        )
    )


@pytest.fixture(scope="module")
def visiting(
    browser_type: BrowserType, chromium: str, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[BrowserContext]:
    """A browser for which the site's name is this machine's."""
    mapped = f"--host-resolver-rules=MAP {HOST} 127.0.0.1"
    with browser_type.launch_persistent_context(
        tmp_path_factory.mktemp("browser"), viewport=DESK, executable_path=chromium,
        args=[*CHROMIUM_ARGS, mapped],
    ) as context:  # fmt: skip
        yield context


@pytest.fixture
def tab(visiting: BrowserContext, site: Site) -> Iterator[AppPage]:
    tab = AppPage(visiting.new_page(), site.address)
    yield tab
    tab.page.close()


def test_a_browser_finds_nothing_missing_under_the_policy(tab: AppPage) -> None:
    tab.open("Machine", C="80")
    tab.press("Radial clearance", "ArrowRight")
    assert tab.query()["C"] == "80.5"
    tab.go("Root locus")
    tab.go("Notes")
    ours = (f"request: http://{HOST}:", f"websocket: ws://{HOST}:")
    assert [fault for fault in tab.faults if not fault.startswith(ours)] == []


# The documentation's own settings make it; all its pages take a minute, and one shows the same.
_DOCUMENT = r"""
# A page

The stiffness $K_{XX}$, and the load

$$\sigma = \frac{\mu \Omega L R}{4 W} \left( \frac{L}{C} \right)^2$$
"""


@pytest.fixture(scope="module")
def documentation(site: Site, tmp_path_factory: pytest.TempPathFactory) -> str:
    """Address of one page of documentation with mathematics, copied where a host serves it from."""
    source = tmp_path_factory.mktemp("documentation")
    (source / "index.md").write_text(_DOCUMENT)
    command = [sys.executable, "-m", "sphinx", "-W", "-q", "-c", ROOT / "docs", source]
    subprocess.run([*command, site.folder / "docs"], check=True)
    return f"{site.address}/docs/"


def test_the_documentations_mathematics_is_drawn_under_its_policy(
    visiting: BrowserContext, documentation: str
) -> None:
    page, faults = visiting.new_page(), []
    page.on("console", lambda said: faults.append(f"{said.text} {said.location}"))
    page.on("pageerror", lambda error: faults.append(str(error)))
    page.on("requestfailed", lambda request: faults.append(request.url))
    page.goto(documentation, wait_until="networkidle")
    formulas = page.locator("article mjx-container mjx-math")
    expect(formulas).to_have_count(2)
    small, large = (formula.bounding_box() for formula in formulas.all())
    assert small
    assert large
    assert 10 < small["height"] < large["height"]
    # Its letters come from MathJax's own fonts, and nothing is left of TeX.
    assert page.evaluate(
        "[...document.fonts].some(f => /MJX/.test(f.family) && f.status == 'loaded')"
    )
    assert "frac" not in page.locator("article").inner_text()
    assert faults == []
    page.close()


def _replica(tab: AppPage) -> str:
    cookies = {cookie["name"]: cookie["value"] for cookie in tab.page.context.cookies()}
    return cookies["rotorcalc_replica"]


def _keep_a_case(tab: AppPage) -> None:
    tab.open_tab("Forces")
    with tab.run():
        tab.page.get_by_role("button", name="Keep as A").click()


@pytest.mark.parametrize("goes", ["stop", "kill"])
def test_a_browser_whose_replica_goes_continues_on_the_other(
    goes: str, tab: AppPage, site: Site
) -> None:
    """Machine, page, tab and cases are there; of a visitor who has touched nothing too."""
    tab.open("Equilibrium", C="80")
    if goes == "kill":
        _keep_a_case(tab)
    before, theirs = tab.shown(), _replica(tab)
    {"stop": site.replicas[theirs].stop, "kill": site.replicas[theirs].kill}[goes]()
    try:
        assert tab.changes(lambda: _replica(tab), theirs)
        tab.rest()
        assert tab.shown() == before
        tab.press("Radial clearance", "ArrowRight")
        assert tab.query()["C"] == "80.5"
        tab.go("Response")
        assert tab.query()["C"] == "80.5"
        assert tab.shown()["cases"] or goes == "stop"
    finally:
        site.start(theirs)


def test_only_the_sites_own_origin_may_speak_to_streamlits_script(site: Site) -> None:
    answer = site.get("/rotorcalc/_stcore/host-config")
    assert json.loads(answer.body)["allowedOrigins"] == [f"http://{HOST}", f"https://{HOST}"]


def test_the_rest_of_the_host_configuration_is_streamlits_own() -> None:
    (own, *_) = create_host_config_routes(None)
    theirs = finished(own.endpoint(Request({"type": "http", "method": "GET", "headers": []})))
    assert json.loads(theirs.body).keys() == {*own_origin.REST, "allowedOrigins"}
    assert {key: json.loads(theirs.body)[key] for key in own_origin.REST} == own_origin.REST
