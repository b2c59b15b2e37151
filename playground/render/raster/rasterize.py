"""Draw meshes into a frame: per pixel the triangle seen, its depth and its weights.

The frame is a *visibility buffer*: no colour, only who is seen where. Whatever a shading formula
needs at a pixel (position, normal, colour, texture coordinates) is
``sum(weights * attribute[faces[triangle]])``, perspective-correct, so that the same frame serves
every attribute and every formula.

References
----------
Burns & Hunt, The visibility buffer: a cache-friendly approach to deferred shading, JCGT 2(2), 2013.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError, unknown_name
from playground.render.raster import coverage, depth
from playground.render.raster.clip import Bools, Floats, Ints, clip_triangles, frustum_planes

Cull = Literal["back", "front"]

BLOCK = 2**15  # triangles set up at a time: about 20 MB, whatever the size of the mesh
MAX_SIDE = 2**15  # pixels; keeps edge functions within int64, see clip.GUARD_PIXELS


@dataclass(frozen=True)
class Frame:
    """What is seen at each pixel; row 0 on top. All arrays are C-contiguous.

    Attributes
    ----------
    depth : (h, w) float64
        (z/w + 1) / 2 of the nearest fragment; 1 where nothing was drawn.
    triangle : (h, w) int32
        Row of `faces` of the object seen; -1 where nothing was drawn.
    object : (h, w) int32
        `object_id` of the object seen; -1 where nothing was drawn.
    weights : (h, w, 3) float64
        Perspective-correct barycentric weights in that triangle; their sum is 1 (0: nothing).
    front : (h, w) bool
        True where the triangle is seen counter-clockwise.
    """

    depth: Floats
    triangle: NDArray[np.int32]
    object: NDArray[np.int32]
    weights: Floats
    front: Bools

    @classmethod
    def empty(cls, size: tuple[int, int]) -> Frame:
        """A frame of size (width, height) with nothing drawn."""
        width, height = size
        return cls(
            np.ones((height, width)),
            np.full((height, width), -1, dtype=np.int32),
            np.full((height, width), -1, dtype=np.int32),
            np.zeros((height, width, 3)),
            np.zeros((height, width), dtype=np.bool_),
        )

    @property
    def size(self) -> tuple[int, int]:
        """(width, height) in pixels."""
        return self.depth.shape[1], self.depth.shape[0]

    @property
    def drawn(self) -> Bools:
        """(h, w) bool: something is seen there."""
        return self.triangle >= 0


@dataclass(frozen=True)
class _Pieces:
    """Triangles after clipping that may be seen, ready to interpolate; K in number."""

    source: Ints  # (K,) row of faces
    xy: Floats  # (K, 3, 2) window corners, unrounded
    fixed: Ints  # (K, 3, 2) window corners in 1/256 pixel
    depth: Floats  # (K, 3)
    one_over_w: Floats  # (K, 3)
    weights: Floats  # (K, 3, 3) of the corners in the source triangle
    cut: Bools  # (K,) False: the weights are the identity
    front: Bools  # (K,)

    def __getitem__(self, chosen: Bools) -> _Pieces:
        return _Pieces(*(getattr(self, name)[chosen] for name in self.__dataclass_fields__))


def rasterize(
    clip: Floats,
    faces: NDArray[np.integer],
    size: tuple[int, int],
    cull: Cull | None = None,
    out: Frame | None = None,
    object_id: int = 0,
    offset: tuple[float, float] = (0.5, 0.5),
) -> Frame:
    """Draw one mesh; into `out`, if given, which is how several objects meet in one frame.

    Parameters
    ----------
    clip : (N, 4) float64
        Vertices in clip space (projection · view · model · position).
    faces : (M, 3) int
        Triangles, in draw order: at equal depth the earlier one stays (GL_LESS).
    size : (width, height) in pixels
    cull : None, "back" or "front"
        Faces to leave out; front is counter-clockwise in NDC.
    out : Frame, optional
        Drawn into and returned.
    object_id : int
        Written to `Frame.object`.
    offset : (dx, dy)
        The sample within its pixel, 0 <= d < 1, rounded to 1/256; for anti-aliasing.

    Raises
    ------
    PlaygroundError
        For a size, offset or name that is not allowed, or an `out` of another size.
    """
    _check(size, cull, offset)
    frame = Frame.empty(size) if out is None else out
    if frame.size != tuple(size):
        raise PlaygroundError("out must have the given size", got=frame.size, allowed=str(size))
    for start in range(0, len(faces), BLOCK):
        pieces = _set_up(clip, faces[start : start + BLOCK], size, cull)
        _draw(frame, pieces, start, object_id, offset)
    return frame


def _check(size: tuple[int, int], cull: str | None, offset: tuple[float, float]) -> None:
    if not all(1 <= side <= MAX_SIDE for side in size):
        raise PlaygroundError("size out of range", got=size, allowed=f"1 to {MAX_SIDE} pixels")
    if cull not in (None, "back", "front"):
        raise unknown_name("cull", cull, ("back", "front", "None"))
    if not all(0 <= d < 1 - 0.5 / coverage.SUBPIXELS for d in offset):
        raise PlaygroundError("offset must lie inside the pixel", got=offset, allowed="0 to 0.998")


def _set_up(
    clip: Floats, faces: NDArray[np.integer], size: tuple[int, int], cull: Cull | None
) -> _Pieces:
    """Clip, project and round triangles; leave out those culled."""
    clip = np.asarray(clip, dtype=np.float64)
    clipped = clip_triangles(clip, faces.astype(np.int64), frustum_planes(size))
    xy, corner_depth = coverage.to_window(clipped.position, size)
    fixed = coverage.snap(xy)
    area = coverage.doubled_area(fixed)
    pieces = _Pieces(
        source=clipped.source,
        xy=xy,
        fixed=fixed,
        depth=corner_depth,
        one_over_w=1.0 / clipped.position[..., 3],
        weights=clipped.weights,
        cut=clipped.cut,
        front=area < 0,
    )
    if cull is None:
        return pieces
    return pieces[area <= 0 if cull == "back" else area >= 0]


def _draw(
    frame: Frame, pieces: _Pieces, first: int, object_id: int, offset: tuple[float, float]
) -> None:
    """Cover, interpolate, test: batch by batch, the frame's depth always up to date."""
    sample = coverage.sample_position(offset)
    dx, dy = sample / coverage.SUBPIXELS
    _, _, some = coverage.pixel_bounds(pieces.fixed, frame.size, sample)
    pieces = pieces[some & (coverage.doubled_area(pieces.fixed) != 0)]
    corner = depth.interpolation_corners(pieces.xy, pieces.fixed)
    plane = depth.depth_plane(corner, pieces.depth)
    width, height = frame.size
    for spans in coverage.cover(pieces.fixed, (width, height), offset):
        for piece, column, row in coverage.expand(spans):
            pixel = row * width + column
            x, y = column + dx, row + dy
            z = depth.depth_at(plane, piece, x, y)

            # Only fragments that are seen (so far) get weights.
            won = depth.keep_nearest(frame.depth.reshape(-1), pixel, z)
            piece, pixel = piece[won], pixel[won]
            weights = depth.window_weights(corner[piece], pieces.one_over_w[piece], x[won], y[won])
            cut = np.flatnonzero(pieces.cut[piece])
            weights[cut] = np.einsum("fk,fki->fi", weights[cut], pieces.weights[piece[cut]])

            frame.weights.reshape(-1, 3)[pixel] = weights
            frame.triangle.reshape(-1)[pixel] = pieces.source[piece] + first
            frame.object.reshape(-1)[pixel] = object_id
            frame.front.reshape(-1)[pixel] = pieces.front[piece]
