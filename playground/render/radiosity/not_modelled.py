"""What a scene has and radiosity leaves out, named: a picture must not hide it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from playground.scene.scene import Scene
from playground.scene.setup import Setup


def not_modelled(setup: Setup) -> tuple[str, ...]:
    """One sentence for each thing that ``setup`` has, ``name: what the picture shows instead``."""
    return (*_ambient(setup), *_rays(setup.scene), *_highlights(setup))


def _ambient(setup: Setup) -> Iterator[str]:
    lights, items = setup.scene.lights, setup.scene.objects
    lit = any(np.any(np.multiply(x.ambient, y.material.ambient)) for x in lights for y in items)
    if lit and setup.settings.weights["ambient"] > 0.0:
        yield (
            "ambient: the ambient term is left out; the light it stands for has been computed, "
            "as light between diffuse surfaces"
        )


def _rays(scene: Scene) -> Iterator[str]:
    materials = [item.material for item in scene.objects]
    if any(any(material.reflectance) for material in materials):
        yield "mirrors: what a mirror reflects is left out; its diffuse colour alone sends light on"
    if any(any(material.transmittance) for material in materials):
        yield "glass: it lets no light through; it casts the shadow of a solid"


def _highlights(setup: Setup) -> Iterator[str]:
    lights, items = setup.scene.lights, setup.scene.objects
    shiny = [
        y for x in lights for y in items if np.any(np.multiply(x.specular, y.material.specular))
    ]
    if shiny and setup.settings.weights["specular"] > 0.0:
        yield "specular interreflection: no surface is lit by the highlight of another"
        yield "highlights: they are those of the local model; nothing casts a shadow on them"
