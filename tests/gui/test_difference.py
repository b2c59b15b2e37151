"""|A − B| in false colours, and the reference in the background."""

import time
from dataclasses import replace
from threading import Event

import numpy as np
import pytest

from playground.explain.colour_map import colour_of
from playground.gui.picture import reference
from playground.gui.picture.difference import differ
from playground.gui.work.long_work import Piece
from playground.render.numpy_renderer import NumpyRenderer
from playground.scene.library import load

VIEW = (90, 60)


def test_the_difference_is_the_largest_of_the_components():
    a = np.array([[[10, 20, 30, 255], [0, 0, 0, 255]]], dtype=np.uint8)
    b = np.array([[[13, 10, 30, 0], [255, 1, 2, 255]]], dtype=np.uint8)
    found = differ(a, b)
    assert found.steps.tolist() == [[10, 255]]
    assert found.largest == 1.0 and found.mean == pytest.approx(265 / 510)
    assert np.array_equal(differ(b, a).steps, found.steps)


@pytest.mark.parametrize("magnify", [1.0, 4.0, 255.0])
def test_the_colours_run_from_nothing_to_one_over_the_magnification(magnify):
    steps = np.arange(256, dtype=np.uint8).reshape(1, -1, 1).repeat(3, axis=2)
    painted = differ(steps, np.zeros_like(steps)).painted(magnify)[0]
    assert (painted[:, 3] == 255).all()
    expected = 255.0 * colour_of(np.arange(256) / 255.0 * magnify)
    assert np.abs(painted[:, :3] - expected).max() <= 0.5
    assert np.array_equal(painted[int(np.ceil(255 / magnify))], painted[255])


@pytest.mark.parametrize("name", ["teapot", "sphere"])
@pytest.mark.parametrize("samples", [1, 3])
def test_the_reference_is_the_numpy_renderers_picture(name, samples):
    setup = load(name).with_(samples=samples)
    expected = np.empty((VIEW[1], VIEW[0], 4), dtype=np.uint8)
    with NumpyRenderer(VIEW) as renderer:
        renderer.render(setup, out=expected)
    pieces = list(reference.coded(setup, VIEW))
    np.testing.assert_array_equal(pieces[-1].item, expected)
    shares = [piece.share for piece in pieces]
    assert shares == sorted(shares) and shares[0] == 0.0 and shares[-1] == 1.0


@pytest.mark.gl
class TestInTheWindow:
    """Difference and reference as pictures of the view."""

    def shows(self, hands, layout, other):
        hands.window.state = replace(hands.state, layout=layout, other=other)
        hands.frames(3)
        self.ready(hands)

    def ready(self, hands):
        hands.until(lambda: not hands.window.slots.reference.computing)

    def codes(self, hands, size, shading):
        return hands.expected(size, shading=shading)

    @pytest.mark.parametrize("other", ["flat", "per-vertex"])
    def test_the_numbers_are_those_of_the_two_pictures(self, hands, other):
        self.shows(hands, "difference", other)
        seen = hands.pixels()
        size = seen.shape[1::-1]
        expected = differ(self.codes(hands, size, "per-fragment"), self.codes(hands, size, other))
        found = hands.window.slots.difference.difference
        np.testing.assert_array_equal(found.steps, expected.steps)
        painted = expected.painted(hands.state.magnify)[..., :3]
        free = np.s_[40:-160]  # between caption and legend
        np.testing.assert_array_equal(seen[free], painted[free])
        assert found.largest > 0.1

    def test_it_is_computed_only_when_something_changes(self, hands):
        self.shows(hands, "difference", "per-vertex")
        computed = hands.window.slots.difference.computed
        hands.io.add_mouse_pos_event(300, 300)
        hands.frames(10)
        assert hands.window.slots.difference.computed == computed
        hands.key("s")
        assert hands.window.slots.difference.computed == computed + 1
        hands.window.state = replace(hands.state, magnify=32.0)
        hands.frames(3)
        assert hands.window.slots.difference.computed == computed + 1

    def test_the_gpu_agrees_with_the_reference(self, hands):
        self.shows(hands, "difference", "reference")
        found = hands.window.slots.difference.difference
        # Rounding moves an edge by a pixel here and there; inside, 8-bit codes agree to a step.
        assert found.mean < 1e-3
        assert (found.steps <= 1).mean() > 0.999

    @pytest.mark.parametrize("layout", ["side by side", "wipe"])
    def test_the_reference_stands_beside_the_others(self, hands, layout):
        self.shows(hands, layout, "reference")
        picture = hands.window.slots.reference.codes
        assert picture is not None and picture[..., :3].std() > 5.0
        seen = hands.pixels()
        right = picture[200:400, -100:, :3]
        np.testing.assert_array_equal(seen[200:400, -100:], right)

    def test_the_window_goes_on_while_it_is_computed(self, hands, monkeypatch):
        self.shows(hands, "wipe", "reference")
        before = hands.window.slots.reference.codes
        real, wanted = reference.reference_pieces.pieces, Event()

        def held(setup, size):
            while not wanted.is_set():
                time.sleep(0.001)
                yield Piece()
            yield from real(setup, size)

        monkeypatch.setattr(reference.reference_pieces, "pieces", held)
        hands.drag((250, 300), (300, 330))  # asserts a frame each time
        assert hands.window.slots.reference.computing
        hands.frames(2)
        assert hands.window.slots.reference.codes is before  # the last one stands
        wanted.set()
        self.ready(hands)
        assert hands.window.slots.reference.codes is not before

    def test_nothing_is_computed_when_nobody_looks(self, hands):
        self.shows(hands, "wipe", "reference")
        hands.drag((250, 300), (300, 330))
        hands.window.state = replace(hands.state, layout="single")
        hands.frames(3)
        assert not hands.window.slots.reference.computing

    def test_bugs_are_not_part_of_the_reference(self, hands):
        hands.load("teapot", bugs=("missing-max",))
        self.shows(hands, "difference", "reference")
        assert not hands.state.failed
        assert hands.window.slots.difference.difference.largest > 0.05
