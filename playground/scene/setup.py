"""`Setup` = scene + camera + settings: one frozen value that a picture follows from."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError, shown, unknown_name
from playground.scene.camera import Camera
from playground.scene.knob import knobs
from playground.scene.material import Material
from playground.scene.scene import Object, Scene
from playground.scene.settings import Settings

_PARTS = ("scene", "camera", "settings", "objects", "lights", "name")


@dataclass(frozen=True)
class Setup:
    """Everything a picture follows from. Never changes: `with_` returns a new one."""

    scene: Scene = Scene()
    camera: Camera = Camera()
    settings: Settings = Settings()
    name: str = "untitled"

    def __post_init__(self) -> None:
        """Check that each part is what it must be."""
        kinds = {"scene": Scene, "camera": Camera, "settings": Settings, "name": str}
        for part, kind in kinds.items():
            value = getattr(self, part)
            if not isinstance(value, kind):
                raise PlaygroundError(
                    f"setup.{part} is not valid",
                    got=shown(value),
                    allowed="text" if kind is str else f"a {kind.__name__}",
                )

    def with_(self, **changes: Any) -> Setup:
        """A new setup in which the named quantities have other values.

        Takes the name of any knob of the settings (``shading="per-vertex"``,
        ``terms=("diffuse",)``), of the camera (``eye=(0, 0, 4)``), of the scene
        (``background``), and of a material or ``tessellation`` and ``normals``,
        which then hold for every object (``shininess=20``). Whole parts go by
        ``scene``, ``camera``, ``settings``, ``objects`` and ``lights``.

        Raises
        ------
        PlaygroundError
            A name that is no knob, or a value out of its range.
        """
        setup = self
        parts = {name: changes.pop(name) for name in _PARTS if name in changes}
        whole = {name: parts.pop(name) for name in ("objects", "lights") if name in parts}
        setup = replace(setup, **parts) if parts else setup
        if whole:
            setup = replace(setup, scene=replace(setup.scene, **whole))

        # Sort the knobs by the part that declares them.
        by_part: dict[str, dict[str, Any]] = {}
        for name, value in changes.items():
            by_part.setdefault(owner_of(name, _PARTS)[0], {})[name] = value
        for part in ("scene", "camera", "settings"):
            if part in by_part:
                setup = replace(setup, **{part: replace(getattr(setup, part), **by_part[part])})
        for part in ("material", "object"):
            if part in by_part:
                setup = setup._every_object(part, by_part[part])
        return setup

    def _every_object(self, part: str, changes: dict[str, Any]) -> Setup:
        def changed(item: Object) -> Object:
            if part == "material":
                return replace(item, material=replace(item.material, **changes))
            return replace(item, **changes)

        return self.with_(objects=tuple(changed(item) for item in self.scene.objects))

    def bounds(self) -> tuple[NDArray[np.float64], float]:
        """Centre (3,) and radius of a ball that holds every object, in world units."""
        return self._bounds

    @cached_property
    def _bounds(self) -> tuple[NDArray[np.float64], float]:
        balls = [item.ball for item in self.scene.objects]
        if not balls:
            return np.zeros(3), 1.0
        low = np.min([centre - radius for centre, radius in balls], axis=0)
        high = np.max([centre + radius for centre, radius in balls], axis=0)
        centre = (low + high) / 2
        centre.setflags(write=False)
        radius = max(float(np.linalg.norm(c - centre)) + r for c, r in balls)
        return centre, radius or 1.0

    def framed(self, direction: Iterable[float] | None = None) -> Setup:
        """The same setup with the camera moved back until every object is in view."""
        centre, radius = self.bounds()
        camera = self.camera
        if direction is None:
            direction = np.subtract(camera.eye, camera.target)
        away = np.asarray(tuple(direction), dtype=np.float64)
        away = away / np.linalg.norm(away)
        distance = 1.05 * radius / np.sin(np.radians(camera.fov) / 2)
        eye = centre + distance * away
        return replace(
            self,
            camera=replace(camera, eye=_triple(eye), target=_triple(centre), near=0.0, far=0.0),
        )


def _triple(point: NDArray[np.float64]) -> tuple[float, float, float]:
    return float(point[0]), float(point[1]), float(point[2])


def owner_of(name: str, others: Iterable[str] = ()) -> tuple[str, type]:
    """The part of a setup whose knob ``name`` is: its name and its class.

    ``others`` are names that are allowed where it is asked, besides knobs.
    """
    for part, declared in _OWNERS.items():
        if name in knobs(declared):
            return part, declared
    every = [key for declared in _OWNERS.values() for key in knobs(declared)]
    raise unknown_name("quantity", name, [*every, *others])


_OWNERS: dict[str, type] = {
    "settings": Settings,
    "camera": Camera,
    "material": Material,
    "object": Object,
    "scene": Scene,
}
