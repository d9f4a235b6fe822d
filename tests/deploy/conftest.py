"""A server, and two replicas behind the real nginx with the project's own configuration."""

import os
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from http.client import HTTPConnection, HTTPResponse
from pathlib import Path

import pytest

from deploy import publish
from tests.deploy import documented
from tests.load.client import Visitor
from tests.load.replicas import ROOT, Replica, free_port
from tests.waiting import until

HOST = "rotor.example.org"
BASE = "rotorcalc"
NAMES = ("1", "2")

# A proxy before nginx that holds the certificate, as another address of this machine.
OUTER = "127.0.0.10"

# What Debian's own nginx.conf holds around ours, with one worker.
_AROUND = """
daemon off;
{user}
worker_processes 1;
pid {folder}/nginx.pid;
error_log {folder}/error.log;
include {folder}/etc/nginx/modules-enabled/*.conf;
events {{
    worker_connections 768;
}}
http {{
    include {types};
    client_body_temp_path {folder}/body;
    proxy_temp_path {folder}/proxy;
    fastcgi_temp_path {folder}/fastcgi;
    uwsgi_temp_path {folder}/uwsgi;
    scgi_temp_path {folder}/scgi;
    include {folder}/etc/nginx/conf.d/*.conf;
}}
"""


@dataclass
class Site:
    """nginx, the replicas behind it, and ways to visit them."""

    port: int
    folder: Path
    replicas: dict[str, Replica]

    @property
    def address(self) -> str:
        return f"http://{HOST}:{self.port}/{BASE}"

    def visitor(self, **cookies: str) -> Visitor:
        return Visitor(self.address, port=self.port, cookies=cookies)

    def get(
        self, path: str, *, timeout: float = 30.0, source: str = "127.0.0.1", **headers: str
    ) -> HTTPResponse:
        """Ask for a path below the app's; underscores in a header's name stand for hyphens."""
        connection = HTTPConnection("127.0.0.1", self.port, timeout, source_address=(source, 0))
        named = {key.replace("_", "-"): value for key, value in headers.items()}
        connection.request("GET", path, headers={"Host": HOST} | named)
        answer = connection.getresponse()
        answer.body = answer.read()  # type: ignore[attr-defined]
        connection.close()
        return answer

    def start(self, name: str) -> None:
        """Restart a replica at its address."""
        self.replicas[name] = _replica(name, self.replicas[name].port).wait()


@pytest.fixture(scope="session")
def server() -> Iterator[Replica]:
    """A server as anybody starts it, for tests that leave it as it was."""
    replica = Replica()
    yield replica.wait()
    replica.stop()


@pytest.fixture(scope="session")
def nginx(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Path of nginx: the machine's own, or Debian's, fetched and not installed."""
    if found := shutil.which("nginx", path=f"{os.environ['PATH']}:/usr/sbin"):
        return Path(found)
    if fetched := _fetched_nginx(tmp_path_factory.mktemp("debian")):
        return fetched
    pytest.fail("nginx is not installed (Debian: apt install nginx-light)", pytrace=False)


def _fetched_nginx(folder: Path) -> Path | None:
    """Return nginx unpacked from Debian's packages, which takes no rights, or nothing elsewhere."""
    apt, dpkg = shutil.which("apt-get"), shutil.which("dpkg")
    if apt is None or dpkg is None:
        return None
    subprocess.run([apt, "download", "-q", "nginx", "nginx-common"], cwd=folder, check=False)
    for package in folder.glob("*.deb"):
        subprocess.run([dpkg, "-x", str(package), str(folder)], check=True)
    program = folder / "usr/sbin/nginx"
    return program if program.exists() else None


@pytest.fixture(scope="session")
def site(nginx: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Site]:
    """The site, as deploy/ describes it."""
    folder = tmp_path_factory.mktemp("nginx")
    publish.publish(folder / "www", BASE)
    replicas = {name: _replica(name, free_port()) for name in NAMES}
    site = Site(free_port(), folder, replicas)
    _configure(site, nginx)
    command = [str(nginx), "-p", str(folder), "-c", str(folder / "etc/nginx/nginx.conf")]
    subprocess.run([*command, "-t", "-q"], check=True)
    server = subprocess.Popen(command)
    try:
        for replica in replicas.values():
            replica.wait()
        _wait_for(site)
        yield site
    finally:
        server.terminate()
        server.wait()
        for replica in site.replicas.values():
            replica.stop()


def _replica(name: str, port: int) -> Replica:
    return Replica(
        port=port,
        ROTORCALC_REPLICA=name,
        STREAMLIT_SERVER_BASE_URL_PATH=BASE,
        STREAMLIT_SERVER_ALLOWED_HOSTS=HOST,
        STREAMLIT_SERVER_COOKIE_SECRET="the same for both",  # noqa: S106 - a test's
    )


def _configure(site: Site, nginx: Path) -> None:
    """Write the project's configuration with this machine's ports and folders in it."""
    ours = (ROOT / "deploy/nginx.conf").read_text()
    changes = {
        "listen 80": f"listen 127.0.0.1:{site.port}",
        "/srv/rotorcalc/www": f"{site.folder}/www",
        "/srv/rotorcalc/docs": f"{site.folder}/docs",
        "/var/log/nginx/rotorcalc.log": f"{site.folder}/access.log",
        "/var/log/nginx/rotorcalc-error.log": f"{site.folder}/rotorcalc-error.log",
    }
    changes |= {f"app{name}:8501": f"127.0.0.1:{site.replicas[name].port}" for name in NAMES}
    for old, new in changes.items():
        assert old in ours
        ours = ours.replace(old, new)
    write_around(site.folder, nginx)
    (site.folder / "etc/nginx/conf.d/rotorcalc.conf").write_text(ours)
    steps = documented.block("On Debian, with systemd").splitlines(keepends=True)
    documented.carry_out("".join(line for line in steps if "worker_" in line), site.folder)
    outer = documented.block("On Debian, with systemd", "nginx").replace("192.0.2.10", OUTER)
    (site.folder / "etc/nginx/conf.d/outer.conf").write_text(outer)


def write_around(folder: Path, nginx: Path) -> None:
    """Write what a distribution has in /etc/nginx, below a folder."""
    beside = nginx.parents[2] / "etc/nginx/mime.types"  # where a package was unpacked
    types = beside if beside.exists() else "/etc/nginx/mime.types"
    for name in ("modules-enabled", "conf.d", "sites-enabled"):
        (folder / "etc/nginx" / name).mkdir(parents=True)
    # Started by root, nginx would read the test's folder as another user, who may not.
    user = "user root;" if os.geteuid() == 0 else ""
    (folder / "etc/nginx/nginx.conf").write_text(
        _AROUND.format(folder=folder, types=types, user=user)
    )


def _wait_for(site: Site) -> None:
    def answers() -> bool:
        with suppress(OSError):
            return site.get(f"/{BASE}/_stcore/health").status == 200
        return False

    try:
        until(answers)
    except AssertionError:
        pytest.fail((site.folder / "error.log").read_text(), pytrace=False)
