"""The form factor of two patches: every method of the lecture, and the closed form beside them.

Computed by NumPy in float64, whatever draws the picture.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Any

import numpy as np

from playground.errors import PlaygroundError
from playground.render.radiosity.factor.form_factors import METHODS
from playground.render.radiosity.factor.pairs import point_at, segments, stretch
from playground.render.radiosity.factor.visibility import between, facing
from playground.render.radiosity.patch.patches import Patches
from playground.scene.settings import Settings
from playground.shading.floats import Array
from playground.shading.form_factor import point_to_disc, point_to_point
from playground.shading.polygon_pair import exchange_area
from playground.shading.shadow import visible_share

RAYS = 17  # segments between two patches: so many per side, squared
Two = tuple[float, float]


@dataclass(frozen=True)
class MethodTold:
    """What one method says of two patches i and j.

    ``factors`` are F_ij and F_ji, ``sums`` the row sums of i and j, ``seconds`` what one of the
    two rows took. ``error`` is how far F_ij is from `PatchPair.expected`, relative; None
    where that is 0. ``exchange`` is A_i F_ij − A_j F_ji, which is 0 in nature.
    """

    method: str
    factors: Two
    sums: Two
    seconds: float
    error: float | None
    exchange: float


@dataclass(frozen=True, eq=False)
class PatchPair:
    """Two patches as each sees the other: lengths in world units, angles in degrees.

    Pairs of values are those of i and of j, with nothing in between. ``point`` is cos θ_i cos θ_j
    A / (π r²) of the two centres with the area of the other patch; ``disc`` takes that patch for
    a disc, see `point_to_disc`; ``closed`` are F_ij and F_ji of the two polygons, exact.
    ``visible`` is the share of this that gets through, by ``segments`` segments; 1 without
    occlusion. ``methods`` are those asked so far.
    """

    patches: Patches
    numbers: tuple[int, int]
    area: Two
    centre: Array  # (2, 3)
    normal: Array  # (2, 3)
    angle: Two
    distance: float
    point: Two
    disc: Two
    closed: Two
    facing: bool
    occlusion: bool
    segments: int
    visible: float
    methods: tuple[MethodTold, ...] = ()

    @property
    def expected(self) -> Two:
        """F_ij and F_ji as they should be: the closed form times the visible share.

        Exact where all or nothing is visible; in between, as good as its segments.
        """
        return self.closed[0] * self.visible, self.closed[1] * self.visible

    def told(self, method: str) -> MethodTold | None:
        """What a method says; None if it was not asked."""
        return next((told for told in self.methods if told.method == method), None)

    def swapped(self) -> PatchPair:
        """The same pair from the other side."""

        def other(two: Two) -> Two:
            return two[1], two[0]

        return replace(
            self,
            numbers=(self.numbers[1], self.numbers[0]),
            centre=self.centre[::-1],
            normal=self.normal[::-1],
            methods=tuple(
                replace(
                    told,
                    factors=other(told.factors),
                    sums=other(told.sums),
                    error=_error(told.factors[1], self.expected[1]),
                    exchange=0.0 - told.exchange,
                )
                for told in self.methods
            ),
            area=other(self.area),
            angle=other(self.angle),
            point=other(self.point),
            disc=other(self.disc),
            closed=other(self.closed),
        )

    def text(self) -> str:
        """The explanation for a terminal."""
        from playground.explain.patch_words import text

        return text(self)

    def latex(self) -> str:
        """The lecture's formula with the numbers of this pair, as LaTeX."""
        from playground.explain.patch_words import latex

        return latex(self)

    def to_dict(self) -> dict[str, Any]:
        """The explanation as plain values."""
        from playground.explain.patch_words import to_dict

        return to_dict(self)

    def __str__(self) -> str:
        return self.text()


def explain_pair(patches: Patches, i: int, j: int, settings: Settings | None = None) -> PatchPair:
    """What patches i and j are to each other, by every method.

    Parameters
    ----------
    patches : Patches
    i, j : int
        Two different patches.
    settings : Settings, optional
        Its ``occlusion`` and ``hemicube`` count.

    Raises
    ------
    PlaygroundError
        There is no such patch, or both are the same.
    """
    *_, last = pair_steps(patches, i, j, settings)
    return last


def pair_steps(
    patches: Patches, i: int, j: int, settings: Settings | None = None
) -> Iterator[PatchPair]:
    """As `explain_pair`, method by method, the simplest first; before all, without any."""
    settings = settings or Settings()
    pair = _alone(patches, i, j, settings.occlusion)
    yield pair
    for method in reversed(METHODS):
        pair = replace(pair, methods=(*pair.methods, _asked(pair, method, settings)))
        yield pair


def _alone(patches: Patches, i: int, j: int, occlusion: bool) -> PatchPair:
    """The pair before any method is asked."""
    for number in (i, j):
        if not 0 <= number < len(patches):
            allowed = f"0 to {len(patches) - 1}"
            raise PlaygroundError("there is no such patch", got=number, allowed=allowed)
    if i == j:
        raise PlaygroundError(
            "a form factor needs two patches",
            got=f"patch {i} twice",
            fix="A flat patch sends no light to itself. Choose another one.",
        )
    both = np.array([i, j])
    area, centre, normal = patches.area[both], patches.centre[both], patches.normal[both]
    way = centre[1] - centre[0]
    distance = float(np.linalg.norm(way))
    towards = way / distance if distance > 0.0 else np.zeros(3)
    cosine = np.array([normal[0] @ towards, -normal[1] @ towards])
    ends = centre[0], normal[0], centre[1], normal[1]
    per_area = float(point_to_point(*ends))
    exchanged = float(exchange_area(*patches.polygon[both]))
    meets = bool(facing(patches, both[:1], both[1:])[0])
    theta = np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))
    return PatchPair(
        patches=patches,
        numbers=(i, j),
        area=_two(area),
        centre=patches.origin + centre,
        normal=normal,
        angle=_two(theta),
        distance=distance,
        point=_two(per_area * area[::-1]),
        disc=_two(point_to_disc(*ends, area[::-1])),
        closed=_two(exchanged / area),
        facing=meets,
        occlusion=occlusion,
        segments=RAYS**2,
        visible=_visible(patches, i, j) if occlusion and meets else 1.0,
    )


def _two(values: Array) -> Two:
    return float(values[0]), float(values[1])


def _visible(patches: Patches, i: int, j: int) -> float:
    """The share of what the pair would exchange that gets through, by `RAYS`² segments.

    Each is weighed by the lecture's formula for its two ends.
    """
    one, other = ((patches.turned[k][None], patches.normal[k][None]) for k in (i, j))
    place = segments(RAYS).T[..., None]  # (4, R, 1): all segments of one pair at once
    start, end = point_at(one[0], place[:2]), point_at(other[0], place[2:])
    up, down = (np.broadcast_to(side[1], start.shape) for side in (one, other))
    area = stretch(one, place[:2]) * stretch(other, place[2:])
    weight = point_to_point(start, up, end, down) * area.ravel()
    stands = between(patches)
    open_ = np.flatnonzero(weight > 0.0)
    hidden = stands.hidden(start[open_], up[open_], end[open_], down[open_])
    seen = weight.copy()
    seen[open_[hidden]] = 0.0
    return float(visible_share(seen.sum(), weight.sum()))


def _asked(pair: PatchPair, method: str, settings: Settings) -> MethodTold:
    """Both rows by one method."""
    i, j = pair.numbers
    knobs: dict[str, Any] = {"resolution": settings.hemicube} if method == "hemicube" else {}
    began = perf_counter()
    rows = [METHODS[method](pair.patches, [k], pair.occlusion, **knobs)[0] for k in (i, j)]
    took = (perf_counter() - began) / 2.0
    there, back = float(rows[0][j]), float(rows[1][i])
    return MethodTold(
        method=method,
        factors=(there, back),
        sums=(float(rows[0].sum()), float(rows[1].sum())),
        seconds=took,
        error=_error(there, pair.expected[0]),
        exchange=pair.area[0] * there - pair.area[1] * back,
    )


def _error(value: float, expected: float) -> float | None:
    return value / expected - 1.0 if expected > 0.0 else None
