"""Every layout of the view shows, pixel by pixel, what a renderer without a window draws."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from playground.gui.picture.difference import differ
from playground.gui.picture.orbit import widened
from playground.gui.picture.overlay_knobs import Overlays
from playground.gui.state import FIVE, LAYOUTS, REFERENCE
from playground.render.gl.renderer import GLRenderer
from playground.render.numpy_renderer import NumpyRenderer
from playground.scene.settings import TERMS, Shading

pytestmark = pytest.mark.gl
MODES = tuple(mode.value for mode in Shading)
PAIRS = [(a, b) for a, b in product(MODES, (*MODES, REFERENCE)) if a != b]
CAPTION = 40  # rows from the top in which a caption may stand
GAP = 4  # pixels between two pictures
GRIP = 10  # columns to either side of the divider that its line and knob cover
LEGEND = np.s_[-150:, -330:]  # of the difference
LINES = ("wireframe", "vertex_normals", "face_normals")


class Looking:
    """The window in some layout, and the same pictures drawn without it."""

    def __init__(self, hands, gl_context):
        self.hands, self.gl_context = hands, gl_context

    def at(self, **changes):
        """The pixels of the view after ``changes`` of the state, when all is computed."""
        self.hands.window.state = replace(self.hands.state, **changes)
        self.hands.frames(3)
        reference = self.hands.window.slots.reference
        self.hands.until(lambda: not reference.computing)
        return self.hands.pixels()

    def drawn(self, size, mode, **changes):
        """The codes (H, W, 3) of a renderer that knows nothing of the window."""
        setup = self.hands.state.setup
        camera = widened(setup.camera, size[0] / size[1])
        shading = "per-fragment" if mode == REFERENCE else mode
        setup = setup.with_(shading=shading, camera=camera, **changes)
        codes = np.empty((size[1], size[0], 4), dtype=np.uint8)
        if mode == REFERENCE:
            with NumpyRenderer(size) as renderer:
                renderer.render(setup, out=codes)
            return codes[..., :3]
        self.gl_context.__enter__()
        try:
            with GLRenderer(size, self.gl_context) as renderer:
                renderer.render(setup, out=codes)
        finally:
            self.hands.window.ctx.__enter__()
        return codes[..., :3]


@pytest.fixture
def looking(hands, gl_context):
    made = Looking(hands, gl_context)
    yield made
    hands.window.state = replace(hands.state, layout="single")
    hands.frames(2)


def size_of(codes):
    return codes.shape[1], codes.shape[0]


def same(seen, expected):
    """Equal pixels below the captions."""
    assert expected[CAPTION:].std() > 5.0
    np.testing.assert_array_equal(seen[CAPTION:], expected[CAPTION:])


def test_every_layout_is_looked_at_here():
    elsewhere = {FIVE}  # in test_radiosity_window
    assert set(LAYOUTS) - elsewhere == {"single", "side by side", "wipe", "difference", "terms"}


@pytest.mark.parametrize("samples", [1, 4])
@pytest.mark.parametrize("mode", MODES)
def test_single(looking, mode, samples):
    looking.hands.load("teapot", shading=mode, samples=samples)
    seen = looking.at(layout="single")
    np.testing.assert_array_equal(seen, looking.drawn(size_of(seen), mode))


@pytest.mark.parametrize(("mode", "other"), PAIRS)
def test_side_by_side(looking, mode, other):
    looking.hands.load("teapot", shading=mode)
    seen = looking.at(layout="side by side", other=other)
    half = (seen.shape[1] - GAP) // 2
    left, right = seen[:, :half], seen[:, half + GAP :]
    same(left, looking.drawn(size_of(left), mode))
    same(right, looking.drawn(size_of(right), other))


@pytest.mark.parametrize(("mode", "other"), PAIRS)
def test_wipe(looking, mode, other):
    looking.hands.load("teapot", shading=mode)
    seen = looking.at(layout="wipe", other=other, wipe=0.3)
    line = round(0.3 * seen.shape[1])
    left, right = np.s_[:, : line - GRIP], np.s_[:, line + GRIP :]
    same(seen[left], looking.drawn(size_of(seen), mode)[left])
    same(seen[right], looking.drawn(size_of(seen), other)[right])


@pytest.mark.parametrize(("mode", "other"), PAIRS)
def test_difference(looking, mode, other):
    looking.hands.load("teapot", shading=mode)
    seen = looking.at(layout="difference", other=other, magnify=16.0)
    a, b = (looking.drawn(size_of(seen), which) for which in (mode, other))
    expected = differ(a, b).painted(16.0)[..., :3].astype(np.float64)
    seen[LEGEND] = expected[LEGEND]
    same(seen, expected)


@pytest.mark.parametrize("mode", MODES)
def test_term_by_term(looking, mode):
    """Five pictures of one size, row by row; where a term is off, nothing is left of it."""
    on = ("diffuse", "specular", "emissive")
    looking.hands.load("teapot", shading=mode, terms=on)
    seen = looking.at(layout="terms")
    wide, high = (seen.shape[1] - 2 * GAP) // 3, (seen.shape[0] - GAP) // 2
    for i, terms in enumerate([*((term,) if term in on else () for term in TERMS), on]):
        x, y = (i % 3) * (wide + GAP), (i // 3) * (high + GAP)
        box = seen[y : y + high, x : x + wide]
        same(box, looking.drawn((wide, high), mode, terms=terms))


@pytest.mark.parametrize("samples", [1, 4])
@pytest.mark.parametrize("name", LINES)
def test_lines_over_reference_and_difference_are_those_over_the_picture(looking, name, samples):
    """The same pixels change, hidden ones stay hidden, and the numbers are of the plain pictures.

    The colours of the picture are chosen so that no line has the colour below it.
    """
    looking.hands.load("teapot", shading="per-fragment", terms=("diffuse",), samples=samples)
    chalk = Overlays(**{name: True})
    found = {}
    for layout, other in (("single", "flat"), ("wipe", REFERENCE), ("difference", "flat")):
        plain = looking.at(layout=layout, other=other, wipe=0.0, overlays=Overlays())
        numbers = looking.hands.window.slots.difference.difference
        lined = looking.at(overlays=chalk)
        changed = np.any(plain != lined, axis=2)
        changed[:CAPTION], changed[:, :GRIP], changed[LEGEND] = False, False, False
        assert changed.mean() > 0.01
        assert looking.hands.window.slots.difference.difference is numbers
        found[layout] = changed
    np.testing.assert_array_equal(found["wipe"], found["single"])
    np.testing.assert_array_equal(found["difference"], found["single"])
