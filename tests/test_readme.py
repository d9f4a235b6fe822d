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


def test_every_picture_named_exists_and_is_small() -> None:
    pictures = re.findall(r"\((docs/.*?)\)", TEXT)
    assert pictures
    for name in pictures:
        assert 0 < (ROOT / name).stat().st_size < 300_000, name


def test_every_file_and_folder_of_the_code_that_is_named_exists() -> None:
    for text in (TEXT, (ROOT / "deploy/README.md").read_text(encoding="utf-8")):
        named = re.findall(r"`((?:app\.py|(?:ui|pages|rotorcalc|tests|deploy)/)[\w./]*)`", text)
        assert len(named) > 5
        for name in named:
            assert (ROOT / name).exists(), name


def test_the_readme_lists_every_folder_of_the_code() -> None:
    named = set(re.findall(r"`([\w/]+/)`", TEXT))
    for root in ("ui", "rotorcalc"):
        for folder in (ROOT / root).iterdir():
            own = f"{root}/{folder.name}/"
            assert own in named or not (folder / "__init__.py").exists() or own in UNNAMED, own


# Tools of what is named.
UNNAMED = {"rotorcalc/numerics/"}
