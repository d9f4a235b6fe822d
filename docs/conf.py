"""Sphinx: the documentation, built offline by `make docs` into build/docs."""

import sys
from itertools import groupby
from pathlib import Path

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

sys.path.insert(0, str(Path(__file__).parents[1]))

from rotorcalc import __version__
from rotorcalc.validation import Case, validate

project, author = "rotorcalc", "the rotorcalc developers"
version = release = __version__
# No date: the same text gives the same pages.
project_copyright = author

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
    "sphinx-mathjax-offline",
]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
myst_enable_extensions = ["dollarmath", "colon_fence"]
myst_heading_anchors = 3
nitpicky = False

autosummary_generate = True
autosummary_ignore_module_all = False
autodoc_typehints = "none"  # the docstrings have symbol, unit and shape
autodoc_default_options = {"members": True, "member-order": "bysource"}
napoleon_google_docstring = False
napoleon_use_ivar = True

html_theme = "furo"
html_title = f"rotorcalc {version}"
html_theme_options = {"top_of_page_buttons": []}
html_favicon = "../ui/frame/icon.svg"  # of a page that names none browsers ask the host
html_show_sphinx = False
exclude_patterns = ["_templates"]


class Validation(SphinxDirective):
    """The checks of `rotorcalc.validation` as tables, computed at the build."""

    def run(self) -> list[nodes.Node]:
        """Return the tables, and refuse to build where a check fails."""
        cases = validate()
        failed = [case.name for case in cases if not case.holds]
        if failed:
            raise self.error(f"checks fail: {', '.join(failed)}")
        words = "\n\n".join(
            _table(group, list(members))
            for group, members in groupby(cases, key=lambda case: case.group)
        )
        place = nodes.section()
        self.state.nested_parse(StringList(words.splitlines()), 0, place, match_titles=True)
        return [nodes.paragraph(text=f"All {len(cases)} checks hold."), *place.children]


def _table(group: str, cases: list[Case]) -> str:
    rows = "\n".join(
        f"| {_cell(case.name)} | {case.value:.7g} | {case.reference:.7g} | {case.tolerance:.2g} "
        f"| {case.unit} | {_cell(case.source)} |"
        for case in cases
    )
    return (
        f"**{group}**\n\n| check | value | reference | allowed difference | unit | source |\n"
        f"|:--|--:|--:|--:|:--|:--|\n{rows}"
    )


def _cell(words: str) -> str:
    return words.replace("|", r"\|").replace("_", r"\_").replace("*", r"\*")


def _bars(
    _app: Sphinx, _what: str, _name: str, _obj: object, _options: object, lines: list[str]
) -> None:
    """Keep the bars of |λ|, which reStructuredText takes for a substitution."""
    lines[:] = [line.replace("|", r"\|") for line in lines]


def setup(app: Sphinx) -> None:
    """Register the directive, and what docstrings need."""
    app.add_directive("validation", Validation)
    app.connect("autodoc-process-docstring", _bars)
