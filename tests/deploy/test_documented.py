"""The steps of deploy/README.md and of Containerfile lead to a configuration that nginx accepts."""

import re
import shutil
from pathlib import Path

import pytest

from tests.deploy import documented
from tests.deploy.conftest import write_around
from tests.load.replicas import ROOT, free_port

NAME = "rotors.another.example"
# Programs of the steps that a test's machine has not, or that change it.
_STANDING_IN = ("apt-get", "systemctl", "git", "python3", "podman", "curl")


@pytest.fixture
def host(tmp_path: Path, nginx: Path) -> Path:
    """The folder of a machine on which nothing is set up yet, but a clone."""
    write_around(tmp_path, nginx)
    (tmp_path / "etc/systemd/system").mkdir(parents=True)
    (tmp_path / "var/log/nginx").mkdir(parents=True)
    source = tmp_path / "srv/rotorcalc/source/deploy"
    shutil.copytree(ROOT / "deploy", source)
    text = (source / "nginx.conf").read_text().replace("/var/log/nginx", str(tmp_path))
    (source / "nginx.conf").write_text(text.replace("listen 80", f"listen 127.0.0.1:{free_port()}"))
    programs = tmp_path / "bin"
    programs.mkdir()
    lines = dict.fromkeys(_STANDING_IN, "true")
    lines["nginx"] = f'exec {nginx} -p {tmp_path} -c {tmp_path}/etc/nginx/nginx.conf "$@"'
    for name, line in lines.items():
        (programs / name).write_text(f"#!/bin/sh\n{line}\n")
        (programs / name).chmod(0o755)
    return tmp_path


def _carry_out(commands: str, host: Path, named: str) -> None:
    assert named in commands
    documented.carry_out(
        commands.replace(named, named.replace("rotor.example.org", NAME)), host,
        PATH=f"{host}/bin:/usr/bin:/bin",
    )  # fmt: skip


def _names(configuration: Path) -> list[str]:
    return re.findall(r"server_name (.*);", configuration.read_text())


def _connections(host: Path) -> int:
    text = (host / "etc/nginx/nginx.conf").read_text()
    return int(re.findall(r"worker_connections (\d+);", text)[0])


def test_the_steps_on_debian_name_the_server_and_leave_the_clone_alone(host: Path) -> None:
    source = host / "srv/rotorcalc/source"
    before = {path: path.read_bytes() for path in source.rglob("*") if path.is_file()}
    _carry_out(documented.block("On Debian, with systemd"), host, "NAME=rotor.example.org")
    assert _names(host / "etc/nginx/conf.d/rotorcalc.conf") == ["_", NAME]
    assert f"ALLOWED_HOSTS={NAME}\n" in (host / "etc/rotorcalc.env").read_text()
    assert _connections(host) >= 2 * 2 * 400 + 500
    assert before == {path: path.read_bytes() for path in before}


def test_the_steps_in_containers_leave_the_clone_alone_and_the_image_is_named(host: Path) -> None:
    source = host / "srv/rotorcalc/source/deploy"
    before = (source / "nginx.conf").read_bytes()
    steps = f"cd {source.parent}\n{documented.block('In containers')}"
    _carry_out(steps, host, "HOST_NAME=rotor.example.org")
    assert (source / "nginx.conf").read_bytes() == before
    proxy = (source / "Containerfile").read_text().split(" AS proxy\n")[1]
    shutil.copy(source / "nginx.conf", host / "etc/nginx/conf.d/default.conf")
    (run,) = re.findall(r"^RUN ((?:.*\\\n)*.*)$", proxy, re.MULTILINE)
    documented.carry_out(run, host, HOST_NAME=NAME)
    assert _names(host / "etc/nginx/conf.d/default.conf") == ["_", NAME]
    assert _connections(host) >= 2 * 2 * 400 + 500
    for log in ("rotorcalc", "rotorcalc-error"):  # the engine's, which are bounded
        assert (host / f"var/log/nginx/{log}.log").readlink().parent == Path("/dev")
    compose = (source / "compose.yaml").read_text()
    assert "HOST_NAME: ${HOST_NAME}" in compose
    services = compose.split("\nservices:\n")[1].split("\nnetworks:\n")[0]
    assert len(re.findall("^  \\w+:$", services, re.MULTILINE)) == services.count("*log") == 3
