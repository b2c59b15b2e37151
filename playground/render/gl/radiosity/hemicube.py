"""Form factors by the hemicube on the GPU: many hemicubes in one draw call.

Twin in spirit: `playground.render.radiosity.factor.hemicube`. All five faces of a number of
hemicubes are instances of one draw; the vertex stage moves each to its place in one tall picture,
and clip distances keep it there. Then the delta form factors are added up, by NumPy from the
picture of patch numbers, or by the GPU.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from playground.errors import PlaygroundError
from playground.render.gl.context import rest
from playground.render.gl.program import Program
from playground.render.gl.radiosity.row_buffer import RowBuffer, adds_faster, can_add
from playground.render.gl.source import assemble
from playground.render.radiosity.factor.hemicube_view import (
    BACK,
    Stands,
    Triangulation,
    delta_form_factors,
    drawn_pieces,
    mended,
    row_sums,
    stands,
    triangulation,
    units,
)
from playground.render.radiosity.patch.patches import Parents, Patches
from playground.shading.floats import Array

if TYPE_CHECKING:
    import moderngl

LARGEST_BATCH = 32  # more hemicubes per draw are not faster
PIXELS = LARGEST_BATCH * 3 * 64 * 64  # of a picture
CLIP_DISTANCES = (0x3000, 0x3001)  # GL_CLIP_DISTANCE0 and 1, which moderngl has no name for


class Hemicubes:
    """The hemicubes of one set of patches: uploaded once, asked for rows any number of times.

    Parameters
    ----------
    occlusion : bool
        False counts each patch by itself, as if the others were not there; the GPU must add
        up then.
    resolution : int
        Pixels along an edge of the top; odd ones count as the next even one.
    plain : bool
        Draw each patch, instead of parents in which patches are looked up.
    rotate : bool
        Turn each hemicube about its normal, see `stands`.
    adder : {"auto", "cpu", "gpu"}
        Who adds up; auto takes the GPU where `adds_faster`.

    Raises
    ------
    PlaygroundError
        The resolution is not allowed, or too large for this driver; the GPU must add up
        and cannot.
    """

    def __init__(
        self,
        context: moderngl.Context,
        patches: Patches,
        occlusion: bool = True,
        resolution: int = 64,
        *,
        plain: bool = False,
        rotate: bool = True,
        adder: str = "auto",
    ) -> None:
        self._context, self._patches, self._rotate = context, patches, rotate
        self._deltas = delta_form_factors(resolution)
        self.batch, self.occlusion = _batch(context, self._deltas.shape[1]), occlusion
        self.adds = adder == "gpu" or not occlusion or (adder == "auto" and adds_faster(context))
        if self.adds and not can_add(context):
            raise _cannot_add(context)
        pieces = drawn_pieces(patches, plain)
        mesh = triangulation(pieces, units(patches))
        defines = {
            **_defines(pieces, mesh),
            "BATCH": self.batch,
            "BACK": BACK,
            "PATCHES": len(patches),
        }
        fragment = "items.frag" if occlusion else "unblocked.frag"
        sources = (
            assemble("radiosity/hemicube.vert", defines),
            assemble(f"radiosity/{fragment}", defines),
        )
        self._program = Program(context, sources)
        self._upload(mesh, pieces)
        self._target = _Target(context, self._deltas, self.batch, len(patches))
        self._adder = _Adder(context, defines, self._deltas) if self.adds else None

    def _upload(self, mesh: Triangulation, pieces: Parents) -> None:
        kind = np.column_stack([pieces.first, pieces.grid, pieces.triangle])
        columns = {
            "corner": mesh.positions,
            "corner_normal": mesh.normals,
            "corner_place": mesh.place,
            "corner_piece": np.repeat(kind, 4, axis=0),
            "corner_far": np.repeat(mesh.far, 4, axis=0),
        }
        used = {name: column for name, column in columns.items() if name in self._program.gl}
        table = np.hstack(list(used.values())).astype(np.float32)
        self._vertices = self._context.buffer(table.tobytes())
        self._indices = self._context.buffer(mesh.faces.astype(np.uint32).tobytes())
        widths = " ".join(f"{column.shape[1]}f" for column in used.values())
        content: Any = [(self._vertices, widths, *used)]
        self._array = self._context.vertex_array(self._program.gl, content, self._indices)

    def rows(self, chosen: ArrayLike) -> Array:
        """Rows F_ij of the form-factor matrix for the chosen patches i, (len(chosen), N)."""
        chosen = np.asarray(chosen, dtype=np.int64)
        result = np.empty((len(chosen), len(self._patches)))
        stand = stands(self._patches, chosen, self._rotate)
        for first in range(0, len(chosen), self.batch):
            part = slice(first, min(first + self.batch, len(chosen)))
            result[part] = self._rows(stand, part)
        return result

    def item_buffer(self, patch: int) -> NDArray[np.integer]:
        """What one patch sees, (3N, N): per pixel the number of a patch plus 1, 0 for none.

        Of hemicubes with occlusion only.
        """
        self._draw(stands(self._patches, [patch], self._rotate), slice(0, 1))
        return np.array(mended(self._target.read(1)[0]))

    def _rows(self, stand: Stands, part: slice) -> Array:
        count = part.stop - part.start
        if self._adder is None:
            self._draw(stand, part)
            return row_sums(self._target.read(count), self._deltas, len(self._patches))
        if not self.occlusion:
            self._adder.rows.begin(self._program.gl)
            self._draw(stand, part)
            return self._adder.rows.read(count)
        self._draw(stand, part)
        return self._adder.add(self._target.items, count)

    def _draw(self, stand: Stands, part: slice) -> None:
        """Draw the item buffers of some of the stands; the next call overwrites them."""
        count = part.stop - part.start
        numbers = np.zeros((self.batch, 3, 4))
        numbers[:count, 0, :3], numbers[:count, 0, 3] = stand.centre[part], stand.near[part]
        numbers[:count, 1, :3], numbers[:count, 2, :3] = stand.tangent[part], stand.normal[part]
        self._program.write({"stands": numbers.reshape(-1, 4)})
        context = self._context
        context.enable_only(context.DEPTH_TEST if self.occlusion else context.NOTHING)
        for distance in CLIP_DISTANCES:
            context.enable_direct(distance)
        self._target.begin(count)
        self._array.render(instances=5 * count)
        for distance in CLIP_DISTANCES:
            context.disable_direct(distance)

    def release(self) -> None:
        """Free the GPU memory."""
        rest(self._context)
        for item in (self._array, self._vertices, self._indices, self._target, self._program):
            item.release()
        if self._adder is not None:
            self._adder.release()


class _Target:
    """The tall picture of item buffers, with 16 bits per pixel where these hold all patches."""

    def __init__(self, context: moderngl.Context, deltas: Array, batch: int, patches: int) -> None:
        size = (deltas.shape[1], batch * deltas.shape[0])
        self._kind = "u2" if patches < 2**16 - 1 else "u4"
        self.items = context.texture(size, 1, dtype=self._kind)
        self.items.filter = (context.NEAREST, context.NEAREST)
        self._depth = context.depth_renderbuffer(size)
        self._framebuffer = context.framebuffer([self.items], self._depth)
        dtype = np.uint16 if self._kind == "u2" else np.uint32
        self._read = np.empty((batch, *deltas.shape), dtype=dtype)

    def begin(self, count: int) -> None:
        """Bind, and clear the first item buffers."""
        self._framebuffer.use()
        self._framebuffer.clear(viewport=self._part(count))

    def read(self, count: int) -> NDArray[np.integer]:
        """The first item buffers, (count, 3N, N); the next call overwrites them."""
        read = self._read[:count]
        self._framebuffer.read_into(
            read, viewport=self._part(count), components=1, dtype=self._kind, alignment=1
        )
        return read

    def _part(self, count: int) -> tuple[int, int, int, int]:
        _, height, width = self._read.shape
        return 0, 0, width, count * height

    def release(self) -> None:
        """Free the GPU memory."""
        for item in (self._framebuffer, self.items, self._depth):
            item.release()


class _Adder:
    """The GPU adds up: a pass over all pixels of the item buffers."""

    def __init__(
        self, context: moderngl.Context, defines: dict[str, object], deltas: Array
    ) -> None:
        batch, patches = (int(str(defines[name])) for name in ("BATCH", "PATCHES"))
        self._context, self._batch = context, batch
        self.rows = RowBuffer(context, deltas, batch, patches)
        sources = assemble("trace/screen.vert"), assemble("radiosity/add_items.frag", defines)
        self._program = Program(context, sources)
        self._array = context.vertex_array(self._program.gl, [])
        size = (deltas.shape[1], batch * deltas.shape[0])
        self._unused = context.renderbuffer(size, 1, dtype="f1")  # a framebuffer must have one
        self._framebuffer = context.framebuffer([self._unused])

    def add(self, items: moderngl.Texture, count: int) -> Array:
        """The rows of the first ``count`` item buffers, (count, N)."""
        self._context.enable_only(self._context.NOTHING)
        width, height = self._framebuffer.size
        self._framebuffer.viewport = 0, 0, width, height // self._batch * count
        self._framebuffer.use()
        self.rows.begin(self._program.gl, items)
        self._array.render(vertices=3)
        return self.rows.read(count)

    def release(self) -> None:
        """Free the GPU memory."""
        for item in (self._framebuffer, self._unused, self._array, self._program, self.rows):
            item.release()


def _batch(context: moderngl.Context, resolution: int) -> int:
    """How many hemicubes one picture holds."""
    names = ("GL_MAX_TEXTURE_SIZE", "GL_MAX_RENDERBUFFER_SIZE")
    tallest = min(int(context.info[name]) for name in names)
    tallest = min(tallest, int(context.info["GL_MAX_VIEWPORT_DIMS"][1]))
    if 3 * resolution > tallest:
        raise PlaygroundError(
            "hemicube resolution too large for this driver",
            got=resolution,
            allowed=f"up to {tallest // 6 * 2} pixels",
            fix="Choose a smaller one, or renderer numpy.",
        )
    pixels = 3 * resolution**2
    return max(min(PIXELS // pixels, tallest // (3 * resolution), LARGEST_BATCH), 1)


def _defines(pieces: Parents, mesh: Triangulation) -> dict[str, object]:
    """How patches are found in triangles and in uneven quads: only where there are such."""
    divided = (pieces.grid > 1).any(axis=1)
    uneven = ~pieces.triangle & (mesh.far != 1.0).any(axis=1)
    symbols = {"TRIANGLES": pieces.triangle, "GENERAL_QUADS": uneven}
    return {name: 1 for name, which in symbols.items() if (divided & which).any()}


def _cannot_add(context: moderngl.Context) -> PlaygroundError:
    return PlaygroundError(
        "this driver cannot add up hemicubes",
        got=f"OpenGL {context.version_code / 100:.1f}",
        allowed="OpenGL 4.3 or newer",
        fix="Use renderer numpy for form factors without occlusion.",
    )
