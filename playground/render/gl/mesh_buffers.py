"""A mesh on the GPU: uploaded once, in the layout that the shading needs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from playground.render.gl.clusters import Clusters, build_clusters
from playground.scene.mesh import Mesh

if TYPE_CHECKING:
    import moderngl

    from playground.render.gl.program import Program

Columns = dict[str, NDArray[np.float32]]
SMALL = 20_000  # triangles; below, drawing all of them is as fast as choosing


class MeshBuffers:
    """The vertex and index buffers of one mesh, and its clusters if it is large.

    ``flat`` asks for the layout of flat shading, ``texture`` for texture coordinates, and
    ``more`` holds further numbers per vertex by their names in the shader.
    """

    def __init__(
        self,
        context: moderngl.Context,
        mesh: Mesh,
        flat: bool,
        texture: bool,
        more: Columns | None = None,
    ) -> None:
        self._context = context
        self.clusters: Clusters | None = None
        more = dict(more or {})
        if texture and mesh.texcoords is not None:
            more["object_texcoord"] = mesh.texcoords
        if flat:
            columns, faces = _flat_layout(mesh, more)
        else:
            columns = {"object_position": mesh.positions, "object_normal": mesh.normals, **more}
            faces = mesh.faces
            if len(faces) >= SMALL:
                self.clusters = build_clusters(mesh.positions, faces)
                order, faces = self.clusters.vertex_order, self.clusters.faces
                columns = {name: column[order] for name, column in columns.items()}
        self._widths = {name: column.shape[1] for name, column in columns.items()}
        table = np.hstack(list(columns.values()), dtype=np.float32)
        self.vertices = context.buffer(table)
        self.indices = context.buffer(np.ascontiguousarray(faces, dtype=np.uint32))

    def array(self, program: Program) -> moderngl.VertexArray:
        """A new vertex array for ``program``; attributes that it does not use are skipped."""
        parts, names = [], []
        for name, width in self._widths.items():
            used = name in program.attributes
            parts.append(f"{width}f" if used else f"{4 * width}x")
            names += [name] if used else []
        content: list[Any] = [(self.vertices, " ".join(parts), *names)]
        return self._context.vertex_array(program.gl, content, self.indices)

    def release(self) -> None:
        """Free the GPU memory."""
        self.vertices.release()
        self.indices.release()


def _flat_layout(mesh: Mesh, more: Columns) -> tuple[Columns, NDArray[np.int32]]:
    """One vertex per triangle, its last one (the provoking vertex), carries centre and normal.

    The other two corners are borrowed from whichever triangle has a vertex there.
    """
    count = len(mesh.faces)
    owner = np.full(len(mesh.positions), -1, dtype=np.int32)
    owner[mesh.faces[:, 2]] = np.arange(count)

    # Corners that are nobody's last vertex need copies of their own at the end; what those
    # say of a triangle is never read.
    orphans = np.unique(mesh.faces[owner[mesh.faces] < 0])
    owner[orphans] = count + np.arange(len(orphans))
    vertex = np.concatenate([mesh.faces[:, 2], orphans])
    faces = owner[mesh.faces]
    faces[:, 2] = np.arange(count)
    padding = np.zeros((len(orphans), 3))
    columns = {
        **{name: column[vertex] for name, column in more.items()},
        "object_position": mesh.positions[vertex],
        "triangle_centre": np.concatenate([mesh.triangle_centres, padding]).astype(np.float32),
        "triangle_normal": np.concatenate([mesh.triangle_normals, padding]).astype(np.float32),
    }
    return columns, faces
