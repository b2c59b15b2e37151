"""`Lightmap`: the light that arrives at every surface of a scene, in one image."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError, unknown_name
from playground.render.image import Image
from playground.render.lightmap.atlas import Part
from playground.scene.scene import Scene
from playground.scene.settings import LIGHT_SHOWN
from playground.scene.setup import Setup
from playground.shading.display import srgb_decode

Singles = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Lightmap:
    """Light per texel, and where in the image each object of the scene lies.

    Light is the irradiance that arrives at the front of a surface over π, in the unit of colours:
    a surface with reflectance m_d shows m_d ⊗ it. Direct light, straight from lamps and emitters,
    is apart from indirect light, so that neither is counted twice.

    Parameters
    ----------
    size : int
        Texels along either edge.
    direct, indirect : (H, W, 3) float32
        Row 0 is at v = 0, the bottom. Texels around charts hold the light of the nearest one.
    coverage : (H, W) bool
        Which texels a lookup on some chart reads.
    chart : (H, W) int32
        The number of the chart that a texel belongs to, −1 for none.
    parts : tuple of Part or None
        Per object of the scene.
    geometry, lighting : str
        What it was baked for, see `geometry_checksum` and `lighting_checksum`.
    """

    size: int
    direct: Singles
    indirect: Singles
    coverage: NDArray[np.bool_]
    chart: NDArray[np.int32]
    parts: tuple[Part | None, ...]
    geometry: str
    lighting: str

    def texels(self, light_shown: str = "all") -> Singles:
        """The light to draw with, (H, W, 3): all, direct or indirect, as `Settings.light_shown`.

        Raises
        ------
        PlaygroundError
            There is no such part of the light.
        """
        if light_shown not in LIGHT_SHOWN:
            raise unknown_name("light_shown", light_shown, LIGHT_SHOWN)
        if light_shown == "all":
            return np.asarray(self.direct + self.indirect)
        return self.direct if light_shown == "direct" else self.indirect

    def image(self, light_shown: str = "all", charts: bool = False) -> Image:
        """The texels as a picture, row 0 on top; ``charts`` paints what is no chart's in grey."""
        pixels = self.texels(light_shown)
        if charts:
            pixels = np.where(self.coverage[..., None], pixels, np.float32(srgb_decode(0.5)))
        return Image(np.ascontiguousarray(pixels[::-1]), coverage=self.coverage[::-1] * 1.0)

    def check_fits(self, scene: Scene) -> None:
        """Raise an error unless this was baked for the geometry of ``scene``."""
        if geometry_checksum(scene) != self.geometry:
            raise PlaygroundError(
                "the lightmap was baked for other geometry",
                got=f"{len(scene.objects)} objects in the scene, "
                f"{len(self.parts)} in the lightmap; meshes or transforms differ",
                fix="Bake it again: playground bake SETUP -o out.toml",
            )

    def save(self, path: str | Path) -> None:
        """Write a .npz file; whatever happens, an old one stays until the new one is whole."""
        from playground.render.lightmap.lightmap_file import save_lightmap

        save_lightmap(self, Path(path))


def geometry_checksum(scene: Scene) -> str:
    """What tells the meshes of a scene and where they stand from others: 64 hexadecimal digits."""
    digest = hashlib.sha256()
    for item in scene.objects:
        geometry = item.geometry()
        for values in (
            geometry.mesh.positions,
            geometry.mesh.faces,
            np.asarray(geometry.offset, dtype=np.float64),
            np.asarray(item.transform.matrix, dtype=np.float64),
        ):
            digest.update(str(values.shape).encode())
            digest.update(np.ascontiguousarray(values).tobytes())
    return digest.hexdigest()


def lighting_checksum(setup: Setup) -> str:
    """What tells lights, and colours that send light on, from others: 64 hexadecimal digits."""
    weights = setup.settings.weights
    black = (0.0, 0.0, 0.0)
    lights = [replace(x, specular=black, ambient=black) for x in setup.scene.lights]
    materials = [
        (m.diffuse, m.emissive, Path(m.texture).name, m.texture_encoding)
        for m in (item.material for item in setup.scene.objects)
    ]
    told = (lights, materials, weights["diffuse"], weights["emissive"])
    return hashlib.sha256(repr(told).encode()).hexdigest()
