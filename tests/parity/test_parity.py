"""Each GLSL function against its float64 twin, on the same float32 inputs.

u = 2^-24 is the rounding of float32. Tolerances are counts of roundings, derived beside each.
"""

import numpy as np
import pytest

from playground import shading
from playground.render.gl import probe

pytestmark = pytest.mark.gl
U = 2.0**-24
N = 20_000


def f32(a):
    return np.asarray(a, dtype=np.float32).astype(np.float64)


def directions(rng, n=N):
    """Unit vectors, rounded to float32: random ones, and the axes."""
    v = rng.normal(size=(n, 3))
    v /= np.linalg.norm(v, axis=1, keepdims=True)
    v[:3] = np.eye(3)
    v[3:6] = -np.eye(3)
    return f32(v)


def assert_close(got, want, bound):
    """``bound`` broadcasts over the rows; the message shows the worst case."""
    got, want = np.asarray(got, np.float64), np.asarray(want, np.float64)
    assert np.isfinite(got).all()
    excess = np.abs(got - want) / np.broadcast_to(bound, want.shape)
    worst = np.unravel_index(np.argmax(excess), excess.shape)
    assert excess[worst] <= 1.0, f"row {worst}: {got[worst]} != {want[worst]}"


@pytest.mark.parametrize("size", [1e-36, 1e-30, 1e-19, 1.0, 1e18, 1e30, 3e38])
def test_unit_at_every_size(gl, rng, size):
    v = f32(directions(rng) * size * rng.uniform(0.1, 1.0, (N, 1)))
    # Division, three squares, a sum, inversesqrt (1.5 ulp), product: 8 roundings. A component
    # below 1.2e-38 may be flushed to zero, which counts by its share of the length.
    flushed = 1.2e-38 / np.linalg.norm(v / size, axis=1, keepdims=True) / size
    got, want = probe.call("vector", "unit", v), shading.vector.unit(v)
    assert_close(got, want, 8 * U + 2 * flushed)


def test_unit_of_zero_is_zero(gl):
    assert not probe.call("vector", "unit", np.zeros((1, 3))).any()
    assert not probe.call("vector", "unit_moderate", np.zeros((1, 3))).any()
    assert not shading.vector.unit(np.zeros(3)).any()


@pytest.mark.parametrize("size", [1e-15, 1e-6, 1.0, 1e6, 1e17])
def test_unit_moderate_is_unit(gl, rng, size):
    v = f32(directions(rng) * size)
    assert_close(probe.call("vector", "unit_moderate", v), shading.vector.unit(v), 8 * U)


@pytest.mark.parametrize("size", [1e-30, 1.0, 1e37])
def test_length_any(gl, rng, size):
    v = f32(directions(rng) * size * rng.uniform(0.1, 1.0, (N, 1)))
    want = shading.vector.length_any(v)
    assert_close(probe.call("vector", "length_any", v), want, 8 * U * want)


def test_reflection(gl, rng):
    n, l = directions(rng), directions(rng)  # noqa: E741
    # n·l: 3 products, 2 sums (5u); 2(n·l)n: 1 more; minus l: 1 more, of a result up to 2.
    assert_close(probe.call("vector", "reflection", n, l), shading.vector.reflection(n, l), 14 * U)


def test_turned_to_eye(gl, rng):
    n, v = directions(rng), directions(rng)
    clear = np.abs(np.sum(n * v, axis=1)) > 5 * U  # nearer, the sign of n·v is rounding
    got, want = probe.call("vector", "turned_to_eye", n, v), shading.vector.turned_to_eye(n, v)
    assert np.array_equal(got[clear], want[clear])


def test_halfway(gl, rng):
    l, v = directions(rng), directions(rng)  # noqa: E741
    near_opposite = np.linalg.norm(l + v, axis=1) < 1e-3
    l[near_opposite] = v[near_opposite]
    # The sum loses up to u/|l + v|; unit adds 8 roundings.
    bound = 8 * U + 2 * U / np.linalg.norm(l + v, axis=1, keepdims=True)
    assert_close(probe.call("vector", "halfway", l, v), shading.vector.halfway(l, v), bound)


def power_bound(base, exponent, value):
    """y = sh·log2 x has 5 roundings, which exp2 turns into a relative error of y·ln 2 each."""
    y = np.abs(exponent * np.log2(np.maximum(base, 1e-300)))
    return value * U * (8 + 5 * np.minimum(y, 200)) + 1.2e-38


@pytest.mark.parametrize("exponent", [0.0, 0.5, 1.0, 5.0, 20.0, 80.0, 1e3, 1e4, 1e5, 1e6])
def test_power(gl, rng, exponent):
    near_one = 1.0 - 10.0 ** rng.uniform(-7.2, 0.0, N // 2)
    base = f32(np.concatenate([rng.uniform(0.0, 1.5, N // 2), near_one, [0.0, -0.5, 1.0]]))
    base = base[exponent * np.log2(np.maximum(base, 1e-30)) < 120]
    got = probe.call("power", "power", base, exponent)
    want = shading.power.power(base, exponent)
    assert_close(got, want, power_bound(base, exponent, want))


@pytest.mark.parametrize("exponent", [0.0, 1.0, 5.0, 80.0, 1e3, 1e4, 1e5, 1e6])
def test_power_below_one(gl, rng, exponent):
    gap = f32(np.concatenate([10.0 ** rng.uniform(-12.0, 0.0, N), rng.uniform(0, 2, N), [0, 1, 4]]))
    got = probe.call("power", "power_below_one", f32(1.0 - gap), gap, exponent)
    want = shading.power.power_below_one(1.0 - gap, gap, exponent)
    # Far from 1, x = 1 − gap is itself rounded: u/x relative, times the exponent.
    x = np.maximum(1.0 - gap, 1e-30)
    rounded = np.where(x < 0.71, np.minimum(exponent * U / x, 100.0), 0.0)
    assert_close(got, want, power_bound(x, exponent, want) + 2 * want * rounded)


@pytest.mark.parametrize("n", [1, 2, 3, 5, 10, 20, 31, 32])
def test_power_below_one_whole(gl, rng, n):
    gap = f32(np.concatenate([10.0 ** rng.uniform(-12.0, 0.0, N), rng.uniform(0, 2, N), [0, 1, 4]]))
    got = probe.call("power", "power_below_one_whole", f32(1.0 - gap), gap, constant=n)
    want = shading.power.power_below_one(1.0 - gap, gap, n)
    # Squaring doubles a relative error and adds one rounding: n − 1 in all, and 3 at the end.
    # The second order of what 1 − gap lost, (n u/x)²/2, counts where x is small and the value nil.
    x = np.maximum(1.0 - gap, 1e-30)
    second = np.where(gap < 1.0, np.minimum((n * U / x) ** 2, 1.0), 0.0)
    assert_close(got, want, want * (U * (n + 3) + second) + 1.2e-38)


@pytest.mark.parametrize("shininess", [1.0, 5.0, 80.0, 1e3, 1e4, 1e5, 1e6])
def test_lobe_is_accurate_at_any_shininess(gl, rng, shininess):
    axis = directions(rng)
    width = 3.0 / np.sqrt(shininess)
    direction = axis + rng.normal(size=(N, 3)) * width * rng.uniform(0, 1, (N, 1))
    direction = f32(direction / np.linalg.norm(direction, axis=1, keepdims=True))
    got = probe.call("power", "lobe", direction, axis, shininess)
    # t = d·d/2 has 6 roundings relative to t. sh·t·(1−t)^sh is at most 1/e and a half, so
    # they move the value by 6u/2; the power adds y <= 24 before it is below u: 5·24·2^-24·u...
    want = shading.power.lobe(direction, axis, shininess)
    assert_close(got, want, 16 * U)


@pytest.mark.parametrize("shininess", [5.0, 80.0, 1e3, 1e4, 1e5, 1e6])
@pytest.mark.parametrize("name", ["specular_factor", "blinn_factor"])
def test_highlight(gl, rng, name, shininess):
    n, l = directions(rng), directions(rng)  # noqa: E741
    r = shading.vector.reflection(n, l)
    v = r + rng.normal(size=(N, 3)) * 2.0 / np.sqrt(shininess) * rng.uniform(0, 1, (N, 1))
    v = f32(v / np.linalg.norm(v, axis=1, keepdims=True))
    keep = np.linalg.norm(l + v, axis=1) > 0.05
    n, l, v = n[keep], l[keep], v[keep]  # noqa: E741
    got = probe.call("phong", name, n, l, v, shininess)
    want = getattr(shading.phong, name)(n, l, v, shininess)
    # r (or h) is off by up to δ = 14u (h: 10u + 2u/0.05), so t = |d|²/2 by |d|δ. With
    # s = sh·t the value moves by sh·√(2t)·δ·e^-s <= √sh · max √(2s)e^-s · δ = 0.61 √sh δ.
    delta = 14 * U if name == "specular_factor" else 50 * U
    assert_close(got, want, 0.61 * np.sqrt(shininess) * delta + 16 * U)


def test_terms(gl, rng):
    n, l = directions(rng), directions(rng)  # noqa: E741
    s, m = f32(rng.uniform(0, 4, (N, 3))), f32(rng.uniform(0, 1, (N, 3)))
    factor = f32(rng.uniform(0, 1, N))
    phong = shading.phong
    assert_close(probe.call("phong", "diffuse_factor", n, l), phong.diffuse_factor(n, l), 5 * U)
    assert_close(probe.call("phong", "component_filter", s, m), phong.component_filter(s, m), 4 * U)
    for name in ("diffuse_term", "specular_term"):
        got = probe.call("phong", name, factor, s)
        assert_close(got, getattr(phong, name)(factor, s), 4 * U)


def test_gate(gl, rng):
    n, l = directions(rng), directions(rng)  # noqa: E741
    clear = np.abs(np.sum(n * l, axis=1)) > 5 * U  # nearer, the sign of n·l is rounding
    got, want = probe.call("phong", "gate", n, l), shading.phong.gate(n, l)
    assert np.array_equal(got[clear], want[clear])


def test_attenuation(gl, rng):
    d = f32(10.0 ** rng.uniform(-30, 18, N))
    d[:2] = 0.0
    k = f32(10.0 ** rng.uniform(-6, 3, (3, N)))
    k[0, 0] = 0.0  # all of 1/(0 + 0 + 0): finite
    got = probe.call("light", "attenuation", d, *k)
    want = shading.light.attenuation(d, *k)
    assert_close(got, want, 8 * U * want + 1.2e-38)


def test_toward(gl, rng):
    p, q = f32(rng.normal(size=(N, 3)) * 1e3), f32(rng.normal(size=(N, 3)) * 1e3)
    q[0] = p[0]
    got = probe.call("light", "toward", p, q)
    vector, distance = shading.light.toward(p, q)
    assert_close(got[:, :3], vector, 10 * U)
    assert_close(got[:, 3], distance, 10 * U * distance + 1e-30)


@pytest.mark.parametrize(("inner", "outer"), [(15, 25), (20, 20), (0, 180), (1, 1.001), (0, 0.5)])
def test_spot_cone(gl, rng, inner, outer):
    axis = directions(rng)
    spread = np.radians(1.5 * outer) * rng.uniform(0, 1, (N, 1))
    sideways = np.cross(axis, directions(rng))
    sideways /= np.linalg.norm(sideways, axis=1, keepdims=True) + 1e-12
    point = f32(np.cos(spread) * axis + np.sin(spread) * sideways)
    point = f32(point / np.linalg.norm(point, axis=1, keepdims=True))
    edge, width = (f32(x) for x in shading.light.cone(np.radians(inner), np.radians(outer)))
    got = probe.call("light", "spot_cone", axis, point, edge, width)
    want = shading.light.spot_cone(axis, point, edge, width)
    # h = |axis − point|²/4 has 6 roundings; the smooth step has a slope of at most 1.5/width.
    h = np.sum((axis - point) ** 2, axis=1) / 4
    if width == 0:
        clear = np.abs(h - edge) > 8 * U * edge
        assert np.array_equal(got[clear], want[clear])
    else:
        assert_close(got, want, 8 * U + 1.5 * (6 * h + edge) * U / width)


def test_display(gl, rng):
    c = f32(np.concatenate([rng.uniform(-0.5, 3.0, (N, 3)), [[0, 1, 0.0031308], [0.5, 2, -1]]]))
    assert np.array_equal(probe.call("display", "clamp_colour", c), shading.display.clamp_colour(c))
    between = np.abs(np.mod(c * 255 + 0.5, 1.0) - 0.5) < 0.499  # not on the edge of a code
    got, want = probe.call("display", "wrap_colour", c), shading.display.wrap_colour(c)
    assert_close(got[between], want[between], 4 * U)
    x = f32(np.concatenate([rng.uniform(0, 1, N), rng.uniform(0, 0.01, N), [0, 1]]))
    for name in ("srgb_encode", "srgb_decode"):
        assert_close(probe.call("display", name, x), getattr(shading.display, name)(x), 16 * U)


def test_bilinear(gl, rng):
    texels = rng.uniform(0, 1, (7, 5, 3)).astype(np.float32)
    texcoord = f32(rng.uniform(-2, 3, (N, 2)))
    got = probe.call("texture", "bilinear", texcoord, texels=texels)
    # fract of coordinates up to 3 is exact but for 3·u·size texels; then 6 roundings.
    want = shading.texture.bilinear(texels, texcoord)
    assert_close(got, want, 2 * 3 * 7 * U + 6 * U)
