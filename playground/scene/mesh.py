"""A triangle mesh as a frozen value: positions, normals, faces, texture coordinates.

Knows what a sound mesh is and its few derived quantities. Must not know shapes,
files or renderers; imports NumPy only.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from playground.errors import PlaygroundError
from playground.scene.normals import angle_weighted_normals, direction, face_normals, weld

Floats = NDArray[np.float64]

# Normals this close to length 1 are kept to the bit: one step of float32 at 1.
UNIT_SLACK = float(np.finfo(np.float32).eps)


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles that share vertices. Make one with `Mesh.create`, which checks.

    Parameters
    ----------
    positions : float32 array of shape (N, 3)
    normals : float32 array of shape (N, 3), unit, pointing away from the surface
    faces : int32 array of shape (M, 3), counter-clockwise seen from outside
    texcoords : float32 array of shape (N, 2), optional
        (0, 0) is the lower left corner of the image.
    name : str

    All arrays are C-contiguous and read-only.
    """

    positions: NDArray[np.float32]
    normals: NDArray[np.float32]
    faces: NDArray[np.int32]
    texcoords: NDArray[np.float32] | None = None
    name: str = ""

    def __post_init__(self) -> None:
        """Lock the arrays, copying those the caller could still change."""
        object.__setattr__(self, "positions", _locked(self.positions, np.float32))
        object.__setattr__(self, "normals", _locked(self.normals, np.float32))
        object.__setattr__(self, "faces", _locked(self.faces, np.int32))
        if self.texcoords is not None:
            object.__setattr__(self, "texcoords", _locked(self.texcoords, np.float32))

    @classmethod
    def create(
        cls,
        positions: ArrayLike,
        faces: ArrayLike,
        normals: ArrayLike | None = None,
        texcoords: ArrayLike | None = None,
        name: str = "",
    ) -> Mesh:
        """A sound mesh: checked, without degenerate triangles, with unit normals.

        Parameters
        ----------
        positions : array of shape (N, 3), finite also as float32
        faces : integer array of shape (M, 3), M >= 1, entries in 0..N-1
        normals : array of shape (N, 3), optional
            Of any length. Zero, NaN or infinite ones, or all if None, become
            angle-weighted ones; a vertex without faces gets (0, 0, 1).
        texcoords : array of shape (N, 2), optional, finite

        Raises
        ------
        PlaygroundError
            A shape, an index or a number is wrong, or no triangle has an area.
        """
        label = f"mesh '{name}'" if name else "mesh"
        places = _finite(_numbers(positions, 3, f"{label}: positions"), f"{label}: positions")
        count = len(places)
        triangles = _with_area(places, _indices(faces, count, f"{label}: faces"), label)
        given = None if normals is None else _numbers(normals, 3, f"{label}: normals", count)
        if texcoords is not None:
            what = f"{label}: texcoords"
            texcoords = _finite(_numbers(texcoords, 2, what, count), what)
        unit = _unit_normals(given, places, triangles)
        return cls(
            _locked(places, np.float32),
            _locked(unit, np.float32),
            _locked(triangles, np.int32),
            None if texcoords is None else _locked(np.asarray(texcoords), np.float32),
            name,
        )

    @cached_property
    def bounds(self) -> tuple[Floats, Floats]:
        """The lowest and highest corner (float64, shape (3,)) of the box around all faces."""
        drawn = self._drawn
        return _locked(drawn.min(axis=0), np.float64), _locked(drawn.max(axis=0), np.float64)

    @cached_property
    def centre(self) -> Floats:
        """The middle of `bounds`, float64, shape (3,)."""
        low, high = self.bounds
        return _locked(0.5 * low + 0.5 * high, np.float64)

    @cached_property
    def radius(self) -> float:
        """The radius of the ball about `centre` that holds all faces."""
        offset = self._drawn - self.centre
        return float(np.sqrt(np.einsum("ni,ni->n", offset, offset).max()))

    @cached_property
    def closed(self) -> bool:
        """Whether the faces, welded by exact position, bound a solid without a gap.

        Every undirected edge is shared by exactly two faces that run along it in
        opposite directions. Says nothing of which side is the inside: see `cullable`.
        """
        place = weld(self.positions)[self.faces]
        after = np.roll(place, -1, axis=1)
        count = np.int64(len(self.positions))
        forward = np.sort((place * count + after).ravel())
        backward = np.sort((after * count + place).ravel())
        distinct = not np.any(forward[1:] == forward[:-1])
        return bool(distinct and np.array_equal(forward, backward))

    @cached_property
    def volume(self) -> float:
        """Signed volume by the divergence theorem; negative if a closed mesh is inside out."""
        first, second, third = np.moveaxis(self.positions[self.faces] - self.centre, 1, 0)
        return float(np.einsum("mi,mi->", first, np.cross(second, third)) / 6.0)

    @cached_property
    def cullable(self) -> bool:
        """Whether back faces cannot be seen from outside: closed and not inside out."""
        return self.closed and self.volume > 0.0

    @cached_property
    def triangle_normals(self) -> Floats:
        """Geometric unit normals, float64, shape (M, 3)."""
        return _locked(face_normals(self.positions, self.faces), np.float64)

    @cached_property
    def triangle_centres(self) -> Floats:
        """Means of the three corners, float64, shape (M, 3)."""
        corners = self.positions[self.faces].astype(np.float64)
        return _locked(corners.mean(axis=1), np.float64)

    @property
    def _drawn(self) -> Floats:
        """Positions that some face uses, float64: stray vertices have no say in the size."""
        used = np.zeros(len(self.positions), dtype=bool)
        used[self.faces] = True
        return self.positions[used].astype(np.float64)


def _locked(values: NDArray[Any], dtype: type) -> NDArray[Any]:
    # A component of a unit normal below 1e-38 may well become 0
    with np.errstate(under="ignore"):
        array: NDArray[Any] = np.ascontiguousarray(values, dtype=dtype)
    if array is values and array.flags.writeable:
        array = array.copy()
    array.setflags(write=False)
    return array


def _numbers(values: ArrayLike, columns: int, what: str, rows: int | None = None) -> Floats:
    """The values as float64 of shape (rows, columns)."""
    allowed = f"numbers of shape ({'N' if rows is None else rows}, {columns})"
    try:
        array = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise PlaygroundError(f"{what} must be numbers", got=str(error), allowed=allowed) from None
    if array.ndim != 2 or array.shape[1] != columns or (rows is not None and len(array) != rows):
        raise PlaygroundError(
            f"{what} have the wrong shape",
            got=str(array.shape),
            allowed=allowed,
            fix="Give one row per vertex.",
        )
    return array


def _finite(values: Floats, what: str) -> Floats:
    """The values rounded to float32 and back, all finite."""
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        rounded = values.astype(np.float32).astype(np.float64)
    bad = ~np.isfinite(rounded)
    if bad.any():
        row, column = np.argwhere(bad)[0]
        raise PlaygroundError(
            f"{what}[{row}][{column}] is not finite",
            got=str(values[row, column]),
            allowed="numbers from -3.4e38 to 3.4e38",
            fix="Mend or remove this vertex.",
        )
    return rounded


def _indices(faces: ArrayLike, count: int, what: str) -> NDArray[np.int64]:
    """The faces as int64 of shape (M, 3), all within 0..count-1."""
    allowed = "whole numbers of shape (M, 3) with M >= 1"
    try:
        array = np.asarray(faces)
    except ValueError as error:
        raise PlaygroundError(f"{what} are ragged", got=str(error), allowed=allowed) from None
    if array.ndim != 2 or array.shape[1] != 3 or len(array) == 0 or array.dtype.kind not in "iu":
        raise PlaygroundError(
            f"{what} must be a list of triangles",
            got=f"{array.dtype} of shape {array.shape}",
            allowed=allowed,
            fix="Give at least one triangle.",
        )
    bad = (array < 0) | (array >= count)
    if bad.any():
        row, column = np.argwhere(bad)[0]
        raise PlaygroundError(
            f"{what}[{row}][{column}] names a vertex that is not there",
            got=str(array[row, column]),
            allowed=f"0 to {count - 1}",
            fix="Mend or remove this triangle.",
        )
    return array.astype(np.int64)


def _with_area(positions: Floats, triangles: NDArray[np.int64], label: str) -> NDArray[np.int64]:
    """Only the triangles that have an area."""
    kept = triangles[np.any(face_normals(positions, triangles) != 0.0, axis=1)]
    if len(kept) == 0:
        raise PlaygroundError(
            f"{label} has no triangle with an area",
            got=f"{len(triangles)} degenerate triangles",
            allowed="at least one triangle whose corners are not on one line",
            fix="Check the unit and the scale of the model.",
        )
    return kept


def _unit_normals(given: Floats | None, positions: Floats, triangles: NDArray[np.int64]) -> Floats:
    """The given normals made unit, with angle-weighted ones where they are no direction."""
    if given is None:
        return angle_weighted_normals(positions, triangles)
    usable = np.isfinite(given).all(axis=1) & np.any(given != 0.0, axis=1)
    known = np.where(usable[:, None], given, 0.0)
    unit = direction(known)
    off = np.abs(np.einsum("ni,ni->n", unit, known) - 1.0)
    unit = np.where((off <= UNIT_SLACK)[:, None], known, unit)
    if not usable.all():
        unit = np.where(usable[:, None], unit, angle_weighted_normals(positions, triangles))
    return unit
