"""The atlas in its panel: zoomed by the wheel, moved by dragging, its texel under the mouse."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from playground.gui.lightmap.atlas_look import AtlasLook, Spot
from playground.gui.lightmap.atlas_picture import AtlasPicture
from playground.gui.picture.canvas import ink
from playground.gui.state import State
from playground.render.lightmap.lightmap import Lightmap

NOTCH = 1.25  # what one notch of the wheel zooms
LEAST = 7.0  # units: the frame around a texel is never smaller
FRAME = (1.0, 1.0, 1.0)
SHADE = (0.0, 0.0, 0.0)
BEYOND = (1.0, 0.48, 0.0)


def draw(state: State, lightmap: Lightmap, atlas: AtlasPicture) -> State:
    """Show it over the whole width, follow the mouse, and frame the texel that is meant."""
    atlas.seen = True
    wide = max(imgui.get_content_region_avail().x, 16.0)
    at, room = imgui.get_cursor_screen_pos(), imgui.ImVec2(wide, wide)
    if not imgui.is_rect_visible(room):
        imgui.dummy(room)
        return state
    imgui.invisible_button("##atlas", room)
    look = _followed(state.atlas, at, wide, lightmap.size)
    dense = imgui.get_io().display_framebuffer_scale.x
    texture = atlas.texture(lightmap, look, state.setup.settings, max(round(wide * dense), 1))
    paint = imgui.get_window_draw_list()
    high = imgui.ImVec2(at.x + wide, at.y + wide)
    paint.add_image(imgui.ImTextureRef(texture.glo), at, high)
    if look.spot is not None:
        paint.push_clip_rect(at, high, True)
        _framed(look, look.spot, at, wide, lightmap.size)
        paint.pop_clip_rect()
    return state if look is state.atlas else replace(state, atlas=look)


def _followed(look: AtlasLook, at: imgui.ImVec2, wide: float, texels: int) -> AtlasLook:
    """The look after what the mouse does over the last item."""
    io = imgui.get_io()
    x, y = (io.mouse_pos.x - at.x) / wide, (io.mouse_pos.y - at.y) / wide
    if imgui.is_item_active() and imgui.is_mouse_dragging(0, 0.0):
        look = look.moved(io.mouse_delta.x / wide, io.mouse_delta.y / wide)
    over = imgui.is_item_hovered()
    if over:
        imgui.set_item_key_owner(imgui.Key.mouse_wheel_y)  # the panel does not scroll meanwhile
        if io.mouse_wheel:
            look = look.closer(NOTCH**io.mouse_wheel, x, y)
        u, v = look.at(x, y)
        column, row = (min(max(int(share * texels), 0), texels - 1) for share in (u, v))
        spot: Spot | None = Spot(column, row, True)
    elif look.spot is not None and look.spot.in_atlas:
        spot = None
    else:
        return look
    return look if spot == look.spot else replace(look, spot=spot)


def _framed(look: AtlasLook, spot: Spot, at: imgui.ImVec2, wide: float, texels: int) -> None:
    """A frame around a texel, large enough to be found; at the rim for one beyond it."""
    left, bottom = look.seen_at(spot.column / texels, spot.row / texels)
    right, top = look.seen_at((spot.column + 1) / texels, (spot.row + 1) / texels)
    more = max(0.5 * (LEAST / wide - (right - left)), 0.0)
    inside = left < 1.0 and right > 0.0 and top < 1.0 and bottom > 0.0
    if not inside:
        more = 0.5 * LEAST / wide
        left = right = min(max(left, more), 1.0 - more)
        top = bottom = min(max(top, more), 1.0 - more)
    low = imgui.ImVec2(at.x + wide * (left - more), at.y + wide * (top - more))
    high = imgui.ImVec2(at.x + wide * (right + more), at.y + wide * (bottom + more))
    paint = imgui.get_window_draw_list()
    paint.add_rect(low, high, ink(SHADE), 0.0, 3.0)
    paint.add_rect(low, high, ink(FRAME if inside else BEYOND), 0.0, 1.5)
