"""Trees of boxes that take long to build are built beside the window, before rays are traced."""

from __future__ import annotations

from collections.abc import Sequence

import moderngl

from playground.gui.work.long_work import LongWork, Piece, Pieces
from playground.render.trace.bvh import bvh_of, is_built
from playground.scene.mesh import Mesh
from playground.scene.scene import Scene

LARGE = 100_000  # triangles: the tree of fewer is there within a blink
GREY = bytes((90, 90, 90, 255))


class LargeTrees:
    """The trees of the large meshes of a scene; `growing` asks for them."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._work: LongWork[bool] | None = None
        self._texture: moderngl.Texture | None = None

    def growing(self, scene: Scene) -> bool:
        """Whether a tree is still missing; it is being built then."""
        if self._work is not None:
            self._work.take()
            self._work = None if self._work.done else self._work
        if self._work is None:
            missing = large_meshes(scene)
            self._work = LongWork(built(missing), aside=True) if missing else None
        return self.working

    @property
    def working(self) -> bool:
        """Whether a thread builds."""
        return self._work is not None

    @property
    def texture(self) -> moderngl.Texture:
        """What stands in the place of the picture meanwhile."""
        if self._texture is None:
            self._texture = self._context.texture((1, 1), 4, GREY)
        return self._texture

    def rest(self) -> None:
        """No tree is wanted any more; one that is being built is finished, for later."""
        if self._work is not None:
            self._work.stop()
            self._work = None

    def close(self) -> None:
        """Stop, and free the GPU memory."""
        self.rest()
        if self._texture is not None:
            self._texture.release()
            self._texture = None


def large_meshes(scene: Scene) -> list[Mesh]:
    """The large meshes that have no tree yet."""
    meshes = (item.geometry().mesh for item in scene.objects)
    return [mesh for mesh in meshes if len(mesh.faces) > LARGE and not is_built(mesh)]


def built(meshes: Sequence[Mesh]) -> Pieces[bool]:
    """Build tree after tree; the only item is that all are there."""
    for number, mesh in enumerate(meshes):
        yield Piece(number / len(meshes))
        bvh_of(mesh)
    yield Piece(1.0, True)
