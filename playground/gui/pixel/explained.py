"""The explanation of the picked pixel: computed when something has changed, then remembered."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from time import perf_counter
from typing import Generic, TypeVar

from playground.errors import PlaygroundError
from playground.explain.pixel import Explanation, ShadedPoint, explain
from playground.gui.picture.comparison import Picture
from playground.gui.pixel.clue import Clue
from playground.scene.setup import Setup

KEPT = 4  # explanations: going back and forth between two shadings costs nothing
REST = 2.0  # times what the last one took, before the next is computed
SHORT = 0.02  # seconds: what takes less is computed at every frame
Found = TypeVar("Found")
Key = tuple[object, ...]


class Explainer(Generic[Found]):
    """A few explanations by setup, pixel, size and ``more``; ``how`` makes another kind of them.

    During a drag each frame asks for another one. Where they take long, most of these
    frames get the last one instead, so that the window stays fluent.
    """

    def __init__(self, how: Callable[..., Found] | None = None) -> None:
        self._how = how
        self._kept: list[tuple[Key, Found | None]] = []
        self._began = self._took = 0.0

    def __call__(
        self, setup: Setup, pixel: tuple[int, int], size: tuple[int, int], *more: object
    ) -> Found | None:
        """Why ``pixel`` has its colour, or None where the setup cannot be explained."""
        key = (setup, pixel, size, *more)
        for known, why in self._kept:
            if known == key:
                return why
        rest = REST * self._took if self._took > SHORT else 0.0
        if self._kept and perf_counter() < self._began + self._took + rest:
            return self._kept[0][1]
        self._began = perf_counter()
        try:
            made: Found | None = (self._how or explain)(setup, pixel, size, *more)  # type: ignore[assignment]
        except PlaygroundError:  # the renderer refuses it too, and says why
            made = None
        self._took = perf_counter() - self._began
        self._kept = [(key, made), *self._kept][:KEPT]
        return made


_explainer: Explainer[Explanation] = Explainer()


def explained(picture: Picture, pixel: tuple[float, float]) -> Explanation | None:
    """The explanation of the pixel at a fraction of width and height of ``picture``."""
    if picture.stored or picture.paths:  # the local model would explain another picture
        return None
    size = picture.box[2:]
    return _explainer(picture.setup, pixel_at(pixel, size), size)


def pixel_at(share: tuple[float, float], size: tuple[int, int]) -> tuple[int, int]:
    """The pixel at a fraction of width and height."""
    x, y = (min(max(int(s * n), 0), n - 1) for s, n in zip(share, size, strict=True))
    return x, y


def chosen_corner(why: Explanation, clue: Clue) -> int:
    """The number of the point whose vectors are shown: the chosen one, or the heaviest."""
    last = len(why.corners) - 1
    if clue.corner is None or len(why.weights) == 1:
        return min(int(why.weights.argmax()), last)
    return min(clue.corner, last)


def chosen_light(point: ShadedPoint, clue: Clue) -> int:
    """The number of the light whose vectors are shown; -1 if there is none."""
    if clue.light is None and point.lights:
        return _strongest(point)
    return min(clue.light or 0, len(point.lights) - 1)


@lru_cache(maxsize=8)
def _strongest(point: ShadedPoint) -> int:
    """The number of the light that adds most; a point never changes."""
    adds = [float((light.diffuse + light.specular).sum()) for light in point.lights]
    return adds.index(max(adds))
