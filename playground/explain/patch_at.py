"""Which patch is seen in a direction, or in a pixel."""

from __future__ import annotations

import weakref

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.explain.pixel import check_pixel
from playground.render.checks import check_setup, check_size
from playground.render.radiosity.factor.visibility import halves
from playground.render.radiosity.patch.divide import divide
from playground.render.radiosity.patch.patches import Patches
from playground.render.surface import surfaces
from playground.render.view import view_of
from playground.scene.setup import Setup
from playground.shading.floats import Array
from playground.shading.triangle import ray_triangle
from playground.shading.vector import dot

SAME = 1e-9  # relative: both sides of a lamp are one distance away

_halves: weakref.WeakKeyDictionary[Patches, tuple[Array, NDArray[np.intp]]] = (
    weakref.WeakKeyDictionary()
)


def patch_at(patches: Patches, eye: Array, direction: Array) -> int | None:
    """The nearest patch from the world point ``eye`` (3,) in ``direction`` (3,), or None.

    Where two lie in one place, as the sides of a lamp do, the one that turns its front. Every
    triangle is tested: for one ray that takes less time than to build a tree.
    """
    if patches not in _halves:
        _halves[patches] = halves(patches.polygon)
    triangles, owner = _halves[patches]
    distance, _ = ray_triangle(eye - patches.origin, direction, *np.moveaxis(triangles, 1, 0))
    met = np.flatnonzero(distance > 0.0)
    if len(met) == 0:
        return None
    nearest = met[distance[met] <= distance[met].min() * (1.0 + SAME)]
    front = dot(patches.normal[owner[nearest]], direction) < 0.0
    return int(owner[nearest[np.argmax(front)]])


def patch_of_pixel(
    setup: Setup, patches: Patches, pixel: tuple[int, int], size: tuple[int, int]
) -> int:
    """The patch in the centre of ``pixel`` = (x, y) of a picture of ``size``.

    Raises
    ------
    PlaygroundError
        The pixel is outside the picture, or shows no patch.
    """
    x, y = check_pixel(pixel, *check_size(size))
    view = view_of(setup.camera, surfaces(setup.scene, setup.settings.weights), size)
    step, (right, up, back) = view.pixel(size[1]), view.camera_from_world
    across, down = x + 0.5 - size[0] / 2.0, y + 0.5 - size[1] / 2.0
    found = patch_at(patches, view.eye, step * across * right - step * down * up - back)
    if found is None:
        raise PlaygroundError("no patch there", got=f"pixel {pixel[0]} {pixel[1]}: the background")
    return found


def patches_of_pixels(
    setup: Setup, one: tuple[int, int], other: tuple[int, int], size: tuple[int, int]
) -> tuple[Patches, int, int]:
    """The patches of ``setup`` before any refinement, and which of them two pixels show.

    Raises
    ------
    PlaygroundError
        As `patch_of_pixel` and `divide`; the setup may not be one that can be rendered.
    """
    check_setup(setup)
    patches = divide(setup)
    i, j = (patch_of_pixel(setup, patches, pixel, size) for pixel in (one, other))
    return patches, i, j
