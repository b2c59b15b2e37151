"""A pair of patches, and the light of one, in words, in LaTeX and in plain values."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from playground.explain.words import plain, triple
from playground.shading.floats import Array

if TYPE_CHECKING:
    from playground.explain.patch_light import PatchLight
    from playground.explain.patch_pair import MethodTold, PatchPair


def text(pair: PatchPair) -> str:
    """The pair for a terminal: its geometry, then a line per method."""
    i, j = pair.numbers
    lines = [
        f"patches i = {i} and j = {j} of {len(pair.patches)}",
        *(
            f"  {name} = {number:<6} area {area:.6g}   centre {_point(centre)}   "
            f"n = {_point(normal)}   θ = {angle:.2f}°"
            for name, number, area, centre, normal, angle in zip(
                "ij", pair.numbers, pair.area, pair.centre, pair.normal, pair.angle, strict=True
            )
        ),
        f"  |v| = {pair.distance:.6g} from centre to centre",
        f"  {seen(pair)}",
        f"point to point   F_ij = cos θ_i cos θ_j / (π |v|²) A_j = {pair.point[0]:.6g}",
        f"point to disc    F_ij = cos θ_i cos θ_j A_j / (π |v|² + A_j) = {pair.disc[0]:.6g}",
        f"closed form      F_ij = {pair.closed[0]:.6g}   F_ji = {pair.closed[1]:.6g}   "
        "of the two polygons, nothing in between",
        "",
        f"  {'method':<17}{'F_ij':>12}{'F_ji':>12}{'error':>12}{'A_i F_ij - A_j F_ji':>21}"
        f"{'sum F_i':>9}{'sum F_j':>9}{'ms a row':>10}",
        *(_row(told) for told in pair.methods),
    ]
    lines.append("error: against the closed form" + _times(pair))
    return "\n".join(lines)


def _point(values: Array) -> str:
    return triple(np.round(values, 4) + 0.0)  # without a negative zero


def seen(pair: PatchPair) -> str:
    """Whether the two see each other."""
    if not pair.facing:
        return "they do not face each other: no light goes from one to the other"
    if not pair.occlusion:
        return "they face each other; what stands in between is not looked at (occlusion is off)"
    if pair.visible == 1.0:
        return f"they see each other: all of {pair.segments} segments get through"
    if pair.visible == 0.0:
        return f"something hides them from each other: none of {pair.segments} segments arrives"
    share = f"{100.0 * pair.visible:.1f} %"
    return f"something stands in between: {share} gets through, by {pair.segments} segments"


def _times(pair: PatchPair) -> str:
    partly = pair.facing and 0.0 < pair.visible < 1.0
    return f" times the {100.0 * pair.visible:.1f} % that gets through" if partly else ""


def percent(error: float | None) -> str:
    """A relative error as a signed percentage."""
    if error is None:
        return "-"
    return f"{100.0 * error:+.0f} %" if abs(error) >= 0.095 else f"{100.0 * error:+.2g} %"


def _row(told: MethodTold) -> str:
    there, back = told.factors
    return (
        f"  {told.method:<17}{there:>12.6g}{back:>12.6g}{percent(told.error):>12}"
        f"{told.exchange:>21.2e}{told.sums[0]:>9.4f}{told.sums[1]:>9.4f}{1e3 * told.seconds:>10.1f}"
    )


def latex(pair: PatchPair) -> str:
    """The lecture's formula with this pair's numbers, and the closed form."""
    a, b = pair.angle
    return (
        r"f_{ij}=\frac{\cos\theta_i\cos\theta_j}{\pi|v|^2}="
        rf"\frac{{\cos {a:.2f}^\circ\cos {b:.2f}^\circ}}{{\pi\cdot {pair.distance:.4g}^2}},\quad "
        rf"F_{{ij}}\approx f_{{ij}}A_j={pair.point[0]:.6g},\quad "
        rf"F_{{ij}}={pair.closed[0]:.6g}"
    )


def to_dict(pair: PatchPair) -> dict[str, Any]:
    """Plain values; those of i before those of j."""
    names = (
        "numbers",
        "area",
        "angle",
        "distance",
        "point",
        "disc",
        "closed",
        "expected",
        "facing",
    )
    more = ("occlusion", "segments", "visible")
    return {
        "patches": len(pair.patches),
        "centre": plain(pair.centre),
        "normal": plain(pair.normal),
        **{name: _listed(getattr(pair, name)) for name in (*names, *more)},
        "methods": [
            {name: _listed(getattr(told, name)) for name in told.__dataclass_fields__}
            for told in pair.methods
        ],
    }


def _listed(value: Any) -> Any:
    return list(value) if isinstance(value, tuple) else value


def light_text(light: PatchLight) -> list[str]:
    """The equation of a patch, its senders, and where its light goes: lines for a terminal."""
    here = f"patch {light.patch} of {light.count} itself, area {light.area:.6g}"
    return [
        f"{here}:",
        f"  C = E + ρ ⊗ (D + Σ F C) = {triple(light.emission)} + {triple(light.reflectance)} ⊗ "
        f"({triple(light.lamps)} + {triple(light.gathered)})",
        f"    = {triple(light.balanced)}; the solver has {triple(light.light)}, "
        f"off by {light.residual:.1e}",
        f"  direct    {triple(light.direct)}   straight from what sends out light",
        f"  indirect  {triple(light.indirect)}   reflected before",
        f"  what other patches send, the largest {len(light.senders)} of {light.sending}, "
        f"row sum {light.row_sum:.6f}:",
        *(
            f"    patch {s.patch:<6} F = {s.factor:.6f}   C = {triple(s.light)}   "
            f"F C = {triple(s.sent)}   {100.0 * s.share:5.1f} %"
            for s in light.senders
        ),
        "  its energy, area times colour:",
        *(f"    {name:<10}{triple(value)}" for name, value in light.ledger.items()),
    ]


def light_dict(light: PatchLight) -> dict[str, Any]:
    """Plain values under the names of `PatchLight`."""
    names = ("patch", "count", "area", "reflectance", "emission", "lamps", "gathered", "direct")
    more = ("indirect", "light", "balanced", "residual", "row_sum", "sending")
    return {
        **{name: plain(getattr(light, name)) for name in (*names, *more)},
        "senders": [
            {name: plain(getattr(s, name)) for name in s.__dataclass_fields__}
            for s in light.senders
        ],
        "ledger": {name: plain(value) for name, value in light.ledger.items()},
    }
