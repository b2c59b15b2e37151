"""The path-traced reference: its mean is the exact picture, within its own error bars."""

import numpy as np
import pytest

import playground as pg
from playground.render.trace.path import PathTracing
from playground.scene.shapes import make

WHITE = (1.0, 1.0, 1.0)
BLACK = (0.0, 0.0, 0.0)


def traced(setup, size=(12, 9), samples=64, seed=1):
    path = PathTracing(setup, size, seed)
    for _ in path.steps(samples):
        pass
    return path


def furnace(reflectance, emission=0.5):
    """The inside of a ball-like closed mesh that shines and reflects alike everywhere."""
    ball = make("icosphere", 3)
    inside = pg.Mesh.create(ball.positions, ball.faces[:, ::-1], -ball.normals)
    material = pg.Material(diffuse=(reflectance,) * 3, emissive=(emission,) * 3)
    thing = pg.Object(arrays=inside, material=material, normals="flat")
    camera = pg.Camera(eye=(0.1, 0.2, 0.1), target=(0.0, 0.0, -1.0))
    return pg.Setup(pg.Scene(objects=(thing,), lights=()), camera)


@pytest.mark.parametrize("reflectance", [0.0, 0.5, 0.9])
def test_furnace(reflectance):
    """Every path ends by chance, and nothing is lost by it: E / (1 - rho)."""
    path = traced(furnace(reflectance), samples=100)
    want = 0.5 / (1.0 - reflectance)
    mean = path.image().pixels.mean(dtype=np.float64)
    # The channels are alike, so that one of them counts; pixels are independent.
    error = np.sqrt((path.standard_error()[..., 0] ** 2).sum()) / (12 * 9)
    assert abs(mean - want) <= 4.0 * error + 1e-6 * want
    assert error < 0.03 * want


def test_direct_light_is_what_the_ray_tracer_shows():
    """Point light and shadow: no chance is involved but where in the pixel a path starts."""
    floor = pg.Object(
        "quad",
        material=pg.Material(diffuse=WHITE, specular=BLACK),
        transform=pg.Transform(scale=(4, 4, 4)),
    )
    ball = pg.Object(
        "sphere",
        material=pg.Material(diffuse=BLACK, specular=BLACK),
        transform=pg.Transform(translate=(0.0, 0.7, 0.0), scale=(0.5, 0.5, 0.5)),
    )
    lights = (pg.PointLight(position=(0.5, 3.0, 0.0), ambient=BLACK),)
    camera = pg.Camera(eye=(0.0, 2.0, 3.0), target=(0.0, 0.0, 0.0))
    setup = pg.Setup(pg.Scene(objects=(floor, ball), lights=lights), camera)
    path = traced(setup, (16, 12), 64)
    want = pg.render(setup.with_(samples=16), (16, 12), "numpy", "ray-tracing").pixels
    # 16 fixed samples of a pixel and 64 random ones differ by the edges in it: at most 1 of
    # contrast, off by 4 standard deviations 0.5/8 and a step of 1/16 each.
    assert np.abs(path.image("direct").pixels - want).max() < 4 * 0.5 / 8 + 1 / 16
    inner = np.abs(path.image("direct").pixels - want).mean()
    assert inner < 0.01


def test_area_light_by_chance_is_the_closed_form():
    setup = pg.load("area-light").with_(terms=("diffuse", "emissive"), specular=BLACK)
    path = traced(setup, (24, 18), 64)
    want = pg.render(setup.with_(light_samples=256, samples=16), (24, 18), "numpy", "ray-tracing")
    off = path.image("direct").pixels.astype(float) - want.pixels
    error = path.standard_error()
    lit = error[..., 0] > 0.0
    # Means over the picture: independent pixels, and 2/256 of the light at most where a
    # shadow is soft (the lattice's own error).
    mean, spread = off[lit].mean(axis=0), np.sqrt((error[lit] ** 2).sum(axis=0)) / lit.sum()
    assert np.all(np.abs(mean) < 4.0 * spread + 2 / 256)


def test_what_is_not_direct_is_indirect():
    path = traced(furnace(0.5), samples=4)
    parts = [path.image(shown).pixels for shown in ("all", "direct", "indirect")]
    assert np.allclose(parts[0], parts[1] + parts[2], atol=1e-6)
    # Emission and one bounce of it: 0.5 + 0.25, the same on every path.
    assert np.allclose(parts[1], 0.75, atol=1e-6)


def test_seeds_differ_and_repeat():
    setup = pg.load("area-light")
    first, again, other = (traced(setup, (8, 6), 2, seed).image().pixels for seed in (1, 1, 2))
    assert np.array_equal(first, again)
    assert not np.array_equal(first, other)


def test_the_error_falls_with_the_root_of_the_samples():
    setup = pg.load("area-light")
    few = traced(setup, (16, 12), 32).standard_error()
    many = traced(setup, (16, 12), 512).standard_error()
    ratio = np.sqrt((few**2).mean() / (many**2).mean())
    assert 3.0 < ratio < 5.3  # 4, but for what 32 samples tell of a variance


def test_it_can_be_dropped_at_any_step():
    path = PathTracing(pg.load("area-light"), (8, 6))
    steps = path.steps(4)
    assert 0.0 < next(steps) < 1.0
    steps.close()
    assert path.image().pixels.shape == (6, 8, 3)
