"""Sheets that lie over the window: the keys, and the choice of a file."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from imgui_bundle import imgui

from playground.gui import save_sheet
from playground.gui.actions import open_setup
from playground.gui.shortcuts import ACTIONS, MENUS
from playground.gui.state import State
from playground.scene.scene import MESH_FILES

MOUSE = (
    ("why this colour?", "click, or Shift and move"),
    ("forget that", "right click"),
    ("orbit", "drag"),
    ("pan", "right or Shift drag, Shift wheel"),
    ("nearer, farther", "wheel"),
    ("type a value", "Ctrl-click"),
    ("default value", "right-click"),
    ("open a file", "drop it here"),
)
COLUMNS = 3  # of the sheet of keys, where there is room
KINDS = (".toml", ".png", *MESH_FILES)
TITLES = {
    "shortcuts": "Keys and mouse",
    "open": "Open a setup, a model or a picture",
    "save": "Save the setup as",
}


def draw(state: State) -> State:
    """The sheet that is asked for, in the middle of the window."""
    if not state.sheet:
        return state
    size, middle = imgui.get_font_size(), imgui.get_main_viewport().get_center()
    imgui.set_next_window_pos(middle, imgui.Cond_.always, imgui.ImVec2(0.5, 0.5))
    view = imgui.get_main_viewport().work_size
    wide = (84 if state.sheet == "shortcuts" else 42) * size
    high = {"shortcuts": 40, "save": 7}.get(state.sheet, 30) * size
    room = imgui.ImVec2(min(wide, view.x - 2 * size), min(high, view.y - 2 * size))
    imgui.set_next_window_size(room)
    flags = imgui.WindowFlags_.no_resize.value | imgui.WindowFlags_.no_collapse.value
    unfolded, stays = imgui.begin(f"{TITLES[state.sheet]}###sheet", True, flags)
    if unfolded:
        state = SHEETS[state.sheet](state)
    imgui.end()
    escape = imgui.is_key_pressed(imgui.Key.escape)
    return replace(state, sheet="") if escape or not stays else state


def _keys(state: State) -> State:
    """Columns of tables, one table per menu."""
    count = COLUMNS if imgui.get_window_width() > 65 * imgui.get_font_size() else 2
    imgui.columns(count, "keys", False)
    groups = [(menu, [(a.name, a.keys) for a in ACTIONS if a.menu == menu]) for menu in MENUS]
    groups.append(("Mouse", list(MOUSE)))
    share = sum(len(lines) + 2 for _, lines in groups) / count
    so_far = column = 0
    for title, lines in groups:
        if so_far + (len(lines) + 2) / 2 > share * (column + 1) and column + 1 < count:
            imgui.next_column()
            column += 1
        so_far += len(lines) + 2
        imgui.text_disabled(title)
        for name, keys in lines:
            imgui.text(name)
            imgui.same_line(14.5 * imgui.get_font_size())
            imgui.text_unformatted(keys)
        imgui.spacing()
    imgui.columns(1)
    return state


def _open(state: State) -> State:
    """A field for a path, and the folder it names as a list to click."""
    folder = folder_of(state.typed)
    if imgui.is_window_appearing():
        imgui.set_keyboard_focus_here()
    imgui.set_next_item_width(-6 * imgui.get_font_size())
    flags = imgui.InputTextFlags_.enter_returns_true.value
    entered, typed = imgui.input_text_with_hint("##path", f"{folder}/...", state.typed, flags)
    state = replace(state, typed=typed)
    imgui.same_line()
    if imgui.button("Open", imgui.ImVec2(-1, 0)) or entered:
        return _chosen(state, Path(state.typed).expanduser())
    if imgui.begin_child("files"):
        for path in entries(folder):
            name = f"{path.name}/" if path.is_dir() else path.name
            if path == folder.parent:
                name = "../"
            if imgui.selectable(name, False)[0]:
                state = _chosen(state, path)
    imgui.end_child()
    return state


def _chosen(state: State, path: Path) -> State:
    """Go into a folder, or open a file and take the sheet away if it opened."""
    if path.is_dir():
        return replace(state, typed=f"{path.resolve()}/".replace("//", "/"))
    opened = open_setup(state, path)
    return opened if opened.failed else replace(opened, typed="")


def folder_of(typed: str) -> Path:
    """The folder whose content is listed: that of the path being typed, or the current one."""
    path = Path(typed).expanduser()
    folder = path if path.is_dir() else path.parent
    return (folder if folder.is_dir() else Path()).resolve()


def entries(folder: Path) -> list[Path]:
    """The folder above, the folders within, the files that can be opened."""
    try:
        inside = [path for path in folder.iterdir() if not path.name.startswith(".")]
        folders = sorted(path for path in inside if path.is_dir())
        files = sorted(path for path in inside if path.suffix.lower() in KINDS)
    except OSError:
        folders, files = [], []
    above = [folder.parent] if folder.parent != folder else []
    return [*above, *folders, *files]


SHEETS = {"shortcuts": _keys, "open": _open, "save": save_sheet.draw}
