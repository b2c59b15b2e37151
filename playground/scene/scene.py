"""What is lit: objects, lights and a background."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError, unknown_name
from playground.scene.knob import Declared, choice, colour, integer, text
from playground.scene.light import DirectionalLight, Light
from playground.scene.material import Material
from playground.scene.mesh import Mesh
from playground.scene.transform import Transform

MESH_FILES = (".obj", ".ply", ".stl", ".glb", ".gltf")
NO_OFFSET = np.zeros(3)
NO_OFFSET.setflags(write=False)


@dataclass(frozen=True, eq=False)
class Geometry:
    """A mesh and where its origin lies in object space (float64, shape (3,))."""

    mesh: Mesh
    offset: NDArray[np.float64]


@dataclass(frozen=True)
class Object(Declared):
    """One thing of the scene: a mesh, its material, where it stands.

    ``mesh`` names a generator (``sphere``, ``teapot``, ...) or a mesh file; a
    `Mesh` made in Python may stand in ``arrays`` instead.
    """

    label = "object"

    mesh: str = text("sphere", help="a generator, or a mesh file (" + " ".join(MESH_FILES) + ")")
    tessellation: int = integer(
        0, 0, 4096, help="how finely a generator divides its surface; 0 for its own default"
    )
    normals: str = choice(
        "exact",
        ("exact", "smooth", "flat"),
        help="of the generator or file, averaged over the faces, or one per face",
    )
    material: Material = Material()
    transform: Transform = Transform()
    arrays: Mesh | None = field(default=None, compare=True)

    def geometry(self) -> Geometry:
        """The mesh itself, loaded or generated once and then remembered."""
        if self.arrays is not None:
            return _with_normals(Geometry(self.arrays, NO_OFFSET), self.normals)
        return _with_normals(_source(self.mesh, self.tessellation), self.normals)


@dataclass(frozen=True)
class Scene(Declared):
    """Objects under lights, in front of a background (linear RGB)."""

    label = "scene"

    title: str = text("", help="one line that says what is to be seen")
    background: tuple[float, float, float] = colour(0.1, 0.1, 0.12, help="where nothing is hit")
    objects: tuple[Object, ...] = (Object(),)
    lights: tuple[Light, ...] = (DirectionalLight(),)

    def __post_init__(self) -> None:
        super().__post_init__()
        for name, kind in (("objects", Object), ("lights", Light)):
            values = tuple(getattr(self, name))
            for value in values:
                if not isinstance(value, kind):
                    raise PlaygroundError(
                        f"scene.{name} holds something else", got=value, allowed=kind.__name__
                    )
            object.__setattr__(self, name, values)


@lru_cache(maxsize=64)
def _source(mesh: str, tessellation: int) -> Geometry:
    from playground.scene import shapes

    if mesh in shapes.SHAPES:
        return Geometry(shapes.make(mesh, tessellation or None), NO_OFFSET)
    if Path(mesh).suffix.lower() in MESH_FILES:
        from playground.scene.mesh_file import load_mesh

        return Geometry(*load_mesh(Path(mesh)))
    raise unknown_name("mesh", mesh, [*shapes.SHAPES, *(f"FILE{suffix}" for suffix in MESH_FILES)])


@lru_cache(maxsize=64)
def _with_normals(geometry: Geometry, normals: str) -> Geometry:
    if normals == "exact":
        return geometry
    from playground.scene.normals import flat, smooth

    return Geometry((flat if normals == "flat" else smooth)(geometry.mesh), geometry.offset)
