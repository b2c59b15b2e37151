"""Lines over the picture that know its depth: edges of triangles, and normals.

They are drawn by GL into the picture itself, so what lies behind a surface stays hidden.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import moderngl
import numpy as np
from numpy.typing import NDArray

from playground.gui.picture.gizmo_math import seen, surfaces_of
from playground.gui.radiosity.patch_lines import PatchLines
from playground.render.surface import Surface
from playground.render.trace.bvh import bvh_of
from playground.render.view import View
from playground.scene.mesh import Mesh
from playground.scene.normals import weld
from playground.scene.setup import Setup
from playground.shading.vector import unit

Array = NDArray[np.float64]
MOST_EDGES = 200_000  # of one mesh; beyond, every pixel would be an edge
MOST_NORMALS = 1500  # of one kind; more would be fur
LENGTH = 0.07  # of a normal, in radii of the scene
NEARER = 0.996  # of the distance from the eye: lines lie just above their surface
KEPT = 16  # meshes whose edges stay on the GPU
COLOURS = {
    "wireframe": (1.0, 1.0, 1.0, 0.38),
    "vertex normals": (0.25, 0.80, 1.0, 1.0),
    "face normals": (1.0, 0.35, 0.85, 1.0),
    "boxes": (0.95, 0.65, 0.10, 0.8),
    "patches": (0.55, 0.90, 1.0, 0.5),
    "shooters": (1.0, 0.85, 0.0, 0.6),
}
VERTEX = """#version 330
uniform mat4 clip_from_eye;
uniform mat4 eye_from_object;
uniform float nearer;
in vec3 position;
void main() {
    // Towards the eye, which is the origin: the same pixel, a little less depth.
    vec3 place = nearer * (eye_from_object * vec4(position, 1.0)).xyz;
    gl_Position = clip_from_eye * vec4(place, 1.0);
}
"""
FRAGMENT = """#version 330
uniform vec4 colour;
out vec4 shown;
void main() { shown = colour; }
"""


@dataclass(frozen=True)
class Marks:
    """Which lines a picture carries."""

    wireframe: bool = False
    vertex_normals: bool = False
    face_normals: bool = False
    boxes: tuple[int, int] | None = None  # of which object, and of which level of its tree
    patches: PatchLines | None = None  # those of radiosity

    def __bool__(self) -> bool:
        lines = self.wireframe or self.vertex_normals or self.face_normals
        return lines or self.boxes is not None or self.patches is not None


NO_MARKS = Marks()


@lru_cache(maxsize=KEPT)
def edges(mesh: Mesh) -> NDArray[np.int32]:
    """Every edge of a mesh once, as pairs of vertex numbers (E, 2)."""
    place = weld(mesh.positions)[mesh.faces].astype(np.int64)
    after = np.roll(place, -1, axis=1)
    low, high = np.minimum(place, after).ravel(), np.maximum(place, after).ravel()
    _, first = np.unique(low * len(mesh.positions) + high, return_index=True)
    ends = np.stack([mesh.faces.ravel(), np.roll(mesh.faces, -1, axis=1).ravel()], axis=1)
    return np.asarray(ends[few(first, MOST_EDGES)], dtype=np.int32)


def few(values: NDArray[np.intp], most: int) -> NDArray[np.intp]:
    """At most ``most`` of the values, evenly chosen."""
    if len(values) <= most:
        return values
    return values[np.linspace(0, len(values) - 1, most).astype(np.intp)]


def normal_lines(surface: Surface, length: float, faces: bool) -> Array:
    """World segments (K, 2, 3) along the normals of vertices or of triangles."""
    mesh = surface.mesh
    points = mesh.triangle_centres if faces else mesh.positions
    normals = mesh.triangle_normals if faces else mesh.normals
    chosen = few(np.arange(len(points)), MOST_NORMALS)
    start = points[chosen] @ surface.linear.T + surface.origin
    along = unit(normals[chosen] @ surface.normal_from_object.T)
    return np.stack([start, start + length * along], axis=1)


@lru_cache(maxsize=4)
def box_lines(mesh: Mesh, level: int) -> NDArray[np.float32]:
    """The edges of the boxes at a level of the tree of a mesh, pairs of places (24 N, 3).

    Of a level below the lowest, those of the lowest.
    """
    bvh = bvh_of(mesh)
    low, high = bvh.level(min(level, bvh.depth - 1)) if bvh.nodes else (np.zeros((0, 3)),) * 2
    ends = np.stack([low, high], axis=1)
    corner = np.array([[(i >> axis) & 1 for axis in range(3)] for i in range(8)])
    places = np.stack([ends[:, corner[:, axis], axis] for axis in range(3)], axis=2)
    pairs = [(i, i | 1 << axis) for i in range(8) for axis in range(3) if not i >> axis & 1]
    return np.ascontiguousarray(places[:, np.ravel(pairs)].reshape(-1, 3), dtype=np.float32)


class LineArt:
    """Draws the marks of a setup over the picture that is bound, which has its depth."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._program = context.program(vertex_shader=VERTEX, fragment_shader=FRAGMENT)
        self._edges: dict[int, tuple[Mesh, moderngl.VertexArray, list[moderngl.Buffer]]] = {}

    def draw(self, setup: Setup, marks: Marks, size: tuple[int, int]) -> None:
        """Draw the marks of ``setup`` into the bound framebuffer, upside down as all pictures."""
        view = seen(setup.scene, setup.camera, size)
        clip = view.clip_from_eye.copy()
        clip[1] *= -1.0
        self._write("clip_from_eye", clip)
        self._program["nearer"].value = NEARER  # type: ignore[union-attr]
        context = self._context
        context.enable_only(moderngl.DEPTH_TEST | moderngl.BLEND)
        # The alpha of a picture stays 1, or the window would shine through.
        over = moderngl.SRC_ALPHA, moderngl.ONE_MINUS_SRC_ALPHA
        context.blend_func = (*over, moderngl.ONE, moderngl.ONE)  # type: ignore[assignment]
        everything = surfaces_of(setup.scene)
        if marks.wireframe:
            self._write("colour", COLOURS["wireframe"])
            for surface in everything:
                self._write("eye_from_object", view.eye_from_object(surface))
                self._wires(surface.mesh).render(moderngl.LINES)
        if marks.boxes is not None and marks.boxes[0] < len(setup.scene.objects):
            surface = everything[marks.boxes[0]]
            self._write("eye_from_object", view.eye_from_object(surface))
            self._lines(box_lines(surface.mesh, marks.boxes[1]), "boxes")
        self._write("eye_from_object", np.eye(4))
        for on, name in (
            (marks.vertex_normals, "vertex normals"),
            (marks.face_normals, "face normals"),
        ):
            if on:
                self._normals(everything, view, setup.bounds()[1], name)
        if marks.patches is not None:
            places = view.relative(marks.patches.edges), view.relative(marks.patches.triangles)
            self._lines(places[0].astype(np.float32), "patches")
            self._lines(places[1].astype(np.float32), "shooters", moderngl.TRIANGLES)
        context.blend_func = over
        context.enable_only(moderngl.DEPTH_TEST)

    def _normals(
        self, everything: tuple[Surface, ...], view: View, radius: float, name: str
    ) -> None:
        length = LENGTH * radius
        lines = [normal_lines(surface, length, name == "face normals") for surface in everything]
        if not lines:
            return
        places = view.relative(np.concatenate(lines).reshape(-1, 3))
        self._lines(places.astype(np.float32), name)

    def _lines(self, places: NDArray[np.float32], name: str, kind: int = moderngl.LINES) -> None:
        """Segments between pairs of places (2 N, 3), or triangles of three."""
        if len(places) == 0:
            return
        self._write("colour", COLOURS[name])
        buffer = self._context.buffer(places.tobytes())
        array = self._context.vertex_array(self._program, [(buffer, "3f", "position")])
        array.render(kind)
        array.release()
        buffer.release()

    def _wires(self, mesh: Mesh) -> moderngl.VertexArray:
        if id(mesh) not in self._edges:
            for number in list(self._edges)[: -KEPT + 1]:
                self._free(number)
            places = self._context.buffer(mesh.positions.tobytes())
            pairs = self._context.buffer(edges(mesh).tobytes())
            content = [(places, "3f", "position")]
            array = self._context.vertex_array(self._program, content, index_buffer=pairs)
            self._edges[id(mesh)] = mesh, array, [places, pairs]
        return self._edges[id(mesh)][1]

    def _write(self, name: str, value: object) -> None:
        array = np.asarray(value, dtype=np.float32)
        self._program[name].write(np.ascontiguousarray(array.T).tobytes())  # type: ignore[union-attr]

    def _free(self, number: int) -> None:
        _, array, buffers = self._edges.pop(number)
        array.release()
        for buffer in buffers:
            buffer.release()

    def release(self) -> None:
        """Free the GPU memory."""
        for number in list(self._edges):
            self._free(number)
        self._program.release()
