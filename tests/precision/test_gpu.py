"""The GPU in float16 and float64 against NumPy in the same arithmetic.

u = 2^-11 is the rounding of float16, e = 2^-53 that of float64.
"""

import numpy as np
import pytest
from edge_distance import edge_distance

import playground as pg
from playground import locate, shading
from playground.render.gl import probe
from playground.render.gl.bugs import zoo
from playground.render.gl.renderer import GLRenderer
from playground.render.numpy_renderer import clip_positions, culled
from playground.render.surface import surfaces
from playground.render.view import view_of

pytestmark = pytest.mark.gl
U, E = 2.0**-11, 2.0**-53
N = 5_000
SIZE = (160, 120)
SHADINGS = ("flat", "per-vertex", "per-fragment")
THREE = (
    pg.SpotLight(attenuate=True, quadratic=0.05),
    pg.PointLight(position=(-2, 1, 2), diffuse=(0.2, 0.9, 0.4), attenuate=True),
    pg.DirectionalLight(to_light=(0, -1, 0.5), diffuse=(0.5, 0.1, 0.1)),
)


def directions(rng, n=N):
    v = rng.normal(size=(n, 3))
    return v / np.linalg.norm(v, axis=1, keepdims=True)


def calls(rng):
    """Library, function, arguments, and how many e or 2e its float64 results may be apart.

    Two evaluations of one formula in the same order differ where a compiler fuses a product
    with a sum, and by division and square root, which GLSL leaves 2.5 e: half a dozen e.
    """
    n, l, v = directions(rng), directions(rng), directions(rng)  # noqa: E741
    yield "vector", "unit", (7 * v,), 12
    yield "vector", "length_any", (7 * v,), 12 * 8
    yield "vector", "reflection", (n, l), 14
    yield "vector", "halfway", (n[:9], l[:9]), 40
    yield "phong", "diffuse_factor", (n, l), 6
    yield "phong", "component_filter", (n, l), 2
    yield "light", "attenuation", (10 ** rng.uniform(-3, 2, N), *rng.uniform(0.1, 9, (3, N))), 90
    yield "light", "toward", (3 * v, 5 * l), 12 * 16
    # An angle is off by δ = 14e, the value by 0.61 √sh δ (tests/parity); own_pow and own_exp by
    # e times the exponent of e^x, below 40 where the value counts.
    for shininess in (0.0, 1.0, 5.0, 80.0, 1e4):
        near = shading.vector.reflection(n, l) + directions(rng) * 2 / np.sqrt(shininess + 1)
        arguments = (n, l, shading.vector.unit(near), np.full(N, shininess))
        yield "phong", "specular_factor", arguments, 0.61 * np.sqrt(shininess) * 14 + 80
        yield "phong", "blinn_factor", arguments, 0.61 * np.sqrt(shininess) * 50 + 80
    yield "power", "power", (rng.uniform(-0.2, 1.5, N), rng.uniform(0, 9, N)), 40 * 1.5**9


def as_columns(result):
    return np.column_stack(result) if isinstance(result, tuple) else result


def test_formulas_in_float64(gl, rng):
    for library, name, arguments, roundings in calls(rng):
        got = probe.call(library, name, *arguments, precision="float64")
        want = as_columns(getattr(getattr(shading, library), name)(*arguments))
        assert got.dtype == np.float64
        assert np.abs(got - want).max() <= roundings * E, name


def test_formulas_in_float16(gl, rng):
    """The same operations in the same order, each rounded: the same bits.

    exp, log and pow are computed in float32 by both, and rounded: about one in a thousand lies
    where the last digits of float32 decide, and goes to the other neighbour.
    """
    for library, name, arguments, _ in calls(rng):
        arguments = [np.asarray(a, np.float16) for a in arguments]
        got = probe.call(library, name, *arguments, precision="float16")
        want = as_columns(getattr(getattr(shading, library), name)(*arguments))
        assert want.dtype == np.float16
        same = got == want.astype(np.float32)
        exact = name not in ("specular_factor", "blinn_factor", "power")
        assert same.all() if exact else same.mean() >= 0.998, name
        assert (np.abs(got - want) <= 2 * U * np.abs(want) + 2.0**-24).all(), name


def test_rounding_is_that_of_float16(gl):
    """Every float16 with its neighbours halfway, and a little beside: to nearest, ties to even."""
    numbers = np.arange(2**16, dtype=np.uint16).view(np.float16).astype(np.float32)
    numbers = numbers[np.isfinite(numbers)]
    with np.errstate(over="ignore"):
        up = np.nextafter(numbers.astype(np.float16), np.float16(np.inf)).astype(np.float64)
    between = np.where(np.isfinite(up), (numbers + up) / 2, 65520.0).astype(np.float32)
    beside = [np.nextafter(between, np.float32(side)) for side in (-np.inf, np.inf)]
    x = np.concatenate([numbers, between, *beside, [1e6, -1e30, 65519.996, 65520.0]])
    x = x.astype(np.float32)
    # component_filter multiplies by 1 and rounds the product: `rounded` of each component.
    got = probe.call("phong", "component_filter", np.repeat(x[:, None], 3, 1), np.ones((1, 3)),
                     precision="float16")  # fmt: skip
    with np.errstate(over="ignore"):
        assert np.array_equal(got[:, 0], x.astype(np.float16).astype(np.float32))


def away_from_edges(setup):
    """Pixels that see the same triangle in both renderers: see tests/oracle."""
    everything = surfaces(setup.scene, setup.settings.weights)
    view = view_of(setup.camera, everything, SIZE)
    nearest = np.full((SIZE[1], SIZE[0]), np.inf)
    for surface in everything:
        clip, cull = clip_positions(surface, view), culled(surface, view)
        nearest = np.minimum(nearest, edge_distance(clip, surface.mesh.faces, SIZE, cull))
    return nearest > 1.0 / 256.0 + 1e-3


def both(setup):
    """Colours (K, 3) of GL and NumPy where a surface is seen, away from edges."""
    ours, theirs = (pg.render(setup, SIZE, name) for name in ("gl", "numpy"))
    seen = away_from_edges(setup) & (theirs.coverage > 0)
    assert seen.sum() > 500
    return ours.pixels[seen].astype(np.float64), theirs.pixels[seen].astype(np.float64)


@pytest.mark.parametrize("shading", SHADINGS)
@pytest.mark.parametrize("name", ["sphere", "teapot", "textured", "stretched"])
def test_pictures_in_float16(gl, name, shading):
    """The same bits at almost every pixel.

    Six interpolated numbers, good to about 1e-6 in float32, are rounded to float16 with steps
    of 2^-11 to 2^-12: at most 6 · 1e-6/2^-12 = 2 % of the pixels start from a neighbour.
    """
    ours, theirs = both(pg.load(name).with_(shading=shading, precision="float16", lights=THREE))
    assert (ours == theirs).all(axis=1).mean() >= 0.98
    assert np.array_equal(ours, ours.astype(np.float16))


@pytest.mark.parametrize("shading", SHADINGS)
@pytest.mark.parametrize("name", ["sphere", "teapot", "stretched"])
def test_pictures_in_float64(gl, name, shading):
    """Flat shading interpolates nothing: one float32 rounding is left. Else it is interpolated."""
    assert_exact(pg.load(name).with_(shading=shading, lights=THREE))


def assert_exact(setup):
    """GL in float64 draws what NumPy does, as exactly as the shading of the setup allows."""
    ours, theirs = both(setup.with_(precision="float64"))
    error = np.abs(ours - theirs)
    if setup.settings.shading == "flat":
        # Both round to float32; float64 errors of 1e-14 may send one in 10^6 the other way.
        assert (error <= 2.0**-23 * theirs).all()
        assert (error == 0).mean() >= 0.999
        assert (np.abs(both(setup)[0] - theirs) > 0).mean() > 0.1  # float32 is less exact
    assert error.max() <= 2e-4 * max(1.0, theirs.max())  # as tests/oracle, for its reasons
    assert np.median(error) <= 1e-6


@pytest.mark.parametrize("precision", ["float16", "float32", "float64"])
@pytest.mark.parametrize("shading", SHADINGS)
def test_still_scenes_edited_shaders_and_mistakes(gl, precision, shading):
    setup = pg.load("textured").with_(precision=precision, shading=shading, lights=THREE)
    with GLRenderer(SIZE) as renderer:
        first = renderer.render(setup).pixels
        for _ in range(10):
            later = renderer.render(setup).pixels
        assert renderer._baked
        # Constants change no rounding, but for the squarings of float32: 2e-6 (CONTRIBUTING).
        assert np.abs(first - later).max() <= (2e-6 * 3 if precision == "float32" else 1e-7)

        file = "lib/phong.glsl"
        text = locate.shader(file).read_text(encoding="utf-8")
        assert text.count("return factor * product;") == 2
        renderer.overrides = {file: text.replace("factor * product", "0.5 * factor * product")}
        darker = renderer.render(setup).pixels
        assert not renderer.shader_error
        assert darker.mean() < 0.9 * first.mean()
        renderer.overrides = {file: text.replace("factor * product;", "factor * ;")}
        renderer.render(setup)
        assert "shaders/lib/phong.glsl:" in renderer.shader_error
    for name in zoo() if precision != "float32" else ():  # that is native: tests/unit
        with GLRenderer(SIZE) as renderer:
            renderer.render(setup.with_(bugs=(name,)))


def test_float32_is_the_gpus_own(gl):
    setup = pg.load("teapot")
    pictures = [pg.render(setup.with_(precision=p), SIZE, "gl") for p in ("native", "float32")]
    assert np.array_equal(pictures[0].pixels, pictures[1].pixels)


def test_more_digits_less_error(gl):
    """What the lesson shows: each precision against float64, at two shininesses."""
    for shininess in (5, 80):
        setup = pg.load("sphere").with_(shininess=shininess, shading="flat")
        exact = pg.render(setup, SIZE, "numpy").pixels.astype(np.float64)
        clear = away_from_edges(setup)
        errors = {}
        for precision in ("float16", "float32", "float64"):
            picture = pg.render(setup.with_(precision=precision), SIZE, "gl").pixels
            errors[precision] = np.abs(picture - exact)[clear].max()
        assert errors["float64"] < errors["float32"] < 1e-5 < errors["float16"]
        # n, l and v are rounded before anything else: 3u in ρ. √sh max √(2s)e^-s 3u = 1.8 √sh u,
        # three terms of size 1 add 4u each.
        assert errors["float16"] <= (1.83 * np.sqrt(shininess) * 2 + 12) * U
