"""What is lit: objects, lights and a background."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError, shown, unknown_name
from playground.files import Stamp, stamp
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

    def __post_init__(self) -> None:
        super().__post_init__()
        kinds = {"material": Material, "transform": Transform, "arrays": Mesh | None}
        for name, kind in kinds.items():
            value = getattr(self, name)
            if not isinstance(value, kind):
                allowed = "a Mesh or None" if name == "arrays" else f"a {name.capitalize()}"
                raise PlaygroundError(
                    f"object.{name} is not valid", got=shown(value), allowed=allowed
                )

    def geometry(self) -> Geometry:
        """The mesh itself, loaded or generated once and then remembered.

        A file is read as it is at the first call: an object never changes.
        """
        return self._geometry

    @cached_property
    def _geometry(self) -> Geometry:
        if self.arrays is not None:
            return Geometry(_with_normals(self.arrays, self.normals), NO_OFFSET)
        file = Path(self.mesh)
        state = stamp(file) if file.suffix.lower() in MESH_FILES else None
        source = _source(self.mesh, self.tessellation, state)
        return Geometry(_with_normals(source.mesh, self.normals), source.offset)

    @cached_property
    def ball(self) -> tuple[NDArray[np.float64], float]:
        """Centre (3,) and radius of a ball around the object, in world units."""
        geometry, matrix = self.geometry(), self.transform.matrix
        linear = matrix[:3, :3]
        centre = linear @ (geometry.mesh.centre + geometry.offset) + matrix[:3, 3]
        centre.setflags(write=False)
        stretch = float(np.linalg.norm(linear, 2)) if np.any(linear) else 0.0
        return centre, geometry.mesh.radius * stretch


@dataclass(frozen=True)
class Scene(Declared):
    """Objects under lights, in front of a background (linear RGB)."""

    label = "scene"

    title: str = text("", help="one line that says what is to be seen")
    background: tuple[float, float, float] = colour(0.1, 0.1, 0.12, help="where nothing is hit")
    lightmap: str = text(help="file of baked light, for the method lightmap; empty for none")
    objects: tuple[Object, ...] = (Object(),)
    lights: tuple[Light, ...] = (DirectionalLight(),)

    def __post_init__(self) -> None:
        super().__post_init__()
        for name, kind in (("objects", Object), ("lights", Light)):
            values = getattr(self, name)
            if not isinstance(values, Iterable):
                raise PlaygroundError(
                    f"scene.{name} is not a list",
                    got=shown(values),
                    allowed=f"any number of {kind.__name__} values in a list or tuple",
                    fix=f"Write {name}=[{kind.__name__.lower()}].",
                )
            values = tuple(values)
            for value in values:
                if not isinstance(value, kind):
                    raise PlaygroundError(
                        f"scene.{name} holds something else",
                        got=shown(value),
                        allowed=kind.__name__,
                    )
            object.__setattr__(self, name, values)


_given: dict[tuple[str, Stamp], Geometry] = {}


def give(mesh: str, state: Stamp, geometry: Geometry) -> None:
    """Take ``geometry`` for what is in a mesh file of this name and state: it was read apart."""
    _given[mesh, state] = geometry


@lru_cache(maxsize=64)
def _source(mesh: str, tessellation: int, state: Stamp | None) -> Geometry:
    """The mesh of a name; ``state`` tells a file that has changed from what it was."""
    from playground.scene import shapes

    if state is not None and (mesh, state) in _given:
        return _given.pop((mesh, state))
    if mesh in shapes.SHAPES:
        return Geometry(shapes.make(mesh, tessellation or None), NO_OFFSET)
    if Path(mesh).suffix.lower() in MESH_FILES:
        from playground.scene.mesh_file import load_mesh

        return Geometry(*load_mesh(Path(mesh)))
    raise unknown_name("mesh", mesh, [*shapes.SHAPES, *(f"FILE{suffix}" for suffix in MESH_FILES)])


@lru_cache(maxsize=64)
def _with_normals(mesh: Mesh, normals: str) -> Mesh:
    if normals == "exact":
        return mesh
    from playground.scene.normals import flat, smooth

    return flat(mesh) if normals == "flat" else smooth(mesh)
