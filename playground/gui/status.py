"""The line at the bottom: the last message, what was drawn with, and what it took."""

from __future__ import annotations

from functools import lru_cache

from imgui_bundle import imgui

from playground.gui.state import State
from playground.gui.widget.theme import PALETTES
from playground.render.needs import needs
from playground.render.surface import surfaces
from playground.render.view import view_of
from playground.scene.camera import Camera
from playground.scene.scene import Scene
from playground.scene.settings import Settings
from playground.scene.setup import Setup

ROWS = 2  # of text
GAP = "   "  # between two numbers


def draw(state: State, numbers: str, light: str = "") -> None:
    """Two rows: message and numbers; what the pictures need of the renderer, or of ``light``."""
    alarm = state.failed and not state.hint
    whole = state.hint or state.message or state.setup.scene.title or state.setup.name
    message = whole.replace("\n", " ")
    if alarm:
        imgui.push_style_color(imgui.Col_.text, (*PALETTES[state.theme].alarm, 1.0))
    text = f"{numbers}{GAP}{triangles(state.setup.scene):,} triangles"
    padding, gap = imgui.get_style().window_padding.x, imgui.get_font_size()
    end = imgui.get_window_width() - padding
    text = _beside(message, text, end - padding - gap)
    start = end - imgui.calc_text_size(text).x
    room = start - padding - gap
    imgui.text_unformatted(_cut(message, room))
    imgui.set_item_tooltip(_wrapped(whole))
    if alarm:
        imgui.pop_style_color()
    imgui.same_line(start)
    imgui.text_disabled(text)
    line = light or "needs: " + described(state.setup)
    imgui.text_disabled(_cut(line, imgui.get_content_region_avail().x))
    if light:
        imgui.set_item_tooltip(_wrapped(light))
        return
    imgui.set_item_tooltip(
        "the features that this scene uses; nothing else is compiled or computed\n" + _wrapped(line)
    )


def triangles(scene: Scene) -> int:
    """How many triangles the scene has."""
    return sum(len(item.geometry().mesh.faces) for item in scene.objects)


def described(setup: Setup) -> str:
    """The distinct needs of the objects, in words."""
    return _described(setup.scene, setup.settings, setup.camera)


@lru_cache(maxsize=4)
def _described(scene: Scene, settings: Settings, camera: Camera) -> str:
    everything = surfaces(scene, settings.weights)
    view = view_of(camera, everything, (4, 3))
    every = (needs(surface, view, settings, True).describe() for surface in everything)
    return "; ".join(dict.fromkeys(every)) or "nothing: no object"


def _beside(message: str, numbers: str, room: float) -> str:
    """As many of the numbers, the last ones, as leave the message its room: it comes first."""
    room -= imgui.calc_text_size(message).x
    while numbers and imgui.calc_text_size(numbers).x > room:
        numbers = numbers.partition(GAP)[2]
    return numbers


def _cut(text: str, room: float) -> str:
    """The text, or as much of it as there is room for."""
    text = text.replace("\n", " ")
    if imgui.calc_text_size(text).x <= room:
        return text
    low, high = 0, len(text)
    while low < high:  # the longest head that fits
        middle = (low + high + 1) // 2
        fits = imgui.calc_text_size(text[:middle] + "…").x <= room
        low, high = (middle, high) if fits else (low, middle - 1)
    return text[:low] + "…"


@lru_cache(maxsize=8)
def _wrapped(text: str, width: int = 80) -> str:
    from textwrap import fill

    return fill(text, width).replace("%", "%%")
