"""The page's style: what a browser has to do for it when something is put into the page."""

import re

import pytest

from ui.frame import page, presentation


@pytest.mark.parametrize("style", [page.STYLE, presentation.STYLE])
def test_what_is_put_into_the_page_concerns_few_other_elements(style: str) -> None:
    """Where :has() may hold of any element, or for any, each new one styles the page anew.

    Counting the children of a row so made a tab's styles take 1.2 s instead of 0.2 s.
    """
    text = re.sub(r"/\*.*?\*/", "", style, flags=re.DOTALL)
    places = list(re.finditer(r":has\(", text))
    assert places
    for place in places:
        subject = re.split(r"[\s>,}]", text[: place.start()])[-1]
        assert re.match(r"[\w.\[]", subject), text[place.start() - 30 : place.end() + 30]
        argument = text[place.end() :].lstrip("> \n")
        assert re.match(r"\w|\.|\[|:is\(\s*[\w.\[]", argument), argument[:40]
