"""A mesh on the GPU: uploaded once, in the layout that the shading needs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from playground.scene.mesh import Mesh

if TYPE_CHECKING:
    import moderngl

    from playground.render.gl.program import Program

Layout = tuple[dict[str, NDArray[Any]], NDArray[np.int32]]


class MeshBuffers:
    """The vertex and index buffers of one mesh; ``flat`` holds one vertex per triangle too.

    For flat shading each triangle owns its last vertex (the provoking one), which
    carries the triangle's centre and normal; the other two corners are borrowed from
    whichever triangle has a vertex there.
    """

    def __init__(self, context: moderngl.Context, mesh: Mesh, flat: bool, texture: bool) -> None:
        self._context = context
        columns, faces = _flat_layout(mesh) if flat else _smooth_layout(mesh)
        if texture and mesh.texcoords is not None:
            columns["object_texcoord"] = mesh.texcoords[columns.pop("vertex")[:, 0].astype(int)]
        columns.pop("vertex", None)
        self._names = list(columns)
        self._widths = [array.shape[1] for array in columns.values()]
        table = np.hstack(list(columns.values())).astype(np.float32)
        self.vertices = context.buffer(table.tobytes())
        self.indices = context.buffer(faces.astype(np.uint32).tobytes())
        self._arrays: dict[int, moderngl.VertexArray] = {}

    def array(self, program: Program) -> moderngl.VertexArray:
        """The vertex array for ``program``; attributes that it does not use are skipped."""
        found = self._arrays.get(id(program))
        if found is None:
            parts, names = [], []
            for name, width in zip(self._names, self._widths, strict=True):
                used = name in program.attributes
                parts.append(f"{width}f" if used else f"{4 * width}x")
                names += [name] if used else []
            content = [(self.vertices, " ".join(parts), *names)]
            found = self._context.vertex_array(program.gl, content, self.indices)
            self._arrays[id(program)] = found
        return found

    def release(self) -> None:
        """Free the GPU memory."""
        for array in self._arrays.values():
            array.release()
        self.vertices.release()
        self.indices.release()


def _smooth_layout(mesh: Mesh) -> Layout:
    vertex = np.arange(len(mesh.positions))[:, None]
    return {
        "object_position": mesh.positions,
        "object_normal": mesh.normals,
        "vertex": vertex,
    }, mesh.faces


def _flat_layout(mesh: Mesh) -> Layout:
    count = len(mesh.faces)
    owner = np.full(len(mesh.positions), -1, dtype=np.int32)
    owner[mesh.faces[:, 2]] = np.arange(count)

    # Corners that are nobody's last vertex need copies of their own at the end.
    orphans = np.unique(mesh.faces[owner[mesh.faces] < 0])
    owner[orphans] = count + np.arange(len(orphans))
    vertex = np.concatenate([mesh.faces[:, 2], orphans])
    faces = owner[mesh.faces]
    faces[:, 2] = np.arange(count)

    # An orphan is never the last vertex, so what it says of a triangle is not read.
    padding = np.zeros((len(orphans), 3))
    return {
        "object_position": mesh.positions[vertex],
        "triangle_centre": np.concatenate([mesh.triangle_centres, padding]),
        "triangle_normal": np.concatenate([mesh.triangle_normals, padding]),
        "vertex": vertex[:, None],
    }, faces
