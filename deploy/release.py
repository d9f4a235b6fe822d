"""Lays out a release beside the one that runs, and restarts the replicas on it, one by one:

    python3 -m deploy.release PORT...

Run in a checkout, which stands where it likes; what is released is its last commit. A replica goes
on in its own release's folder until it is restarted, pages that nobody has visited yet included.
Where one does not start on the new release, all is put back and the others have noticed nothing.

    /srv/rotorcalc/releases/COMMIT   the code, its bytecode, and links to:
    /srv/rotorcalc/venvs/LOCK        the packages, made anew only where the lock has changed
    /srv/rotorcalc/www               the browser's files of all releases, side by side
    /srv/rotorcalc/current           a link to the release on which replicas start

It needs nothing but Python's own library: the packages come with the first release.
"""

import hashlib
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

ROOT = Path("/srv/rotorcalc")
SETTINGS = Path("/etc/rotorcalc.env")
_BASE_PATH = "STREAMLIT_SERVER_BASE_URL_PATH"


class ReleaseError(Exception):
    """A replica did not start on the new release."""


def lay_out(checkout: Path, root: Path, base: str) -> Path:
    """Lay out a checkout's last commit below a root, unless it is there; return its folder."""
    commit = _said(checkout, "git", "rev-parse", "--short=12", "HEAD")
    release = root / "releases" / commit
    if release.exists():
        return release
    new = release.with_name(f"{commit}.new")  # until it is whole
    shutil.rmtree(new, ignore_errors=True)
    new.mkdir(parents=True)
    archive = new / "archive.tar"
    _do(checkout, "git", "archive", f"--output={archive}", "HEAD")
    _do(new, "tar", "-xf", archive.name)
    archive.unlink()
    (new / "COMMIT").write_text(commit)
    packages = _packages(root, new / "deploy/requirements.txt")
    (new / ".venv").symlink_to(Path("../../venvs") / packages.name)
    _do(new, ".venv/bin/python", "-m", "compileall", "-q", "app.py", "pages", "rotorcalc", "ui")
    _do(new, ".venv/bin/python", "-m", "deploy.publish", str(root / "www"), **{_BASE_PATH: base})
    return new.rename(release)


def release(ports: list[str], root: Path, new: Path, restart: Callable[[str], bool]) -> None:
    """Restart the replicas on a release one after the other, or put back the one before.

    `restart` waits until the replica of a port is ready, and returns whether it is.
    """
    before = _current(root)
    _set_current(root, new)
    for done, port in enumerate(ports):
        if not restart(port):
            if before is None:
                raise ReleaseError(f"{port} does not start")
            _set_current(root, before)
            for other in ports[: done + 1]:
                restart(other)
            raise ReleaseError(f"{port} does not start on {new.name}: {before.name} is put back")
    _forget_all_but(root, {new, before or new})


def base_path(settings: Path) -> str:
    """Return the path below which the app stands, as the replicas' settings say."""
    lines = (line.partition("=") for line in settings.read_text().splitlines())
    return next((value for name, _, value in lines if name == _BASE_PATH), "")


def packages_of(lock: Path, root: Path) -> Path:
    """Return the folder of the packages that a lock names."""
    python = ".".join(map(str, sys.version_info[:2]))
    return root / "venvs" / f"{hashlib.sha256(lock.read_bytes()).hexdigest()[:12]}-{python}"


def _packages(root: Path, lock: Path) -> Path:
    """Return the folder of a lock's packages, and fill it if need be."""
    folder = packages_of(lock, root)
    made = folder.with_name(f"{folder.name}.made")
    if not made.exists():
        _do(root, sys.executable, "-m", "venv", "--clear", str(folder))
        install = ("-m", "pip", "install", "--quiet", "--no-deps", "-r", str(lock))
        _do(root, str(folder / "bin/python"), *install)
        made.touch()
    return folder


def _current(root: Path) -> Path | None:
    link = root / "current"
    return link.resolve() if link.exists() else None


def _set_current(root: Path, to: Path) -> None:
    """Set the link on a release, in one step."""
    link = root / "current.new"
    link.unlink(missing_ok=True)
    link.symlink_to(Path("releases") / to.name)
    link.replace(root / "current")


def _forget_all_but(root: Path, kept: set[Path]) -> None:
    """Remove what belongs to no release but the one that runs and the last that did."""
    for folder in (root / "releases").iterdir():
        if folder not in kept:
            shutil.rmtree(folder)
    used = {(path / ".venv").readlink().name for path in (root / "releases").iterdir()}
    for made in (root / "venvs").glob("*.made"):
        if made.stem not in used:
            made.unlink()
            shutil.rmtree(made.with_suffix(""))
    # A release writes its files for browsers anew, after its COMMIT, also where they are the same.
    begun = min((folder / "COMMIT").stat().st_mtime_ns for folder in kept)
    for path in (root / "www").rglob("*"):
        if path.is_file() and path.stat().st_mtime_ns < begun:
            path.unlink()


def _systemd(port: str) -> bool:
    done = subprocess.run(["systemctl", "restart", f"rotorcalc@{port}"], check=False)  # noqa: S603, S607
    return done.returncode == 0


def _do(folder: Path, *command: str, **environment: str) -> None:
    subprocess.run(command, cwd=folder, env=os.environ | environment, check=True)  # noqa: S603


def _said(folder: Path, *command: str) -> str:
    done = subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True)  # noqa: S603
    return done.stdout.strip()


def main(ports: list[str]) -> None:
    """Release the last commit of the folder that is worked in."""
    os.umask(0o022)  # a replica is another user
    new = lay_out(Path.cwd(), ROOT, base_path(SETTINGS))
    try:
        release(ports, ROOT, new, _systemd)
    except ReleaseError as error:
        sys.exit(f"{error}; systemctl status rotorcalc@PORT says why")


if __name__ == "__main__":
    if not sys.argv[1:] or not all(word.isdigit() for word in sys.argv[1:]):
        sys.exit(__doc__)
    main(sys.argv[1:])
