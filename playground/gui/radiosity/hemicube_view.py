"""The hemicube of patch i on the screen: five faces, the pixel under the mouse, its sums."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

from imgui_bundle import imgui

from playground.explain.colour_map import VIRIDIS
from playground.gui.picture.canvas import ink
from playground.gui.radiosity import hemicube_image
from playground.gui.radiosity.factor_told import FactorTold, HemicubeTold
from playground.gui.radiosity.factor_view import FactorView
from playground.gui.widgets import Ui, edit
from playground.render.radiosity.factor.hemicube_view import delta_form_factors

LARGEST = 26.0  # of the image, in heights of the text


def draw(view: FactorView, of: FactorTold, ui: Ui) -> FactorView:
    """Knobs, image and sums; returns the view with what the mouse did."""
    told = of.hemicube
    assert told is not None
    view = edit(ui, view, only=("resolution", "colouring"))
    wide = imgui.get_content_region_avail().x
    side = min(wide, LARGEST * imgui.get_font_size())
    at = imgui.get_cursor_screen_pos()
    imgui.invisible_button("##hemicube", imgui.ImVec2(side, side))
    end = imgui.ImVec2(at.x + side, at.y + side)
    imgui.get_window_draw_list().add_image(imgui.ImTextureRef(of.picture), at, end)
    _frames(at, side)
    mouse, found = imgui.get_io().mouse_pos, None
    if imgui.is_item_hovered():
        share = (mouse.x - at.x) / side, (mouse.y - at.y) / side
        found = hemicube_image.pixel_at(told.items, *share)
    lit = found[0] if found is not None and found[0] >= 0 else None
    if lit is not None and imgui.is_item_clicked():
        view = view.clicked(lit, second=True)
    if found is not None:
        _tooltip(told, *found)
    if view.colouring == "delta":
        _legend(told, side)
    if view.colouring == "light" and not of.solved:
        imgui.text_disabled("not solved yet: surfaces in white light")
    _sums(view, told)
    return view if view.lit == lit else replace(view, lit=lit)


def _frames(at: imgui.ImVec2, side: float) -> None:
    """The edges between the faces: the top in the middle, each side at its edge of it."""
    paint, colour = imgui.get_window_draw_list(), imgui.get_color_u32(imgui.Col_.text_disabled)
    quarter = 0.25 * side

    def box(x: float, y: float, wide: float, high: float) -> None:
        low = imgui.ImVec2(at.x + x * quarter, at.y + y * quarter)
        paint.add_rect(low, imgui.ImVec2(low.x + wide * quarter, low.y + high * quarter), colour)

    for place in ((1, 1, 2, 2), (0, 1, 1, 2), (3, 1, 1, 2), (1, 0, 2, 1), (1, 3, 2, 1)):
        box(*place)


def _tooltip(told: HemicubeTold, patch: int, delta: float) -> None:
    """The pixel under the mouse, and all pixels of its patch."""
    if patch < 0:
        imgui.set_tooltip(f"no patch; delta form factor {delta:.3g}")
        return
    sums = _summed(told, patch, "of it sum to F =")
    imgui.set_tooltip(f"patch {patch}: delta form factor {delta:.3g}\n{sums}")


def _summed(told: HemicubeTold, patch: int, words: str) -> str:
    """The pixels of a patch and the sum of their delta form factors."""
    count, factor = hemicube_image.summed(told.items, patch)
    pixels = "1 pixel" if count == 1 else f"{count} pixels"
    return f"{pixels} {words} {factor:.5g}"


def _legend(told: HemicubeTold, side: float) -> None:
    """What the colours mean, from 0 to the largest delta form factor."""
    paint, line = imgui.get_window_draw_list(), imgui.get_font_size()
    at, most = imgui.get_cursor_screen_pos(), float(delta_form_factors(told.resolution).max())
    colours = [ink((float(r), float(g), float(b))) for r, g, b in VIRIDIS]
    step = side / (len(colours) - 1)
    for i, (a, b) in enumerate(pairwise(colours)):
        low = imgui.ImVec2(at.x + i * step, at.y)
        end = imgui.ImVec2(at.x + (i + 1) * step, at.y + 0.7 * line)
        paint.add_rect_filled_multi_color(low, end, a, b, b, a)
    text = imgui.get_color_u32(imgui.Col_.text)
    for share in (0.0, 0.5, 1.0):
        words = f"{share * most:.3g}"
        x = at.x + share * (side - imgui.calc_text_size(words).x)
        paint.add_text(imgui.ImVec2(x, at.y + 0.8 * line), text, words)
    imgui.dummy(imgui.ImVec2(side, 1.9 * line))


def _sums(view: FactorView, told: HemicubeTold) -> None:
    """The patch under the mouse, or j; and all patches."""
    marked = view.other if view.pointed in (None, view.one) else view.pointed
    if marked is not None:
        name = "j = " if marked == view.other else ""
        imgui.text(f"patch {name}{marked}: {_summed(told, marked, 'sum to F =')}")
    else:
        imgui.text_disabled("point at a patch: its pixels and their sum")
    imgui.text(f"row sum {hemicube_image.row_sum(told.items):.5f}")
    imgui.set_item_tooltip("of all pixels that show the front of a patch; 1 in a closed scene")
