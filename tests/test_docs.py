"""The documentation names everything that is public, and reaches all its own texts."""

import re
from pathlib import Path

import rotorcalc as rc
from tests.app.session import PAGES
from ui.lecture.views import VIEWS

DOCS = Path(__file__).parents[1] / "docs"


def text(name: str) -> str:
    return (DOCS / name).read_text(encoding="utf-8")


def test_the_reference_has_every_public_name() -> None:
    named = set(re.findall(r"\w+", text("reference/index.md")))
    assert set(rc.__all__) - named == set()


def test_every_page_of_the_app_is_described() -> None:
    described = set(re.findall(r"^\| \*\*(.+?)\*\* \|", text("pages.md"), re.MULTILINE))
    assert set(PAGES.values()) <= described


def test_every_view_of_a_lecture_is_named() -> None:
    assert set(VIEWS) <= set(re.findall(r"`([\w ]+)`", text("lecture.md")))


def test_every_text_is_reached_from_the_front() -> None:
    reached = set(re.findall(r"^[\w/-]+$", text("index.md"), re.MULTILINE))
    texts = {f"{path.relative_to(DOCS).with_suffix('')}" for path in DOCS.rglob("*.md")}
    assert {name for name in texts if "generated" not in name} - {"index"} == reached
