"""Sheets that lie over the window: the keys, and the choice of a file."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from os.path import expanduser, isdir
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
    ("pan", "right drag, Shift drag"),
    ("pan as well", "Shift wheel"),
    ("nearer, farther", "wheel"),
    ("type a value", "Ctrl+click"),
    ("default value", "right click"),
    ("move a handle", "drag it"),
    ("nearer or farther", "and Shift, or wheel"),
    ("open a file", "drop it here"),
)
COLUMNS = 3  # of the sheet of keys, where there is room
GAP = 0.8  # between them, in heights of the text
Table = tuple[str, list[tuple[str, str]]]  # its title, and what each key does
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
    high = {"shortcuts": 36, "save": 7}.get(state.sheet, 30) * size
    room = imgui.ImVec2(min(wide, view.x - 2 * size), min(high, view.y - 2 * size))
    imgui.set_next_window_size(room)
    flags = imgui.WindowFlags_.no_resize.value | imgui.WindowFlags_.no_collapse.value
    unfolded, stays = imgui.begin(f"{TITLES[state.sheet]}###sheet", True, flags)
    if unfolded:
        state = SHEETS[state.sheet](state)
    imgui.end()
    escape = imgui.is_key_pressed(imgui.Key.escape)
    if stays and not escape:
        return state
    # The folder that was looked into stays; a name to save is not one to open.
    return replace(state, sheet="", typed="" if state.sheet == "save" else state.typed)


def _keys(state: State) -> State:
    """Columns of tables, one table per menu; fewer columns where they would not fit."""
    groups = [(menu, [(a.name, a.keys) for a in ACTIONS if a.menu == menu]) for menu in MENUS]
    groups.append(("Mouse", list(MOUSE)))
    size, room = imgui.get_font_size(), imgui.get_content_region_avail().x
    imgui.push_style_var(imgui.StyleVar_.item_spacing, imgui.ImVec2(GAP * size, 0.12 * size))
    for count in range(COLUMNS, 0, -1):
        columns = _columns(groups, count)
        tabs = [_widest(name for _, lines in column for name, _ in lines) for column in columns]
        ends = [_widest(keys for _, lines in column for _, keys in lines) for column in columns]
        wide = sum(tabs) + sum(ends) + (2 * len(columns) - 1) * GAP * size
        if wide <= room or count == 1:
            break
    for i, (column, tab) in enumerate(zip(columns, tabs, strict=True)):
        if i:
            imgui.same_line(0.0, GAP * size + max(room - wide, 0.0) / count)
        imgui.begin_group()
        _tables(column, tab + GAP * size)
        imgui.end_group()
    imgui.pop_style_var()
    return state


def _columns(groups: list[Table], count: int) -> list[list[Table]]:
    """The tables in columns of about the same height: the highest first, each where room is."""
    heights, columns = [0] * count, [list[Table]() for _ in range(count)]
    for group in sorted(groups, key=lambda group: -len(group[1])):
        column = heights.index(min(heights))
        heights[column] += len(group[1]) + 2
        columns[column].append(group)
    in_order = (sorted(column, key=groups.index) for column in columns)
    return sorted(in_order, key=lambda column: groups.index(column[0]) if column else len(groups))


def _tables(column: list[Table], tab: float) -> None:
    """One table below the other, the keys behind ``tab``."""
    for title, lines in column:
        imgui.text_disabled(title)
        for name, keys in lines:
            imgui.text(name)
            imgui.same_line(tab)
            imgui.text_unformatted(keys)
        imgui.spacing()


def _widest(words: Iterable[str]) -> float:
    return max((float(imgui.calc_text_size(word).x) for word in words), default=0.0)


def _open(state: State) -> State:
    """A field for a path, and the folder it names as a list to click."""
    folder = folder_of(state.typed)
    if imgui.is_window_appearing():
        imgui.set_keyboard_focus_here()
    imgui.set_next_item_width(-6 * imgui.get_font_size())
    flags = imgui.InputTextFlags_.enter_returns_true.value
    entered, typed = imgui.input_text_with_hint("##path", f"{folder}/...", state.typed, flags)
    if entered:
        imgui.set_keyboard_focus_here(-1)  # a folder was entered, or a file not opened: type on
    state = replace(state, typed=typed)
    imgui.same_line()
    if imgui.button("Open", imgui.ImVec2(-1, 0)) or entered:
        return _chosen(state, Path(expanduser(state.typed)))
    if imgui.begin_child("files"):
        found = entries(folder)
        for path in found:
            name = f"{path.name}/" if path.is_dir() else path.name
            if path == folder.parent:
                name = "../"
            if imgui.selectable(name, False)[0]:
                state = _chosen(state, path)
        if not any(path.suffix.lower() in KINDS for path in found):
            imgui.text_disabled(f"no file here that can be opened: {' '.join(KINDS)}")
    imgui.end_child()
    return state


def _chosen(state: State, path: Path) -> State:
    """Go into a folder, or open a file and take the sheet away if it opened."""
    if isdir(path):
        return replace(state, typed=f"{path.resolve()}/".replace("//", "/"))
    opened = open_setup(state, path)
    return opened if opened.failed else replace(opened, typed="")


def folder_of(typed: str) -> Path:
    """The folder whose content is listed: that of the path being typed, or the current one."""
    path = Path(expanduser(typed))
    folder = path if isdir(path) else path.parent
    return (folder if isdir(folder) else Path()).resolve()


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
