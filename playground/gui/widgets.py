"""From a knob to the widget that turns it: generated from the declaration.

`edit` draws every knob of a value and returns the value with what the user changed.
A row is a label, the lecture's symbol, and the widget; its tooltip says the rest.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, TypeVar

from imgui_bundle import imgui

from playground.errors import PlaygroundError
from playground.gui.radiosity.factor_told import FactorTold
from playground.gui.radiosity.radiosity_told import RadiosityTold
from playground.gui.rays.tracing_told import TracingTold
from playground.gui.widget import spans
from playground.gui.widget.typeset import typeset
from playground.scene.knob import Knob, knobs

if TYPE_CHECKING:
    from playground.gui.lightmap.atlas_picture import AtlasPicture
    from playground.gui.radiosity.stored_slots import StoredSlots

COLOUR_FLAGS = (
    imgui.ColorEditFlags_.float.value
    | imgui.ColorEditFlags_.hdr.value
    | imgui.ColorEditFlags_.no_options.value
)
LABELS = 8.8  # width of the column of labels, in heights of the text
Item = TypeVar("Item")


@dataclass
class Ui:
    """What panels share during one frame: the scale of the text, and what was refused."""

    scale: float = 1.0
    refused: list[str] = field(default_factory=list)
    view: tuple[int, int] = (1, 1)  # size of the view, in pixels of the framebuffer
    tracing: TracingTold = TracingTold()
    atlas: AtlasPicture | None = None
    factors: FactorTold = FactorTold()
    radiosity: RadiosityTold = RadiosityTold()
    stored: StoredSlots | None = None  # the light that pictures are drawn with


def edit(ui: Ui, item: Item, only: Iterable[str] = (), skip: Iterable[str] = ()) -> Item:
    """Draw the knobs of ``item`` and return it as the user leaves it."""
    known = knobs(type(item))
    for name in tuple(only) or [name for name in known if name not in tuple(skip)]:
        item = attempt(ui, item, name, row(known[name], name, getattr(item, name)))
    return item


def attempt(ui: Ui, item: Item, name: str, value: Any) -> Item:
    """``item`` with ``name`` set to ``value``, or as it was where that is not allowed."""
    if value == getattr(item, name):
        return item
    try:
        return replace(item, **{name: value})  # type: ignore[type-var]
    except PlaygroundError as error:
        ui.refused.append(str(error))
        return item


def row(knob: Knob, name: str, value: Any) -> Any:
    """A label and the widget of one knob; returns the value, changed or not."""
    label(name, knob.symbol)
    tooltip(knob)
    imgui.same_line(LABELS * imgui.get_font_size())
    imgui.set_next_item_width(-1)
    return bare(knob, name, value)


def bare(knob: Knob, name: str, value: Any) -> Any:
    """The widget of one knob without its label; right-click sets the declared default."""
    value = _WIDGETS[knob.kind](knob, f"##{name}", value)
    if knob.kind in spans.RIGHT_CLICK:
        tooltip(knob)
        if imgui.is_item_hovered() and imgui.is_mouse_clicked(1):
            return knob.default
    return value


def tooltip(knob: Knob) -> None:
    """Say, over the last item, what the knob is."""
    if imgui.is_item_hovered(imgui.HoveredFlags_.for_tooltip) and imgui.begin_tooltip():
        imgui.push_text_wrap_pos(24 * imgui.get_font_size())
        imgui.text_unformatted(spans.hint(knob))
        imgui.pop_text_wrap_pos()
        imgui.end_tooltip()


def label(name: str, symbol: str = "") -> None:
    """The name of a knob, and behind it, fainter, the lecture's symbol with its subscript."""
    imgui.align_text_to_frame_padding()
    imgui.text(name.replace("_", " "))
    if not symbol:
        return
    imgui.same_line()
    size, at = imgui.get_font_size(), imgui.get_cursor_screen_pos()
    at.y += imgui.get_style().frame_padding.y
    width = typeset(symbol, at, size, imgui.get_color_u32(imgui.Col_.text_disabled))
    imgui.dummy(imgui.ImVec2(width, size))


def fits(words: Iterable[str]) -> bool:
    """Whether radio buttons with these words stand side by side in the space left."""
    style, size = imgui.get_style(), imgui.get_frame_height()
    space = style.item_inner_spacing.x + style.item_spacing.x
    wide = sum(imgui.calc_text_size(word).x + size + space for word in words)
    return bool(wide - style.item_spacing.x <= imgui.get_content_region_avail().x)


def _number(knob: Knob, name: str, value: float) -> float:
    if not spans.bounded(knob):
        speed = spans.drag_speed((value,))
        low, high = (knob.low, knob.high) if knob.low > -1e30 else (0.0, 0.0)
        changed, new = imgui.drag_float(name, value, speed, low, high, spans.number_format(knob))
    else:
        flags = imgui.SliderFlags_.logarithmic if knob.scale == "log" else 0
        low, high = spans.span(knob, value)
        pattern = spans.number_format(knob, low, high)
        changed, new = imgui.slider_float(name, value, low, high, pattern, flags)
    return spans.tidy(new) if changed else value


def _integer(knob: Knob, name: str, value: int) -> int:
    low, high = int(knob.low), int(knob.high)
    flags = imgui.SliderFlags_.logarithmic if high - low > 100 else 0
    return int(imgui.slider_int(name, value, low, high, "%d", flags)[1])


def _switch(knob: Knob, name: str, value: bool) -> bool:
    return bool(imgui.checkbox(name, value)[1])


def _choice(knob: Knob, name: str, value: str) -> str:
    if fits(knob.choices):
        for i, choice in enumerate(knob.choices):
            if i:
                imgui.same_line()
            if imgui.radio_button(f"{choice}{name}", choice == value):
                value = choice
            tooltip(knob)
        return value
    index = knob.choices.index(value)
    _, index = imgui.combo(name, index, list(knob.choices))
    tooltip(knob)
    return knob.choices[index]


def _names(knob: Knob, name: str, value: tuple[str, ...]) -> tuple[str, ...]:
    chosen = set(value)
    for i, choice in enumerate(knob.choices):
        if i and fits([choice]):
            imgui.same_line()
        _, on = imgui.checkbox(f"{choice}{name}", choice in chosen)
        chosen = chosen | {choice} if on else chosen - {choice}
    return tuple(choice for choice in knob.choices if choice in chosen)


def _colour(knob: Knob, name: str, value: tuple[float, ...]) -> tuple[float, ...]:
    changed, new = imgui.color_edit3(name, list(value), COLOUR_FLAGS)
    return tuple(max(0.0, spans.tidy(v)) for v in new) if changed else value


def _vector(knob: Knob, name: str, value: tuple[float, ...]) -> tuple[float, ...]:
    speed = 0.5 if knob.unit == "degrees" else spans.drag_speed(value)
    changed, new = imgui.drag_float3(name, list(value), speed, 0.0, 0.0, "%.3g")
    return tuple(spans.tidy(v) for v in new) if changed else value


def _vertices(knob: Knob, name: str, value: tuple[tuple[float, ...], ...]) -> Any:
    """One row of three numbers per corner; a corner more or less by the buttons below."""
    points, left = list(value), imgui.get_cursor_pos_x()
    for i, point in enumerate(value):
        if i:
            imgui.set_cursor_pos_x(left)
            imgui.set_next_item_width(-1)
        points[i] = _vector(knob, f"{name}{i}", point)
        tooltip(knob)
    fewest, most = knob.count
    imgui.set_cursor_pos_x(left)
    if len(points) < most:
        if imgui.small_button(f"+ corner{name}"):
            last, first = points[-1], points[0]
            points.append(tuple((a + b) / 2.0 for a, b in zip(last, first, strict=True)))
        imgui.set_item_tooltip("one more, between the last and the first")
    if len(points) > fewest:
        if len(points) < most:
            imgui.same_line()
        if imgui.small_button(f"- corner{name}"):
            points.pop()
        imgui.set_item_tooltip("without the last")
    return tuple(points)


def _text(knob: Knob, name: str, value: str) -> str:
    # Only a finished text counts: half a file name names no file.
    _, new = imgui.input_text(name, value)
    done = imgui.is_item_deactivated_after_edit()
    tooltip(knob)
    return str(new) if done else value


_WIDGETS: dict[str, Callable[[Knob, str, Any], Any]] = {
    "number": _number,
    "integer": _integer,
    "switch": _switch,
    "choice": _choice,
    "names": _names,
    "colour": _colour,
    "vector": _vector,
    "vertices": _vertices,
    "text": _text,
}
