"""The steps that deploy/README.md documents, to be carried out below a test's own folder."""

import os
import re
import subprocess
from pathlib import Path

from tests.load.replicas import ROOT


def block(title: str, language: str = "sh") -> str:
    """Return the first block of commands under a heading."""
    text = (ROOT / "deploy/README.md").read_text()
    section = text.split(f"\n## {title}\n")[1].split("\n## ")[0]
    return re.findall(rf"```{language}\n(.*?)```", section, re.DOTALL)[0]


def carry_out(commands: str, folder: Path, **environment: str) -> None:
    """Run commands whose /etc, /srv and /var are in a folder."""
    below = re.sub(r"(?<![\w./])/(etc|srv|var)/", rf"{folder}/\1/", commands)
    subprocess.run(["sh", "-euc", below], cwd=folder, env=os.environ | environment, check=True)  # noqa: S607 - the system's shell
