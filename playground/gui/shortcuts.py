"""Every action once: its name, key, menu, and what it does.

Keys, menus and the help sheet all follow from this table.
"""

from __future__ import annotations

from functools import cache, partial

from imgui_bundle import imgui

from playground.gui import actions, presentation
from playground.gui.action import Action, key
from playground.gui.lesson import lesson_course
from playground.gui.picture.navigation import NOTCH, SHIFT_STEP, STEP, closer, shifted, turned
from playground.gui.picture.pixel_pick import forget
from playground.gui.picture.stand import stepped
from playground.gui.radiosity import radiosity_keys
from playground.gui.state import TRACED, State
from playground.scene.settings import TERMS, Shading

FUNCTION_KEYS = range(imgui.Key.f1.value, imgui.Key.f12.value + 1)  # nobody types with them
CTRL, SHIFT = imgui.Key.mod_ctrl.value, imgui.Key.mod_shift.value
ESCAPE = imgui.Key.escape.value


def _term(number: int, term: str) -> Action:
    letter, do = term[0], partial(actions.toggle_term, term=term)
    keys = (key(f"_{number}"), key(f"keypad{number}"), key(letter))
    name, on = f"{term} on or off", partial(_adds, term=term)
    return Action("Shading", name, f"{number} or {letter.upper()}", keys, do, on=on)


def _mode(mode: str, keys: str, *chords: int) -> Action:
    do, on = partial(actions.shade, mode=mode), partial(_shaded, mode=mode)
    return Action("Shading", mode, keys, chords, do, on=on)


def _adds(state: State, term: str) -> bool:
    return term in state.setup.settings.terms


def _shaded(state: State, mode: str) -> bool:
    return bool(state.mode == mode)


def _walk(name: str, arrow: str, yaw: float, pitch: float) -> Action:
    do = partial(turned, yaw=yaw, pitch=pitch)
    return Action("Camera", name, arrow.title(), (key(f"{arrow}_arrow"),), do, repeats=True)


def _overlay(name: str, letter: str, knob: str) -> Action:
    do = partial(actions.toggle_overlay, name=knob)
    on = partial(_lies_over, name=knob)
    return Action("Picture", name, letter.upper(), (key(letter),), do, on=on)


def _lies_over(state: State, name: str) -> bool:
    return bool(getattr(state.overlays, name))


def _shift(name: str, arrow: str, right: float, up: float) -> Action:
    do = partial(shifted, right=right, up=up)
    chord = key(f"{arrow}_arrow", SHIFT)
    return Action("Camera", name, f"Shift+{arrow.title()}", (chord,), do, repeats=True)


ACTIONS: tuple[Action, ...] = (
    Action(
        "File", "Open...", "Ctrl+O", (key("o", CTRL),), partial(actions.show_sheet, sheet="open")
    ),
    Action("File", "Save setup", "Ctrl+S", (key("s", CTRL),), actions.save_setup),
    Action("File", "Save as...", "Ctrl+Shift+S", (key("s", CTRL | SHIFT),), actions.name_to_save),
    Action("File", "Save picture", "F12", (key("f12"),), actions.take_picture),
    Action(
        "File",
        "Copy as command line",
        "Ctrl+Shift+C",
        (key("c", CTRL | SHIFT),),
        actions.copy_command,
    ),
    Action("File", "Quit", "Ctrl+Q", (key("q", CTRL),), actions.quit_window),
    Action("Edit", "Undo", "Ctrl+Z", (key("z", CTRL),), actions.undo, repeats=True),
    Action(
        "Edit",
        "Redo",
        "Ctrl+Y or Ctrl+Shift+Z",
        (key("y", CTRL), key("z", CTRL | SHIFT)),
        actions.redo,
        repeats=True,
    ),
    Action("Edit", "Reset to the loaded setup", "R", (key("r"),), actions.reset),
    _mode(Shading.FLAT.value, "Shift+F", key("f", SHIFT)),
    _mode(Shading.PER_VERTEX.value, "V or G", key("v"), key("g")),
    _mode(Shading.PER_FRAGMENT.value, "P", key("p")),
    Action(
        "Shading",
        "Ray tracing, or back",
        "Y",
        (key("y"),),
        actions.toggle_tracing,
        on=lambda state: state.method == TRACED,
    ),
    *radiosity_keys.METHODS,
    *(_term(i, term) for i, term in enumerate(TERMS, 1)),
    *radiosity_keys.SOLVER,
    Action("Lessons", "Go on", "Page Down", (key("page_down"),), lesson_course.go_on),
    Action("Lessons", "Back", "Page Up", (key("page_up"),), lesson_course.go_back),
    Action("Lessons", "Close the lesson", "Ctrl+L", (key("l", CTRL),), lesson_course.close_lesson),
    Action("Camera", "Frame the objects", "F", (key("f"),), actions.frame_objects),
    Action(
        "Camera",
        "Walk around, or stop",
        "Space",
        (key("space"),),
        actions.play,
        on=lambda state: state.playing,
    ),
    Action("Camera", "Arrows from the side, or back", "O", (key("o"),), stepped),
    _walk("Orbit left", "left", -STEP, 0.0),
    _walk("Orbit right", "right", STEP, 0.0),
    _walk("Orbit up", "up", 0.0, STEP),
    _walk("Orbit down", "down", 0.0, -STEP),
    _shift("Move left", "left", -SHIFT_STEP, 0.0),
    _shift("Move right", "right", SHIFT_STEP, 0.0),
    _shift("Move up", "up", 0.0, SHIFT_STEP),
    _shift("Move down", "down", 0.0, -SHIFT_STEP),
    Action(
        "Camera",
        "Nearer",
        "Page Up or +",
        (key("page_up"), key("equal"), key("equal", SHIFT), key("keypad_add")),
        partial(closer, factor=NOTCH),
        repeats=True,
    ),
    Action(
        "Camera",
        "Farther",
        "Page Down or -",
        (key("page_down"), key("minus"), key("keypad_subtract")),
        partial(closer, factor=1.0 / NOTCH),
        repeats=True,
    ),
    Action(
        "Window",
        "Compare: next layout",
        "Tab or C",
        (key("tab"), key("c")),
        actions.next_layout,
    ),
    Action(
        "Window",
        "Presentation: black, white",
        "F5",
        (key("f5"),),
        presentation.next_presentation,
    ),
    Action("Window", "Full screen, or back", "F11", (key("f11"),), actions.toggle_full_screen),
    Action("Window", "Beginner or full layout", "B", (key("b"),), presentation.next_level),
    Action(
        "Window",
        "Show or hide the controls",
        "H",
        (key("h"),),
        actions.toggle_panel,
        on=lambda state: state.panel,
    ),
    Action(
        "Window",
        "Shaders, to read and edit",
        "F4",
        (key("f4"),),
        actions.toggle_shaders,
        on=lambda state: state.shaders,
    ),
    _overlay("Wireframe", "w", "wireframe"),
    _overlay("Normals", "n", "vertex_normals"),
    _overlay("Axes", "x", "axes"),
    _overlay("Handles of the lights", "l", "move_lights"),
    _overlay("Handles of the object", "m", "move_object"),
    Action("Window", "Dark or light", "T", (key("t"),), actions.toggle_theme),
    Action(
        "Window",
        "Larger text",
        "Ctrl +",
        (key("equal", CTRL), key("equal", CTRL | SHIFT), key("keypad_add", CTRL)),
        actions.larger_text,
    ),
    Action(
        "Window",
        "Smaller text",
        "Ctrl -",
        (key("minus", CTRL), key("keypad_subtract", CTRL)),
        actions.smaller_text,
    ),
    Action("Window", "Usual text", "Ctrl 0", (key("_0", CTRL),), actions.usual_text),
    Action("Window", "Forget the explained pixel", "Esc", (key("escape"),), forget),
    Action("Window", "End the presentation", "Esc", (key("escape"),), presentation.ended),
    Action(
        "Help",
        "Keys",
        "F1 or ?",
        (key("f1"), key("slash", SHIFT)),
        partial(actions.show_sheet, sheet="shortcuts"),
    ),
)

MENUS = tuple(dict.fromkeys(action.menu for action in ACTIONS))


def keys_of(name: str) -> str:
    """The keys of an action, for tooltips."""
    return next(action.keys for action in ACTIONS if action.name == name)


def pressed(state: State) -> State:
    """What the keys of this frame do, but for those that a text field, a menu or a sheet has.

    A key does one thing: Esc forgets the pixel, and only if there is none ends the presentation.
    """
    typing, done = imgui.get_io().want_text_input, set[int]()
    if _hit(ESCAPE, False) and _menu_closed():
        return state
    for action in ACTIONS:
        chords = [c for c in action.chords if not typing or c in FUNCTION_KEYS]
        hit = {chord for chord in chords if chord not in done and _hit(chord, action.repeats)}
        if hit and (not state.sheet or action.menu == "Help"):
            before, state = state, action.do(state)
            done |= hit if state is not before else set()
    return state


def _menu_closed() -> bool:
    """Close an open menu or list; Dear ImGui does so for its keyboard navigation alone."""
    popup = imgui.PopupFlags_
    if not imgui.is_popup_open("", popup.any_popup_id.value | popup.any_popup_level.value):
        return False
    imgui.internal.close_popup_to_level(0, True)
    return True


def _hit(chord: int, repeats: bool) -> bool:
    key, modifiers = _parts(chord)
    return bool(imgui.is_key_pressed(key, repeats)) and _modifiers() == modifiers


@cache
def _parts(chord: int) -> tuple[imgui.Key, int]:
    """The key and the modifiers of a chord."""
    modifiers = imgui.Key.mod_mask_.value
    return imgui.Key(chord & ~modifiers), chord & modifiers


def _modifiers() -> int:
    """The modifiers of this frame; one let go within it still counts for the keys in it."""
    keys = imgui.Key
    held = int(imgui.get_io().key_mods)
    for modifier in (keys.mod_ctrl, keys.mod_shift, keys.mod_alt, keys.mod_super):
        held |= modifier.value if imgui.is_key_released(modifier) else 0
    return held
