"""A box with code: syntax colours, marked lines, and what the user types into it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

from imgui_bundle import imgui, imgui_color_text_edit

from playground.gui.widget import theme

TextEditor = imgui_color_text_edit.TextEditor
LANGUAGES = {".py": "python", ".hlsl": "hlsl", ".cg": "hlsl"}  # all others are GLSL


@dataclass(frozen=True)
class Mark:
    """A line (from 1) that stands out: why, and how: ``error``, ``include`` or ``here``."""

    line: int
    kind: str
    why: str


class CodeBox:
    """Text with a cursor in it, which is all that Dear ImGui remembers of it too."""

    def __init__(self, suffix: str) -> None:
        self._editor = TextEditor()
        self._editor.set_language(getattr(TextEditor.Language, LANGUAGES.get(suffix, "glsl"))())
        self._editor.set_show_whitespaces_enabled(False)
        self._editor.set_show_scrollbar_mini_map_enabled(False)
        self._editor.set_smooth_scrolling_enabled(False)
        self._text: str | None = None
        self._raw = ""
        self._look: tuple[object, ...] = ()
        self._first = 0
        self._paper = 0

    def draw(
        self, name: str, text: str, marks: tuple[Mark, ...], colours: str, size: imgui.ImVec2
    ) -> str:
        """Show ``text`` and return it as the user leaves it."""
        if text != self._text:
            self._editor.set_text(text)
            self._text, self._raw, self._look = text, self._editor.get_text(), ()
            if self._first:
                self.scroll_to(self._first)
                self._first = 0
        if self._look != (marks, colours):
            self._mark(marks, colours)
        theme.push_code_font()
        # The corner between the scroll bars has the colour of the paper, so they have it too.
        imgui.push_style_color(imgui.Col_.scrollbar_bg, self._paper)
        self._editor.render(name, size)
        imgui.pop_style_color()
        imgui.pop_font()
        if self._editor.is_read_only_enabled():
            return text
        raw = self._editor.get_text()
        if raw != self._raw:
            self._raw = raw
            self._text = raw if raw.endswith("\n") or not text.endswith("\n") else raw + "\n"
        return self._text or ""

    def read_only(self) -> CodeBox:
        """The same box, in which nothing can be typed."""
        self._editor.set_read_only_enabled(True)
        return self

    def scroll_to(self, line: int) -> None:
        """Bring a line (from 1) to the middle."""
        self._editor.scroll_to_line(line - 1)

    def lead_to(self, lines: list[int]) -> None:
        """Bring a line into view when the box is shown for the first time."""
        if self._text is None and lines:
            self._first = lines[0]

    def _mark(self, marks: tuple[Mark, ...], colours: str) -> None:
        dark = colours == "dark"
        palettes = TextEditor.get_dark_palette, TextEditor.get_light_palette
        palette = palettes[not dark]()
        self._editor.set_palette(palette)
        self._paper = palette.get(TextEditor.Color.background)
        tints = {
            "error": imgui.IM_COL32(255, 60, 40, 110),
            "include": imgui.IM_COL32(70, 130, 220, 60),
            "here": imgui.IM_COL32(255, 190, 40, 90 if dark else 120),
        }
        self._editor.clear_markers()
        for mark in marks:
            tint = tints[mark.kind]
            self._editor.add_marker(mark.line - 1, tint, tint, mark.why, mark.why)
        self._look = (marks, colours)


@lru_cache(maxsize=32)
def code_box(place: str, file: str) -> CodeBox:
    """The box of one file in one place of the window; its cursor stays while others show."""
    suffix = file[file.rfind(".") :]
    return CodeBox(suffix)
