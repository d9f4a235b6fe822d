"""A copy of the project, which a test may break."""

import shutil
from pathlib import Path

from tests.load.replicas import ROOT

# What a server runs from.
PARTS = ("app.py", "pages", "rotorcalc", "static", "ui", ".streamlit", "LICENSE", "deploy")


def copy(folder: Path) -> Path:
    """Copy the project into a folder that is made, and return the folder."""
    folder.mkdir()
    for part in PARTS:
        source = ROOT / part
        if source.is_dir():
            ignored = shutil.ignore_patterns("__pycache__", "*.min.js")
            shutil.copytree(source, folder / part, ignore=ignored)
        else:
            shutil.copy(source, folder / part)
    return folder
