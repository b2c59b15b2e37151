"""Form factors by the hemicube, drawn with the rasteriser of the oracle: no GL at all.

Every face of every hemicube is a small picture of what the patch sees; many of them are drawn
at once, one above another. Only pixels whose centre lies on the border of two patches,
to within the rounding of positions, differ from the GPU's.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike, NDArray

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
from playground.render.raster import coverage, depth
from playground.render.raster.clip import NEAR, clip_triangles
from playground.shading.floats import Array
from playground.shading.hemicube import face_coordinates, place_on_quad

Ints = NDArray[np.int64]

PIXELS = 2**18  # of the hemicubes that are drawn together
CORNERS = 2**18  # that are carried into faces at a time

# x and y are within ±w on the top; of a side only what is above the horizon counts.
ACROSS = [[1.0, 0.0, 0.0, 1.0], [-1.0, 0.0, 0.0, 1.0], [0.0, -1.0, 0.0, 1.0]]
TOP = np.vstack([NEAR, ACROSS, [[0.0, 1.0, 0.0, 1.0]]])
SIDE = np.vstack([NEAR, ACROSS, [[0.0, 1.0, 0.0, 0.0]]])


def hemicube(
    patches: Patches, chosen: ArrayLike, occlusion: bool = True, resolution: int = 64
) -> Array:
    """Rows F_ij of the form-factor matrix for the chosen patches i, (len(chosen), N).

    `Hemicubes` says what the arguments mean, and keeps what several calls have in common.
    """
    return Hemicubes(patches, occlusion, resolution).rows(chosen)


class Hemicubes:
    """The hemicubes of one set of patches, asked for rows any number of times.

    Parameters
    ----------
    occlusion : bool
        False counts each patch by itself, as if the others were not there.
    resolution : int
        Pixels along an edge of the top; each side has half as many rows. Odd ones count as the
        next even one.
    plain : bool
        Draw each patch, instead of parents in which patches are looked up.
    rotate : bool
        Turn each hemicube about its normal, see `stands`.

    A hemicube looks from one point, the centre of its patch: for patches that are near or touch it
    the result is the factor from that point, whatever the resolution. Back faces block, and
    belong to no patch.

    Raises
    ------
    PlaygroundError
        The resolution is not allowed.

    References
    ----------
    Cohen & Greenberg, The Hemi-Cube, SIGGRAPH 1985.
    """

    def __init__(
        self,
        patches: Patches,
        occlusion: bool = True,
        resolution: int = 64,
        *,
        plain: bool = False,
        rotate: bool = True,
    ) -> None:
        self._patches, self._occlusion, self._rotate = patches, occlusion, rotate
        self._deltas = delta_form_factors(resolution)
        self._scene = _Scene(patches, plain)

    def rows(self, chosen: ArrayLike) -> Array:
        """Rows F_ij of the form-factor matrix for the chosen patches i, (len(chosen), N)."""
        chosen, count = np.asarray(chosen, dtype=np.int64), len(self._patches)
        result = np.empty((len(chosen), count))
        corners = len(self._scene.mesh.positions)
        step = max(min(PIXELS // self._deltas.size, CORNERS // corners), 1)
        for first in range(0, len(chosen), step):
            part = slice(first, first + step)
            stand = stands(self._patches, chosen[part], self._rotate)
            if self._occlusion:
                items = self._scene.items(stand, self._deltas.shape[1])
                result[part] = row_sums(items, self._deltas, count)
            else:
                result[part] = self._scene.unblocked(stand, self._deltas, count)
        return result

    def item_buffer(self, patch: int) -> NDArray[np.int32]:
        """What one patch sees, (3N, N): per pixel the number of a patch plus 1, 0 for none.

        `playground.render.radiosity.factor.hemicube_view` says how the faces lie in it, and unfolds
        them.
        """
        stand = stands(self._patches, [patch], self._rotate)
        return np.asarray(mended(self._scene.items(stand, self._deltas.shape[1])[0]))


class _Scene:
    """The pieces that are drawn, ready for any number of hemicubes."""

    def __init__(self, patches: Patches, plain: bool) -> None:
        self.pieces: Parents = drawn_pieces(patches, plain)
        self.mesh: Triangulation = triangulation(self.pieces, units(patches))
        self.of = self.mesh.faces[:, 0] // 4  # the piece of each triangle
        self.divided = bool((self.pieces.grid > 1).any())

    def items(self, stand: Stands, resolution: int) -> NDArray[np.int32]:
        """The item buffers of all stands, (K, 3R, R)."""
        count = len(stand.centre)
        items = np.zeros(count * 3 * resolution**2, dtype=np.int32)
        nearest = np.ones(len(items))
        for seen in self._faces(stand, resolution):
            for pixel, piece, x, y in seen.fragments():
                z = seen.depth_at(piece, x, y)
                won = depth.keep_nearest(nearest, pixel, z)
                items[pixel[won]] = self._item(seen, piece[won], x[won], y[won])
        return items.reshape(count, 3 * resolution, resolution)

    def unblocked(self, stand: Stands, deltas: Array, patches: int) -> Array:
        """Rows (K, N) without a depth test: every fragment counts."""
        count, resolution = len(stand.centre), deltas.shape[1]
        rows = np.zeros(count * (patches + 1))
        for seen in self._faces(stand, resolution):
            for pixel, piece, x, y in seen.fragments():
                hemicube, place = np.divmod(pixel, deltas.size)
                slot = hemicube * (patches + 1) + self._item(seen, piece, x, y)
                rows += np.bincount(slot, deltas.ravel()[place], minlength=len(rows))
        return rows.reshape(count, patches + 1)[:, 1:]

    def _faces(self, stand: Stands, resolution: int) -> Iterator[_Seen]:
        """The triangles as the faces of all hemicubes see them: first the tops, then the sides."""
        relative = self.mesh.positions - stand.centre[:, None]
        behind = np.einsum("kvi,vi->kv", relative, self.mesh.normals)[:, self.mesh.faces[:, 0]] > 0
        local = np.einsum("kij,kvj->kvi", stand.axes, relative)
        for faces in (range(1), range(1, 5)):
            view = np.stack([face_coordinates(local, face) for face in faces], axis=1)
            away = view[..., 2]
            ahead = away - 2.0 * stand.near[:, None, None]  # the near plane is z = −w
            clip = np.stack([view[..., 0], view[..., 1], ahead, away], axis=-1)
            yield _Seen(clip, self.mesh.faces, behind, resolution)

    def _item(self, seen: _Seen, piece: Ints, x: Array, y: Array) -> Ints:
        """The patch of each fragment plus 1, 0 for the back of one."""
        source = seen.triangle[piece]
        parent = self.of[source]
        patch = self.pieces.first[parent]
        if self.divided:
            weights = seen.weights_at(piece, x, y)
            place = np.einsum("fc,fcx->fx", weights, self.mesh.place[self.mesh.faces[source]])
            s, t = self._on_piece(place, parent).T
            patch = self.pieces.patch_at(parent, s, t)
        return np.where(seen.behind[piece], 0, patch + 1)

    def _on_piece(self, place: Array, parent: NDArray[np.integer]) -> Array:
        """The (s, t) of points on their pieces, moved inside where rounding put them outside."""
        far, triangle = self.mesh.far[parent], self.pieces.triangle[parent]
        inside = np.clip(place, 0.0, None)
        total = np.sum(inside, axis=1, keepdims=True)
        on_triangle = inside * np.minimum(1.0, (1.0 - 1e-12) / np.maximum(total, 0.5))
        on_quad = np.clip(place_on_quad(place, np.where(triangle[:, None], 1.0, far)), 0.0, 1.0)
        return np.where(triangle[:, None], on_triangle, on_quad)


class _Seen:
    """Triangles cut to some faces of K hemicubes, and moved to their places in the picture.

    ``clip`` (K, faces, V, 4) are the vertices, one face for the top, four for the sides;
    ``behind`` (K, T) tells which triangles are seen from behind.
    """

    def __init__(
        self, clip: Array, faces: NDArray[np.int32], behind: NDArray[np.bool_], resolution: int
    ) -> None:
        hemicubes, count, vertices, _ = clip.shape
        top = count == 1
        copies = np.arange(hemicubes * count)[:, None, None]
        index = (faces + vertices * copies).reshape(-1, 3).astype(np.int64)
        cut = clip_triangles(clip.reshape(-1, 4), index, TOP if top else SIDE)
        xy, corner_depth = coverage.to_window(cut.position, (resolution, resolution))

        # Rows count upwards here, from the bottom of the top or the horizon of a side.
        copy = cut.source // len(faces)
        first = copy // count * 3 * resolution
        first += 0 if top else resolution + copy % count * (resolution // 2)
        xy[..., 1] = first[:, None] + (resolution if top else resolution / 2) - xy[..., 1]

        fixed = coverage.snap(xy)
        some = np.flatnonzero(coverage.doubled_area(fixed) != 0)
        self._size = (resolution, 3 * resolution * hemicubes)
        self._fixed = fixed[some]
        self._corner = depth.interpolation_corners(xy[some], self._fixed)
        self._plane = depth.depth_plane(self._corner, corner_depth[some])
        self._one_over_w = 1.0 / cut.position[some, :, 3]
        self._weights = cut.weights[some]
        self.triangle = cut.source[some] % len(faces)
        self.behind = behind[copy[some] // count, self.triangle]

    def fragments(self) -> Iterator[tuple[Ints, Ints, Array, Array]]:
        """Covered pixels in batches: number in the picture, piece, and the pixel's centre."""
        for spans in coverage.cover(self._fixed, self._size):
            for piece, column, row in coverage.expand(spans):
                yield row * self._size[0] + column, piece, column + 0.5, row + 0.5

    def depth_at(self, piece: Ints, x: Array, y: Array) -> Array:
        """What the depth test compares, 1 − near/w; of backs a little more, see `BACK`."""
        z = depth.depth_at(self._plane, piece, x, y)
        return np.where(self.behind[piece], 1.0 - (1.0 - z) / BACK, z)

    def weights_at(self, piece: Ints, x: Array, y: Array) -> Array:
        """Perspective-correct weights (F, 3) of the triangle's own corners."""
        weights = depth.window_weights(self._corner[piece], self._one_over_w[piece], x, y)
        return np.asarray(np.einsum("fk,fki->fi", weights, self._weights[piece]))
