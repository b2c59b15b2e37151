"""Radiosity that has a closed form: furnaces, facing plates, spheres, ducts.

Twin: shaders/lib/enclosure.glsl. What solvers are held against. Light in the unit of colours; ρ
is a reflectance, E what a surface emits, C what leaves it, H what arrives. 1 − ρ is formed
with ρ itself, never with a product: near ρ = 1 all digits are in that difference.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from playground.shading.floats import Array, floats
from playground.shading.optics import mirror_series


def leaving(emission: ArrayLike, rho: ArrayLike, arriving: ArrayLike) -> Array:
    """C = E + ρ H, the radiosity equation of one patch; arrays broadcast to (...).

    Source: Goral, Torrance, Greenberg and Battaile, Modeling the Interaction of Light Between
    Diffuse Surfaces, SIGGRAPH 1984, eq. 1.
    """
    emission, rho, arriving = floats(emission, rho, arriving)
    return np.asarray(emission + rho * arriving)


def furnace(emission: ArrayLike, rho: ArrayLike) -> Array:
    """C = H = E / (1 − ρ) everywhere in any closed enclosure of one E and one ρ < 1; (...).

    Source: Cohen and Wallace, Radiosity and Realistic Image Synthesis, 1993, section 3.
    """
    emission, rho = floats(emission, rho)
    return np.asarray(emission / (1.0 - rho))


def furnace_after(emission: ArrayLike, rho: ArrayLike, bounces: ArrayLike) -> Array:
    """E (1 + ρ + ... + ρ^bounces): the furnace after so many bounces, 0 for its own light; (...).

    So many sweeps of Jacobi's method from C = E. Source: `optics.mirror_series`.
    """
    (emission,) = floats(emission)
    return np.asarray(emission * mirror_series(rho, bounces))


def facing(
    emission: ArrayLike, other_emission: ArrayLike, share: ArrayLike, other_share: ArrayLike
) -> Array:
    """C of one of two surfaces that see each other and not themselves, (...).

    (E₁ + s₁ E₂) / (1 − s₁ s₂), where s = ρ F is the share of the other's light that a surface
    receives and reflects. Infinite plates have F = 1. The denominator is written
    (1 − s₁) + s₁ (1 − s₂). Source: Siegel and Howell, Thermal Radiation Heat Transfer, 1992,
    section 8-3.
    """
    emission, other_emission, share, other_share = floats(
        emission, other_emission, share, other_share
    )
    lost = (1.0 - share) + share * (1.0 - other_share)
    return np.asarray((emission + share * other_emission) / lost)


def around_sphere(
    emission: ArrayLike,
    inner_emission: ArrayLike,
    rho: ArrayLike,
    inner_rho: ArrayLike,
    to_inner: ArrayLike,
) -> Array:
    """C of a hollow sphere around a smaller one, ``to_inner`` the form factor to that; (...).

    (E₂ + ρ₂ F₂₁ E₁) / (1 − ρ₂ (1 − F₂₁) − ρ₂ F₂₁ ρ₁), the denominator as
    (1 − ρ₂) + ρ₂ F₂₁ (1 − ρ₁). All the light of the inner sphere arrives, F₁₂ = 1: it has
    C₁ = `leaving` (E₁, ρ₁, C₂). Holds for any convex body within a surface of constant curvature
    that it leaves evenly lit. Source: Siegel and Howell, 1992, section 8-3.
    """
    emission, inner_emission, rho, inner_rho, to_inner = floats(
        emission, inner_emission, rho, inner_rho, to_inner
    )
    back = rho * to_inner
    lost = (1.0 - rho) + back * (1.0 - inner_rho)
    return np.asarray((emission + back * inner_emission) / lost)


def integrating_sphere(emission: ArrayLike, lost: ArrayLike) -> Array:
    """H everywhere in a sphere of zones: the mean of E over the mean of 1 − ρ; (...).

    From any point of a sphere to a zone the form factor is the zone's share of the area, so all
    zones receive the same. Source: Jacquez and Kuppenheim, Theory of the Integrating Sphere,
    Journal of the Optical Society of America 45(6), 1955.
    """
    emission, lost = floats(emission, lost)
    return np.asarray(emission / lost)


def duct_factor(own: ArrayLike, other: ArrayLike, third: ArrayLike) -> Array:
    """The form factor between two sides of an endless triangular duct, given its sides; (...).

    (a + b − c) / 2a, crossed strings, with the larger of b and c first: in a flat duct a + b and c
    are nearly equal. Source: Hottel, in McAdams, Heat Transmission, 1954.
    """
    own, other, third = floats(own, other, third)
    larger, smaller = np.maximum(own, other), np.minimum(own, other)
    return np.asarray(0.5 * ((larger - third) + smaller) / own)
