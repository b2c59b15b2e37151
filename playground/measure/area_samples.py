"""A floor under a shining square, and sums over samples of the square: rivals of the closed forms.

The lower the square hangs, the harder it is to sample; here it is as wide as it is high.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from playground.shading.vector import Array, dot, reflection, unit

CORNERS = np.array([(-0.5, 1.0, -0.5), (0.5, 1.0, -0.5), (0.5, 1.0, 0.5), (-0.5, 1.0, 0.5)])
DOWN = np.array([0.0, -1.0, 0.0])  # where the square shines
UP = np.array([0.0, 1.0, 0.0])  # the floor's normal
EYE = np.array([0.0, 2.0, 4.0])
FLOOR = 4.0  # its side; the square above has 1
GAUSS = 48  # points along each side for the reference: no more change the 13th digit

Integrand = Callable[[Array], Array]  # of unit vectors (..., S, 3) to the light: (..., S)


def floor(size: tuple[int, int]) -> Array:
    """Points (H, W, 3) of the floor around the square's shadow."""
    width, height = size
    x, z = (FLOOR * ((np.arange(n) + 0.5) / n - 0.5) for n in (width, height))
    return np.stack([*np.broadcast_arrays(x[None, :], 0.0, z[:, None])], axis=-1)


def mirror_axes(points: Array) -> Array:
    """Where the floor mirrors the eye's ray at each point, unit vectors (..., 3)."""
    return reflection(np.broadcast_to(UP, points.shape), unit(EYE - points))


def diffuse(_: Array) -> Integrand:
    """The cosine over π: what a form factor sums."""
    return lambda directions: np.maximum(dot(directions, UP), 0.0) / np.pi


def highlight(points: Array, shininess: float) -> Integrand:
    """max(axis·ω, 0)^shininess: what the Phong lobe sums."""
    axes = mirror_axes(points)[..., None, :]

    def lobe(directions: Array) -> Array:
        with np.errstate(under="ignore"):
            return np.asarray(np.maximum(dot(directions, axes), 0.0) ** shininess)

    return lobe


def integrate(points: Array, integrand: Integrand, places: Array, weights: Array) -> Array:
    """Σ weight · integrand · cos θ'/r² over ``places`` (..., S, 2) of the unit square, (...)."""
    x, z = places[..., 0] - 0.5, places[..., 1] - 0.5
    to_light = np.stack([x, np.ones_like(x), z], axis=-1) - points[..., None, :]
    squared = dot(to_light, to_light)
    directions = to_light / np.sqrt(squared)[..., None]
    return np.asarray(
        np.sum(weights * integrand(directions) * -dot(directions, DOWN) / squared, axis=-1)
    )


def sampled(
    points: Array, integrand: Integrand, count: int, stratified: bool, rng: np.random.Generator
) -> Array:
    """The mean over ``count`` random samples, other ones at each point; one per cell if stratified.

    ``points`` are (..., 3), the result (...). A stratified ``count`` is a square number.
    """
    places = rng.random((*points.shape[:-1], count, 2))
    if stratified:
        side = round(np.sqrt(count))
        cell = np.stack(np.divmod(np.arange(count), side), axis=-1)
        places = (cell + places) / side
    return integrate(points, integrand, places, np.full(count, 1.0 / count))


def converged(points: Array, integrand: Integrand) -> Array:
    """By Gauss's quadrature over the square, (H, W) for ``points`` (H, W, 3)."""
    node, weight = np.polynomial.legendre.leggauss(GAUSS)
    node, weight = 0.5 * (node + 1.0), 0.5 * weight
    places = np.stack(np.meshgrid(node, node), axis=-1).reshape(-1, 2)
    return integrate(points, integrand, places, np.outer(weight, weight).ravel())
