"""What a traced picture will show that its author may not expect: named warnings."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from playground.render.trace.solids import Solid
from playground.render.trace.traced_scene import TracedScene
from playground.scene.light import AreaLight, PointLight
from playground.scene.settings import Shading


def warnings_of(scene: TracedScene, precision: str = "float64") -> tuple[str, ...]:
    """One sentence each, ``name: what, and what the picture shows``; of a tracer in a precision."""
    return (*_open_glass(scene), *_hidden_lights(scene), *_ignored(scene, precision))


def _open_glass(scene: TracedScene) -> Iterator[str]:
    for solid in scene.solids:
        if solid.transmissive and not solid.closed:
            yield (
                f"open glass: {_called(scene, solid)} is transmissive but not closed; crossing it "
                "counts as a step into glass or out of it, whatever lies behind"
            )


def _hidden_lights(scene: TracedScene) -> Iterator[str]:
    around_eye = set(scene.holding(np.zeros(3)))
    for number, light in enumerate(scene.setup.scene.lights):
        if not isinstance(light, (PointLight, AreaLight)):
            continue
        place = light.centre if isinstance(light, AreaLight) else light.position
        for holder in scene.holding(scene.view.relative(place)):
            if holder in around_eye:  # a room around the eye and the light
                continue
            solid = scene.solids[holder]
            clear = solid.transmissive and scene.settings.clear_shadows
            shows = "its light leaves unbent" if clear else "nothing outside is lit by it"
            yield f"light inside a solid: light {number} is in {_called(scene, solid)}; {shows}"


def _ignored(scene: TracedScene, precision: str) -> Iterator[str]:
    settings = scene.settings
    if settings.shading != Shading.PER_FRAGMENT:
        yield f"shading: {settings.shading} is ignored; every point that a ray hits is shaded"
    if settings.precision not in ("native", precision):
        yield f"precision: {settings.precision} is ignored; this ray tracer computes in {precision}"


def _called(scene: TracedScene, solid: Solid) -> str:
    assert solid.object is not None
    return f"object {solid.object} ({scene.setup.scene.objects[solid.object].mesh})"
