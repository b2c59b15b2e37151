"""What patches reflect and send out: colours of materials and of area lights."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.render.radiosity.patch.outline import label
from playground.render.texels import check_texcoords, load_texture
from playground.scene.light import AreaLight
from playground.scene.scene import Object
from playground.scene.setup import Setup
from playground.shading.floats import Array
from playground.shading.texture import bilinear
from playground.shading.vector import cross

Integers = NDArray[np.int64]
MOST_SAMPLES = 4_000_000  # of a texture, over all patches of an object


def colours(
    setup: Setup, owner: Integers, polygon: Array, texcoords: Array | None
) -> tuple[Array, Array]:
    """Reflectance and emission (N, 3) of patches with corners (N, 4, 3) and texcoords (N, 4, 2).

    Raises
    ------
    PlaygroundError
        A reflectance of 1 or more, a texture without texture coordinates, or no light at all.
    """
    reflectance, emission = np.zeros((len(owner), 3)), np.zeros((len(owner), 3))
    weights = setup.settings.weights
    for number, item in enumerate(setup.scene.objects):
        own = np.flatnonzero(owner == number)
        if len(own) == 0:
            continue
        diffuse = weights["diffuse"] * np.array(item.material.diffuse)
        reflectance[own] = diffuse
        if item.material.texture:
            check_texcoords(item, item.geometry().mesh)
            assert texcoords is not None
            texels = load_texture(item.material.texture, item.material.texture_encoding)
            reflectance[own] *= _mean_texels(texels, texcoords[own], polygon[own])
        _check_reflectance(item, number, reflectance[own], weights["diffuse"])
        emission[own] = weights["emissive"] * np.array(item.material.emissive)
    number = len(setup.scene.objects)
    for light in setup.scene.lights:
        if isinstance(light, AreaLight):
            emission[owner == number] = light.diffuse
            number += 1
    others = any(any(x.diffuse) for x in setup.scene.lights if not isinstance(x, AreaLight))
    if not emission.any() and not others:
        raise PlaygroundError(
            "nothing in the scene sends out light",
            got="no emissive material and no light whose diffuse colour is above 0",
            fix="Add a light, or make a material emissive, such as emissive = [5.0, 5.0, 5.0].",
        )
    return reflectance, emission


def _check_reflectance(item: Object, number: int, reflectance: Array, weight: float) -> None:
    """Raise an error where a surface would send back all the light that arrives, or more."""
    wrong = ~((reflectance >= 0.0) & (reflectance < 1.0))
    if not wrong.any():
        return
    row, channel = np.argwhere(wrong)[0]
    name = ("red", "green", "blue")[channel]
    times = f" times diffuse_weight {weight:g}" if weight != 1.0 else ""
    raise PlaygroundError(
        f"{label(item, number)} reflects all the {name} light that arrives, or more",
        got=f"material.diffuse {item.material.diffuse[channel]:g}{times}, "
        f"a reflectance of {reflectance[row, channel]:g}",
        allowed="0 or more and less than 1: in a closed room light would never end",
        fix=f"Lower {name} of its diffuse colour"
        + (", or diffuse_weight." if times else ", to 0.9 for a very white wall."),
    )


def _mean_texels(texels: NDArray[np.float32], texcoords: Array, polygon: Array) -> Array:
    """The mean of a texture over each patch, (N, 3).

    Points of an even grid over the two parameters of the patch, weighed by the area around them;
    a triangle is a quad that ends in a point. They are at most one texel apart, unless that makes
    more than `MOST_SAMPLES`.
    """
    height, width = texels.shape[:2]
    extent = np.ptp(texcoords * (width, height), axis=1).max(initial=1.0)
    side = int(min(np.ceil(extent), max(np.sqrt(MOST_SAMPLES / len(texcoords)), 2.0)))
    total, weight = np.zeros((len(texcoords), 3)), np.zeros((len(texcoords), 1))
    middles = (np.arange(max(side, 2)) + 0.5) / max(side, 2)
    for s in middles:
        across = np.stack([(1 - s) * (1 - middles), s * (1 - middles), s * middles], axis=1)
        blend = np.column_stack([across, (1 - s) * middles])  # (T, 4)
        along = (1 - middles)[:, None] * (polygon[:, None, 1] - polygon[:, None, 0])
        along = along + middles[:, None] * (polygon[:, None, 2] - polygon[:, None, 3])
        up = (1 - s) * (polygon[:, 3] - polygon[:, 0]) + s * (polygon[:, 2] - polygon[:, 1])
        area = np.linalg.norm(cross(along, np.broadcast_to(up[:, None], along.shape)), axis=-1)
        seen = bilinear(texels, blend @ texcoords)
        total += np.einsum("nt,ntc->nc", area, seen)
        weight += area.sum(axis=1, keepdims=True)
    return np.asarray(total / weight)
