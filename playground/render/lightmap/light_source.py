"""A lightmap as a source of stored light: read once, drawn at the speed of a texture."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from playground.errors import PlaygroundError
from playground.render.lightmap.lightmap import Lightmap, lighting_checksum
from playground.render.lightmap.lightmap_file import load_lightmap
from playground.render.radiosity.not_modelled import not_modelled
from playground.render.stored import StoredLight
from playground.scene.scene import Object
from playground.scene.setup import Setup

OUTDATED = (
    "The lightmap was baked for other lights or colours: what it shows is their light. "
    "Bake it again to see the new ones."
)


class LightmapLight:
    """Holds the lightmap that was drawn last."""

    def __init__(self) -> None:
        self.warnings: tuple[str, ...] = ()
        self._of: tuple[Any, ...] = ()
        self._stored: tuple[StoredLight | None, ...] = ()
        self._fresh = True

    def prepare(self, setup: Setup) -> Iterator[float]:
        """Nothing is left to compute: a lightmap has been baked before."""
        return iter(())

    def stored(self, setup: Setup) -> tuple[StoredLight | None, ...]:
        """The light of each object, from the file that the scene names.

        Raises
        ------
        PlaygroundError
            The scene names no file, or one that is no lightmap or of other geometry.
        """
        scene = setup.scene
        if not scene.lightmap:
            raise PlaygroundError(
                "this setup has no lightmap to draw with",
                got="scene.lightmap is empty",
                fix="Make one: playground bake SETUP -o out.toml; then draw out.toml.",
            )
        lightmap = load_lightmap(scene.lightmap)
        shown, weights = setup.settings.light_shown, setup.settings.weights
        wanted = lightmap, shown, scene.objects, scene.lights, weights
        if self._of != wanted:
            lightmap.check_fits(scene)
            self._fresh = lighting_checksum(setup) == lightmap.lighting
            self._stored = _placed(lightmap, shown, scene.objects)
            self._of = wanted
        self.warnings = (*not_modelled(setup), *(() if self._fresh else (OUTDATED,)))
        return self._stored

    def note(self) -> str:
        """How large the lightmap is."""
        return f"a lightmap of {self._of[0].size} x {self._of[0].size} texels" if self._of else ""

    def close(self) -> None:
        """Nothing is held but memory."""


def _placed(
    lightmap: Lightmap, light_shown: str, objects: tuple[Object, ...]
) -> tuple[StoredLight | None, ...]:
    texels = lightmap.texels(light_shown)
    return tuple(
        None
        if part is None
        else StoredLight(part.mesh(item.geometry().mesh), texcoords=part.texcoords, texels=texels)
        for part, item in zip(lightmap.parts, objects, strict=True)
    )
