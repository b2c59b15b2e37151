"""Snell, Fresnel and Beer–Lambert against what physics says of them."""

import math

import numpy as np
import pytest

from playground.shading.optics import (
    bounces_until,
    cosine_transmitted,
    fresnel,
    fresnel_polarised,
    mirror_series,
    plate_shift,
    refraction,
    schlick,
    sine_between,
    transmitted_share,
)
from playground.shading.vector import reflection, unit

U = 2.0**-53
INDICES = [(1.0, 1.5), (1.5, 1.0), (1.0, 1.333), (2.42, 1.0), (1.5, 1.50001), (1.4, 1.4)]


def rays(rng, n=2000):
    """Unit normals and unit vectors to the eye on their side."""
    normal = unit(rng.normal(size=(n, 3)))
    to_eye = unit(rng.normal(size=(n, 3)))
    below = np.sum(normal * to_eye, axis=1) < 0.0
    to_eye[below] *= -1.0
    return normal, to_eye


@pytest.mark.parametrize("indices", INDICES)
def test_snells_law_and_the_plane_of_incidence(rng, indices):
    n_i, n_t = indices
    normal, to_eye = rays(rng)
    sine_i = sine_between(normal, to_eye)
    direction = refraction(normal, to_eye, n_i, n_t)
    total = n_i * sine_i > n_t
    assert not direction[total].any()
    through = direction[~total]
    n, v = normal[~total], to_eye[~total]
    # A dozen roundings of numbers of size 1, and 1/cos θ_t where the root is steep.
    steep = 1.0 / np.maximum(cosine_transmitted(sine_i[~total], n_i, n_t), 1e-8)
    assert np.all(np.abs(np.linalg.norm(through, axis=1) - 1.0) <= 16 * U * steep)
    assert np.all(np.abs(n_t * sine_between(n, through) - n_i * sine_i[~total]) < 32 * U * steep)
    assert np.all(np.sum(n * through, axis=1) <= 0.0)  # to the far side
    assert np.all(np.abs(np.sum(np.cross(n, v) * through, axis=1)) < 16 * U)


@pytest.mark.parametrize("indices", [pair for pair in INDICES if pair[0] != pair[1]])
def test_fresnel_is_the_textbook(rng, indices):
    n_i, n_t = indices
    angle = rng.uniform(0.0, np.pi / 2, 5000)
    sine, cosine = np.sin(angle), np.cos(angle)
    share_s, share_p = fresnel_polarised(cosine, sine, n_i, n_t)
    root = np.sqrt((1.0 - (n_i / n_t * sine) ** 2).astype(complex))
    r_s = (n_i * cosine - n_t * root) / (n_i * cosine + n_t * root)
    r_p = (n_t * cosine - n_i * root) / (n_t * cosine + n_i * root)
    # The root is off by u/cos θ_t; numerator and denominator, of size cos θ, share that error.
    bound = 64 * U / np.maximum(np.abs(root) * (cosine + np.abs(root)), 1e-16)
    assert np.all(np.abs(share_s - np.abs(r_s) ** 2) <= bound)
    assert np.all(np.abs(share_p - np.abs(r_p) ** 2) <= bound)


def test_what_is_not_reflected_passes(rng):
    # T = (n_t cos θ_t)/(n_i cos θ_i) |t|², with Fresnel's own t: another derivation of 1 − R.
    n_i, n_t = 1.0, 1.5
    angle = rng.uniform(0.0, 1.55, 5000)
    sine, cosine = np.sin(angle), np.cos(angle)
    cosine_t = cosine_transmitted(sine, n_i, n_t)
    t_s = 2 * n_i * cosine / (n_i * cosine + n_t * cosine_t)
    t_p = 2 * n_i * cosine / (n_t * cosine + n_i * cosine_t)
    passed = n_t * cosine_t / (n_i * cosine) * (t_s**2 + t_p**2) / 2
    assert np.all(np.abs(fresnel(cosine, sine, n_i, n_t) + passed - 1.0) < 32 * U)


def test_known_values():
    assert fresnel(1.0, 0.0, 1.0, 1.5) == pytest.approx(0.04, rel=4 * U)
    brewster = np.arctan(1.5)
    assert fresnel_polarised(np.cos(brewster), np.sin(brewster), 1.0, 1.5)[1] < 1e-30
    assert np.all(fresnel(*angles(np.linspace(0, np.pi / 2, 91)), 1.7, 1.7) == 0.0)
    assert np.all(fresnel(*angles(np.radians([42.0, 60.0, 90.0])), 1.5, 1.0) == 1.0)
    assert fresnel(0.0, 1.0, 1.0, 1.5) == pytest.approx(1.0, rel=8 * U)
    critical = np.arcsin(1 / 1.5)
    assert cosine_transmitted(np.sin(critical + 1e-9), 1.5, 1.0) == -1.0
    assert cosine_transmitted(np.sin(critical - 1e-9), 1.5, 1.0) > 0.0


def angles(angle):
    return np.cos(angle), np.sin(angle)


def test_light_takes_the_same_way_back(rng):
    normal, to_eye = rays(rng)
    through = refraction(normal, to_eye, 1.0, 1.5)
    back = refraction(-normal, through, 1.5, 1.0)
    assert np.all(np.abs(back - to_eye) < 64 * U / np.sum(normal * to_eye, axis=1)[:, None])
    there = fresnel(np.sum(normal * to_eye, 1), sine_between(normal, to_eye), 1.0, 1.5)
    here = fresnel(-np.sum(normal * through, 1), sine_between(normal, through), 1.5, 1.0)
    assert np.all(np.abs(there - here) < 64 * U / np.sum(normal * to_eye, axis=1))


def test_mirrored_and_refracted_lie_in_one_plane(rng):
    normal, to_eye = rays(rng)
    mirrored = reflection(normal, to_eye)
    through = refraction(normal, to_eye, 1.0, 1.33)
    assert np.all(
        np.abs(
            np.sum(np.cross(mirrored, through) * np.cross(normal, to_eye), 1)
            + sine_between(mirrored, through) * sine_between(normal, to_eye)
        )
        < 64 * U
    )


def test_schlick_is_as_far_off_as_it_is_known_to_be():
    cosine, sine = angles(np.linspace(0.0, np.pi / 2, 20001))
    for index, worst in ((1.33, 0.060), (1.5, 0.036), (2.42, 0.076)):  # measured, two digits
        off = np.max(np.abs(schlick(cosine, sine, 1.0, index) - fresnel(cosine, sine, 1.0, index)))
        assert off == pytest.approx(worst, abs=1e-3)
    assert schlick(0.5, np.sqrt(0.75), 1.5, 1.5) == pytest.approx(0.5**5)  # the exact answer: 0
    assert schlick(0.5, np.sqrt(0.75), 1.5, 1.0) == 1.0  # total internal reflection


def test_absorption_multiplies_along_the_way(rng):
    absorption = rng.uniform(0.0, 3.0, (100, 3))
    first, second = rng.uniform(0.0, 2.0, (2, 100))
    whole = transmitted_share(absorption, first + second)
    parts = transmitted_share(absorption, first) * transmitted_share(absorption, second)
    # e^x has the relative error x·u of its argument, at most 12 here, for each of three.
    assert np.all(np.abs(parts - whole) <= 64 * U * whole)
    assert np.all(transmitted_share([0.0, 0.0, 0.0], 7.0) == 1.0)
    assert np.all(transmitted_share([1e300, 1.0, 0.0], 1e300) == [0.0, 0.0, 1.0])


def test_plate_shift_is_where_two_refractions_lead(rng):
    angle = rng.uniform(0.01, 1.5, 200)
    cosine, sine = angles(angle)
    normal = np.tile([0.0, 1.0, 0.0], (200, 1))
    to_eye = np.stack([-sine, cosine, 0 * sine], axis=1)
    inside = refraction(normal, to_eye, 1.0, 1.5)
    leave = inside * (-2.0 / inside[:, 1])[:, None]  # through a plate 2 thick
    straight = -to_eye
    aside = np.linalg.norm(np.cross(leave, straight), axis=1)
    shift = plate_shift(2.0, cosine, sine, 1.0, 1.5)
    assert np.all(np.abs(shift - aside) < 64 * U / cosine)


@pytest.mark.parametrize("rho", [0.0, 0.25, 0.9, 0.99, 1.0 - 2.0**-20, 1.0])
@pytest.mark.parametrize("bounces", [0, 1, 5, 4096])
def test_what_two_mirrors_show_is_a_sum_of_powers(rho, bounces):
    exact = math.fsum(rho**k for k in range(bounces + 1))  # each power and the sum rounded once
    # Roundings of log1p, the product, expm1 and the quotient; an error of x in 1 - e^-x shrinks to
    # x / (e^x - 1) <= 1 of it. Two more for the powers and the sum.
    assert mirror_series(rho, bounces) == pytest.approx(exact, rel=8 * U)


@pytest.mark.parametrize("rho", [0.0, 1e-3, 1 / 255, 0.5, 0.9, 0.9999, 1.0 - 2.0**-20])
def test_so_many_bounces_suffice_and_one_less_does_not(rho):
    missing = 1.0 / 255.0
    bounces = bounces_until(rho, missing)
    assert rho ** (bounces + 1) < missing
    assert bounces == 0 or rho**bounces >= missing


@pytest.mark.parametrize(("rho", "missing"), [(1.0, 0.1), (1.5, 0.1), (-0.1, 0.1), (0.5, 0.0)])
def test_no_number_of_bounces_suffices(rho, missing):
    with pytest.raises(ValueError, match="no number of bounces"):
        bounces_until(rho, missing)
