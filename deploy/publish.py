"""All files that a browser loads, for a proxy to serve: python -m deploy.publish FOLDER.

Streamlit's own, ours and Plotly's are copied below the path at which the app stands, each with a
compressed copy beside it, which a proxy sends as it is. Their names change with their content, so
a folder may hold those of two versions while replicas are updated one after the other. The path is
STREAMLIT_SERVER_BASE_URL_PATH's.
"""

import gzip
import os
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

import streamlit as st

from ui.live import assets

_COMPRESSED = {".js", ".css", ".svg", ".map", ".json", ".wasm", ".ttf"}
_SMALLEST = 1000  # bytes, below which compressing gains nothing


def publish(folder: Path, base: str) -> list[Path]:
    """Copy every file to where its address says, below a folder; return the copies."""
    assets.publish()
    streamlits = Path(st.__file__).parent / "static" / "static"
    ours = Path(__file__).resolve().parents[1] / "static"
    root = folder / base.strip("/")
    return [
        *_copied(streamlits, root / "static"),
        *_copied(ours, root / "app" / "static"),
    ]


def _copied(source: Path, target: Path) -> Iterator[Path]:
    for path in sorted(source.rglob("*")):
        if not path.is_file() or path.name.startswith("."):
            continue
        copy = target / path.relative_to(source)
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, copy)
        content = path.read_bytes()
        if path.suffix in _COMPRESSED and len(content) >= _SMALLEST:
            copy.with_name(f"{copy.name}.gz").write_bytes(gzip.compress(content, mtime=0))
        yield copy


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    publish(Path(sys.argv[1]), os.environ.get("STREAMLIT_SERVER_BASE_URL_PATH", ""))
