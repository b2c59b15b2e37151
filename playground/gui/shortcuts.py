"""Every action once: its name, key, menu, and what it does.

Keys, menus and the help sheet all follow from this table.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from imgui_bundle import imgui

from playground.gui import actions
from playground.gui.navigation import NOTCH, STEP, closer, turned
from playground.gui.state import State
from playground.scene.settings import TERMS, Shading

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


def _term(term: str) -> Action:
    letter = term[0]
    do = partial(actions.toggle_term, term=term)
    return Action("Shading", f"{term} on or off", letter.upper(), (_key(letter),), do)


def _mode(number: int, mode: str) -> Action:
    do = partial(actions.shade, mode=mode)
    keys = (_key(f"_{number}"), _key(f"keypad{number}"))
    return Action("Shading", mode, str(number), keys, do)


def _walk(name: str, arrow: str, yaw: float, pitch: float) -> Action:
    do = partial(turned, yaw=yaw, pitch=pitch)
    return Action("Camera", name, arrow.title(), (_key(f"{arrow}_arrow"),), do, repeats=True)


ACTIONS: tuple[Action, ...] = (
    Action(
        "File", "Open...", "Ctrl+O", (_key("o", CTRL),), partial(actions.show_sheet, sheet="open")
    ),
    Action("File", "Save setup", "Ctrl+S", (_key("s", CTRL),), actions.save_setup),
    Action("File", "Save picture", "P", (_key("p"),), actions.take_picture),
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
    *(_mode(i + 1, mode.value) for i, mode in enumerate(Shading)),
    *(_term(term) for term in TERMS),
    Action("Camera", "Frame the objects", "F", (_key("f"),), actions.frame_objects),
    Action("Camera", "Walk around, or stop", "Space", (_key("space"),), actions.play),
    _walk("Left", "left", -STEP, 0.0),
    _walk("Right", "right", STEP, 0.0),
    _walk("Up", "up", 0.0, STEP),
    _walk("Down", "down", 0.0, -STEP),
    Action(
        "Camera",
        "Nearer",
        "Page Up",
        (_key("page_up"),),
        partial(closer, factor=NOTCH),
        repeats=True,
    ),
    Action(
        "Camera",
        "Farther",
        "Page Down",
        (_key("page_down"),),
        partial(closer, factor=1.0 / NOTCH),
        repeats=True,
    ),
    Action("Window", "Compare: next layout", "C", (_key("c"),), actions.next_layout),
    Action("Window", "Show or hide the controls", "H", (_key("h"),), actions.toggle_panel),
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
    """What the keys of this frame do; nothing while a text field or a sheet has them."""
    if imgui.get_io().want_text_input:
        return state
    for action in ACTIONS:
        if any(_hit(chord, action.repeats) for chord in action.chords):
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
