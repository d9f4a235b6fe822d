"""The bore's lines: pads where the film has them, pockets, and the small pictures."""

import math
import re

import numpy as np
import pytest

from rotorcalc.figures.bore import pad_lines, picture
from rotorcalc.films.pads import gap, outline, pads_of
from tests.films.models import BEARINGS, FINITE, SHORT_PADS

JOURNAL, GAP = 0.7, 0.3


@pytest.mark.parametrize("name", FINITE)
def test_a_journal_on_the_films_outline_touches_the_pads_as_drawn(name):
    pads = pads_of(FINITE[name])
    surface = np.concatenate([one.surface for one in pad_lines(pads, journal=JOURNAL, gap=GAP)])
    for angle in np.radians(np.arange(-60.0, 61.0, 20.0)):
        place = outline(pads, angle)
        if not np.all(np.isfinite(place)) or np.hypot(*place) > 1.0:
            continue
        distance = np.hypot(*(surface - GAP * place).T)
        # Inside everywhere, but for a pad's edges, which are drawn from its own centre.
        assert distance.min() == pytest.approx(JOURNAL, abs=0.03)


@pytest.mark.parametrize("name", FINITE)
def test_every_pad_has_its_arc_its_centre_and_its_pocket(name):
    pads = pads_of(FINITE[name])
    lines = pad_lines(pads, journal=JOURNAL, gap=GAP)
    assert len(lines) == len(pads)
    for pad, one in zip(pads, lines, strict=True):
        assert one.centre == pytest.approx(GAP * np.array([pad.a_x, pad.a_y]))
        radius = np.hypot(*(one.surface - one.centre).T)
        assert radius == pytest.approx(np.full(len(radius), JOURNAL + GAP))
        first = one.surface[0] - one.centre
        assert math.remainder(math.atan2(first[1], first[0]) - pad.start, 2 * math.pi) == (
            pytest.approx(0.0, abs=1e-9)
        )
        assert (len(one.pocket) > 0) == (pad.depth > 0.0)
        if pad.depth > 0.0:
            deep = np.hypot(*(one.pocket - one.centre).T)
            assert deep.max() == pytest.approx(JOURNAL + GAP * (1.0 + pad.depth))
            assert deep[[0, -1]] == pytest.approx(JOURNAL + GAP)


@pytest.mark.parametrize("name", [*FINITE, *SHORT_PADS])
def test_a_picture_is_an_image_of_all_pads_within_its_frame(name):
    svg = picture(BEARINGS[name])
    lines = re.findall(r'<polyline points="([^"]*)"', svg)
    pads = pads_of(BEARINGS[name])
    assert len(lines) == len(pads) + sum(pad.depth > 0.0 for pad in pads)
    places = [float(number) for line in lines for number in re.findall(r"-?\d+\.\d+", line)]
    assert max(map(abs, places)) < 1.7
    # X points down: the loaded pad of an arc lies below the middle.
    if name == "partial arc":
        assert sum(float(pair.split(",")[1]) for pair in lines[0].split()) > 0.0
    assert gap(pads, (0.0, 0.0)) > 0.0


def test_a_bearing_without_fixed_pads_has_no_picture():
    with pytest.raises(ValueError, match="has no fixed pads"):
        picture(BEARINGS["sprung"])
