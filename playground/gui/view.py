"""The view: the pictures of the layout, their captions, the divider, and the camera's mouse."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from playground.errors import PlaygroundError
from playground.gui import layers
from playground.gui.guess import masked
from playground.gui.lightmap import texel_mark
from playground.gui.picture import difference_view, formulas, pixel_pick
from playground.gui.picture.comparison import Picture, formula_box, pictures
from playground.gui.picture.navigation import navigated
from playground.gui.pixel import arrows
from playground.gui.radiosity import factor_pen, patch_pick, stored_words
from playground.gui.rays import ray_pen
from playground.gui.scene_view import Slots
from playground.gui.shader.shader_edit import overrides
from playground.gui.state import State

GRIP = 9  # pixels to either side of the divider that catch the mouse, at text size 1


def draw(state: State, slots: Slots, scale: float) -> tuple[State, bool]:
    """Fill the current ImGui window; returns the state, and whether the mouse holds the camera."""
    origin, space = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail()
    dense = imgui.get_io().display_framebuffer_scale
    width, height = max(int(space.x * dense.x), 1), max(int(space.y * dense.y), 1)
    state, held = navigated(state, imgui.ImVec2(space.x, space.y))
    pick = patch_pick.picked if state.factors.picking else pixel_pick.picked
    state = pick(state, origin, (width, height))
    state = _divider(state, origin, space, scale) if state.layout == "wipe" else state
    state = layers.held(state, pictures(state, width, height), origin, dense, scale)
    shown = pictures(state, width, height)
    slots.use(*layers.numbers(shown))
    slots.override(overrides(state))
    textures = layers.textures(state, shown, slots)
    if state.layout == "difference":
        shown, textures = difference_view.pictured(state, shown, textures, slots)
    for picture, texture in zip(layers.captioned(shown, slots), textures, strict=True):
        _place(picture, texture.glo, origin, dense, scale)
    layers.draw(state, shown, origin, dense, scale)
    stored_words.draw(shown, slots.stored, origin, dense, state.bake.running)
    if state.layout == "difference":
        state = difference_view.legend(state, slots, origin, space, scale)
    if state.layout == "terms":
        highlight = state.setup.settings.highlight
        formulas.write_sum(highlight, formula_box(width, height), origin, dense, scale)
    if state.layout == "wipe":
        _line(state, origin, space, scale)
    if ray_pen.wanted(state, shown):
        state = ray_pen.draw(state, shown, origin, dense, scale)
    else:
        state = arrows.draw(state, shown, origin, scale)
    factor_pen.draw(state, shown, origin, dense, scale)
    state = texel_mark.draw(state, shown, slots.atlas, origin, dense, scale)
    error = masked(state, slots.shader_error)
    if error != state.shader_error:
        state = replace(state, shader_error=error)
    return state, held


def draw_safely(state: State, good: State, slots: Slots, scale: float) -> tuple[State, bool]:
    """As `draw`; a setup that cannot be drawn gives way to the last good one and a message."""
    try:
        return draw(state, slots, scale)
    except PlaygroundError as error:
        failed = state.with_setup(good.setup).fail(error)
        failed = replace(failed, method=good.method, other=good.other)
        return replace(failed, loaded=good.loaded, file=good.file), False


def _place(
    picture: Picture, texture: int, origin: imgui.ImVec2, dense: imgui.ImVec2, scale: float
) -> None:
    """Show a texture in its box, row 0 on top, and its caption in the corner."""
    x, y, w, h = picture.box
    first, last = picture.part
    low = imgui.ImVec2(origin.x + (x + round(first * w)) / dense.x, origin.y + y / dense.y)
    high = imgui.ImVec2(origin.x + (x + round(last * w)) / dense.x, origin.y + (y + h) / dense.y)
    paint = imgui.get_window_draw_list()
    left, right = round(first * w) / w, round(last * w) / w
    paint.add_image(
        imgui.ImTextureRef(texture), low, high, imgui.ImVec2(left, 0), imgui.ImVec2(right, 1)
    )
    if not picture.caption:
        return
    size = imgui.calc_text_size(picture.caption)
    pad = 5 * scale
    from_right = last == 1.0 and first > 0.0
    start = high.x - size.x - 3 * pad if from_right else low.x + pad
    paint.push_clip_rect(low, high, True)
    _chip(imgui.ImVec2(start, low.y + pad), size, picture.caption, pad)
    paint.pop_clip_rect()


def _chip(at: imgui.ImVec2, size: imgui.ImVec2, text: str, pad: float) -> None:
    """White text on a dark plate: readable over any picture."""
    paint = imgui.get_window_draw_list()
    high = imgui.ImVec2(at.x + size.x + 2 * pad, at.y + size.y + pad)
    paint.add_rect_filled(at, high, imgui.IM_COL32(0, 0, 0, 170), pad)
    white = imgui.IM_COL32(255, 255, 255, 255)
    paint.add_text(imgui.ImVec2(at.x + pad, at.y + pad / 2), white, text)


def _divider(state: State, origin: imgui.ImVec2, space: imgui.ImVec2, scale: float) -> State:
    """The strip that moves the wipe."""
    grip = GRIP * scale
    x = origin.x + state.wipe * space.x
    imgui.set_cursor_screen_pos(imgui.ImVec2(x - grip, origin.y))
    imgui.set_next_item_allow_overlap()  # by handles
    imgui.invisible_button("divider", imgui.ImVec2(2 * grip, max(space.y, 1.0)))
    if imgui.is_item_hovered() or imgui.is_item_active():
        imgui.set_mouse_cursor(imgui.MouseCursor_.resize_ew)
    if imgui.is_item_active() and imgui.is_mouse_dragging(0, 0.0):
        share = (imgui.get_io().mouse_pos.x - origin.x) / max(space.x, 1.0)
        state = replace(state, wipe=min(max(share, 0.0), 1.0))
    return state


def _line(state: State, origin: imgui.ImVec2, space: imgui.ImVec2, scale: float) -> None:
    x = round(origin.x + state.wipe * space.x)
    paint, white = imgui.get_window_draw_list(), imgui.IM_COL32(255, 255, 255, 220)
    paint.add_line(imgui.ImVec2(x, origin.y), imgui.ImVec2(x, origin.y + space.y), white, 2 * scale)
    middle = imgui.ImVec2(x, origin.y + space.y / 2)
    paint.add_circle_filled(middle, 7 * scale, white)
    paint.add_circle(middle, 7 * scale, imgui.IM_COL32(0, 0, 0, 160))
