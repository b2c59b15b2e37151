"""The scene as the GPU was last told of it, and how long it has stood still since."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from playground.render.gl.trace.layout import Layout, layout_of
from playground.render.gl.trace.trees import Trees, trees_of
from playground.render.gl.trace.uniforms import Values, scene_values
from playground.render.trace.traced_scene import TracedScene, prepare
from playground.render.view import View, view_of
from playground.scene.camera import Camera
from playground.scene.setup import Setup

STEADY = 8  # frames with the same scene and settings before their numbers become constants
SMALLEST = 1e-3  # solids of at least this radius keep four digits when the eye moves by 1


@dataclass(frozen=True, eq=False)
class Placed:
    """A scene laid out for the GPU in the space of one view."""

    scene: TracedScene
    layout: Layout
    trees: Trees | None
    values: Values

    @property
    def view(self) -> View:
        """The view in whose space everything stands."""
        return self.scene.view

    def media_around(self, setup: Setup) -> int:
        """The media the eye of a setup is in: bit k for medium k of the scene."""
        if setup.camera != self.scene.setup.camera:  # out of all glass, or this would not hold
            return 0
        return sum(1 << k for k, inside in enumerate(self.scene.around_eye) if inside)


class Standing:
    """Places a scene anew at every frame, as exactly as can be, until it has stood still.

    From then on everything stays where it is, and only the eye moves: the numbers of the scene
    are the same from frame to frame, and can be built into a program.
    """

    def __init__(self) -> None:
        self.placed: Placed | None = None
        self.steady = False
        self._frames = 0
        self._seen: tuple[Placed, Camera, tuple[int, int], View] | None = None

    def place(self, setup: Setup, size: tuple[int, int]) -> Placed:
        """The scene of ``setup``, in the space of its own camera or, steady, of an earlier one."""
        before = self.placed.scene.setup if self.placed is not None else None
        same = before is not None and before.scene is setup.scene
        same = same and before is not None and before.settings is setup.settings
        if not same or (self.steady and not self._holds(setup, size)):
            self._frames, self.steady = 0, False
        if self.steady and self.placed is not None:
            return self.placed
        scene = prepare(setup, size)
        layout = layout_of(scene)
        trees = trees_of(scene.solids)
        self.placed = Placed(scene, layout, trees, scene_values(scene, layout, trees))
        self._frames += 1
        self.steady = self._frames > STEADY
        return self.placed

    def view(self, camera: Camera, size: tuple[int, int]) -> View:
        """How a camera sees the scene that is placed; made once for all who ask."""
        assert self.placed is not None
        asked = self.placed, camera, size
        if self._seen is None or self._seen[:3] != asked:
            surfaces = tuple(solid.surface for solid in self.placed.scene.solids)
            self._seen = *asked, view_of(camera, surfaces, size)
        return self._seen[3]

    def _holds(self, setup: Setup, size: tuple[int, int]) -> bool:
        """Whether float32 has digits enough for this camera in the space of an earlier one."""
        assert self.placed is not None
        scene, before = self.placed.scene, self.placed.scene.setup.camera
        camera = setup.camera
        if camera == before:
            return True
        if bool(camera.near or camera.far) != bool(before.near or before.far):
            return False
        view = self.view(camera, size)
        eye = scene.view.relative(view.eye)
        in_glass = any(
            np.linalg.norm(eye - scene.solids[n].ball[0]) <= scene.solids[n].ball[1]
            for n in scene.media.solids
        )
        smallest = min((solid.ball[1] for solid in scene.solids), default=1.0)
        near = 1.0 + float(np.abs(eye).max()) <= smallest / SMALLEST
        return near and not in_glass and 0.25 <= view.scale / scene.view.scale <= 4.0
