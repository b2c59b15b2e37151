"""Cases of single rays: where they meet a shape, how they leave it, how glass bends them.

The formulas take sines and cosines. Where a case gives an angle, or asks for one, the CPU turns it
into them in float64, as it does for a person who types degrees.
"""

from __future__ import annotations

from fractions import Fraction
from math import atan2, cos, frexp, hypot, sin, sqrt
from typing import Any

import numpy as np

from playground.shading.optics import bounces_until, mirror_series
from playground.shading.power import power
from playground.shading.vector import cross

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


def fresnel_table(inputs: Outputs, formulas: Any) -> Outputs:
    """What a boundary reflects at an angle, and the angles at which something happens."""
    optics, indices = formulas.optics, (inputs["n1"], inputs["n2"])
    here, beyond = map(float, indices)
    sine, cosine = sin(inputs["theta_i"]), cos(inputs["theta_i"])
    cosine_t = float(optics.cosine_transmitted(sine, *indices))
    share_s, share_p = optics.fresnel_polarised(cosine, sine, *indices)
    return {
        "normal_R": optics.fresnel(1.0, 0.0, *indices),
        "brewster": atan2(beyond, here),
        "critical": atan2(beyond, sqrt(max((here - beyond) * (here + beyond), 0.0))),
        "schlick": optics.schlick(cosine, sine, *indices),
        "tir": cosine_t < 0.0,
        "theta_t": atan2(here * sine / beyond, cosine_t),
        "Rs": share_s,
        "Rp": share_p,
        "R": optics.fresnel(cosine, sine, *indices),
    }


def slab(inputs: Outputs, formulas: Any) -> Outputs:
    """Light through a plate in air: moved aside, and split at its two faces again and again."""
    sine, cosine = sin(inputs["theta_i"]), cos(inputs["theta_i"])
    across = (cosine, sine, 1.0, inputs["n"])
    reflected = float(formulas.optics.fresnel(*across))
    through = 1.0 - reflected
    return {
        "shift": formulas.optics.plate_shift(inputs["thickness"], *across),
        "T_total": through / (1.0 + reflected),
        "R_total": 2.0 * reflected / (1.0 + reflected),
        "T_truncated": through**2 * mirror_series(reflected**2, inputs["depth"]),
    }


def glass_ball(inputs: Outputs, formulas: Any) -> Outputs:
    """Through a ball at the origin: bent where it enters, a chord of 2 r cos θ_t, bent again."""
    unit, optics, index = formulas.vector.unit, formulas.optics, inputs["n"]
    direction, origin = unit(inputs["d"]), np.asarray(inputs["o"], np.float64)
    scale = 2.0 ** -frexp(max(float(np.max(np.abs(origin))), float(inputs["r"])))[1]
    radius = inputs["r"] * scale
    _, hit = formulas.ray.ray_sphere(origin * scale, inputs["d"], np.zeros(3), radius)
    normal = unit(hit)
    sine = optics.sine_between(normal, -direction)
    within = unit(optics.refraction(normal, -direction, 1.0, index))
    chord = 2.0 * radius * optics.cosine_transmitted(sine, 1.0, index)
    leave = hit + formulas.real(chord) * within
    out = unit(optics.refraction(unit(-leave), -within, index, 1.0))
    turned = np.asarray(cross(np.float64(direction), np.float64(out)))
    ahead = np.dot(np.float64(direction), np.float64(out))
    return {
        "exit_point": np.float64(leave) / scale,
        "exit_direction": out,
        "deviation": atan2(hypot(*turned), ahead),
    }


def nested_dielectrics(inputs: Outputs, formulas: Any) -> Outputs:
    """Through one boundary after another; each starts in the medium that the last one led to."""
    unit, optics = formulas.vector.unit, formulas.optics
    direction, here, energy = unit(inputs["d"]), inputs["n0"], 1.0
    for boundary in inputs["interfaces"]:
        normal, beyond = unit(boundary["normal"]), boundary["n_to"]
        if np.dot(normal, direction) > 0.0:
            normal = -normal
        cosine = formulas.phong.diffuse_factor(normal, -direction)
        sine = optics.sine_between(normal, -direction)
        if optics.cosine_transmitted(sine, here, beyond) < 0.0:
            return {"tir": True}
        energy *= 1.0 - float(optics.fresnel(cosine, sine, here, beyond))
        direction = unit(optics.refraction(normal, -direction, here, beyond))
        here = beyond
    return {"tir": False, "direction": direction, "transmitted_energy": energy}


def mirror_recursion(inputs: Outputs, formulas: Any) -> Outputs:
    """Between two mirrors that shine: what so many bounces show, and how many it takes."""
    rho, emission, depth = inputs["rho"], inputs["emission"], inputs["depth"]
    return {
        "radiance_at_depth": emission * mirror_series(rho, depth),
        "limit": emission / (1.0 - rho),
        "relative_missing": power(rho, depth + 1),
        "depth_for_1_255": bounces_until(rho, 1.0 / 255.0),
    }
