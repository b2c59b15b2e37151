"""The texture with the atlas in the panel, and the places of its texels."""

from __future__ import annotations

from dataclasses import replace

import moderngl
import numpy as np

from playground.errors import PlaygroundError
from playground.explain.texel_places import TexelPlaces, texel_places
from playground.gui.lightmap.atlas_look import AtlasLook
from playground.gui.lightmap.atlas_pixels import atlas_codes
from playground.gui.same_object import kept_for_same
from playground.render.lightmap.lightmap import Lightmap
from playground.render.lightmap.lightmap_file import load_lightmap
from playground.scene.scene import Scene
from playground.scene.settings import Settings


class AtlasPicture:
    """Drawn anew when the lightmap, or how it is looked at, has changed.

    ``seen`` says that the panel is in sight; only then anybody asks for texels in the picture.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._texture: moderngl.Texture | None = None
        self._of: tuple[object, ...] = ()
        self.seen = False

    def texture(
        self, lightmap: Lightmap, look: AtlasLook, settings: Settings, size: int
    ) -> moderngl.Texture:
        """The part of the atlas that is shown, ``size`` pixels high and wide."""
        display = settings.light_shown, settings.exposure, settings.clamp, settings.curve
        wanted = lightmap, replace(look, spot=None), display, size
        if self._texture is None or self._of != wanted:
            codes = atlas_codes(lightmap, look, settings, size)
            data = np.dstack([codes, np.full((size, size), 255, np.uint8)]).tobytes()
            if self._texture is None or self._texture.width != size:
                self.release()
                self._texture = self._context.texture((size, size), 4)
            self._texture.write(data)
            self._of = wanted
        return self._texture

    def release(self) -> None:
        """Free the GPU memory."""
        if self._texture is not None:
            self._texture.release()
            self._texture = None


def baked(scene: Scene) -> tuple[Lightmap, TexelPlaces] | None:
    """The lightmap of a scene with the places of its texels; None if it has none that fits."""
    try:
        return fitting(scene)
    except PlaygroundError:  # the panel says why
        return None


def fitting(scene: Scene) -> tuple[Lightmap, TexelPlaces] | None:
    """As `baked`; a lightmap that cannot be shown is an error.

    Raises
    ------
    PlaygroundError
        The file is missing or damaged, or was baked for other geometry.
    """
    if not scene.lightmap:
        return None
    lightmap = load_lightmap(scene.lightmap)
    places = _places(lightmap, scene)
    if isinstance(places, PlaygroundError):
        raise places
    return lightmap, places


@kept_for_same(4)
def _places(lightmap: Lightmap, scene: Scene) -> TexelPlaces | PlaygroundError:
    """The places; an error is kept, too, so that it is not found anew in every frame."""
    try:
        return texel_places(lightmap, scene)
    except PlaygroundError as error:
        return error
