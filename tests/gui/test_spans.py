"""Sliders span what is useful, from the declaration alone."""

import pytest

from playground.gui.widget import spans
from playground.scene.camera import Camera
from playground.scene.knob import knobs
from playground.scene.light import LIGHTS
from playground.scene.material import Material
from playground.scene.scene import Object, Scene
from playground.scene.settings import Settings
from playground.scene.transform import Transform

EVERY = [Settings, Camera, Material, Object, Scene, Transform, *LIGHTS.values()]
NUMBERS = [
    (kind, name, knob)
    for kind in EVERY
    for name, knob in knobs(kind).items()
    if knob.kind == "number" and spans.bounded(knob)
]


@pytest.mark.parametrize(("kind", "name", "knob"), NUMBERS)
def test_a_span_is_valid_and_holds_default_and_value(kind, name, knob):
    for value in (knob.default, knob.low, min(knob.high, 1e4)):
        low, high = spans.span(knob, value)
        assert knob.low <= low <= knob.default <= high <= knob.high
        assert low <= value <= high and low < high


def test_shininess_spans_the_lecture():
    low, high = spans.span(knobs(Material)["shininess"], 20.0)
    assert 0 < low < 5 and 80 < high < 1000


def test_weights_and_angles():
    assert spans.span(knobs(Settings)["diffuse_weight"], 1.0) == (0.0, 2.0)
    assert spans.span(knobs(LIGHTS["spot"])["inner_angle"], 15.0) == (0.0, 180.0)
    assert spans.span(knobs(Settings)["diffuse_weight"], 7.0) == (0.0, 7.0)
    assert spans.span(knobs(LIGHTS["rectangle"])["turn"], 0.0) == (-360.0, 360.0)


@pytest.mark.parametrize(
    ("single", "meant"), [(0.699999988079071, 0.7), (1234567.875, 1234570.0), (0.0, 0.0)]
)
def test_tidy_gives_the_decimal_that_was_meant(single, meant):
    assert spans.tidy(single) == meant


def test_formats():
    assert spans.number_format(knobs(LIGHTS["spot"])["inner_angle"], 0, 180) == "%.3g°"
    assert spans.number_format(knobs(Settings)["diffuse_weight"], 0, 2) == "%.2f"
    assert spans.number_format(knobs(Material)["shininess"], 0.6, 640) == "%.3g"
    assert spans.number_format(knobs(LIGHTS["rectangle"])["width"], 0.06, 64) == "%.3g"


@pytest.mark.parametrize("kind", EVERY)
def test_every_knob_has_a_hint_that_says_its_default(kind):
    for knob in knobs(kind).values():
        hint = spans.hint(knob)
        assert hint.strip() == hint and knob.help in hint
        assert not knob.symbol or knob.symbol in hint
        assert ("right-click" in hint) <= (knob.kind in spans.RIGHT_CLICK)
