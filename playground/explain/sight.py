"""What each pixel sees, remembered: light and material do not change it."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

from playground.render.numpy_renderer import visibility
from playground.render.raster.rasterize import Frame
from playground.render.surface import Surface
from playground.render.view import View
from playground.scene.camera import Camera


@dataclass(frozen=True)
class _Sight:
    """What visibility follows from: ``key`` says all of it."""

    key: tuple[Any, ...]
    surfaces: tuple[Surface, ...] = field(compare=False)
    view: View = field(compare=False)
    size: tuple[int, int]


def sight(
    everything: tuple[Surface, ...], view: View, camera: Camera, size: tuple[int, int]
) -> Frame:
    """Which triangle of which surface each pixel sees.

    The last answer is kept: another pixel, or another light, costs next to nothing.
    """
    # Meshes count by identity: a mesh never changes.
    places = ((s.mesh, s.linear.tobytes(), s.origin.tobytes()) for s in everything)
    return _seen(_Sight((camera, *places), everything, view, size))


@lru_cache(maxsize=1)
def _seen(sight: _Sight) -> Frame:
    return visibility(sight.surfaces, sight.view, sight.size)
