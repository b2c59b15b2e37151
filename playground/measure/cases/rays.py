"""Cases of single rays: where they meet a shape, how they leave it, how glass bends them."""

from __future__ import annotations

from fractions import Fraction
from math import frexp, hypot
from typing import Any

import numpy as np

Outputs = dict[str, Any]


def ray_sphere(inputs: Outputs, formulas: Any) -> Outputs:
    """The first hit on a sphere, in the scale at which both renderers see a scene: about 1."""
    origin, centre = np.asarray(inputs["o"], np.float64), np.asarray(inputs["c"], np.float64)
    radius = float(inputs["r"])
    largest = max(float(np.max(np.abs(origin - centre))), radius)
    scale = 2.0 ** -frexp(largest)[1]
    t, from_centre = formulas.ray.ray_sphere(
        origin * scale, inputs["d"], centre * scale, radius * scale
    )
    distance = formulas.vector.length_any((origin - centre) * scale)
    return {
        "hit": bool(t >= 0.0),
        "t": float(t) / scale,
        "normal": formulas.vector.unit(from_centre),
        "inside": bool(distance < formulas.real(radius * scale)),
    }


def ray_triangle(inputs: Outputs, formulas: Any) -> Outputs:
    """Where a ray meets a triangle, its edges included."""
    t, weights = formulas.triangle.ray_triangle(inputs["o"], inputs["d"], *inputs["tri"])
    return {"hit": bool(t > 0.0), "t": t, "bary": weights}


def watertight_fan(inputs: Outputs, formulas: Any) -> Outputs:
    """How many rays aimed at shared edges hit any triangle there: none slips through."""
    corners = np.asarray(inputs["triangles"], np.float64)
    rays = np.asarray([(ray["o"], ray["d"]) for ray in inputs["rays"]], np.float64)
    each = (corners[None, :, k] for k in range(3))
    t, _ = formulas.triangle.ray_triangle(rays[:, None, 0], rays[:, None, 1], *each)
    return {"rays_hitting_at_least_one": np.count_nonzero((t > 0.0).any(axis=1))}


def ray_box(inputs: Outputs, formulas: Any) -> Outputs:
    """Where a ray enters and leaves a closed box."""
    entry, leave = formulas.ray.ray_box(inputs["o"], inputs["d"], inputs["lo"], inputs["hi"])
    return {"hit": bool(entry <= leave), "tmin": entry, "tmax": leave}


def ray_offset(inputs: Outputs, formulas: Any) -> Outputs:
    """Whether the next ray starts beyond the error of the hit, and not too far; exactly."""
    normal = inputs["n"]
    start = formulas.ray.offset_ray(inputs["p"], formulas.vector.unit(normal), inputs["hit_error"])
    along = sum(
        (Fraction(float(a)) - Fraction(b)) * Fraction(c)
        for a, b, c in zip(start, inputs["p"], normal, strict=True)
    )
    step = float(along) / hypot(*normal)
    return {
        "positive_side": step > inputs["hit_error"],
        "within_max": step <= inputs["max_distance"],
    }


def refract(inputs: Outputs, formulas: Any) -> Outputs:
    """Reflected and refracted direction, and how much goes where, for both polarisations."""
    unit, optics = formulas.vector.unit, formulas.optics
    normal, to_eye = unit(inputs["normal"]), unit(np.negative(inputs["incident"]))
    indices = (inputs["n1"], inputs["n2"])
    cosine_i = formulas.phong.diffuse_factor(normal, to_eye)
    sine_i = optics.sine_between(normal, to_eye)
    cosine_t = optics.cosine_transmitted(sine_i, *indices)
    share_s, share_p = optics.fresnel_polarised(cosine_i, sine_i, *indices)
    return {
        "tir": bool(cosine_t < 0.0),
        "reflected": formulas.vector.reflection(normal, to_eye),
        "transmitted": optics.refraction(normal, to_eye, *indices),
        "cos_t": cosine_t,
        "Rs": share_s,
        "Rp": share_p,
        "R": optics.fresnel(cosine_i, sine_i, *indices),
    }
