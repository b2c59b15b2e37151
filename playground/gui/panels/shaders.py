"""The shaders below the picture: the files that run, their twins, and where the call stands."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from imgui_bundle import imgui

from playground.gui.actions import shade
from playground.gui.shader import shader_edit as code
from playground.gui.shader.code_box import Mark, code_box
from playground.gui.shader.twins import first_shared, shown_name, twin_of, twin_text
from playground.gui.widget.theme import PALETTES
from playground.gui.widgets import Ui, bare
from playground.scene.knob import knobs
from playground.scene.settings import Shading

if TYPE_CHECKING:
    from playground.gui.state import State

NARROW = 36  # heights of the text: below, there is no room for a twin
EDGE = 5  # pixels that drag the height, at text size 1
PLACES = {  # where the model is called, and how often
    Shading.FLAT.value: ("flat.vert", "once per triangle"),
    Shading.PER_VERTEX.value: ("gouraud.vert", "once per vertex"),
    Shading.PER_FRAGMENT.value: ("phong.frag", "once per fragment"),
}


def height(state: State, room: int) -> int:
    """How much of ``room`` the shaders take."""
    return round(state.shaders_share * room) if state.shaders else 0


def draw(state: State, ui: Ui) -> State:
    """Fill the current ImGui window."""
    state = _edge(state, ui)
    at, size = imgui.get_cursor_pos(), imgui.get_font_size()
    imgui.set_cursor_pos_x(imgui.get_window_width() - 2.5 * size)
    if imgui.button("×"):
        state = replace(state, shaders=False)
    imgui.set_item_tooltip("close the shaders (F4); edits stay until they are reverted")
    imgui.set_cursor_pos(at)
    state = _bar(state)
    if state.shader_error:
        state = _error(state)
    if state.code_view == "files":
        return _files(state)
    return _move(state)


def _edge(state: State, ui: Ui) -> State:
    """The upper edge, which can be dragged."""
    at = imgui.get_cursor_pos()
    imgui.set_cursor_pos(imgui.ImVec2(0, 0))
    imgui.invisible_button("edge", imgui.ImVec2(imgui.get_window_width(), EDGE * ui.scale))
    if imgui.is_item_hovered() or imgui.is_item_active():
        imgui.set_mouse_cursor(imgui.MouseCursor_.resize_ns)
    if imgui.is_item_active() and imgui.is_mouse_dragging(0, 0.0):
        high = imgui.get_window_height()
        bottom = imgui.get_window_pos().y + high
        share = state.shaders_share * (bottom - imgui.get_io().mouse_pos.y) / max(high, 1.0)
        state = replace(state, shaders_share=min(max(share, 0.2), 0.8))
    imgui.set_cursor_pos(at)
    return state


def _bar(state: State) -> State:
    """What is shown, the language beside it, revert, close."""
    known = knobs(type(state))
    size = imgui.get_font_size()
    shown = bare(known["code_view"], "code_view", state.code_view)
    state = state if shown == state.code_view else replace(state, code_view=shown)
    if state.code_view == "files":
        _beside(7 * size)
        imgui.set_next_item_width(6 * size)
        choices = known["twin"].choices
        _, index = imgui.combo("##twin", choices.index(state.twin), list(choices))
        imgui.set_item_tooltip(known["twin"].help)
        state = state if choices[index] == state.twin else replace(state, twin=choices[index])
    for file in (state.code_file, None) if state.code_view == "files" else (None,):
        _beside(7 * size)
        imgui.begin_disabled(file not in dict(state.edits) if file else not state.edits)
        if imgui.button("Revert file" if file else "Revert all"):
            state = code.reverted(state, file)
        imgui.set_item_tooltip("back to what stands on disk; edits here are never written there")
        imgui.end_disabled()
    return state


def _beside(wide: float) -> None:
    """Go on in the same row, or in the next where no room for so much is left."""
    imgui.same_line()
    if imgui.get_content_region_avail().x < wide:
        imgui.new_line()


def _error(state: State) -> State:
    """What the compiler says, in the first line of it; a click leads there."""
    colour = PALETTES[state.theme].alarm
    imgui.push_style_color(imgui.Col_.text, (*colour, 1.0))
    line = state.shader_error.splitlines()[0]
    if imgui.selectable(f"{line}###error", False)[0]:
        file = code.first_place(state.shader_error)
        if file:
            state = replace(state, code_file=file, code_view="files")
            code_box("file", file).scroll_to(code.errors_in(state.shader_error, file)[0][0])
    imgui.pop_style_color()
    said = state.shader_error.replace("%", "%%")
    imgui.set_item_tooltip(f"{said}\nThe picture shows the last shaders that compiled.")
    return state


def _files(state: State) -> State:
    """A tab per file of the chosen object's program, and its text."""
    files = code.running(state)
    if not files:
        imgui.text_disabled("nothing is drawn, so no shader runs")
        return state
    file = state.code_file if state.code_file in files else files[0]
    rows = _rows(files)
    if sum(name.startswith("\n") for name in rows) > 2:  # too narrow for tabs
        imgui.set_next_item_width(-1)
        _, index = imgui.combo("##file", files.index(file), list(files))
        file, rows = files[index], []
    for i, name in enumerate(rows):
        if i and not name.startswith("\n"):
            imgui.same_line()
        name = name.strip()
        edited = name in dict(state.edits)
        wrong = bool(code.errors_in(state.shader_error, name))
        sign = f"{'! ' if wrong else ''}{name}{' *' if edited else ''}"
        if _tab(f"{sign}###{name}", name == file):
            file = name
    state = state if file == state.code_file else replace(state, code_file=file)
    return _text_and_twin(state, file)


def _tab(label: str, on: bool) -> bool:
    """A button that looks pressed where its file is shown."""
    shade = imgui.Col_.button_active if on else imgui.Col_.button
    imgui.push_style_color(imgui.Col_.button, imgui.get_style_color_vec4(shade))
    clicked = imgui.small_button(label)
    imgui.pop_style_color()
    return bool(clicked)


def _rows(files: tuple[str, ...]) -> list[str]:
    """The names, with a line break before each that has no room left in its row."""
    style, room = imgui.get_style(), imgui.get_content_region_avail().x
    names, x = [], 0.0
    for file in files:
        wide = imgui.calc_text_size(f"! {file} *").x + 2 * style.frame_padding.x
        x += wide + style.item_spacing.x
        names.append(f"\n{file}" if x > room else file)
        x = wide + style.item_spacing.x if x > room else x
    return names


def _text_and_twin(state: State, file: str) -> State:
    space = imgui.get_content_region_avail()
    gap = imgui.get_style().item_spacing.x
    alone = state.twin == "none" or space.x < NARROW * imgui.get_font_size()
    half = space.x if alone else (space.x - gap) / 2
    imgui.begin_group()
    text = code.text_of(state, file)
    state = _caption_and_box(state, f"shaders/{file}", file, text, half)
    imgui.end_group()
    if alone:
        return state
    imgui.same_line()
    imgui.begin_group()
    path = twin_of(file, state.twin)
    if path is None:
        imgui.text_disabled(f"{file} has no twin in {state.twin}")
    else:
        imgui.text_disabled(shown_name(path))
        box = code_box(f"twin of {file}", shown_name(path)).read_only()
        box.lead_to(first_shared(text, twin_text(path)))
        box.draw("##twin code", twin_text(path), (), state.theme, imgui.ImVec2(0, 0))
    imgui.end_group()
    return state


def _caption_and_box(state: State, caption: str, file: str, text: str, wide: float) -> State:
    """The editor of a file below its name."""
    edited = file in dict(state.edits)
    imgui.text_disabled(f"{caption}{'  edited, not written to disk' if edited else ''}")
    marks = _marks(state, file, text)
    box = code_box("file", file)
    typed = box.draw("##file", text, marks, state.theme, imgui.ImVec2(wide, 0))
    return code.edited(state, file, typed) if typed != text else state


def _marks(state: State, file: str, text: str) -> tuple[Mark, ...]:
    """Errors, includes, and the call of the model where it runs."""
    includes = [Mark(i, "include", f"shaders/{f} is read here") for i, f in code.includes(text)]
    errors = [Mark(i, "error", why) for i, why in code.errors_in(state.shader_error, file)]
    place, often = PLACES[state.setup.settings.shading]
    here = [Mark(i, "here", f"the model is evaluated here, {often}") for i in code.calls(text)]
    taken = {mark.line for mark in errors}
    marks = [*includes, *(here if file == place else [])]
    return (*errors, *(mark for mark in marks if mark.line not in taken))


def _move(state: State) -> State:
    """Two stages side by side: the call is marked in the one where it runs."""
    mode = state.setup.settings.shading
    left = Shading.FLAT.value if mode == Shading.FLAT else Shading.PER_VERTEX.value
    space, gap = imgui.get_content_region_avail(), imgui.get_style().item_spacing.x
    for i, side in enumerate((left, Shading.PER_FRAGMENT.value)):
        file, often = PLACES[side]
        if i:
            imgui.same_line()
        imgui.push_id(side)
        imgui.begin_group()
        if imgui.radio_button(f"{file}: the model {often}", mode == side):
            state = shade(state, side)
        imgui.set_item_tooltip(f"{side}: let the call of the model stand here")
        text = code.text_of(state, file)
        box = code_box(f"move {i}", file)
        box.lead_to(code.calls(text)[:1])
        wide = imgui.ImVec2((space.x - gap) / 2, 0)
        typed = box.draw("##move", text, _marks(state, file, text), state.theme, wide)
        state = code.edited(state, file, typed) if typed != text else state
        imgui.end_group()
        imgui.pop_id()
    return state
