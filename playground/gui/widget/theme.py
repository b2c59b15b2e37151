"""Colours and sizes of the window: two neutral themes with good contrast, any text size."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

from imgui_bundle import imgui

from playground import locate

TEXT = 15.0  # pixels, at text size 1 on a screen of ordinary density
FONT = "fonts/DejaVuSans.ttf"  # has λ ρ ⊗ · and Vietnamese
CODE_FONT = "fonts/DejaVuSansMono.ttf"  # the same for shaders
CODE = 0.87  # height of the letters of code, in those of other text
Rgb = tuple[float, float, float]


@dataclass(frozen=True)
class Palette:
    """The few colours from which all others follow. Neutral greys leave the picture its hue."""

    paper: Rgb  # behind everything
    field: Rgb  # what can be typed into or dragged
    text: Rgb
    faint: Rgb  # secondary text
    accent: Rgb  # what is on, held or chosen
    alarm: Rgb  # errors


PALETTES = {
    "dark": Palette(
        (0.115, 0.115, 0.12),
        (0.21, 0.21, 0.22),
        (0.93, 0.93, 0.93),
        (0.64, 0.64, 0.66),
        (0.24, 0.50, 0.78),
        (1.0, 0.48, 0.40),
    ),
    "light": Palette(
        (0.95, 0.95, 0.95),
        (0.84, 0.84, 0.85),
        (0.08, 0.08, 0.08),
        (0.36, 0.36, 0.38),
        (0.36, 0.62, 0.92),
        (0.72, 0.08, 0.04),
    ),
}


def load_font() -> None:
    """The fonts of interface and code; their glyphs are drawn when they are first needed."""
    for font in (FONT, CODE_FONT):
        imgui.get_io().fonts.add_font_from_file_ttf(str(locate.asset(font)), TEXT)


def push_code_font() -> None:
    """Write in the font of code until `imgui.pop_font`."""
    size = imgui.get_style().font_size_base * CODE
    imgui.push_font(imgui.get_io().fonts.fonts[1], size)


def apply(theme: str, text_size: float, density: float) -> None:
    """Set every colour and size; the font follows the density of the screen by itself."""
    scale = text_size * density
    style, palette = imgui.get_style(), PALETTES[theme]
    (imgui.style_colors_dark if theme == "dark" else imgui.style_colors_light)()
    for index, colour in _colours(palette).items():
        style.set_color_(index, colour)
    style.font_size_base = TEXT
    style.font_scale_main = text_size
    style.window_padding = imgui.ImVec2(10 * scale, 8 * scale)
    style.frame_padding = imgui.ImVec2(7 * scale, 3 * scale)
    style.item_spacing = imgui.ImVec2(7 * scale, 5 * scale)
    style.item_inner_spacing = imgui.ImVec2(5 * scale, 4 * scale)
    style.indent_spacing = 14 * scale
    style.scrollbar_size = 12 * scale
    style.grab_min_size = 11 * scale
    style.frame_rounding = style.grab_rounding = 3 * scale
    style.window_rounding = style.popup_rounding = 5 * scale
    style.frame_border_size = 1.0  # outlines what is off as clearly as what is on
    style.window_border_size = style.popup_border_size = 1.0
    style.hover_delay_short = 0.35


def lay_paper(paper: Rgb | None) -> None:
    """Another colour behind everything: that of a presentation."""
    if paper:
        imgui.get_style().set_color_(imgui.Col_.window_bg, (*paper, 1.0))


@lru_cache(maxsize=len(PALETTES))
def _colours(palette: Palette) -> dict[int, imgui.ImVec4]:
    paper, field, accent, text = palette.paper, palette.field, palette.accent, palette.text
    raised, hover = _mix(field, text, 0.10), _mix(field, text, 0.18)
    col = imgui.Col_
    made = {
        col.text: text,
        col.text_disabled: palette.faint,
        col.window_bg: paper,
        col.popup_bg: _mix(paper, field, 0.4),
        col.menu_bar_bg: _mix(paper, field, 0.5),
        col.border: _mix(paper, text, 0.22),
        col.frame_bg: field,
        col.frame_bg_hovered: raised,
        col.frame_bg_active: hover,
        col.button: _mix(field, text, 0.04),
        col.button_hovered: hover,
        col.button_active: accent,
        col.header: _mix(paper, field, 0.9),
        col.header_hovered: raised,
        col.header_active: hover,
        col.check_mark: _mix(accent, text, 0.45),
        col.slider_grab: accent,
        col.slider_grab_active: _mix(accent, text, 0.4),
        col.separator: _mix(paper, text, 0.2),
        col.scrollbar_bg: paper,
        col.title_bg_active: field,
        col.nav_cursor: accent,
        col.plot_histogram: accent,  # of progress bars
        col.table_header_bg: _mix(paper, field, 0.9),
        col.table_row_bg_alt: _mix(paper, field, 0.3),
    }
    return {index: imgui.ImVec4(*colour, 1.0) for index, colour in made.items()}


def _mix(a: Rgb, b: Rgb, share: float) -> Rgb:
    red, green, blue = ((1.0 - share) * x + share * y for x, y in zip(a, b, strict=True))
    return red, green, blue
