"""How a traced scene is laid out for the GPU: solids by kind, materials without repetition.

Decides what the program is made of, and nothing of its numbers.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from playground.errors import PlaygroundError
from playground.render.surface import SurfaceLight
from playground.render.trace.solids import Solid
from playground.render.trace.traced_scene import TracedScene
from playground.shading.floats import Array

KINDS = ("ball", "square", "disc", "oval", "box", "cylinder", "mesh")
MOST_MEDIA = 32  # a ray remembers which it has entered in as many bits
ROUND = 1e-12  # a matrix stretches all directions alike if it does so to this
DUST = 2.0**-30  # a sixty-fourth of the rounding of float32
SLACK = 1e-9  # of the size of the scene: what is less far behind a wall is on it


@dataclass(frozen=True, eq=False)
class Look:
    """What a solid is made of, as a row of the material uniforms.

    ``diffuse`` and ``specular`` are zero for what no light shines upon; ``medium`` counts as in
    `Media` and is −1 where the program need not know.
    """

    diffuse: Array
    specular: Array
    shininess: float
    front: Array
    back: Array
    reflectance: Array
    transmittance: Array
    index: float
    absorption: Array
    medium: int
    texels: object

    @property
    def key(self) -> tuple[object, ...]:
        """Equal for looks that need only one row."""
        colours = (v for k, v in vars(self).items() if isinstance(v, np.ndarray) and k != "texels")
        numbers = (*(colour.tobytes() for colour in colours), self.shininess, self.index)
        return (*numbers, self.medium, id(self.texels))


@dataclass(frozen=True, eq=False)
class Layout:
    """Numbers of solids by kind, the looks, and which look each solid has.

    ``lights`` are (number in the scene, light) by kind, those that shine on something.
    ``blocking`` are the solids that can stand between a light and what it shines upon.
    """

    kinds: dict[str, tuple[int, ...]]
    looks: tuple[Look, ...]
    look: tuple[int, ...]
    lights: dict[str, tuple[tuple[int, SurfaceLight], ...]]
    blocking: frozenset[int]
    nested: bool
    media: int


def layout_of(scene: TracedScene) -> Layout:
    """The layout of a scene made ready for tracing.

    Raises
    ------
    PlaygroundError
        More solids of glass than a ray can remember, see `MOST_MEDIA`.
    """
    tracked = needs_media(scene)
    if tracked and len(scene.media.solids) > MOST_MEDIA:
        raise PlaygroundError(
            "too many solids of glass for the ray tracer on the GPU",
            got=len(scene.media.solids),
            allowed=f"up to {MOST_MEDIA} where they overlap, absorb, or hold the eye",
            fix="Use --renderer numpy.",
        )
    rows: dict[tuple[object, ...], int] = {}
    looks: list[Look] = []
    look = []
    for number, solid in enumerate(scene.solids):
        made = _look(solid, int(scene.media.of_solid[number]) if tracked else -1)
        if made.key not in rows:
            rows[made.key] = len(looks)
            looks.append(made)
        look.append(rows[made.key])
    if not looks:
        looks.append(_NOTHING)
    kinds: dict[str, list[int]] = {kind: [] for kind in KINDS}
    for number, solid in enumerate(scene.solids):
        kinds[kind_of(solid)].append(number)
    lights = _lights(scene)
    return Layout(
        {kind: tuple(numbers) for kind, numbers in kinds.items()},
        tuple(looks),
        tuple(look),
        lights,
        _blocking(scene, lights),
        tracked and len(scene.media.solids) > 1,
        len(scene.media.solids) if tracked else 0,
    )


def kind_of(solid: Solid) -> str:
    """A key of `KINDS`: a sphere that is round and plain is a ball, any other an oval."""
    if solid.kind != "sphere":
        return "square" if solid.kind == "quad" else solid.kind
    gram = solid.matrix.T @ solid.matrix
    even = np.allclose(gram, gram[0, 0] * np.eye(3), rtol=ROUND, atol=ROUND * gram[0, 0])
    return "ball" if even and solid.surface.texels is None else "oval"


def flattened(solid: Solid) -> bool:
    """Whether its matrix has no inverse: then its tree has the corners in the eye's space."""
    back = solid.inverse @ solid.matrix
    return solid.bvh is not None and bool(np.abs(back - np.eye(3)).max() > 0.5)


def without_dust(matrix: Array) -> Array:
    """A matrix (R, C) without what no float32 would notice beside the largest of a row.

    Turned by a right angle, a row has 6e-17 where 0 is meant.
    """
    largest = np.abs(matrix).max(axis=1, keepdims=True)
    return np.where(np.abs(matrix) < DUST * largest, 0.0, matrix)


def needs_media(scene: TracedScene) -> bool:
    """Whether rays must remember what they have entered.

    They need not if no glass absorbs, the eye is in none, all is closed and none overlaps: then
    the side from which a surface is met tells everything.
    """
    glass = [scene.solids[n] for n in scene.media.solids]
    if scene.around_eye.any() or any(solid.absorption.any() for solid in glass):
        return True
    if len(glass) < 2:
        return False
    apart = all(
        np.linalg.norm(a.ball[0] - b.ball[0]) > a.ball[1] + b.ball[1]
        for i, a in enumerate(glass)
        for b in glass[:i]
    )
    return not (apart and all(solid.closed for solid in glass))


def _look(solid: Solid, medium: int) -> Look:
    material, lit = solid.material, solid.object is not None
    black = np.zeros(3)
    return Look(
        diffuse=np.array(material.diffuse) if lit else black,
        specular=np.array(material.specular) if lit else black,
        shininess=material.shininess,
        front=solid.glow[0],
        back=solid.glow[1],
        reflectance=np.array(material.reflectance),
        transmittance=np.array(material.transmittance),
        index=material.index,
        absorption=solid.absorption,
        medium=medium,
        texels=solid.surface.texels if lit else None,
    )


_BLACK = np.zeros(3)
_NOTHING = Look(
    *(_BLACK, _BLACK, 1.0, _BLACK, _BLACK, _BLACK, _BLACK, 1.0, _BLACK), medium=-1, texels=None
)


def _lights(scene: TracedScene) -> dict[str, tuple[tuple[int, SurfaceLight], ...]]:
    found: dict[str, tuple[tuple[int, SurfaceLight], ...]] = {}
    for number in range(len(scene.setup.scene.lights)):
        seen = [s.surface.lights[number] for s in scene.solids if s.object is not None]
        if any(light.diffuse.any() or light.specular.any() for light in seen):
            found[seen[0].kind] = (*found.get(seen[0].kind, ()), (number, seen[0]))
    return found


def _blocking(
    scene: TracedScene, lights: dict[str, tuple[tuple[int, SurfaceLight], ...]]
) -> frozenset[int]:
    """Which solids can cast a shadow: not a flat one that has everything on its front or back."""
    boxes = [_corners(solid) for solid in scene.solids]
    size = max((float(np.abs(box).max()) for box in boxes), default=1.0)
    found = []
    for number, solid in enumerate(scene.solids):
        if solid.kind in ("quad", "disc"):
            normal = solid.surface.normal_from_object[:, 1]
            normal = normal / np.linalg.norm(normal)
            height = float(normal @ solid.centre)
            things = [box @ normal - height for box in boxes]
            sources = _heights(scene, lights, normal, height)
            sides = (
                all(float((sign * x).min()) >= -SLACK * size for x in things)
                and all(sign * x > SLACK * size for x in sources)
                for sign in (1.0, -1.0)
            )
            if any(sides):
                continue
        found.append(number)
    return frozenset(found)


def _heights(
    scene: TracedScene,
    lights: dict[str, tuple[tuple[int, SurfaceLight], ...]],
    normal: Array,
    height: float,
) -> list[float]:
    """How far every light is above a plane: those without a place, by their direction."""
    heights: list[float] = []
    for _, light in (x for kind in lights.values() for x in kind):
        if light.to_light is not None:
            heights.append(float(normal @ light.to_light))
        elif light.corners is not None:
            heights += (scene.view.relative(light.corners) @ normal - height).tolist()
        elif light.position is not None:
            heights.append(float(scene.view.relative(light.position) @ normal) - height)
    return heights


def _corners(solid: Solid) -> Array:
    """Points (N, 3) whose convex hull holds a solid."""
    signs = np.array(np.meshgrid(*[(-1.0, 1.0)] * 3)).reshape(3, -1).T
    if solid.kind == "mesh":
        middle, radius = solid.ball
        return np.asarray(middle + radius * signs)
    local = signs * (1.0, 0.0, 1.0) if solid.kind in ("quad", "disc") else signs
    if kind_of(solid) == "ball":
        return np.asarray(solid.centre + solid.ball[1] * signs)
    return np.asarray(local @ solid.matrix.T + solid.centre)
