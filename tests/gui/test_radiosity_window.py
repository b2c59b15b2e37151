"""Radiosity in the window: solved while it draws, never begun anew without a reason."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from playground.gui.picture.orbit import widened
from playground.gui.state import LIGHTMAP, RADIOSITY
from playground.render.renderer import open_renderer
from playground.scene.library import load

pytestmark = pytest.mark.gl
PATCHES = 120
CAPTION = 40  # rows from the top in which a caption may stand


class Solved:
    """The window on a setup by radiosity."""

    def __init__(self, hands, gl_context):
        self.hands, self.gl_context = hands, gl_context

    @property
    def run(self):
        return self.hands.window.slots.stored.radiosity

    def show(self, name="cornell-box", method=RADIOSITY, view=None, **changes):
        """Show a setup; ``view`` are changes of the state."""
        self.hands.load(name, **{"patches": PATCHES, **changes})
        self.hands.window.state = replace(self.hands.state, method=method, **(view or {}))
        self.hands.frames(3)

    def change(self, **changes):
        state = self.hands.state
        self.hands.window.state = state.with_setup(state.setup.with_(**changes))
        self.hands.frames(2)

    def solving(self, **changes):
        solving = replace(self.hands.state.solving, **changes)
        self.hands.window.state = replace(self.hands.state, solving=solving)
        self.hands.frames(2)

    def step(self):
        self.hands.window.state = replace(
            self.hands.state, solving=self.hands.state.solving.stepped()
        )
        self.hands.frames(1)
        self.hands.until(lambda: not self.run.working)

    def wait(self):
        """Until nothing more comes by itself; the pixels of the view."""
        self.hands.until(lambda: not self.hands.window.slots.refining)
        return self.hands.pixels()

    def drawn(self, size, method=RADIOSITY, **changes):
        """The codes (H, W, 3) of a renderer that knows nothing of the window."""
        setup = self.hands.state.setup
        setup = setup.with_(camera=widened(setup.camera, size[0] / size[1]), **changes)
        codes = np.empty((size[1], size[0], 4), dtype=np.uint8)
        self.gl_context.__enter__()
        try:
            with open_renderer(size, "gl", self.gl_context, method) as renderer:
                renderer.render(setup, out=codes)
        finally:
            self.hands.window.ctx.__enter__()
        return codes[..., :3]


@pytest.fixture
def solved(hands, gl_context):
    made = Solved(hands, gl_context)
    made.run._of = made.run._depends = None  # nothing that another test has solved is kept
    yield made
    hands.load("teapot")


def size_of(codes):
    return codes.shape[1], codes.shape[0]


@pytest.mark.parametrize("shading", ["per-fragment", "flat"])
@pytest.mark.parametrize("light_shown", ["all", "indirect"])
def test_the_view_is_the_picture_of_the_library(solved, shading, light_shown):
    solved.show(shading=shading, light_shown=light_shown)
    seen = solved.wait()
    assert solved.run.result.done and not solved.run.error
    expected = solved.drawn(size_of(seen))
    assert expected.std() > 5.0
    np.testing.assert_array_equal(seen, expected)


def test_term_by_term_the_light_is_that_of_all_terms(solved):
    """The diffuse picture alone has light, though nothing shines where only it is summed."""
    solved.show(view={"layout": "terms"})
    seen = solved.wait()
    wide, high = (seen.shape[1] - 2 * 4) // 3, (seen.shape[0] - 4) // 2
    diffuse = seen[CAPTION:high, :wide]
    whole = solved.drawn((wide, high))[CAPTION:]
    assert not solved.run.error
    emissive = solved.drawn((wide, high), "raster", terms=("emissive",))[CAPTION:]
    dark = emissive.max(axis=2) == 0  # the lamp itself is not part of the diffuse term
    np.testing.assert_array_equal(diffuse[dark], whole[dark])


def test_the_camera_moves_and_nothing_is_solved_again(solved):
    solved.show()
    solved.wait()
    result, step = solved.run.result, solved.run.step
    solved.hands.key("left_arrow")
    seen = solved.wait()
    assert solved.run.result is result and solved.run.step is step
    np.testing.assert_array_equal(seen, solved.drawn(size_of(seen)))


def test_the_display_changes_and_nothing_is_solved_again(solved):
    solved.show()
    solved.wait()
    result = solved.run.result
    solved.change(exposure=0.5, curve="srgb")
    seen = solved.wait()
    assert solved.run.result is result
    np.testing.assert_array_equal(seen, solved.drawn(size_of(seen)))


@pytest.mark.parametrize("knob", [{"patches": 90}, {"solver": "jacobi"}, {"diffuse_weight": 0.5}])
def test_what_the_solution_depends_on_begins_it_anew(solved, knob):
    solved.show()
    solved.wait()
    result = solved.run.result
    solved.change(**knob)
    assert solved.run.result is not result
    seen = solved.wait()
    np.testing.assert_array_equal(seen, solved.drawn(size_of(seen)))


def test_a_change_of_colour_keeps_the_form_factors(solved):
    solved.show()
    solved.wait()
    factors = solved.run.result.form_factors
    calls = factors.calls
    first = solved.hands.state.setup.scene.objects[0]
    red = replace(first, material=replace(first.material, diffuse=(0.8, 0.1, 0.1)))
    solved.change(objects=(red, *solved.hands.state.setup.scene.objects[1:]))
    seen = solved.wait()
    assert solved.run.result.form_factors is factors and factors.calls <= calls + 2 * PATCHES
    np.testing.assert_array_equal(seen, solved.drawn(size_of(seen)))


def test_until_the_new_light_is_there_the_old_one_is_shown(solved):
    solved.show()
    before = solved.wait()
    solved.solving(playing=False)
    solved.change(patches=90)
    solved.wait()
    assert solved.run.step is None
    np.testing.assert_array_equal(solved.hands.pixels()[CAPTION:], before[CAPTION:])


class TestSteps:
    def test_each_changes_the_picture(self, solved):
        solved.show(view={"solving": replace(solved.hands.state.solving, playing=False)})
        dark = solved.wait()
        assert solved.run.step is None
        pictures, done = [], []
        for _ in range(4):
            solved.step()
            pictures.append(solved.hands.pixels()[CAPTION:])
            done.append(solved.run.step.done)
        assert done[0] == 0 and done == sorted(set(done))
        assert np.abs(pictures[1] - dark[CAPTION:]).max() > 10
        for one, other in pairwise(pictures[1:]):
            assert np.abs(one - other).max() > 0

    def test_a_pause_holds_and_play_goes_on_from_there(self, solved):
        paused = replace(solved.hands.state.solving, playing=False)
        solved.show(view={"solving": paused})
        solved.wait()
        solved.step()
        solved.step()
        step, result = solved.run.step, solved.run.result
        solved.hands.frames(10)
        assert solved.run.step is step
        solved.hands.key("k")
        assert solved.hands.state.solving.playing
        seen = solved.wait()
        assert solved.run.result is result and result.done
        np.testing.assert_array_equal(seen, solved.drawn(size_of(seen)))

    def test_the_keys_step_and_begin_anew(self, solved):
        solved.show()
        solved.wait()
        result = solved.run.result
        solved.hands.key("j")
        assert not solved.hands.state.solving.playing
        solved.hands.key("z")
        solved.wait()
        assert solved.run.result is not result and solved.run.step is None
        solved.hands.key("j")
        solved.wait()
        assert solved.run.step.done == 0

    def test_who_shoots_is_marked_and_named(self, solved):
        marked = replace(solved.hands.state.solving, playing=False, shooter=True)
        solved.show(view={"solving": marked})
        solved.wait()
        solved.step()
        solved.step()
        lines = solved.hands.window.slots.stored.marked(marked)
        assert lines.shooters == tuple(solved.run.step.patches)
        yellow = solved.hands.pixels()
        solved.solving(shooter=False)
        plain = solved.hands.pixels()
        changed = np.any(plain != yellow, axis=2)
        assert 0.0 < changed[CAPTION:].mean() < 0.3


def test_the_outlines_lie_over_the_picture(solved):
    solved.show()
    plain = solved.wait()
    solved.solving(outlines=True)
    lined = solved.hands.pixels()
    share = np.any(plain != lined, axis=2).mean()
    assert 0.005 < share < 0.3
    patches = solved.run.result.patches
    edges = solved.hands.window.slots.stored.marked(solved.hands.state.solving).edges
    assert len(patches) < len(edges) / 2 < 4 * len(patches)


class TestBounces:
    def test_0_is_what_shines_1_is_direct_and_many_are_the_solution(self, solved):
        solved.show(form_factors="closed-form", solver="jacobi", convergence=1e-6)
        whole = solved.wait()
        solved.solving(by_bounce=True, bounces=0)
        nothing = solved.wait()
        np.testing.assert_array_equal(
            nothing, solved.drawn(size_of(nothing), "raster", terms=("emissive",))
        )
        solved.solving(bounces=1)
        direct = solved.wait()
        solved.solving(bounces=50)
        np.testing.assert_allclose(solved.wait(), whole, atol=1)  # 8-bit steps, rounding
        solved.solving(by_bounce=False)
        solved.change(light_shown="direct")
        np.testing.assert_allclose(direct, solved.wait(), atol=1)

    def test_more_bounces_are_brighter(self, solved):
        solved.show()
        solved.wait()
        means = []
        for bounces in range(4):
            solved.solving(by_bounce=True, bounces=bounces)
            means.append(solved.wait().mean())
        assert means == sorted(set(means))


class TestTrouble:
    def test_a_scene_without_light_says_so_and_the_window_lives(self, solved):
        solved.show("sphere", lights=())
        solved.wait()
        assert "no light" in solved.run.error
        assert solved.hands.state.setup.scene.lights == ()  # nothing is taken back
        solved.show("cornell-box")
        solved.wait()
        assert not solved.run.error and solved.run.result.done

    def test_so_does_one_that_reflects_all(self, solved):
        solved.show("furnace")
        scene = solved.hands.state.setup.scene
        white = tuple(
            replace(x, material=replace(x.material, diffuse=(1.0, 1.0, 1.0))) for x in scene.objects
        )
        solved.change(objects=white)
        seen = solved.wait()
        assert "reflect" in solved.run.error
        plate = seen[CAPTION:]
        assert (plate.min(axis=2) == 255).any()  # white words; the background is blue
        solved.change(objects=scene.objects)
        solved.wait()
        assert not solved.run.error

    def test_without_a_lightmap_the_picture_says_how_to_get_one(self, solved):
        solved.show("cornell-box", method=LIGHTMAP)
        seen = solved.wait()
        trouble = solved.hands.window.slots.stored.trouble(LIGHTMAP)
        assert "playground bake" in trouble
        assert seen.max() == 255
        assert not solved.hands.state.failed


def test_the_lightmap_is_the_picture_of_the_library(solved, tmp_path):
    from playground import radiosity

    setup = load("cornell-box").with_(patches=PATCHES)
    path = tmp_path / "baked.npz"
    radiosity(setup, "numpy").bake(64).save(path)
    solved.show("cornell-box", method=LIGHTMAP, lightmap=str(path))
    seen = solved.wait()
    assert not solved.hands.window.slots.stored.trouble(LIGHTMAP)
    expected = solved.drawn(size_of(seen), LIGHTMAP)
    assert expected.std() > 5.0
    np.testing.assert_array_equal(seen, expected)
