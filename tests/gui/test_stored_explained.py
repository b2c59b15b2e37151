"""Why a pixel of radiosity or of a lightmap has its colour, in the panel of explanations."""

from dataclasses import replace

import numpy as np
import pytest

from playground.explain.stored_pixel import explain_stored
from playground.gui.picture.comparison import pictures
from playground.gui.pixel.clue import Clue
from playground.gui.state import LIGHTMAP, RADIOSITY
from playground.scene.library import load

imgui = pytest.importorskip("imgui_bundle").imgui

from playground.gui.radiosity import stored_panel  # noqa: E402
from playground.gui.radiosity.stored_explained import stored_explained  # noqa: E402
from playground.gui.radiosity.stored_told import stored_told  # noqa: E402

pytestmark = pytest.mark.gl
PATCHES = 60
FLOOR, BEYOND = (0.45, 0.9), (0.02, 0.1)  # of the picture: the floor of the box, the background


class Stored:
    """The window on a picture of stored light, and the words of its panel of explanations."""

    def __init__(self, hands, monkeypatch):
        self.hands, self.said = hands, []
        write = imgui.text_wrapped
        monkeypatch.setattr(
            stored_panel.imgui, "text_wrapped", lambda text: (self.said.append(text), write(text))
        )

    @property
    def run(self):
        return self.hands.window.slots.stored.radiosity

    def show(self, method, pixel=FLOOR, playing=True, **changes):
        self.hands.load("cornell-box", **{"patches": PATCHES, **changes})
        state = self.hands.state
        self.hands.window.state = replace(
            state,
            method=method,
            pixel=pixel,
            clue=Clue(),
            unfold="Explain",
            solving=replace(state.solving, playing=playing),
        )
        self.hands.frames(3)

    def rest(self):
        self.hands.until(lambda: not self.hands.window.slots.refining)

    @property
    def picture(self):
        _, _, wide, high = self.hands.window.view_box()
        return pictures(self.hands.state, wide, high)[0]

    @property
    def why(self):
        return stored_explained(self.hands.state, self.picture, self.hands.window.slots.stored)

    def seen(self, pixel):
        """The codes of a pixel of the view, without the ring around it."""
        self.hands.window.state = self.hands.state.unpicked()
        return self.hands.pixels()[pixel[1], pixel[0]]


@pytest.fixture
def stored(hands, monkeypatch):
    made = Stored(hands, monkeypatch)
    yield made
    hands.load("teapot")


def test_of_radiosity_it_is_the_pixel_that_is_seen_and_that_of_the_library(stored):
    stored.show(RADIOSITY)
    stored.rest()
    why = stored.why
    np.testing.assert_allclose(why.codes, stored.seen(why.pixel), atol=1)  # float32, then rounded
    # Another process of solving stops at the same share of the light that is left.
    setup = stored.picture.setup
    alone = explain_stored(setup, why.pixel, why.size, RADIOSITY)
    assert why.patch == alone.patch
    np.testing.assert_allclose(why.colour, alone.colour, rtol=setup.settings.convergence * 10)


def test_it_tells_the_equation_of_the_patch_and_who_sends(stored):
    stored.show(RADIOSITY)
    stored.rest()
    why = stored.why
    told = stored_told(why)
    assert told.seen == f"sees patch {why.patch} of object 0, cornell_floor_and_back.obj"
    assert told.patch.lines[0].text.startswith("C  (")
    np.testing.assert_allclose(np.prod(told.filter, axis=0), why.diffuse, rtol=1e-12)
    assert " of a light, F 0." in told.patch.senders[0].text  # nothing else is as bright
    assert told.seen in stored.said and told.patch.balance in stored.said


def test_explaining_solves_nothing_and_follows_each_step(stored):
    stored.show(RADIOSITY, playing=False, solver="southwell", patches=80)
    stored.hands.until(lambda: not stored.run.working)
    assert stored.run.step is None and stored.why is None
    assert stored_panel.WAITING in stored.said
    shown = []
    for shots in (0, 1):  # the first step says where the solver begins
        state = stored.hands.state
        stored.hands.window.state = replace(state, solving=state.solving.stepped())
        stored.hands.until(lambda shots=shots: stored.run.step and stored.run.step.done == shots)
        stored.hands.frames(3)
        assert stored.run.step.done == shots
        shown.append(stored.why.patch_light.light)
    assert not shown[0].any() and shown[1].any()


def test_the_background_is_told_as_such(stored):
    stored.show(RADIOSITY, pixel=BEYOND)
    stored.rest()
    assert "No surface here: the background." in stored.said


def test_of_a_lightmap(stored, tmp_path):
    from playground import radiosity

    path = tmp_path / "baked.npz"
    radiosity(load("cornell-box").with_(patches=PATCHES), "numpy").bake(64).save(path)
    stored.show(LIGHTMAP, lightmap=str(path))
    why = stored.why
    np.testing.assert_allclose(why.codes, stored.seen(why.pixel), atol=1)  # float32, then rounded
    assert stored_told(why).patch is None and stored_told(why).seen in stored.said


def test_without_a_lightmap_the_panel_names_the_button(stored):
    stored.show(LIGHTMAP)
    assert stored.why is None
    assert any("Bake in the panel Lightmap" in words for words in stored.said)
