"""What the view says of pictures of stored light: how far they are, or why there is none."""

from __future__ import annotations

from typing import Any

from imgui_bundle import imgui

from playground.gui.picture.canvas import ink
from playground.gui.picture.comparison import Box, Picture
from playground.gui.radiosity.stored_slots import StoredSlots
from playground.gui.scene_view import Slots
from playground.gui.state import LIGHTMAP, RADIOSITY
from playground.percent import percent

WHITE = (1.0, 1.0, 1.0)
NO_LIGHT = {RADIOSITY: "No radiosity: ", LIGHTMAP: "No lightmap: "}
BAKING = "The lightmap is being baked."
ROOM = 0.86  # of the width of the picture, for words


def brief(method: str, slots: StoredSlots) -> str:
    """What a caption adds; nothing where all is done."""
    run = slots.radiosity
    if method != RADIOSITY or run.error or run.done:
        return ""
    if run.step is None:
        return "   patches and form factors..."
    paused = "" if run.playing else ", paused"
    return f"   {percent(run.step.residual)} of the light left{paused}"


def status(slots: Slots) -> str:
    """What the line at the foot says of computed light; empty if none is shown."""
    run, paths = slots.stored.radiosity, slots.paths.told
    words = []
    if slots.stored.solves and run.step is not None and run.patches is not None:
        step = run.step
        left = f"{percent(step.residual)} of the light left, {step.solver}"
        words.append(f"radiosity: {len(run.patches)} patches, {left}")
    if paths is not None and not slots.paths.computing:
        words.append(str(paths))
    return ";   ".join(words)


def draw(
    shown: tuple[Picture, ...], slots: StoredSlots, origin: Any, dense: Any, baking: bool
) -> None:
    """Over each picture without light, in the middle of its box, why it has none."""
    for picture in shown:
        trouble = slots.trouble(picture.stored) if picture.stored else ""
        if trouble:
            waits = baking and picture.stored == LIGHTMAP
            words = BAKING if waits else NO_LIGHT[picture.stored] + trouble
            _plate(words, picture, origin, dense)


def _plate(words: str, picture: Picture, origin: Any, dense: Any) -> None:
    box: Box = picture.box
    first, last = picture.part
    left, right = box[0] + first * box[2], box[0] + last * box[2]
    room = ROOM * (right - left) / dense.x
    size = imgui.calc_text_size(words, False, room)
    middle = origin.x + 0.5 * (left + right) / dense.x, origin.y + (box[1] + 0.5 * box[3]) / dense.y
    low = imgui.ImVec2(middle[0] - 0.5 * size.x, middle[1] - 0.5 * size.y)
    pad = 0.7 * imgui.get_font_size()
    paint, font = imgui.get_window_draw_list(), imgui.get_font()
    start = imgui.ImVec2(low.x - pad, low.y - pad)
    end = imgui.ImVec2(low.x + size.x + pad, low.y + size.y + pad)
    paint.add_rect_filled(start, end, ink((0.0, 0.0, 0.0), 0.8), 0.5 * pad)
    paint.add_text(font, imgui.get_font_size(), low, ink(WHITE), words, wrap_width=room)
