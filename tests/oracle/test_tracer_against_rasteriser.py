"""Where nothing lies in shadow, a ray traced to depth 0 brings what the rasteriser draws.

Both are float64 NumPy and shade with the same functions, the tracer at the point that it hits, the
rasteriser at the same pixel of the same triangle. They may differ by

- coverage: the rasteriser rounds corners to 1/256 pixel, so that a pixel within that of an edge may
  show the neighbouring triangle;
- rounding: positions by two formulas, 1e-13 of the scene, times the slope of the highlight; and
  the picture is float32. 1e-6 bounds both for the shininess of 20 used here.
"""

import numpy as np
import pytest
from test_gl_against_numpy import near_edges

import playground as pg

SIZE = (160, 120)
HEAD_LIGHT = (2.0, 1.5, 3.0)  # a light in the eye casts no shadow that the eye can see


def both(setup):
    traced = pg.render(setup, SIZE, "numpy", method="ray-tracing")
    drawn = pg.render(setup, SIZE, "numpy")
    clear = ~near_edges(setup, SIZE)
    assert clear.mean() > 0.5
    return traced, drawn, clear


def lit_by_the_eye(*objects, **changes):
    lights = (
        pg.PointLight(position=HEAD_LIGHT, attenuate=True, quadratic=0.1),
        pg.SpotLight(position=HEAD_LIGHT, axis=(-2, -1.5, -3), diffuse=(0.2, 0.6, 0.1)),
    )
    scene = pg.Scene(objects=objects, lights=lights)
    # Interpolated normals may look away from the eye, the light's shadow ray asks the flat one.
    setup = pg.Setup(scene, pg.Camera(eye=HEAD_LIGHT)).with_(depth=0, gate=True, normals="flat")
    return setup.with_(**changes)


@pytest.mark.parametrize("mesh", ["sphere", "torus", "box", "cone", "cylinder", "teapot", "quad"])
def test_every_generator(mesh):
    traced, drawn, clear = both(lit_by_the_eye(pg.Object(mesh), surfaces="triangles"))
    assert np.array_equal(traced.coverage[clear], drawn.coverage[clear])
    np.testing.assert_allclose(traced.pixels[clear], drawn.pixels[clear], atol=1e-6)


def test_mirrored_stretched_flattened_and_from_inside():
    place = pg.Transform
    objects = (
        pg.Object("torus", transform=place(scale=(1, -1.5, 0.6), rotate=(50, 20, 10))),
        pg.Object("box", transform=place(size=6.0)),
        pg.Object("cone", transform=place(translate=(1.5, -1, -1), scale=(-1, 1, 1))),
        pg.Object("sphere", transform=place(translate=(-1.5, 1, 0), scale=(1, 0, 1))),
        pg.Object("sphere", transform=place(size=0.0)),
    )
    traced, drawn, clear = both(lit_by_the_eye(*objects, surfaces="triangles"))
    assert np.array_equal(traced.coverage[clear], drawn.coverage[clear])
    np.testing.assert_allclose(traced.pixels[clear], drawn.pixels[clear], atol=1e-6)


@pytest.mark.parametrize("mesh", ["box", "quad", "grid"])
def test_flat_shapes_are_their_own_triangles(mesh):
    """With normals interpolated and a texture: where nothing is curved, nothing differs."""
    # Quarters are exact in float32, so that the corners of the mesh lie on the shape.
    item = pg.Object(mesh, tessellation=4, material=pg.Material(texture="tiles.png"))
    setup = lit_by_the_eye(item).with_(normals="exact")
    traced, drawn, clear = both(setup)
    seen = clear & (drawn.coverage > 0)
    assert seen.sum() > 500
    # At the border of two texels the texture has a kink, not a step: 1e-13 remains 1e-13.
    np.testing.assert_allclose(traced.pixels[clear], drawn.pixels[clear], atol=1e-6)


@pytest.mark.parametrize("mesh", ["sphere", "cylinder"])
def test_round_shapes_are_the_limit_of_their_triangles(mesh):
    """The mesh's distance to the surface falls with the square of its tessellation."""
    material = pg.Material(texture="tiles.png", diffuse=(1, 1, 1))
    analytic = pg.render(_round(mesh, material, 4), SIZE, "numpy", "ray-tracing")
    errors = []
    for tessellation in (16, 64):
        drawn = pg.render(_round(mesh, material, tessellation), SIZE, "numpy")
        inside = (drawn.coverage > 0) & (analytic.coverage > 0)
        errors.append(np.abs(drawn.pixels - analytic.pixels)[inside].mean())
    # 4² is 16 times less; texels have edges, over which an error is of the first order
    assert errors[1] < errors[0] / 3.5


def test_a_disc_is_its_triangles_and_what_their_outline_cuts_off():
    setup = lit_by_the_eye(pg.Object("disc", tessellation=16)).with_(texture="tiles.png")
    traced, drawn, clear = both(setup)
    seen = clear & (drawn.coverage > 0)
    np.testing.assert_allclose(traced.pixels[seen], drawn.pixels[seen], atol=1e-6)
    assert (traced.coverage[seen] == 1).all()
    assert traced.coverage.sum() > drawn.coverage.sum()


def _round(mesh, material, tessellation):
    item = pg.Object(mesh, tessellation=tessellation, material=material)
    return lit_by_the_eye(item).with_(normals="exact")


@pytest.mark.parametrize("samples", [1, 5])
def test_the_samples_of_a_pixel_are_those_of_the_rasteriser(samples):
    setup = lit_by_the_eye(pg.Object("box"), samples=samples, surfaces="triangles")
    traced, drawn, _ = both(setup)
    # Only samples within 1/256 pixel of an edge may differ: few of the edge's pixels
    assert (traced.coverage != drawn.coverage).sum() <= 6
    assert abs(traced.coverage.sum() - drawn.coverage.sum()) < 4


def test_near_and_far_planes_of_the_camera_cut():
    setup = lit_by_the_eye(pg.Object("torus"), surfaces="triangles", near=3.6, far=4.2)
    traced, drawn, clear = both(setup)
    assert np.array_equal(traced.coverage[clear], drawn.coverage[clear])
    uncut = both(setup.with_(near=0.0, far=0.0))[1]
    assert 0 < traced.coverage.sum() < uncut.coverage.sum()


def test_area_lights_and_their_faces():
    lights = (
        pg.RectangleLight(position=(-2, 1, 2), facing=(2, -0.6, -2), diffuse=(3, 3, 2), turn=20),
        pg.PolygonLight(vertices=((-1, 2, -1), (2, 2, -1), (1, 2, 1)), specular=(4, 4, 4)),
    )
    setup = lit_by_the_eye(pg.Object("quad", transform=pg.Transform(size=2.0)))
    setup = setup.with_(lights=lights, normals="exact", light_samples=4)
    traced, drawn, clear = both(setup)
    assert np.array_equal(traced.coverage[clear], drawn.coverage[clear])
    # Nothing stands between the floor and the lights: every sample arrives, and the share is 1.
    # The faces of lights are float32 meshes to the rasteriser; they have one colour.
    np.testing.assert_allclose(traced.pixels[clear], drawn.pixels[clear], atol=1e-6)
