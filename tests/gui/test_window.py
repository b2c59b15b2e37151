"""The real app in a window without a display, driven by hand and by the ImGui test engine."""

import numpy as np
import pytest

from playground.scene.library import library
from playground.scene.settings import TERMS, Shading

pytestmark = pytest.mark.gl
WALK = 300  # deeds of the random walk
MIDDLE = (460, 350)


def eye_distance(state):
    camera = state.setup.camera
    return float(np.linalg.norm(np.subtract(camera.eye, camera.target)))


def test_the_view_shows_what_the_setup_renders(hands):
    for shading in Shading:
        hands.load("teapot", shading=shading)
        seen = hands.pixels()
        expected = hands.expected((seen.shape[1], seen.shape[0]))
        np.testing.assert_array_equal(seen, expected)


@pytest.mark.parametrize("name", library())
def test_every_setup_of_the_library_opens_and_is_drawn(hands, name):
    hands.load(name)
    assert not hands.state.failed
    assert hands.pixels().std() > 1.0


def test_nothing_is_drawn_again_unless_something_changes(hands, window):
    hands.frames(5)
    before = window.slots.draws
    hands.io.add_mouse_pos_event(*MIDDLE)
    hands.frames(20)
    assert window.slots.draws == before
    hands.key("d")
    assert window.slots.draws == before + 1


def test_specular_off_leaves_nothing_brighter_than_the_diffuse_maximum(hands):
    hands.load("sphere", terms=("diffuse", "specular"), background=(0, 0, 0))
    bright = hands.pixels().max()
    hands.key("s")
    assert hands.state.setup.settings.terms == ("diffuse",)
    material = hands.state.setup.scene.objects[0].material
    light = hands.state.setup.scene.lights[0]
    most = np.ceil(255 * np.multiply(material.diffuse, light.diffuse))
    dull = hands.pixels()
    assert (dull <= most).all()
    assert dull.max() < bright


@pytest.mark.parametrize("term", TERMS)
def test_a_key_toggles_each_term(hands, term):
    before = hands.pixels()
    hands.key(term[0])
    assert term not in hands.state.setup.settings.terms
    assert (hands.pixels() <= before).all()
    hands.key(term[0])
    assert hands.state.setup == hands.state.loaded
    np.testing.assert_array_equal(hands.pixels(), before)


def test_letters_choose_the_shading_and_digits_the_terms(hands):
    for digit, term in enumerate(TERMS, 1):
        hands.key(f"_{digit}")
        assert term not in hands.state.setup.settings.terms
        hands.key(f"_{digit}")
        assert hands.state.setup == hands.state.loaded
    for keys, mode in zip((("f", "shift"), ("g",), ("p",)), Shading, strict=True):
        hands.key(*keys)
        assert hands.state.setup.settings.shading == mode.value


def test_dragging_orbits_at_constant_distance_and_is_one_step(hands):
    before, distance = hands.state.setup, eye_distance(hands.state)
    hands.drag(MIDDLE, (600, 420), (500, 300))
    assert hands.state.setup.camera.eye != before.camera.eye
    assert eye_distance(hands.state) == pytest.approx(distance, rel=1e-9)
    assert len(hands.state.history.past) == 1
    hands.key("z", "ctrl")
    assert hands.state.setup == before
    hands.key("y", "ctrl")
    assert hands.state.setup != before
    hands.key("r")
    assert hands.state.setup == before


def test_right_drag_pans_and_the_wheel_comes_nearer(hands):
    before = hands.state.setup.camera
    hands.drag(MIDDLE, (560, 350), button=1)
    panned = hands.state.setup.camera
    assert panned.target != before.target
    assert np.subtract(panned.eye, panned.target) == pytest.approx(
        np.subtract(before.eye, before.target)
    )
    distance = eye_distance(hands.state)
    hands.wheel(*MIDDLE, 1.0)
    hands.wheel(*MIDDLE, 1.0)
    assert eye_distance(hands.state) == pytest.approx(0.81 * distance)
    assert len(hands.state.history.past) == 2  # the pan, and both notches together
    hands.key("f")
    assert hands.state.setup.camera.target != panned.target


def test_the_divider_of_the_wipe_is_dragged_and_splits_the_picture(hands):
    for _ in range(2):
        hands.key("c")
    assert hands.state.layout == "wipe"
    wide = hands.window.view_box()[2]
    camera, x = hands.state.setup.camera, wide * 0.5
    hands.drag((x, 350), (300, 350))
    assert hands.state.wipe == pytest.approx(300 / wide, abs=0.01)
    assert hands.state.setup.camera == camera
    seen = hands.pixels()
    size = (seen.shape[1], seen.shape[0])
    for mode, part in (("per-fragment", slice(0, 280)), ("per-vertex", slice(320, 900))):
        expected = hands.expected(size, shading=mode)
        below = slice(40, None)  # below the captions
        np.testing.assert_array_equal(seen[below, part], expected[below, part])


def test_term_pictures_and_side_by_side_are_drawn(hands):
    hands.key("c")
    assert hands.state.layout == "side by side"
    assert hands.pixels().std() > 5.0
    hands.key("c")
    hands.key("c")
    assert hands.state.layout == "terms"
    assert hands.pixels().std() > 5.0


def test_space_walks_and_stops_and_is_one_step(hands):
    hands.key("space")
    hands.frames(10)
    assert hands.state.playing
    hands.key("space")
    hands.frames(2)
    eye = hands.state.setup.camera.eye
    hands.frames(5)
    assert hands.state.setup.camera.eye == eye != hands.state.loaded.camera.eye
    assert len(hands.state.history.past) == 1


def test_a_dropped_picture_brings_its_setup_back(hands, window, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    hands.key("s")
    hands.drag(MIDDLE, (560, 400))
    wanted = hands.state.setup
    hands.key("f12")
    assert (tmp_path / "teapot.png").is_file()
    hands.load("sphere")
    window.on_files_dropped_event(0, 0, [str(tmp_path / "teapot.png")])
    hands.frames()
    assert hands.state.setup == wanted
    hands.key("z", "ctrl")
    assert hands.state.setup.name == "sphere"


def test_a_bad_file_dropped_shows_a_message_and_changes_nothing(hands, window, tmp_path):
    (tmp_path / "bad.obj").write_text("v 1 2")
    before = hands.state.setup
    for name in ("bad.obj", "missing.toml"):
        window.on_files_dropped_event(0, 0, [str(tmp_path / name)])
        hands.frames()
        assert hands.state.failed and name in hands.state.message
        assert hands.state.setup is before


def test_a_setup_that_cannot_be_drawn_gives_way_to_the_last_good_one(hands, window):
    before = hands.state.setup
    broken = before.with_(mesh="nowhere.obj")
    window.state = window.state.with_setup(before)
    from playground.gui import view

    state, held = window.state.with_setup(broken), False
    window.ui.begin(1 / 60)
    hands.imgui.begin("View")
    state, held = view.draw_safely(state, window.state, window.slots, 1.0)
    hands.imgui.end()
    window.wnd.use()
    window.ui.end()
    window.ui.after_swap()
    assert state.failed and "nowhere.obj" in state.message and not held
    assert state.setup is before


def test_a_bug_in_a_panel_does_not_end_the_lecture(hands, window, monkeypatch, capsys):
    from playground.gui import panels

    def broken(state, ui):
        hands.imgui.push_id("left open")
        raise RuntimeError("boom")

    before = hands.pixels()
    monkeypatch.setitem(panels.PANELS, "View", broken)
    window.wnd.use()
    window.wnd.render(0.0, 1 / 60)
    window.ui.after_swap()
    assert hands.state.failed and "boom" in hands.state.message
    assert "boom" in capsys.readouterr().err
    monkeypatch.undo()
    hands.load("teapot")
    np.testing.assert_array_equal(hands.pixels(), before)


def test_sheets_open_and_close_by_keys(hands):
    hands.key("f1")
    assert hands.state.sheet == "shortcuts"
    hands.key("escape")
    assert hands.state.sheet == ""
    hands.key("o", "ctrl")
    assert hands.state.sheet == "open"
    hands.io.add_input_characters_utf8("sd")
    hands.frames(3)
    assert hands.state.setup == hands.state.loaded  # the letters went into the field
    hands.key("escape")
    hands.frames(2)
    assert hands.state.sheet == ""


def test_a_chord_within_one_slow_frame_still_counts(hands):
    """On a slow frame the modifier may be up again when the key is seen."""
    keys = hands.imgui.Key
    hands.key("s")
    hands.io.add_key_event(keys.mod_ctrl, True)
    hands.frames(1)
    hands.io.add_key_event(keys.z, True)
    hands.io.add_key_event(keys.mod_ctrl, False)
    hands.frames(1)
    hands.io.add_key_event(keys.z, False)
    hands.frames(1)
    assert hands.state.setup == hands.state.loaded


def test_text_of_any_size_and_both_themes_leave_room_for_the_picture(hands):
    hands.key("t")
    for _ in range(8):
        hands.key("equal", "ctrl")
    assert hands.state.text_size == 2.5
    assert hands.pixels().shape[1] > 600
    hands.key("h")
    assert hands.pixels().shape[1] == 1280
    hands.key("_0", "ctrl")


def test_a_random_walk_of_events_leaves_a_sound_state(hands, rng, tmp_path, monkeypatch):
    """Keys, clicks, drags and wheels anywhere: no exception, no GL error, a setup to save.

    A deed is four to sixteen events of mouse and keyboard: three thousand in all.
    """
    from playground.scene.setup_file import format_setup, parse_setup

    monkeypatch.chdir(tmp_path)
    keys = ["d", "s", "a", "e", "_1", "_2", "_3", "c", "t", "h", "f", "r", "space", "escape"]
    keys += ["w", "n", "x", "l", "m", "b", "v", "g", "p", "tab", "f1", "f4", "f5", "page_up"]
    for _ in range(WALK):
        x, y = (float(v) for v in rng.uniform((0, 25), (1280, 720)))
        deed = rng.integers(5)
        if deed == 0:
            hands.key(str(rng.choice(keys)))
        elif deed == 1:
            hands.click(x, y, int(rng.integers(2)))
        elif deed == 2:
            hands.drag((x, y), tuple(rng.uniform((0, 25), (1280, 720))), steps=3)
        elif deed == 3:
            hands.wheel(x, y, float(rng.choice([-1.0, 1.0])))
        else:
            hands.key(str(rng.choice(["z", "y"])), "ctrl")
    setup = hands.state.setup
    assert parse_setup(format_setup(setup), setup.name) == setup
