"""What makes the window comfortable: presets, save as, command line, memory, presentation."""

import json
import shlex
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from playground import locate
from playground.gui.state import start
from playground.scene.library import library, load
from playground.scene.light import PointLight, SpotLight
from playground.scene.material import Material


def parsed(command):
    """The setup that the command line makes of a command."""
    from playground import cli
    from playground.options import setup_of

    words = shlex.split(command)
    assert words[:2] == ["playground", "render"]
    options = cli._parser().parse_args(words[1:])
    return setup_of(options)


@pytest.mark.parametrize("name", library())
def test_a_setup_of_the_library_is_a_short_command(name):
    from playground.gui.command_line import command_line

    setup = load(name)
    assert command_line(setup, name, load(name)) == f"playground render {name} -o {name}.png"


@pytest.mark.parametrize(
    "changes",
    [
        {"shininess": 0.1 + 0.2, "shading": "flat", "gate": True, "terms": ()},
        {"eye": (1.0, 1 / 3, -2e-7), "background": (0, 0.25, 1), "title": "a 'b' $c; d"},
        {"lights": (PointLight(position=(1, 2, 3)), SpotLight(inner_angle=10.0, attenuate=True))},
        {"mesh": "torus", "tessellation": 12, "normals": "flat", "bugs": ("missing-max",)},
        {"diffuse": (0.1, 0.2, 0.3), "curve": "srgb", "exposure": 2.5, "samples": 4},
    ],
)
@pytest.mark.parametrize("name", ["teapot", "sphere"])
def test_the_command_line_read_back_gives_the_setup(name, changes):
    from playground.gui.command_line import command_line

    base = load(name)
    setup = base.with_(**changes)
    item = setup.scene.objects[0]
    moved = replace(item, transform=replace(item.transform, scale=(1, 2, 0.5), size=0.3))
    setup = setup.with_(objects=(moved, *setup.scene.objects[1:]))
    light = setup.scene.lights[0]
    setup = setup.with_(lights=(replace(light, diffuse=(0.3, 0.2, 0.1)), *setup.scene.lights[1:]))
    assert parsed(command_line(setup, name, base)) == setup


def test_what_a_command_line_cannot_say_is_refused():
    from playground.errors import PlaygroundError
    from playground.gui.command_line import command_line

    base = load("sphere")
    for setup in (base.with_(lights=()), base.with_(objects=())):
        with pytest.raises(PlaygroundError, match="the command line cannot"):
            command_line(setup, "sphere", base)


def test_presets_are_materials_that_know_their_names():
    from playground.scene.presets import PRESETS, preset, preset_of

    assert len(PRESETS) >= 12 and preset_of(Material()) == ""
    for name in PRESETS:
        made = preset(name, Material(texture="tiles.png"))
        assert preset_of(made) == name and made.texture == "tiles.png"
        assert preset_of(replace(made, shininess=3.0)) == ""
    assert preset("gold").diffuse == (0.75164, 0.60648, 0.22648)
    assert preset("emerald").shininess == pytest.approx(76.8)


@pytest.mark.parametrize("font", ["fonts/DejaVuSans.ttf", "fonts/DejaVuSansMono.ttf"])
def test_the_fonts_have_greek_vietnamese_and_the_signs_of_the_lecture(font):
    from PIL import ImageFont

    face = ImageFont.truetype(str(locate.asset(font)), 24)
    missing = bytes(face.getmask("\U000f1234"))
    for sign in "ρλΩαθ·⊗∫²→×…≤ễảưỹĐọ":
        assert bytes(face.getmask(sign)) != missing, sign


def state_to_keep():
    from playground.gui.state import start

    state = start(load("sphere").with_(shininess=33.0))
    return replace(state, theme="light", text_size=1.2, layout="wipe", level="beginner").opened(
        state.setup
    )


def test_a_window_is_remembered_and_recalled(tmp_path):
    from playground.gui import memory
    from playground.gui.state import start

    path = tmp_path / "deep" / "folder" / "window.json"
    state = replace(state_to_keep(), recent=("/a/ễ.toml", "/b.toml"))
    memory.remember(state, (1000, 700), path)
    kept = memory.recall(path)
    assert kept.size == (1000, 700) and kept.setup == state.setup and not kept.complaint
    again = memory.recalled(start(kept.setup), kept)
    for name in (*memory.KEPT, "recent", "setup"):
        assert getattr(again, name) == getattr(state, name), name
    assert again.loaded == load("sphere")  # reset leads to the library


def test_a_presentation_is_not_what_is_remembered(tmp_path):
    from playground.gui import memory, presentation

    path = tmp_path / "window.json"
    memory.remember(presentation.next_presentation(state_to_keep()), (800, 600), path)
    assert dict(memory.recall(path).knobs)["theme"] == "light"
    assert dict(memory.recall(path).knobs)["text_size"] == 1.2
    assert dict(memory.recall(path).knobs)["panel"] is True


@pytest.mark.parametrize("text", ["", "{", "[]", "\x00", "[" * 100_000, '{"size": 1e999}'])
def test_a_damaged_memory_is_passed_over_with_a_message(tmp_path, text):
    from playground.gui import memory
    from playground.gui.state import start

    path = tmp_path / "window.json"
    path.write_text(text)
    kept = memory.recall(path)
    assert kept.setup is None and kept.size is None and "damaged" in kept.complaint
    state = memory.recalled(start(load("sphere")), kept)
    assert state.failed and "damaged" in state.message
    assert state.setup == load("sphere")


def test_one_damaged_entry_does_not_spoil_the_others(tmp_path):
    from playground.gui import memory

    path = tmp_path / "window.json"
    memory.remember(state_to_keep(), (800, 600), path)
    table = json.loads(path.read_text())
    for name, value in (("theme", "pink"), ("size", [5, True]), ("recent", 3), ("setup", "[[")):
        path.write_text(json.dumps({**table, name: value}))
        kept = memory.recall(path)
        assert name in kept.complaint, name
        assert dict(kept.knobs)["text_size"] == 1.2
    assert memory.recall(tmp_path / "never") == memory.Memory()


def test_the_settings_folder_is_named_by_the_variable(tmp_path, monkeypatch):
    from playground.gui import memory

    assert str(memory.place()).startswith(str(tmp_path))
    monkeypatch.delenv("PLAYGROUND_SETTINGS")
    assert memory.place().name == "window.json" and not str(memory.place()).startswith(
        str(tmp_path)
    )


@pytest.mark.gl
def test_presentation_shows_the_picture_alone_and_comes_back(hands, window):
    before = hands.state
    plain = hands.pixels()
    for background, code in (("black", 0), ("white", 255)):
        hands.key("f5")
        assert hands.state.presentation == background
        seen = hands.pixels()
        assert seen.shape[:2] == (720, 1280)
        assert (seen[2, 2] == code).all()
        assert hands.state.setup is before.setup
    hands.key("escape")
    assert hands.state.presentation == "off"
    for name in ("panel", "theme", "text_size", "shaders"):
        assert getattr(hands.state, name) == getattr(before, name)
    np.testing.assert_array_equal(hands.pixels(), plain)
    for _ in range(3):
        hands.key("f5")
    assert hands.state.presentation == "off"


@pytest.mark.gl
def test_beginners_see_fewer_panels(hands):
    from playground.gui.panels import PANELS
    from playground.gui.presentation import FOR_BEGINNERS, shows

    assert set(FOR_BEGINNERS) < set(PANELS)
    hands.key("b")
    assert hands.state.level == "beginner"
    assert [name for name in PANELS if shows(hands.state, name)] == list(FOR_BEGINNERS)
    hands.key("b")
    assert all(shows(hands.state, name) for name in PANELS)


@pytest.mark.gl
def test_save_as_and_recent_files(hands, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    hands.key("s")
    hands.key("s", "ctrl", "shift")
    assert hands.state.sheet == "save" and hands.state.typed == "teapot.toml"
    hands.frames(3)
    hands.key("a", "ctrl")
    hands.io.add_input_characters_utf8("mine")
    hands.frames(3)
    hands.key("enter")
    assert (tmp_path / "mine.toml").is_file(), hands.state
    assert hands.state.sheet == "" and hands.state.recent == (str(tmp_path / "mine.toml"),)
    assert load(tmp_path / "mine.toml").settings == hands.state.setup.settings


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        ("", "setup.toml"),
        (".", "setup.toml"),
        ("/", "/setup.toml"),
        ("a/b", "a/b.toml"),
        ("a/b/", "a/b/setup.toml"),
        ("a/..", "a/../setup.toml"),
    ],
)
def test_what_is_typed_to_save_always_names_a_file(typed, meant):
    from playground.gui.save_sheet import target

    assert target(typed) == Path(meant)


TYPED = ("/", "~nobody-has-this-name/x", "a" * 300)  # 300: more than a name may have


@pytest.mark.gl
@pytest.mark.parametrize("chord", [("s", "ctrl", "shift"), ("o", "ctrl")])
def test_any_text_can_be_typed_where_a_file_is_asked_for(hands, tmp_path, monkeypatch, chord):
    monkeypatch.chdir(tmp_path)
    hands.key(*chord)
    sheet = hands.state.sheet
    hands.frames(3)
    for typed in TYPED:
        hands.key("a", "ctrl")
        hands.key("delete")
        hands.io.add_input_characters_utf8(typed)
        hands.frames(3)
        assert hands.state.typed == typed
    hands.key("enter")  # too long a name: the sheet stays, and one goes on typing
    assert hands.state.failed and hands.state.sheet == sheet
    hands.frames(3)
    hands.key("a", "ctrl")
    hands.io.add_input_characters_utf8("mine")
    hands.frames(3)
    assert hands.state.typed == "mine"
    hands.key("escape")


@pytest.mark.gl
def test_an_error_is_told_until_something_goes_well(hands):
    from playground.gui.actions import open_setup

    before = hands.state.setup
    hands.window.state = open_setup(hands.state, "nowhere.toml")
    hands.frames(5)
    assert hands.state.failed and "nowhere.toml" in hands.state.message
    hands.wheel(300, 300, 1.0)
    assert hands.state.setup != before and not hands.state.failed
    hands.window.state = replace(open_setup(hands.state, "nowhere.toml"), playing=True)
    hands.frames(5)
    assert hands.state.failed  # the camera walks by itself


def test_an_error_outlives_a_camera_that_walks_by_itself():
    from playground.gui.frame import without_old_error
    from playground.gui.state import start

    failed = start(load("sphere")).fail("no such file")
    moved = replace(failed, setup=failed.setup.with_(eye=(0, 0, 9)))
    assert not without_old_error(failed, moved).failed
    for walking in (
        replace(moved, playing=True),
        replace(moved, scope=replace(moved.scope, playing=True)),
    ):
        assert without_old_error(failed, walking).failed


def test_the_message_comes_before_the_numbers(monkeypatch):
    from playground.gui import status

    sizes = SimpleNamespace(calc_text_size=lambda text: SimpleNamespace(x=len(text)))
    monkeypatch.setattr(status, "imgui", sizes)
    numbers = "llvmpipe   1.0 ms   2 triangles"
    for room, left in ((43, numbers), (42, "1.0 ms   2 triangles"), (22, ""), (3, "")):
        assert status._beside("no such file", numbers, room) == left


@pytest.mark.gl
def test_the_window_fills_the_screen_and_comes_back(hands, window):
    for full in (True, False):
        hands.key("f11")
        assert window.wnd.fullscreen == full and not hands.state.wish


@pytest.mark.gl
def test_the_command_goes_to_the_clipboard(hands):
    hands.key("s")
    hands.key("c", "ctrl", "shift")
    words = hands.imgui.get_clipboard_text()
    assert words.startswith("playground render teapot --set settings.terms=")
    assert words in hands.state.message
    assert parsed(words) == hands.state.setup


@pytest.mark.gl
def test_a_preset_is_chosen_from_its_list(hands):
    from playground.scene.presets import preset_of

    def choose(engine):
        engine.item_click("Controls/Material/##preset")
        engine.yield_(2)
        engine.item_click("//$FOCUSED/ruby")

    hands.do(choose)
    assert preset_of(hands.state.setup.scene.objects[0].material) == "ruby"


@pytest.mark.gl
def test_no_key_means_two_things(window):
    from playground.gui.shortcuts import ACTIONS

    seen = {}
    for action in ACTIONS:
        for chord in action.chords:
            other = seen.setdefault(chord, action)
            # An open lesson takes the keys of the camera that step through slides elsewhere.
            takes = action.keys == "Esc" or other.menu == "Lessons"
            assert other is action or takes, (action.name, other.name)


def test_another_setup_is_never_compared_with_itself():
    for name, shading in (("teapot", "per-fragment"), ("popping", "per-vertex")):
        setup = load(name)
        assert setup.settings.shading == shading
        state = replace(start(setup.with_(shading="flat")), other=shading).opened(setup)
        assert state.other not in (shading, "flat")
        assert replace(state, other="flat").opened(setup).other == "flat"
