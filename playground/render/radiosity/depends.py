"""What a solution depends on: not the camera, the display, highlights or the light shown."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from playground.render.texels import load_texture
from playground.scene.material import Material
from playground.scene.scene import Object
from playground.scene.setup import Setup

FACTORS = ("patches", "form_factors", "hemicube", "occlusion", "normalise")
SOLUTION = (*FACTORS, "refinement", "solver", "convergence")


@dataclass(frozen=True)
class Depends:
    """Two setups whose `Depends` are equal have the same solution.

    Meshes and textures count as they are in memory: a file that was read anew is another one.
    """

    objects: tuple[Object, ...]
    lights: tuple[Any, ...]
    settings: tuple[Any, ...]
    weights: tuple[float, float]
    meshes: tuple[Any, ...]
    textures: tuple[Any, ...]


class _Same:
    """Equal to itself alone."""

    def __init__(self, value: Any) -> None:
        self.value = value

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Same) and other.value is self.value

    __hash__ = None  # type: ignore[assignment]


def depends(setup: Setup) -> Depends:
    """What of ``setup`` its solution depends on."""
    items, settings = setup.scene.objects, setup.settings
    black = (0.0, 0.0, 0.0)
    return Depends(
        objects=tuple(replace(item, material=_diffuse(item.material)) for item in items),
        lights=tuple(replace(x, specular=black, ambient=black) for x in setup.scene.lights),
        settings=tuple(getattr(settings, name) for name in SOLUTION),
        weights=(settings.weights["diffuse"], settings.weights["emissive"]),
        meshes=tuple(_Same(item.geometry().mesh) for item in items),
        textures=tuple(
            _Same(load_texture(x.material.texture, x.material.texture_encoding))
            for x in items
            if x.material.texture
        ),
    )


def _diffuse(material: Material) -> Material:
    """The material without what radiosity does not look at."""
    return Material(
        diffuse=material.diffuse,
        emissive=material.emissive,
        texture=material.texture,
        texture_encoding=material.texture_encoding,
    )
