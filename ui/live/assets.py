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


@cache
def plotly_bundle() -> str:
    """Return the address of Plotly's own script, out of its Python package."""
    name = f"plotly-{plotly.__version__}.min.js"
    return _published(name, Path(plotly.__file__).parent / "package_data" / "plotly.min.js")


@cache
def script(name: str) -> str:
    """Return the address of a script of ours."""
    source = _HERE / f"{name}.js"
    digest = hashlib.sha256(source.read_bytes()).hexdigest()[:12]
    return _published(f"{name}-{digest}.js", source)


def module(name: str) -> str:
    """Return a component's JavaScript, which comes with every message: it loads the script here."""
    return (
        f'const script = await import(location.origin + "{script(name)}");\n'
        "export default script.default;\n"
    )


def _published(name: str, source: Path) -> str:
    """Put a file where Streamlit serves it, and return its address."""
    target = _SERVED / name
    # The name has the content's digest or version; another size is a copy that was cut short.
    if not target.exists() or target.stat().st_size != source.stat().st_size:
        with tempfile.NamedTemporaryFile(dir=_SERVED, delete=False) as copy:
            copy.write(source.read_bytes())
        Path(copy.name).chmod(0o644)
        Path(copy.name).replace(target)  # whole at once: another process may serve it already
    base = st.get_option("server.baseUrlPath").strip("/")
    return f"/{base}/app/static/{name}" if base else f"/app/static/{name}"


def publish() -> None:
    """Put every script where Streamlit serves it."""
    plotly_bundle()
    for source in _HERE.glob("*.js"):
        script(source.stem)


if __name__ == "__main__":
    publish()
