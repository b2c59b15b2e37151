"""Light that was computed before, stored with each surface, and surfaces that show it.

What is stored is H, the light that arrives at the front of a surface (its irradiance over π), in
the unit of colours: w_e m_e + w_d m_d ⊗ H is what the surface shows in every direction. Only the
specular term is left to evaluate, by the local model. The ambient term is left out: it stands for
light that is in H.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from playground.render.surface import Surface, surfaces
from playground.scene.mesh import Mesh
from playground.scene.scene import Scene
from playground.scene.settings import Settings
from playground.scene.setup import Setup
from playground.shading.texture import bilinear

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class StoredLight:
    """The light stored for one object: ``light`` per vertex, or ``texels`` and where to find them.

    Parameters
    ----------
    mesh : Mesh
        Drawn in place of the object's own. Only its front shows stored light: nothing arrives
        at a back, which is black.
    light : float32 array of shape (V, 3), optional
        H at the vertices of the mesh.
    texcoords : float32 array of shape (V, 2), optional
        Where in the lightmap the vertices lie; (0, 0) is its lower left corner.
    texels : float32 array of shape (H, W, 3), optional
        The lightmap: H per texel, row 0 at v = 0. Several objects may share it.
    origin : array of shape (3,), optional
        The mesh has the axes of the world, about this point; None if it has the object's own.
    """

    mesh: Mesh
    light: NDArray[np.float32] | None = None
    texcoords: NDArray[np.float32] | None = None
    texels: NDArray[np.float32] | None = None
    origin: Array | None = None

    @property
    def columns(self) -> dict[str, NDArray[np.float32]]:
        """The numbers per vertex, by their names in shaders/stored.vert."""
        columns = {"object_light": self.light, "object_lightmap_texcoord": self.texcoords}
        return {name: column for name, column in columns.items() if column is not None}

    def at(self, interpolate: Callable[[NDArray[np.float32]], Array]) -> Array:
        """H at points (..., 3), given how numbers per vertex (V, C) are interpolated there."""
        if self.texels is not None and self.texcoords is not None:
            return bilinear(self.texels, interpolate(self.texcoords))
        assert self.light is not None
        return interpolate(self.light)


def stored_surfaces(
    scene: Scene, weights: dict[str, float], stored: Sequence[StoredLight | None]
) -> tuple[Surface, ...]:
    """`surfaces` that show stored light, one of ``stored`` for each object of the scene.

    An object that is shrunk to nothing may have None. ``weights`` are those of the four terms.
    After the objects come, as there, the sides of area lights that are to be seen.
    """
    local = surfaces(scene, {**weights, "diffuse": 0.0, "ambient": 0.0})
    shown = [
        _with_light(surface, light, weights["diffuse"] * np.array(item.material.diffuse))
        if light is not None
        else surface
        for surface, light, item in zip(local, stored, scene.objects, strict=False)
    ]
    return (*shown, *local[len(scene.objects) :])


def shown_weights(settings: Settings) -> dict[str, float]:
    """The weights of the four terms in a picture of stored light.

    What emits light and what a lamp makes shine are direct light: of indirect light there is the
    diffuse term alone, so that the pictures of both add up to that of all light.
    """
    if settings.light_shown != "indirect":
        return settings.weights
    return {term: w if term == "diffuse" else 0.0 for term, w in settings.weights.items()}


def shown_background(setup: Setup) -> tuple[float, float, float]:
    """What is seen where nothing is; it has been reflected nowhere, so it is no indirect light."""
    indirect = setup.settings.light_shown == "indirect"
    return (0.0, 0.0, 0.0) if indirect else setup.scene.background


def _with_light(surface: Surface, stored: StoredLight, reflectance: Array) -> Surface:
    surface = replace(surface, mesh=stored.mesh, stored=stored, reflectance=reflectance)
    if stored.origin is None:
        return surface
    still = np.eye(3)
    return replace(
        surface,
        linear=still,
        origin=stored.origin,
        normal_from_object=still,
        mirrored=False,
        stretched=False,
    )
