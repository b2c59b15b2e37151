"""Where a ray meets a shape: sphere, plane, disc, cylinder, box; and where it leaves it.

Twin: shaders/lib/ray.glsl. A ray is origin + t · direction with t > 0; the direction may
have any length, and t is in units of it. Each function gives `NO_HIT` = −1 where the
ray passes by. Arrays broadcast: points and directions (..., 3), results (...).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from playground.shading.floats import Array, floats
from playground.shading.vector import dot

NO_HIT = -1.0
SMALLEST_STEP = 1e-30  # a step below it would be flushed to zero on a GPU


def ray_sphere(
    origin: ArrayLike, direction: ArrayLike, centre: ArrayLike, radius: ArrayLike
) -> tuple[Array, Array]:
    """The first t >= 0 on the sphere and the vector from its centre to the hit; (...), (..., 3).

    For a t² − 2 b t + c = 0 the discriminant D comes from the point of the line nearest to the
    centre, the roots from q = b ± √D as q / a and c / q, and the hit from that nearest point, half
    a chord along the ray: a sphere far away or grazed keeps its digits. ``centre`` plus the
    vector is the hit point.
    Source: Haines, Günther, Akenine-Möller, Precision Improvements for Ray/Sphere
    Intersection, Ray Tracing Gems, 2019, chapter 7.
    """
    origin, direction, centre, radius = floats(origin, direction, centre, radius)
    seen = origin - centre
    squared = dot(direction, direction)
    ahead = -dot(seen, direction)
    middle = ahead / squared
    # From far away rounding moves this point along the ray by many radii: take off what is left.
    middle = middle - dot(seen + middle[..., None] * direction, direction) / squared
    nearest = seen + middle[..., None] * direction
    inside = radius * radius - dot(nearest, nearest)
    chord = np.sqrt(np.maximum(inside, 0.0) * squared)
    distance = np.sqrt(dot(seen, seen))
    c = (distance - radius) * (distance + radius)
    q = ahead + np.where(ahead < 0.0, -chord, chord)
    other = c / np.where(q == 0.0, 1.0, q)
    first = np.minimum(q / squared, other)
    last = np.maximum(q / squared, other)
    t = np.where(first >= 0.0, first, last)
    hit = (inside >= 0.0) & (t >= 0.0)
    half = np.where(first >= 0.0, -chord, chord) / squared
    from_centre = nearest + half[..., None] * direction
    return np.where(hit, t, NO_HIT), np.where(hit[..., None], from_centre, 0.0)


def ray_plane(
    origin: ArrayLike, direction: ArrayLike, point: ArrayLike, normal: ArrayLike
) -> Array:
    """Where (t) the ray meets the plane through ``point``; a ray along the plane misses it."""
    origin, direction, point, normal = floats(origin, direction, point, normal)
    steep = dot(normal, direction)
    t = dot(normal, point - origin) / np.where(steep == 0.0, 1.0, steep)
    return np.asarray(np.where((steep != 0.0) & (t > 0.0), t, NO_HIT))


def ray_disc(
    origin: ArrayLike,
    direction: ArrayLike,
    centre: ArrayLike,
    normal: ArrayLike,
    radius: ArrayLike,
) -> Array:
    """Where (t) the ray meets the disc, its rim included."""
    origin, direction, centre, normal, radius = floats(origin, direction, centre, normal, radius)
    t = ray_plane(origin, direction, centre, normal)
    away = origin + np.maximum(t, 0.0)[..., None] * direction - centre
    return np.asarray(np.where((t > 0.0) & (dot(away, away) <= radius * radius), t, NO_HIT))


def ray_tube(origin: ArrayLike, direction: ArrayLike, low: ArrayLike, high: ArrayLike) -> Array:
    """Where (t) the ray meets the side of the cylinder x² + z² = 1, low <= y <= high.

    In the plane of x and z this is `ray_sphere` for a circle: discriminant from the nearest
    point, roots q / a and c / q. Caps are discs.
    """
    origin, direction, low, high = floats(origin, direction, low, high)
    ox, oz, dx, dz = origin[..., 0], origin[..., 2], direction[..., 0], direction[..., 2]
    squared = dx * dx + dz * dz
    safe = np.where(squared > 0.0, squared, 1.0)
    ahead = -(ox * dx + oz * dz)
    across = ox * dz - oz * dx
    inside = squared - across * across
    chord = np.sqrt(np.maximum(inside, 0.0))
    distance = np.sqrt(ox * ox + oz * oz)
    c = (distance - 1.0) * (distance + 1.0)
    q = ahead + np.where(ahead < 0.0, -chord, chord)
    other = c / np.where(q == 0.0, 1.0, q)
    best = np.full(np.broadcast(q, low).shape, NO_HIT)
    for t in (np.maximum(q / safe, other), np.minimum(q / safe, other)):
        y = origin[..., 1] + t * direction[..., 1]
        hit = (squared > 0.0) & (inside >= 0.0) & (t > 0.0) & (y >= low) & (y <= high)
        best = np.where(hit, t, best)
    return np.asarray(best)


def ray_box(
    origin: ArrayLike, direction: ArrayLike, low: ArrayLike, high: ArrayLike
) -> tuple[Array, Array]:
    """Where the ray enters and leaves the closed box, t >= 0; a miss has entry > exit.

    Along an axis in which the ray does not move it is always or never between the two faces;
    comparing decides that, not dividing 0 by 0: a ray in a face hits.
    Source: Williams, Barrus, Morley, Shirley, An Efficient and Robust Ray–Box Intersection
    Algorithm, 2005.
    """
    origin, direction, low, high = floats(origin, direction, low, high)
    still = direction == 0.0
    safe = np.where(still, 1.0, direction)
    between = np.where((low <= origin) & (origin <= high), np.inf, -np.inf)
    a = np.where(still, -between, (low - origin) / safe)
    b = np.where(still, between, (high - origin) / safe)
    entry = np.maximum(np.max(np.minimum(a, b), axis=-1), 0.0)
    leave = np.min(np.where(still, between, np.maximum(a, b)), axis=-1)
    return entry, leave


def offset_ray(point: ArrayLike, normal: ArrayLike, error: ArrayLike) -> Array:
    """The origin of a ray that leaves a surface on the side of ``normal``, shape (..., 3).

    The point is moved along the unit normal by twice ``error`` (...), a bound on how far it lies
    from the surface; each coordinate is then rounded away from the point, so that the step is
    never lost. No fixed epsilon: the step follows the size of the numbers.
    Source: Pharr, Jakob, Humphreys, Physically Based Rendering 4, section 6.8.6.
    """
    point, normal, error = floats(point, normal, error)
    moved = point + 2.0 * np.maximum(error, SMALLEST_STEP)[..., None] * normal
    away = np.where(normal > 0.0, np.inf, -np.inf).astype(moved.dtype)
    return np.asarray(np.where(normal == 0.0, moved, np.nextafter(moved, away)))
