"""Every action once: its name, key, menu, and what it does.

Keys, menus and the help sheet all follow from this table.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from imgui_bundle import imgui

from playground.gui import actions, presentation
from playground.gui.navigation import NOTCH, SHIFT_STEP, STEP, closer, shifted, turned
from playground.gui.pixel_pick import forget
from playground.gui.state import State
from playground.scene.settings import TERMS, Shading

FUNCTION_KEYS = range(imgui.Key.f1.value, imgui.Key.f12.value + 1)  # nobody types with them
CTRL, SHIFT = imgui.Key.mod_ctrl.value, imgui.Key.mod_shift.value


@dataclass(frozen=True)
class Action:
    """One thing that can be done.

    ``chords`` are ImGui key chords, the first of which is written as ``keys``.
    ``repeats`` says that holding the key repeats it.
    """

    menu: str
    name: str
    keys: str
    chords: tuple[int, ...]
    do: Callable[[State], State]
    repeats: bool = False


def _key(name: str, modifiers: int = 0) -> int:
    return int(getattr(imgui.Key, name).value) | modifiers


def _term(number: int, term: str) -> Action:
    letter, do = term[0], partial(actions.toggle_term, term=term)
    keys = (_key(f"_{number}"), _key(f"keypad{number}"), _key(letter))
    return Action("Shading", f"{term} on or off", f"{number} or {letter.upper()}", keys, do)


def _mode(mode: str, keys: str, *chords: int) -> Action:
    return Action("Shading", mode, keys, chords, partial(actions.shade, mode=mode))


def _walk(name: str, arrow: str, yaw: float, pitch: float) -> Action:
    do = partial(turned, yaw=yaw, pitch=pitch)
    return Action("Camera", name, arrow.title(), (_key(f"{arrow}_arrow"),), do, repeats=True)


def _overlay(name: str, letter: str, knob: str) -> Action:
    do = partial(actions.toggle_overlay, name=knob)
    return Action("Picture", name, letter.upper(), (_key(letter),), do)


def _shift(name: str, arrow: str, right: float, up: float) -> Action:
    do = partial(shifted, right=right, up=up)
    chord = _key(f"{arrow}_arrow", SHIFT)
    return Action("Camera", name, f"Shift+{arrow.title()}", (chord,), do, repeats=True)


ACTIONS: tuple[Action, ...] = (
    Action(
        "File", "Open...", "Ctrl+O", (_key("o", CTRL),), partial(actions.show_sheet, sheet="open")
    ),
    Action("File", "Save setup", "Ctrl+S", (_key("s", CTRL),), actions.save_setup),
    Action("File", "Save as...", "Ctrl+Shift+S", (_key("s", CTRL | SHIFT),), actions.name_to_save),
    Action("File", "Save picture", "F12", (_key("f12"),), actions.take_picture),
    Action(
        "File",
        "Copy as command line",
        "Ctrl+Shift+C",
        (_key("c", CTRL | SHIFT),),
        actions.copy_command,
    ),
    Action("File", "Quit", "Ctrl+Q", (_key("q", CTRL),), actions.quit_window),
    Action("Edit", "Undo", "Ctrl+Z", (_key("z", CTRL),), actions.undo, repeats=True),
    Action(
        "Edit",
        "Redo",
        "Ctrl+Y",
        (_key("y", CTRL), _key("z", CTRL | SHIFT)),
        actions.redo,
        repeats=True,
    ),
    Action("Edit", "Reset to the loaded setup", "R", (_key("r"),), actions.reset),
    _mode(Shading.FLAT.value, "Shift+F", _key("f", SHIFT)),
    _mode(Shading.PER_VERTEX.value, "V or G", _key("v"), _key("g")),
    _mode(Shading.PER_FRAGMENT.value, "P", _key("p")),
    *(_term(i, term) for i, term in enumerate(TERMS, 1)),
    Action("Camera", "Frame the objects", "F", (_key("f"),), actions.frame_objects),
    Action("Camera", "Walk around, or stop", "Space", (_key("space"),), actions.play),
    _walk("Left", "left", -STEP, 0.0),
    _walk("Right", "right", STEP, 0.0),
    _walk("Up", "up", 0.0, STEP),
    _walk("Down", "down", 0.0, -STEP),
    _shift("Move left", "left", -SHIFT_STEP, 0.0),
    _shift("Move right", "right", SHIFT_STEP, 0.0),
    _shift("Move up", "up", 0.0, SHIFT_STEP),
    _shift("Move down", "down", 0.0, -SHIFT_STEP),
    Action(
        "Camera",
        "Nearer",
        "Page Up or +",
        (_key("page_up"), _key("equal"), _key("equal", SHIFT), _key("keypad_add")),
        partial(closer, factor=NOTCH),
        repeats=True,
    ),
    Action(
        "Camera",
        "Farther",
        "Page Down or -",
        (_key("page_down"), _key("minus"), _key("keypad_subtract")),
        partial(closer, factor=1.0 / NOTCH),
        repeats=True,
    ),
    Action(
        "Window",
        "Compare: next layout",
        "Tab or C",
        (_key("tab"), _key("c")),
        actions.next_layout,
    ),
    Action(
        "Window",
        "Presentation: black, white",
        "F5",
        (_key("f5"),),
        presentation.next_presentation,
    ),
    Action("Window", "End the presentation", "Esc", (_key("escape"),), presentation.ended),
    Action("Window", "Beginner or full layout", "B", (_key("b"),), presentation.next_level),
    Action("Window", "Show or hide the controls", "H", (_key("h"),), actions.toggle_panel),
    Action("Window", "Shaders, to read and edit", "F4", (_key("f4"),), actions.toggle_shaders),
    _overlay("Wireframe", "w", "wireframe"),
    _overlay("Normals", "n", "vertex_normals"),
    _overlay("Axes", "x", "axes"),
    _overlay("Handles of the lights", "l", "move_lights"),
    _overlay("Handles of the object", "m", "move_object"),
    Action("Window", "Dark or light", "T", (_key("t"),), actions.toggle_theme),
    Action(
        "Window",
        "Larger text",
        "Ctrl +",
        (_key("equal", CTRL), _key("equal", CTRL | SHIFT), _key("keypad_add", CTRL)),
        actions.larger_text,
    ),
    Action(
        "Window",
        "Smaller text",
        "Ctrl -",
        (_key("minus", CTRL), _key("keypad_subtract", CTRL)),
        actions.smaller_text,
    ),
    Action("Window", "Usual text", "Ctrl 0", (_key("_0", CTRL),), actions.usual_text),
    Action("Window", "Forget the explained pixel", "Esc", (_key("escape"),), forget),
    Action(
        "Help",
        "Keys",
        "F1 or ?",
        (_key("f1"), _key("slash", SHIFT)),
        partial(actions.show_sheet, sheet="shortcuts"),
    ),
)

MENUS = tuple(dict.fromkeys(action.menu for action in ACTIONS))


def pressed(state: State) -> State:
    """What the keys of this frame do, but for those that a text field or a sheet has."""
    typing = imgui.get_io().want_text_input
    for action in ACTIONS:
        chords = [c for c in action.chords if not typing or c in FUNCTION_KEYS]
        if any(_hit(chord, action.repeats) for chord in chords):
            if state.sheet and action.menu != "Help":
                continue
            state = action.do(state)
    return state


def _hit(chord: int, repeats: bool) -> bool:
    modifiers = imgui.Key.mod_mask_.value
    pressed_now = imgui.is_key_pressed(imgui.Key(chord & ~modifiers), repeats)
    return bool(pressed_now) and _modifiers() == chord & modifiers


def _modifiers() -> int:
    """The modifiers of this frame; one let go within it still counts for the keys in it."""
    keys = imgui.Key
    held = int(imgui.get_io().key_mods)
    for key in (keys.mod_ctrl, keys.mod_shift, keys.mod_alt, keys.mod_super):
        held |= key.value if imgui.is_key_released(key) else 0
    return held
