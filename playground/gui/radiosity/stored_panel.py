"""Why a pixel of stored light has its colour: what arrives, what is left of it, who sent it."""

from __future__ import annotations

from imgui_bundle import imgui

from playground.explain.stored_pixel import StoredPixel
from playground.gui.picture.comparison import Picture
from playground.gui.picture.pixel_pick import forget
from playground.gui.picture.stand import viewed
from playground.gui.pixel import filter_bars, rows
from playground.gui.pixel.equation import write
from playground.gui.radiosity.stored_explained import stored_explained
from playground.gui.radiosity.stored_told import PatchTold, StoredTold, stored_told
from playground.gui.state import LIGHTMAP, State
from playground.gui.widgets import Ui

WAITING = "Light is being computed; what arrives at this pixel is told when there is some."
ARRIVING = (
    "straight from what sends out light",
    "reflected at least once before",
    "what the picture shows of both: the light per area that arrives, over π",
)


def draw(state: State, picture: Picture, ui: Ui) -> State:
    """The light behind the picked pixel; returns what the user made of it."""
    assert ui.stored is not None
    why = stored_explained(state, viewed(state, picture), ui.stored)
    if why is None:
        trouble = ui.stored.trouble(picture.stored)
        waits = not trouble or (state.bake.running and picture.stored == LIGHTMAP)
        imgui.text_wrapped(WAITING if waits else f"No light to explain: {trouble}")
        return state
    forgotten = rows.head(
        f"pixel ({why.pixel[0]}, {why.pixel[1]}), {why.method}",
        f"of {why.size[0]} × {why.size[1]}; computed in float64, of the light that is shown",
    )
    if why.object is not None and not why.back:
        _light(stored_told(why))
    else:
        imgui.text_wrapped(_nothing(why))
    rows.display(why)
    if why.object is not None and not why.back:
        _more(stored_told(why), state)
    return forget(state) if forgotten else state


def _nothing(why: StoredPixel) -> str:
    """What is seen where no light is stored."""
    if why.back:
        return f"The back of object {why.object}, where nothing arrives."
    if why.light is not None:
        return f"Light {why.light} itself: the colour it emits, s_d."
    return "No surface here: the background."


def _light(told: StoredTold) -> None:
    """What arrives, and the terms that it makes."""
    imgui.text_wrapped(told.seen)
    imgui.separator_text("arriving light")
    for number, (line, words) in enumerate(zip(told.arriving, ARRIVING, strict=True)):
        rows.line(line, f"arriving {number}")
        imgui.set_item_tooltip(words)
    imgui.separator_text("terms")
    rows.line(told.diffuse, "diffuse")
    indent = 1.8 * imgui.get_font_size()
    imgui.indent(indent)
    symbols, numbers = told.equation
    write(symbols, "", indent=indent)
    write(numbers, "", faint=True, indent=indent)
    imgui.unindent(indent)
    for line in told.others:
        rows.line(line, line.text.split()[0])


def _more(told: StoredTold, state: State) -> None:
    """The filter as bars, and the patch."""
    imgui.separator_text("the filter m ⊗ H")
    filter_bars.draw(*told.filter, ("m_d", "H"))
    if told.patch is None:
        return
    _patch(told.patch)
    if state.solving.by_bounce:
        imgui.text_disabled("of all bounces, also where few are shown")


def _patch(told: PatchTold) -> None:
    """The radiosity equation of the patch with its numbers."""
    imgui.separator_text(told.title)
    write(told.symbols, "")
    for line in told.lines:
        rows.line(line, line.text.split("  ")[0])
    imgui.text_wrapped(told.balance)
    imgui.separator_text("what other patches send to it, F C")
    for number, line in enumerate(told.senders):
        rows.line(line, f"sender {number}")
    imgui.text_wrapped(told.energy)
