"""The scripts that a browser loads: ours and Plotly's own, under names that change with them.

Streamlit serves the folder `static` beside app.py, and no other. So the scripts are put there, once
a version; `python -m ui.live.assets` does it ahead, where the app must not write its own folder.
"""

import hashlib
import tempfile
from functools import cache
from pathlib import Path

import plotly
import streamlit as st

_HERE = Path(__file__).parent
_SERVED = _HERE.parents[1] / "static"


class NotServedError(RuntimeError):
    """A script cannot be put where Streamlit serves it."""


@cache
def plotly_bundle() -> str:
    """Return the address of Plotly's own script, out of its Python package."""
    return _published(*_plotly())


@cache
def script(name: str) -> str:
    """Return the address of a script of ours."""
    return _published(*_ours(_HERE / f"{name}.js"))


@cache
def katex() -> str:
    """Return the address of the KaTeX of Streamlit's own pages, to set equations alike."""
    (file,) = (Path(st.__file__).parent / "static" / "static" / "js").glob("katex.*.js")
    base = st.get_option("server.baseUrlPath").strip("/")
    return f"{base and '/'}{base}/static/js/{file.name}"


def module(name: str) -> str:
    """Return a component's JavaScript, which comes with every message: it loads the script here."""
    return (
        f'const script = await import(location.origin + "{script(name)}");\n'
        "export default script.default;\n"
    )


def publish() -> None:
    """Put every script where Streamlit serves it, unless it is there.

    Raises NotServedError where that cannot be.
    """
    for name, source in (_plotly(), *map(_ours, sorted(_HERE.glob("*.js")))):
        _published(name, source)


def _plotly() -> tuple[str, Path]:
    source = Path(plotly.__file__).parent / "package_data" / "plotly.min.js"
    return f"plotly-{plotly.__version__}.min.js", source


@cache
def _ours(source: Path) -> tuple[str, Path]:
    digest = hashlib.sha256(source.read_bytes()).hexdigest()[:12]
    return f"{source.stem}-{digest}.js", source


def _published(name: str, source: Path) -> str:
    """Put a file where Streamlit serves it, and return its address."""
    target = _SERVED / name
    # The name has the content's digest or version; another size is a copy that was cut short.
    if not target.exists() or target.stat().st_size != source.stat().st_size:
        try:
            _put(target, source.read_bytes())
        except OSError as error:  # not as one: Streamlit would say that its port is taken
            raise NotServedError(
                f"{target} is missing and cannot be written ({error.strerror}): "
                "run python -m ui.live.assets as the owner of that folder"
            ) from None
    base = st.get_option("server.baseUrlPath").strip("/")
    return f"/{base}/app/static/{name}" if base else f"/app/static/{name}"


def _put(target: Path, content: bytes) -> None:
    """Write a file whole at once: another process may serve it already."""
    with tempfile.NamedTemporaryFile(dir=target.parent, delete=False) as copy:
        try:
            copy.write(content)
            copy.flush()
            Path(copy.name).chmod(0o644)
            Path(copy.name).replace(target)
        except OSError:
            Path(copy.name).unlink()
            raise


if __name__ == "__main__":
    publish()
