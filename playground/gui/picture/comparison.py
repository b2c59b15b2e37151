"""Which pictures the view shows, and where: a pure function of the state and the space.

Boxes are in pixels of the screen, relative to the upper left corner of the view.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

from playground.gui.guess import played
from playground.gui.picture.orbit import widened
from playground.gui.same_object import kept_for_same
from playground.gui.state import (
    FIVE,
    LIGHTMAP,
    METHODS,
    PATHS,
    RADIOSITY,
    REFERENCE,
    STORED,
    TRACED,
    State,
    shown,
)
from playground.scene.settings import TERMS, Settings, Shading
from playground.scene.setup import Setup

GAP = 4  # pixels between two pictures
Box = tuple[int, int, int, int]  # x, y, width, height


@dataclass(frozen=True)
class Picture:
    """One picture of the view: what it shows, its caption, its box.

    ``part`` is the share of the width that is shown, from and to.
    """

    setup: Setup
    caption: str
    box: Box
    part: tuple[float, float] = (0.0, 1.0)
    reference: bool = False  # by NumPy in float64, not by GL
    traced: bool = False  # ray by ray
    tests: bool = False  # how much each of its rays tests, in place of its colours
    stored: str = ""  # the method of stored light that it shows
    paths: bool = False  # by chance, path by path

    @property
    def rastered(self) -> bool:
        """Whether GL draws it triangle by triangle."""
        return not (self.reference or self.traced or self.stored or self.paths)


def pictures(state: State, width: int, height: int) -> tuple[Picture, ...]:
    """The pictures of the layout that ``state`` asks for, in a space of the given size."""
    setup, mode = played(state, shown(state)), state.mode
    if state.layout == FIVE:
        return _five_answers(setup, width, height)
    if mode in (*METHODS, REFERENCE, PATHS):
        setup = _as(setup, mode)
    if state.layout == "terms":
        return _term_by_term(setup, mode, width, height)
    found = _laid_out(state, setup, mode, width, height)
    if state.chalk.tests and state.layout != "difference":
        found = tuple(replace(p, tests=True) if p.traced else p for p in found)
    return found


def _laid_out(
    state: State, setup: Setup, mode: str, width: int, height: int
) -> tuple[Picture, ...]:
    """One picture, or the two that are compared."""
    whole = (0, 0, width, height)
    if state.layout == "single":
        return (replace(_picture(setup, mode, whole), caption=""),)
    other = _as(setup, state.other)
    if state.layout == "wipe":
        return (
            _picture(setup, mode, whole, (0.0, state.wipe)),
            _picture(other, state.other, whole, (state.wipe, 1.0)),
        )
    if state.layout == "difference":
        return _picture(setup, mode, whole), _picture(other, state.other, whole)
    half = max((width - GAP) // 2, 1)
    right = (half + GAP, 0, max(width - half - GAP, 1), height)
    return (
        _picture(setup, mode, (0, 0, half, height)),
        _picture(other, state.other, right),
    )


def grid(count: int, width: int, height: int) -> tuple[int, int]:
    """Columns and rows for ``count`` boxes, chosen so that a 4:3 picture in them is largest."""

    def side(columns: int) -> float:
        rows = -(-count // columns)
        return min(width / columns / 4.0, height / rows / 3.0)

    columns = max(range(1, count + 1), key=side)
    return columns, -(-count // columns)


def boxes(count: int, width: int, height: int) -> list[Box]:
    """That many boxes of one size, row by row."""
    columns, rows = grid(count, width, height)
    w, h = (width - GAP * (columns - 1)) // columns, (height - GAP * (rows - 1)) // rows
    return [
        ((i % columns) * (w + GAP), (i // columns) * (h + GAP), max(w, 1), max(h, 1))
        for i in range(count)
    ]


@kept_for_same(2)
def _five_answers(setup: Setup, width: int, height: int) -> tuple[Picture, ...]:
    """One scene, five answers: by the local model alone, and by four that know of each other."""
    captions = {
        "Phong, local": setup.settings.shading,
        "Phong with lightmap": LIGHTMAP,
        "ray tracing": TRACED,
        RADIOSITY: RADIOSITY,
        PATHS: PATHS,
    }
    return tuple(
        replace(_picture(_as(setup, mode), mode, box), caption=caption)
        for (caption, mode), box in zip(
            captions.items(), boxes(len(captions), width, height), strict=True
        )
    )


@kept_for_same(2)
def _term_by_term(setup: Setup, mode: str, width: int, height: int) -> tuple[Picture, ...]:
    """Four pictures of one term each, and their sum; the sixth box is left for the formula."""
    places = boxes(len(TERMS) + 2, width, height)
    made = []
    for term, box in zip(TERMS, places, strict=False):
        alone = replace(setup, settings=_only(setup.settings, term))
        off = "" if term in setup.settings.terms else " (off)"
        made.append(replace(_picture(alone, mode, box), caption=f"{term}{off}"))
    return (*made, replace(_picture(setup, mode, places[len(TERMS)]), caption="sum"))


def formula_box(width: int, height: int) -> Box:
    """The box beside the sum, where the formula stands."""
    return boxes(len(TERMS) + 2, width, height)[-1]


def _picture(setup: Setup, mode: str, box: Box, part: tuple[float, float] = (0.0, 1.0)) -> Picture:
    camera = widened(setup.camera, max(box[2], 1) / max(box[3], 1))
    if camera is not setup.camera:
        setup = replace(setup, camera=camera)
    stored = mode if mode in STORED else ""
    made = Picture(setup, mode, box, part, mode == REFERENCE, mode == TRACED, stored=stored)
    return replace(made, paths=True) if mode == PATHS else made


def _as(setup: Setup, mode: str) -> Setup:
    """The setup with what a picture of this mode needs; the same one where it has it."""
    settings = _shaded(setup.settings, mode)
    return setup if settings is setup.settings else replace(setup, settings=settings)


# The same settings give the same object again: renderers notice change by identity.
@lru_cache(maxsize=64)
def _shaded(settings: Settings, shading: str) -> Settings:
    if shading == REFERENCE:  # makes no mistakes, and has no shading of its own
        return replace(settings, shading=Shading.PER_FRAGMENT.value, bugs=())
    if shading in METHODS or shading == PATHS:
        return replace(settings, bugs=()) if settings.bugs else settings
    return replace(settings, shading=shading)


@lru_cache(maxsize=64)
def _only(settings: Settings, term: str) -> Settings:
    return replace(settings, terms=(term,) if term in settings.terms else ())
