"""The menu bar: the library of setups, and the table of actions."""

from __future__ import annotations

from functools import lru_cache

from imgui_bundle import imgui

from playground.errors import PlaygroundError
from playground.gui.action import Action
from playground.gui.actions import open_setup
from playground.gui.lesson.lesson_course import open_lesson
from playground.gui.shortcuts import ACTIONS, MENUS
from playground.gui.state import State
from playground.lesson.library import lessons
from playground.lesson.page import listed, plural
from playground.lesson.script import read_lesson
from playground.scene.library import library, load


def draw(state: State) -> State:
    """The bar at the top of the window."""
    if not imgui.begin_main_menu_bar():
        return state
    imgui.push_style_var(imgui.StyleVar_.item_spacing, _spacing())
    for i, menu in enumerate(MENUS):
        if i == 1 and imgui.begin_menu("Setups"):
            state = _setups(state)
            imgui.end_menu()
        if imgui.begin_menu(menu):
            for action in ACTIONS:
                if menu == "File" and action.name == "Save setup":
                    state = _recent(state)
                if menu == "Lessons" and action.name == "Go on":
                    state = _lessons(state)
                if action.menu == menu:
                    state = _item(state, action)
            imgui.end_menu()
    imgui.pop_style_var()
    name = state.setup.name
    right = imgui.get_window_width() - imgui.calc_text_size(name).x - 12.0
    if right > imgui.get_cursor_pos_x():
        imgui.set_cursor_pos_x(right)
        imgui.text_disabled(name)
    imgui.end_main_menu_bar()
    return state


def _spacing() -> imgui.ImVec2:
    """The usual spacing, or less of it where large type would push the last menus out of sight."""
    usual = imgui.get_style().item_spacing
    names = (*MENUS, "Setups")
    room = imgui.get_content_region_avail().x
    room -= sum(imgui.calc_text_size(name).x for name in names)
    return imgui.ImVec2(max(min(usual.x, 0.5 * room / len(names)), 1.0), usual.y)


def _item(state: State, action: Action) -> State:
    on = action.on is not None and action.on(state)
    chosen = imgui.menu_item_simple(action.name, action.keys, on)
    return action.do(state) if chosen else state


def _recent(state: State) -> State:
    if imgui.begin_menu("Open recent", bool(state.recent)):
        for name in state.recent:
            if imgui.menu_item_simple(name):
                state = open_setup(state, name)
        imgui.end_menu()
    return state


def _setups(state: State) -> State:
    for name, title in _library():
        if imgui.menu_item_simple(name, title, selected=name == state.loaded.name):
            state = open_setup(state, name)
    return state


def _lessons(state: State) -> State:
    """The lessons that come with the project: number, title, slides."""
    for name, title, slides in _taught():
        if imgui.menu_item_simple(f"{name}  {title}", slides):
            state = open_lesson(state, name)
    imgui.separator()
    return state


@lru_cache(maxsize=1)
def _taught() -> tuple[tuple[str, str, str], ...]:
    """Number, title and slides of every lesson; of a wrong one, what is wrong."""
    found = []
    for path in lessons():
        number = str(int(path.stem[:2]))
        try:
            lesson = read_lesson(path)
            slides = lesson.slides
            words = f"{plural('slide', len(slides))} {listed(slides)}" if slides else ""
            found.append((number, lesson.title, words))
        except PlaygroundError as error:
            found.append((number, str(error), ""))
    return tuple(found)


@lru_cache(maxsize=1)
def _library() -> tuple[tuple[str, str], ...]:
    """Name and title of every setup that comes with the project."""
    found = []
    for name in library():
        try:
            found.append((name, load(name).scene.title))
        except PlaygroundError as error:
            found.append((name, str(error)))
    return tuple(found)
