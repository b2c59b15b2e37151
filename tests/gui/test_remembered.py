"""What the window remembers from frame to frame is what it would compute anew."""

import sys
from dataclasses import replace

import numpy as np
import pytest

from playground.explain.pixel import explain
from playground.gui.same_object import kept_for_same
from playground.scene.library import load

imgui = pytest.importorskip("imgui_bundle").imgui

from playground.gui.picture.canvas import segment  # noqa: E402
from playground.gui.picture.gizmo_math import seen  # noqa: E402
from playground.gui.pixel.equation import triple  # noqa: E402
from playground.gui.pixel.telling import LIT_TERMS, display_told, point_told  # noqa: E402

SIZE = (920, 651)
PIXEL = (390, 309)
REMEMBERING = (  # modules of playground.gui that keep what they have said, measured or placed
    "pixel.telling",
    "pixel.equation",
    "pixel.side_view",
    "pixel.triangle_mark",
    "pixel.triangle_lens",
    "pixel.lobe_plot",
    "widget.typeset",
    "widget.theme",
    "panels.explain",
    "panels.popping",
    "panels.scene",
    "panels.bug_zoo",
)


def test_the_same_object_is_known_and_an_equal_one_is_not():
    asked = []

    @kept_for_same(2)
    def length(values):
        asked.append(values)
        return len(values)

    first, equal, third = [1], [1], [1, 2]
    assert [length(first), length(first), length(equal)] == [1, 1, 1]
    assert asked == [first, equal]
    assert asked[1] is equal
    assert (length(third), length(first)) == (2, 1)  # the first is forgotten: two are kept
    assert len(asked) == 4


@pytest.mark.parametrize(
    "change",
    [
        {"shininess": 3.0},
        {"highlight": "blinn"},
        {"exposure": 0.5},
        {"diffuse": (0.1, 0.9, 0.2)},
        {"shading": "per-vertex"},
        {"terms": ("ambient", "specular")},
    ],
)
def test_another_setup_is_told_with_its_own_numbers(change):
    setup = load("teapot")
    whys = [explain(changed, PIXEL, SIZE) for changed in (setup, setup.with_(**change))]
    for why in (*whys, *whys):  # back and forth: none is told with the numbers of the other
        told, point = point_told(why, 0, 0), why.corners[0]
        for term in LIT_TERMS:
            added = getattr(point.lights[0], term)
            assert told.lights[0].terms[term].text == f"{term}  {triple(added)}"
        assert told.emissive.text == f"emissive  {triple(point.emissive)}"
        assert told.chosen.lobe[2].startswith(f"cos^{why.shininess:g} = ")
        assert display_told(why).colour.text == f"colour  {triple(why.colour)}"
        assert display_told(why).shown.text == f"shown  {triple(why.shown)}"
        codes = tuple(round(255 * c) for c in display_told(why).shown.colour[:3])
        assert codes == tuple(why.codes)
    assert point_told(whys[0], 0, 0) != point_told(whys[1], 0, 0)


def test_each_vertex_and_light_is_told_for_itself():
    setup = load("teapot")
    lights = (setup.scene.lights[0], replace(setup.scene.lights[0], diffuse=(0.1, 0.2, 0.3)))
    why = explain(setup.with_(shading="per-vertex", lights=lights), PIXEL, SIZE)
    for corner, point in enumerate(why.corners):
        for number, light in enumerate(point.lights):
            told = point_told(why, corner, number)
            assert told.total.text == f"sum at this vertex  {triple(point.colour)}"
            assert told.chosen.products[3].strip() == f"= {light.n_dot_l:.3f}"
            assert told.chosen.filters["diffuse"][0] == list(light.light_diffuse)


def test_a_line_over_the_picture_ends_where_the_camera_sees_its_ends(rng):
    setup = load("teapot")
    view = seen(setup.scene, setup.camera, SIZE)
    # Some 20 roundings of terms no larger than 20 (the scene, 20 units about the eye), divided
    # by a depth of 1 or more, then times half the width.
    atol = 20 * np.finfo(float).eps * 20 * SIZE[0]
    checked = 0
    for ends in rng.uniform(-10.0, 10.0, size=(400, 2, 3)):
        depth = (ends - view.eye) @ -view.camera_from_world[2]
        if depth.min() < 1.0:
            continue
        pixels, _ = view.window(ends, SIZE)
        np.testing.assert_allclose(segment(view, *ends, SIZE), pixels, rtol=0, atol=atol)
        checked += 1
    assert checked > 50


def _panel(hands):
    """The codes of the controls, the mouse elsewhere."""
    from playground.gui import frame

    hands.frames(5)  # another size of text takes its frames
    x, y, width, height = frame.areas(hands.state, hands.state.text_size)[1]
    # Below it stand the times of the frame, which differ; they are higher where text is larger.
    return hands.window.pixels((int(x), int(y), int(width), int(height) - 40))


def _forgetful(monkeypatch):
    """Let every function that remembers compute anew."""
    for name in REMEMBERING:
        module = sys.modules[f"playground.gui.{name}"]
        for key, value in vars(module).items():
            if callable(value) and hasattr(value, "__wrapped__"):
                monkeypatch.setattr(module, key, value.__wrapped__)


CHANGES = {
    "shininess": lambda s: s.with_setup(s.setup.with_(shininess=7.0)),
    "colour": lambda s: s.with_setup(s.setup.with_(diffuse=(0.1, 0.7, 0.9))),
    "highlight": lambda s: s.with_setup(s.setup.with_(highlight="blinn")),
    "vertices": lambda s: s.with_setup(s.setup.with_(shading="per-vertex")),
    "corner": lambda s: replace(s, clue=replace(s.clue, corner=0)),
    "camera": lambda s: s.with_setup(s.setup.with_(eye=(1.0, 2.0, 9.0))),
    "pixel": lambda s: replace(s, pixel=(0.5, 0.45)),
    "exposure": lambda s: s.with_setup(s.setup.with_(exposure=0.5)),
    "theme": lambda s: replace(s, theme="light"),
    "text": lambda s: replace(s, text_size=1.3),
    "no surface": lambda s: replace(s, pixel=(0.01, 0.01)),
}


@pytest.mark.gl
@pytest.mark.parametrize("notches", [0.0, -14.0], ids=["top", "further down"])
def test_the_panel_never_shows_what_was(hands, monkeypatch, notches):
    hands.window.state = replace(hands.state, pixel=(0.42, 0.5), unfold="Explain")
    hands.until(lambda: hands.state.unfold == "")
    hands.wheel(1100.0, 400.0, 100.0)
    hands.wheel(1100.0, 400.0, notches)
    hands.io.add_mouse_pos_event(-1.0, -1.0)
    hands.frames(3)
    before = _panel(hands)
    for name, change in CHANGES.items():
        hands.window.state = change(hands.state)
        after = _panel(hands)
        differs = before.shape != after.shape or (before != after).any()
        assert differs or notches, f"{name} changes nothing"  # further down, some stay the same
        with monkeypatch.context() as patch:
            _forgetful(patch)
            np.testing.assert_array_equal(_panel(hands), after, err_msg=name)
        before = after
