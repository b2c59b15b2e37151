"""What the plots of the window have in common: colours of the modes, axes, a legend in words."""

from __future__ import annotations

from collections.abc import Iterable

from imgui_bundle import imgui, implot

from playground.gui.widget.theme import PALETTES

Rgb = tuple[float, float, float]
COLOURS: dict[str, dict[str, Rgb]] = {  # told apart by colour-blind eyes too: Okabe & Ito
    "dark": {
        "flat": (0.80, 0.60, 0.70),
        "per-vertex": (0.95, 0.60, 0.10),
        "per-fragment": (0.34, 0.71, 0.91),
        "reference": (0.62, 0.62, 0.62),
    },
    "light": {
        "flat": (0.66, 0.30, 0.52),
        "per-vertex": (0.80, 0.37, 0.00),
        "per-fragment": (0.00, 0.40, 0.70),
        "reference": (0.55, 0.55, 0.55),
    },
}
PLAIN = (
    implot.Flags_.no_legend.value | implot.Flags_.no_menus.value | implot.Flags_.no_box_select.value
)


def begin(name: str, theme: str, height: float, more: int = 0) -> bool:
    """Open a plot over the whole width in the colours of the theme; `end` it if true.

    Out of sight, only its place is taken.
    """
    room = imgui.ImVec2(imgui.get_content_region_avail().x, height)
    if not imgui.is_rect_visible(room):
        imgui.dummy(room)
        return False
    implot.style_colors_auto()
    paper, field = PALETTES[theme].paper, PALETTES[theme].field
    implot.push_style_color(implot.Col_.frame_bg, imgui.ImVec4(*paper, 1.0))
    implot.push_style_color(implot.Col_.plot_bg, imgui.ImVec4(*field, 0.35))
    implot.push_style_var(
        implot.StyleVar_.plot_padding, imgui.ImVec2(1.15 * imgui.get_font_size(), 4)
    )
    if implot.begin_plot(name, imgui.ImVec2(-1, height), PLAIN | more):
        return True
    _popped()
    return False


def end() -> None:
    """Close the plot that `begin` has opened."""
    implot.end_plot()
    _popped()


def _popped() -> None:
    implot.pop_style_var()
    implot.pop_style_color(2)


def pen(theme: str, mode: str, weight: float = 1.5, alpha: float = 1.0) -> implot.Spec:
    """How the line or the dots of a mode are drawn."""
    colour = imgui.ImVec4(*COLOURS[theme][mode], alpha)
    spec = implot.Spec()
    spec.line_color = spec.marker_line_color = spec.marker_fill_color = colour
    spec.line_weight = weight
    return spec


def legend(theme: str, modes: Iterable[str]) -> None:
    """The names of the modes, each behind a square of its colour."""
    size = imgui.get_font_size()
    for i, mode in enumerate(modes):
        if i:
            imgui.same_line(0.0, size)
        at = imgui.get_cursor_screen_pos()
        colour = imgui.get_color_u32(imgui.ImVec4(*COLOURS[theme][mode], 1.0))
        low = imgui.ImVec2(at.x, at.y + 0.25 * size)
        high = imgui.ImVec2(at.x + 0.6 * size, at.y + 0.85 * size)
        imgui.get_window_draw_list().add_rect_filled(low, high, colour)
        imgui.set_cursor_screen_pos(imgui.ImVec2(at.x + 0.9 * size, at.y))
        imgui.text(mode)


def wrapped(text: str, colour: Rgb) -> None:
    """A paragraph in a colour."""
    imgui.push_style_color(imgui.Col_.text, imgui.ImVec4(*colour, 1.0))
    imgui.push_text_wrap_pos(0.0)
    imgui.text_unformatted(text)
    imgui.pop_text_wrap_pos()
    imgui.pop_style_color()
