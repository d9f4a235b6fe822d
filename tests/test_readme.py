"""The README's example prints what the README says."""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TEXT = (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_example_runs_and_prints_what_the_readme_says() -> None:
    (example,) = re.findall(r"```python\n(.*?)```", TEXT, re.DOTALL)
    (printed,) = re.findall(r"```text\n(.*?)```", TEXT, re.DOTALL)
    command = [sys.executable, "-W", "error", "-c", example]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.stderr == ""
    assert done.stdout == printed


def test_every_picture_and_folder_named_exists_and_pictures_are_small() -> None:
    pictures = re.findall(r"\((docs/.*?)\)", TEXT)
    assert pictures
    for name in pictures:
        assert 0 < (ROOT / name).stat().st_size < 300_000, name
    for name in re.findall(r"^\| `([\w./]+)`", TEXT, re.MULTILINE):
        assert (ROOT / name).exists(), name
