"""The sheet of keys tells the truth: every key that does something, and nothing else."""

import re
from dataclasses import replace
from functools import partial

import pytest
from imgui_bundle import imgui

from playground.gui import sheets
from playground.gui.panels.view import SHADING_KEYS
from playground.gui.shortcuts import ACTIONS, MENUS, keys_of

MODIFIERS = (("Ctrl", imgui.Key.mod_ctrl.value), ("Shift", imgui.Key.mod_shift.value))
SIGNS = {
    "equal": "+",
    "keypad_add": "+",
    "minus": "-",
    "keypad_subtract": "-",
    "page_up": "Page Up",
    "page_down": "Page Down",
    "escape": "Esc",
    "named_key_begin": "Tab",  # the first of all keys has two names
}


def spoken(chord):
    """How a chord is written: "Ctrl+Shift+S", "?", "Page Up"."""
    names = [name for name, bit in MODIFIERS if chord & bit]
    key = imgui.Key(chord & ~imgui.Key.mod_mask_.value).name
    if key == "slash" and names == ["Shift"]:
        return "?"
    if SIGNS.get(key) == "+" and "Shift" in names:  # where + is above another key
        names.remove("Shift")
    digit = re.fullmatch(r"(_|keypad)(\d)", key)
    name = digit[2] if digit else SIGNS.get(key, key.removesuffix("_arrow").title())
    return "+".join([*names, name])


def written(keys):
    """The chords that a line of the sheet names."""
    return {key.replace("Ctrl ", "Ctrl+") for key in keys.split(" or ")}


@pytest.mark.parametrize("action", ACTIONS, ids=lambda action: f"{action.menu}: {action.name}")
def test_the_sheet_names_every_chord_of_an_action(action):
    assert {spoken(chord) for chord in action.chords} == written(action.keys)
    assert action.menu in MENUS


def test_the_keys_of_the_camera_and_of_the_shading_are_what_people_expect():
    expected = {
        "Frame the objects": "F",
        "flat": "Shift+F",
        "per-vertex": "V or G",
        "per-fragment": "P",
        "Nearer": "Page Up or +",
        "Farther": "Page Down or -",
        "Orbit left": "Left",
        "Orbit up": "Up",
        "Move left": "Shift+Left",
    }
    assert {name: keys_of(name) for name in expected} == expected
    assert SHADING_KEYS.splitlines() == ["flat: Shift+F", "per-vertex: V or G", "per-fragment: P"]


@pytest.mark.gl
def test_every_action_is_a_line_of_the_sheet(hands, monkeypatch):
    said = []

    def told(do, words):
        said.append(words)
        do(words)

    for name in ("text", "text_unformatted", "text_disabled"):
        monkeypatch.setattr(sheets.imgui, name, partial(told, getattr(imgui, name)))
    hands.key("slash", "shift")
    assert hands.state.sheet == "shortcuts"
    for action in ACTIONS:
        assert action.name in said and action.keys in said, action
    for deed, way in sheets.MOUSE:
        assert deed in said and way in said


@pytest.mark.gl
@pytest.mark.parametrize("text_size", [1.0, 1.25, 1.28])  # at last as in a window 1000 wide
def test_the_sheet_is_seen_whole(hands, text_size):
    hands.window.state = replace(hands.state, text_size=text_size)
    hands.key("slash", "shift")
    sheet = imgui.internal.find_window_by_name("Keys and mouse###sheet")
    assert (sheet.scroll_max.x, sheet.scroll_max.y) == (0.0, 0.0)
    inner = sheet.inner_clip_rect.max.x - sheet.inner_clip_rect.min.x
    assert sheet.content_size_ideal.x <= inner


@pytest.mark.gl
@pytest.mark.parametrize(
    ("key", "modifiers", "changes"),
    [
        ("f", (), "camera"),
        ("f", ("shift",), "shading"),
        ("g", (), "shading"),
        ("page_up", (), "camera"),
        ("page_down", (), "camera"),
        ("equal", (), "camera"),
        ("keypad_subtract", (), "camera"),
        ("left_arrow", (), "camera"),
        ("down_arrow", (), "camera"),
    ],
)
def test_keys_do_what_the_sheet_says(hands, key, modifiers, changes):
    hands.load("teapot", eye=(0.3, 1.0, 9.0))
    before = hands.state.setup
    hands.key(key, *modifiers)
    after = hands.state.setup
    assert (after.camera != before.camera) == (changes == "camera")
    assert (after.settings.shading != before.settings.shading) == (changes == "shading")
    far = [abs(s.camera.eye[2] - s.camera.target[2]) for s in (before, after)]
    if key in ("page_up", "equal"):
        assert far[1] < far[0]
    if key in ("page_down", "keypad_subtract"):
        assert far[1] > far[0]
