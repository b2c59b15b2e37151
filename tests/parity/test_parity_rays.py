"""Rays and optics on the GPU against their float64 twins, on the same float32 inputs."""

import numpy as np
import pytest

from playground.render.gl import probe
from playground.shading import optics, ray, shadow, triangle
from tests.parity.test_parity import U, assert_close, directions, f32

pytestmark = pytest.mark.gl
N = 4_000


def shot(rng, spread=1.0):
    """Rays from a sphere of radius 3 roughly at the origin, of any length."""
    origin = 3.0 * directions(rng, N)
    direction = spread * rng.uniform(-1.0, 1.0, (N, 3)) - origin
    return f32(origin), f32(direction * rng.uniform(0.1, 10.0, (N, 1)))


def compared(got, want, bound, clear):
    """Equal decisions where ``clear``; t within the bound, relative, where both hit."""
    got, want = np.asarray(got, np.float64), np.asarray(want, np.float64)
    assert np.mean(clear) > 0.9
    assert np.array_equal(got[clear] < 0.0, want[clear] < 0.0)
    both = (got >= 0.0) & (want >= 0.0) & clear
    assert both.any()
    assert_close(got[both], want[both], (bound * np.abs(want))[both])
    return both


def test_ray_sphere(gl, rng):
    origin, direction = shot(rng, 1.5)
    centre, radius = f32(rng.uniform(-0.3, 0.3, (N, 3))), f32(rng.uniform(0.3, 1.2, N))
    got = probe.call("ray", "ray_sphere", origin, direction, centre, radius)
    want, from_centre = ray.ray_sphere(origin, direction, centre, radius)
    seen = origin - centre
    line = direction / np.linalg.norm(direction, axis=1, keepdims=True)
    passing = np.linalg.norm(np.cross(seen, line), axis=1)
    # The nearest point is off by some 12 u of |seen| <= 3.6; the square root halves the digits
    # of what is left of the chord.
    slack = 12 * U * np.linalg.norm(seen, axis=1)
    half = np.sqrt(np.abs(radius**2 - passing**2))
    clear = (np.abs(radius - passing) > slack) & (half > 1e-2)
    bound = 16 * U + 2 * slack * radius / np.maximum(half, 1e-3)
    both = compared(got[:, 0], want, bound, clear)
    assert_close(got[both, 1:], from_centre[both], (6.0 * bound[:, None] + 8 * U)[both])


def test_a_ray_at_the_middle_of_a_ball_far_away_hits(gl, rng):
    """From 10^8 radii away and aimed at the centre: no rounding of t may lead it past the ball.

    Powers of two as the direction and whole numbers of 24 bits as t: origin + t · direction is
    0 without rounding, so the vector from the centre is a radius, off by a few roundings. In
    t = c / q they are 7 of the two factors of c, 4 of q, and 5 of a product and a quotient.
    """
    steps = np.array([[1, 2, -2], [1, -4, 8], [0, 1, 1], [2, -1, 2], [1, 1, 1]])
    direction = f32(rng.permuted(steps[rng.integers(len(steps), size=N)], axis=1))
    t = 64.0 * rng.integers(2**18, 2**21, (N, 1))
    origin, centre, radius = f32(-t * direction), np.zeros((N, 3), np.float32), f32(np.ones(N))
    want = -direction / np.linalg.norm(direction, axis=1, keepdims=True)
    got = probe.call("ray", "ray_sphere", origin, direction, centre, radius)
    same = ray.ray_sphere(*map(np.float32, (origin, direction, centre, radius)))
    for first, from_centre in ((got[:, 0], got[:, 1:]), same):
        assert_close(first, t[:, 0], 16 * U * t[:, 0])
        assert_close(from_centre, want, np.full((N, 3), 8 * U))


@pytest.mark.parametrize("name", ["ray_plane", "ray_disc"])
def test_flat_shapes(gl, rng, name):
    origin, direction = shot(rng, 0.8)
    point, normal = f32(rng.uniform(-0.2, 0.2, (N, 3))), directions(rng, N)
    radius = () if name == "ray_plane" else (f32(rng.uniform(0.5, 1.5, N)),)
    got = probe.call("ray", name, origin, direction, point, normal, *radius)
    want = getattr(ray, name)(origin, direction, point, normal, *radius)
    steep = np.abs(np.sum(normal * direction, 1)) / np.linalg.norm(direction, axis=1)
    distance = np.abs(np.sum(normal * (point - origin), 1))
    bound = U * (8 + 24 / np.maximum(steep, 1e-3) + 24 / np.maximum(distance, 1e-3))
    clear = (steep > 1e-2) & (distance > 1e-2)
    if radius:
        t = ray.ray_plane(origin, direction, point, normal)
        away = np.linalg.norm(origin + t[:, None] * direction - point, axis=1)
        clear &= np.abs(away - radius[0]) > 8 * bound * (1 + away)
    compared(got, want, bound, clear)


def test_ray_tube(gl, rng):
    origin, direction = shot(rng, 1.5)
    origin[: N // 4] *= 0.2  # from within
    origin = f32(origin)
    got = probe.call("ray", "ray_tube", origin, direction, -1.0, 1.0)
    want = ray.ray_tube(origin, direction, -1.0, 1.0)
    flat = np.hypot(direction[:, 0], direction[:, 2])
    across = np.abs(origin[:, 0] * direction[:, 2] - origin[:, 2] * direction[:, 0]) / flat
    half = np.sqrt(np.abs(1.0 - across**2))
    rises = np.abs(direction[:, 1]) / flat
    height = np.minimum(
        np.abs(np.abs(origin[:, 1] + want * direction[:, 1]) - 1.0), np.where(want < 0, 0, 1)
    )
    t_end = [
        (side - origin[:, 1]) / np.where(direction[:, 1] == 0, 1, direction[:, 1])
        for side in (-1.0, 1.0)
    ]
    rim = np.min(
        [
            np.abs(
                np.hypot(origin[:, 0] + t * direction[:, 0], origin[:, 2] + t * direction[:, 2])
                - 1.0
            )
            for t in t_end
        ],
        0,
    )
    clear = (half > 0.05) & (rim > 1e-3) & (rises < 50) & (np.where(want > 0, height, 1) > 1e-4)
    t_scale = np.maximum(np.abs(want) * flat, 1e-3)
    bound = U * (32 + 64 * np.linalg.norm(origin, axis=1) / half / t_scale)
    compared(got, want, bound, clear)


def test_ray_box(gl, rng):
    origin, direction = shot(rng)
    direction[: N // 3, 0] = 0.0
    direction[N // 4 : N // 2, 1] = -0.0
    low = f32(rng.uniform(-1.0, -0.2, (N, 3)))
    high = f32(rng.uniform(0.2, 1.0, (N, 3)))
    origin[: N // 5] = f32(0.1 * origin[: N // 5])
    got = probe.call("ray", "ray_box", origin, direction, low, high)
    entry, leave = ray.ray_box(origin, direction, low, high)
    clear = np.abs(leave - entry) > 8 * U * np.maximum(np.abs(leave), np.abs(entry))
    clear |= np.isinf(leave)
    hit = entry <= leave
    assert np.array_equal((got[:, 0] <= got[:, 1])[clear], hit[clear])
    # A difference and a quotient of exact numbers: 2 roundings.
    assert_close(got[hit, 0], entry[hit], 4 * U * np.abs(entry[hit]) + 1e-30)
    assert_close(got[hit, 1], leave[hit], 4 * U * np.abs(leave[hit]) + 1e-30)


def test_ray_triangle(gl, rng):
    origin, direction = shot(rng, 0.4)
    corners = [f32(rng.normal(size=(N, 3))) for _ in range(3)]
    got = probe.call("triangle", "ray_triangle", origin, direction, *corners)
    want, weights = triangle.ray_triangle(origin, direction, *corners)
    shear = triangle.ray_shear(direction)
    flat = [np.einsum("nij,nj->ni", shear, c - origin)[:, :2] for c in corners]
    size = np.max([np.linalg.norm(p, axis=1) for p in flat], axis=0)
    a, b, c = flat
    edges = [np.abs(p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]) for p, q in ((c, b), (a, c), (b, a))]
    area = np.abs(np.cross(np.pad(b - a, ((0, 0), (0, 1))), np.pad(c - a, ((0, 0), (0, 1))))[:, 2])
    # A vertex is off by 6 u of up to 7 units, an edge function by that times the size, and 2 u.
    slack = 48 * U * size * np.maximum(size, 1.0)
    clear = (np.min(edges, axis=0) > slack) & (area > 0.05)
    bound = 3 * slack / np.maximum(area, 1e-3)
    depth = np.max([np.abs(np.sum((c - origin), 1)) for c in corners], axis=0) + 3.0
    t_bound = 16 * U + bound * depth / np.maximum(
        np.abs(want) * np.linalg.norm(direction, axis=1), 1e-2
    )
    both = compared(got[:, 0], want, t_bound, clear)
    assert_close(got[both, 1:], weights[both], bound[both, None] + 4 * U)


def test_nothing_slips_between_triangles(gl, rng):
    """A fan around the origin; rays aimed at its shared edges and at the shared corner."""
    turn = 2 * np.pi * np.arange(9) / 9
    rim = np.stack([np.cos(turn), np.sin(turn), 0.3 * np.sin(3 * turn)], 1)
    rim, hub = f32(rim + rng.normal(size=rim.shape) * 0.01), f32(rng.normal(size=3) * 0.1)
    along = rng.uniform(0.0, 0.9, (N, 1)) * (rng.uniform(size=(N, 1)) < 0.9)
    target = hub + along * (rim[rng.integers(0, 9, N)] - hub)
    origin = f32(directions(rng, N) * [1, 1, 0.2] + [0.0, 0.0, 5.0])
    direction = f32(target - origin)
    hits32, hits64 = np.zeros(N, int), np.zeros(N, int)
    for k in range(9):
        a, b, c = (np.tile(p, (N, 1)) for p in (hub, rim[k], rim[(k + 1) % 9]))
        hits32 += probe.call("triangle", "ray_triangle", origin, direction, a, b, c)[:, 0] > 0.0
        hits64 += triangle.ray_triangle(origin, direction, a, b, c)[0] > 0.0
    assert hits32.min() >= 1
    assert hits64.min() >= 1


@pytest.mark.parametrize("size", [1e-6, 1.0, 1e5])
def test_offset_ray(gl, rng, size):
    point, normal = f32(rng.uniform(-size, size, (N, 3))), directions(rng, N)
    error = f32(4 * 2.0**-23 * np.max(np.abs(point), axis=1))
    for moved, type_ in (
        (probe.call("ray", "offset_ray", point, normal, error), np.float32),
        (ray.offset_ray(point, normal, error), np.float64),
    ):
        step = np.sum((np.asarray(moved, np.float64) - point) * normal, axis=1)
        assert np.all(step > error)
        rounding = 4 * np.max(np.spacing(np.abs(moved).astype(type_)), axis=1)
        assert np.all(step <= 2 * error * (1 + 4 * U) + rounding)


def test_ray_shear(gl, rng):
    direction = f32(directions(rng, N) * rng.uniform(0.1, 9.0, (N, 1)))
    turned = np.einsum("nij,nj->ni", triangle.ray_shear(direction), direction)
    assert np.max(np.abs(turned - [0.0, 0.0, 1.0])) <= 4 * 2.0**-53  # a quotient and a product


def test_optics(gl, rng):
    normal, to_eye = directions(rng, N), directions(rng, N)
    below = np.sum(normal * to_eye, 1) < 0.0
    to_eye[below] *= -1.0
    n_i, n_t = f32(rng.uniform(1.0, 2.5, (2, N)))
    sine = optics.sine_between(normal, to_eye)
    assert_close(probe.call("optics", "sine_between", normal, to_eye), sine, 8 * U)
    sine, cosine = f32(sine), f32(np.sum(normal * to_eye, 1))
    through = optics.cosine_transmitted(sine, n_i, n_t)
    got = probe.call("optics", "cosine_transmitted", sine, n_i, n_t)
    # Near the critical angle the difference under the root is off by 2 u of n_i sin θ_i.
    clear = np.abs(n_t - n_i * sine) > 8 * U
    assert np.array_equal((got < 0.0)[clear], (through < 0.0)[clear])
    steep = 1.0 / np.maximum(np.abs(through), 1e-3)
    keep = clear & (np.abs(through) > 1e-2)
    assert_close(got[keep], through[keep], (U * (4 + 8 * (n_i / n_t) ** 2 * steep))[keep])
    cos_error = U * (4 + 16 * (n_i / n_t) ** 2 * steep)
    for name in ("fresnel", "schlick", "schlick_either"):
        want = getattr(optics, name)(cosine, sine, n_i, n_t)
        got = probe.call("optics", name, cosine, sine, n_i, n_t)
        # R changes by at most 4/(cos θ_i + cos θ_t) per unit of cos θ_t.
        bound = 16 * U + 8 * cos_error / np.maximum(cosine, 1e-2)
        assert_close(got[keep], want[keep], bound[keep])
    want = np.stack(optics.fresnel_polarised(cosine, sine, n_i, n_t), 1)
    got = probe.call("optics", "fresnel_polarised", cosine, sine, n_i, n_t)
    assert_close(
        got[keep], want[keep], (16 * U + 8 * cos_error / np.maximum(cosine, 1e-2))[keep, None]
    )
    want = optics.refraction(normal, to_eye, n_i, n_t)
    got = probe.call("optics", "refraction", normal, to_eye, n_i, n_t)
    assert_close(got[keep], want[keep], (16 * U + 2 * cos_error)[keep, None])


def test_absorption_and_plates(gl, rng):
    absorption, distance = f32(rng.uniform(0, 4, (N, 3))), f32(rng.uniform(0, 3, N))
    want = optics.transmitted_share(absorption, distance)
    got = probe.call("optics", "transmitted_share", absorption, distance)
    # x = a·d <= 12 carries one rounding, exp 1e-6.
    assert_close(got, want, want * (16 * U + 2e-6) + 1e-37)
    angle = rng.uniform(0.0, 1.4, N)
    sine, cosine = f32(np.sin(angle)), f32(np.cos(angle))
    want = optics.plate_shift(2.0, cosine, sine, 1.0, 1.5)
    got = probe.call("optics", "plate_shift", 2.0, cosine, sine, 1.0, 1.5)
    # n_t cos θ_t − n_i cos θ_i >= 0.5, of numbers up to 1.5: 16 roundings, times sin θ_i.
    assert_close(got, want, 32 * U * sine + 1e-37)


@pytest.mark.parametrize("two_sided", [False, True])
def test_shadow_shares(gl, rng, two_sided):
    to_lamp, facing = directions(rng, N), directions(rng, N)
    distance = f32(rng.uniform(0.1, 20.0, N))
    want = shadow.lamp_weight(to_lamp, distance, facing, two_sided)
    got = probe.call("shadow", "lamp_weight", to_lamp, distance, facing, two_sided)
    # A cosine is off by 3 u, whatever it is; a product and a quotient.
    assert_close(got, want, (3 * U + 4 * U) / distance**2)
    whole = f32(rng.uniform(0.0, 2.0, N) * (rng.uniform(size=N) < 0.9))
    seen = f32(whole * rng.uniform(0.0, 1.0, N))
    want = shadow.visible_share(seen, whole)
    assert_close(probe.call("shadow", "visible_share", seen, whole), want, 4 * U * want)
    assert (want[whole == 0.0] == 1.0).all()
