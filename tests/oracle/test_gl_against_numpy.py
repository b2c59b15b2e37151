"""The two renderers give one picture: GL against float64 NumPy, every setup, every shading.

What remains different, and why it may:

- Coverage. Both round corners to 1/256 pixel, GL after computing them in float32 (about 1e-3 pixel
  at the far side of a window, which may round the other way). A pixel may go to the neighbour, and
  so have the neighbour's colour, only if its centre lies within 1/256 + 1e-3 pixel of an edge.
- Colour. The rasteriser's own float32 interpolation: it extrapolates each varying from a corner of
  the window, so that steep gradients across triangles of a pixel or two carry an error of up to a
  few 1e-5 (colours per vertex) or turn the normal by that much (per fragment, times the slope of
  the highlight). The bound is 2e-4 per unit of the largest colour in the scene, the median 1e-6.
"""

import numpy as np
import pytest
from edge_distance import edge_distance

import playground as pg
from playground.render.numpy_renderer import clip_positions, culled
from playground.render.surface import surfaces
from playground.render.view import view_of

pytestmark = pytest.mark.gl
SIZE = (320, 240)
SHADINGS = ("flat", "per-vertex", "per-fragment")


def near_edges(setup, size=SIZE):
    """Pixels whose centre lies within 1/256 + 1e-3 pixel of an edge of any triangle."""
    everything = surfaces(setup.scene, setup.settings.weights)
    view = view_of(setup.camera, everything, size)
    nearest = np.full((size[1], size[0]), np.inf)
    for surface in everything:
        clip, cull = clip_positions(surface, view), culled(surface, view)
        nearest = np.minimum(nearest, edge_distance(clip, surface.mesh.faces, size, cull))
    return nearest <= 1.0 / 256.0 + 1e-3


def assert_one_picture(setup, size=SIZE):
    with pg.open_renderer(size, "gl") as renderer:
        drawn = renderer.render(setup)
    reference = pg.render(setup, size, renderer="numpy")
    clear = ~near_edges(setup, size)
    assert clear.mean() > 0.5
    assert (drawn.coverage == reference.coverage)[clear].all()
    seen = clear & (reference.coverage > 0)
    assert seen.sum() > 50
    unit = max(1.0, float(np.abs(reference.pixels).max()))
    error = np.abs(drawn.pixels.astype(np.float64) - reference.pixels).max(axis=-1)[seen] / unit
    assert error.max() <= 2e-4, f"worst pixel off by {error.max():.2e}"
    assert np.median(error) <= 1e-6


@pytest.mark.parametrize("shading", SHADINGS)
@pytest.mark.parametrize("name", pg.library())
def test_every_setup_of_the_library(gl, name, shading):
    assert_one_picture(pg.load(name).with_(shading=shading, samples=1))


@pytest.mark.parametrize(
    "change",
    [
        {"highlight": "blinn"},
        {"gate": True},
        {"shininess": 1e4},
        {"terms": ("diffuse",)},
        {"terms": ("ambient", "emissive")},
        {"terms": ()},
        {"specular_weight": 0.25, "diffuse_weight": 2.0},
        {"tessellation": 3},
    ],
    ids=str,
)
def test_every_switch(gl, change):
    assert_one_picture(pg.load("teapot").with_(**change))


def three_lights(**more):
    return (
        pg.SpotLight(attenuate=True, quadratic=0.05, **more),
        pg.PointLight(position=(-2, 1, 2), diffuse=(0.2, 0.9, 0.4), attenuate=True),
        pg.DirectionalLight(to_light=(0, -1, 0.5), diffuse=(0.5, 0.1, 0.1)),
        pg.SpotLight(position=(0, 3, 0), axis=(0, -1, 0), inner_angle=20, outer_angle=20.5),
    )


@pytest.mark.parametrize("shading", SHADINGS)
def test_many_lights_mirrored_stretched_and_seen_from_inside(gl, shading):
    objects = (
        pg.Object("torus", transform=pg.Transform(scale=(1, -1.5, 0.6), rotate=(50, 20, 10))),
        pg.Object("box", transform=pg.Transform(size=6.0)),  # the eye is inside
        pg.Object("cone", transform=pg.Transform(translate=(1.5, -1, -1), scale=(-1, 1, 1))),
    )
    scene = pg.Scene(objects=objects, lights=three_lights())
    assert_one_picture(pg.Setup(scene).with_(shading=shading))


@pytest.mark.parametrize("scale", [1e-6, 1e-3, 1e3, 1e6])
def test_the_size_of_the_world_does_not_matter(gl, scale):
    at = lambda *p: tuple(scale * x for x in p)  # noqa: E731
    light = pg.PointLight(position=at(2, 3, 3), attenuate=True, linear=0.3 / scale, quadratic=0)
    scene = pg.Scene(
        objects=(pg.Object("torus", transform=pg.Transform(size=scale)),), lights=(light,)
    )
    setup = pg.Setup(scene, pg.Camera(eye=at(2, 1.5, 3)))
    assert_one_picture(setup)
    same = pg.Setup(
        pg.Scene(
            objects=(pg.Object("torus"),),
            lights=(pg.PointLight(position=(2, 3, 3), attenuate=True, linear=0.3, quadratic=0),),
        ),
        pg.Camera(eye=(2, 1.5, 3)),
    )
    # The same picture to the rounding of the transform: 2^-24 of positions, through sh = 20.
    ours, theirs = pg.render(setup, SIZE, "numpy"), pg.render(same, SIZE, "numpy")
    assert np.quantile(np.abs(ours.pixels - theirs.pixels), 0.999) < 1e-5


@pytest.mark.parametrize("distance", [1e4, 1e6])
def test_far_from_the_origin_the_picture_is_the_same(gl, distance):
    def moved(x):
        scene = pg.Scene(
            objects=(pg.Object("torus", transform=pg.Transform(translate=(x, 0, -x))),),
            lights=(pg.PointLight(position=(x + 2, 3, -x + 3)),),
        )
        return pg.Setup(scene, pg.Camera(eye=(x + 2, 1.5, -x + 3), target=(x, 0, -x)))

    # Everything is relative to the eye before it becomes float32, so the pictures are equal.
    here, there = (pg.render(moved(x), SIZE, "gl") for x in (0.0, distance))
    assert np.array_equal(here.pixels, there.pixels)


def test_near_plane_through_an_object(gl):
    setup = pg.load("teapot").with_(near=2.9, far=10.0)
    assert_one_picture(setup)


def test_near_plane_through_a_closed_object_off_the_axis(gl):
    """Its inside shows: the near distance is along the view direction, not from the eye."""
    item = pg.Object("sphere", transform=pg.Transform(translate=(3, 0, -3)))
    camera = pg.Camera(eye=(0, 0, 0), target=(0, 0, -1), fov=100, near=2.5)
    setup = pg.Setup(pg.Scene(objects=(item,)), camera)
    assert_one_picture(setup)
    front_only = pg.render(setup.with_(near=0.0), SIZE, "numpy").coverage.sum()
    assert pg.render(setup, SIZE, "numpy").coverage.sum() > 0.8 * front_only


def test_the_near_plane_leaves_objects_whole(gl):
    """Looking past a ball next to the eye: fitting near to it cuts nothing off."""
    setup = pg.load("sphere").with_(eye=(0, 0, 2.2), target=(1.1, 0, 0), fov=60)
    whole = pg.render(setup.with_(near=0.01), SIZE, "numpy")
    fitted = pg.render(setup, SIZE, "numpy")
    assert np.array_equal(whole.coverage, fitted.coverage)
    far = pg.render(setup.with_(far=1e5), SIZE, "gl")
    assert np.array_equal(far.coverage, pg.render(setup, SIZE, "gl").coverage)


@pytest.mark.parametrize("distance", [1e6, 1e12, 1e15, 1e20, 1e28])
def test_lights_however_far(gl, distance):
    lights = (
        pg.PointLight(position=(distance, distance, distance)),
        pg.PointLight(position=(0, distance, 0), attenuate=True, quadratic=0.5 / distance**2),
        pg.SpotLight(position=(0, 0, distance), axis=(0, 0, -1)),
    )
    assert_one_picture(pg.load("sphere").with_(lights=lights))


def test_8_bit_codes_are_the_codes_of_the_float_picture(gl):
    for change in ({}, {"curve": "srgb"}, {"exposure": 1.7}, {"clamp": False, "exposure": 2.0}):
        setup = pg.load("coloured-lights").with_(**change)
        image = pg.render(setup, SIZE, "gl")
        codes = np.empty((SIZE[1], SIZE[0], 4), np.uint8)
        with pg.open_renderer(SIZE, "gl") as renderer:
            renderer.render(setup, out=codes)
        off = np.abs(codes[..., :3].astype(int) - image.codes())
        off = np.minimum(off, 256 - off)
        # The target rounds c·255 + 1/2 in float32: one code where this is nearly whole.
        assert off.max() <= 1
        assert (off > 0).mean() < 1e-3
        assert (codes[..., 3] == 255).all()


def test_a_scene_that_stands_still_keeps_its_picture(gl):
    """After a few frames colours become constants and exponents squarings: at most one code."""
    setup = pg.load("sphere")
    first = np.empty((SIZE[1], SIZE[0], 4), np.uint8)
    with pg.open_renderer(SIZE, "gl") as renderer:
        renderer.render(setup, out=first)
        for _ in range(20):
            later = renderer.render(setup, out=np.empty_like(first))
    off = np.abs(first.astype(int) - later)
    assert off.max() <= 1
    assert (off > 0).mean() < 1e-3


def test_clusters_change_no_pixel(gl, monkeypatch):
    """Skipping what faces away gives, byte for byte, the picture of drawing everything."""
    from playground.render.gl import renderer as module

    setup = pg.load("sphere").with_(mesh="icosphere", tessellation=48)
    assert len(setup.scene.objects[0].geometry().mesh.faces) > 20_000
    for eye in [(0, 0.6, 3.4), (1.2, 0.1, 0.2), (0, 5, 0.01), (-20, 3, 1)]:
        skipping = pg.render(setup.with_(eye=eye), SIZE, "gl")
        with monkeypatch.context() as patch:
            patch.setattr(module, "visible_runs", lambda c, *_: [(0, len(c.faces))])
            everything = pg.render(setup.with_(eye=eye), SIZE, "gl")
        assert np.array_equal(skipping.pixels, everything.pixels)
        assert skipping.coverage.any()


def test_many_samples_smooth_the_edges(gl):
    setup = pg.load("sphere").with_(samples=4)
    smooth = pg.render(setup, SIZE, "gl")
    partly = (smooth.coverage > 0) & (smooth.coverage < 1)
    assert partly.any()
    reference = pg.render(setup.with_(samples=16), SIZE, "numpy")
    # Four samples know an edge to a quarter of a pixel's contrast, on the edge only.
    error = np.abs(smooth.pixels - reference.pixels).max(axis=-1)
    assert error[~partly].mean() < 1e-3
    assert error.mean() < 0.01


def test_moving_sliders_compiles_nothing(gl, monkeypatch):
    from playground.render.gl import edited as module

    compiled = []
    real = module.Program
    monkeypatch.setattr(module, "Program", lambda *a: compiled.append(1) or real(*a))
    setup = pg.load("teapot")
    with pg.open_renderer(SIZE, "gl") as renderer:
        renderer.render(setup)
        assert len(compiled) == 1
        light = pg.DirectionalLight(to_light=(0, 1, 0), diffuse=(0.3, 0.2, 1.0))
        for changed in (
            setup.with_(shininess=77.5),
            setup.with_(lights=(light,)),
            setup.with_(diffuse=(0.1, 0.2, 0.3), specular_weight=0.3),
            setup.with_(eye=(2, 2, 2), fov=50),
        ):
            renderer.render(changed)
        assert len(compiled) == 1
