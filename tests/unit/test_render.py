"""Renderers and pictures: what they take, keep and refuse."""

import os
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image as Pillow

import playground as pg
from playground.render.image_file import read_image
from playground.render.projection import clip_matrix, view_rotation

SIZE = (48, 32)
RENDERERS = [pytest.param("gl", marks=pytest.mark.gl), "numpy"]


@pytest.fixture(params=RENDERERS)
def renderer(request):
    if request.param == "gl":
        request.getfixturevalue("gl")
    with pg.open_renderer(SIZE, request.param) as opened:
        yield opened


@pytest.mark.parametrize(
    ("shape", "dtype"),
    [((32, 48, 4), np.uint8), ((32, 48, 3), np.float32), ((32, 48, 4), np.float32)],
)
def test_arrays_are_written_in_place(renderer, shape, dtype):
    out = np.zeros(shape, dtype)
    setup = pg.load("sphere")
    assert renderer.render(setup, out=out) is out
    image = renderer.render(setup)
    assert image.pixels.shape == (32, 48, 3)
    if dtype == np.float32:
        assert np.array_equal(out[..., :3], image.pixels)
    else:
        assert np.abs(out[..., :3].astype(int) - image.codes()).max() <= 1
        assert (out[..., 3] == 255).all()
    assert out[0, 0].any()
    assert (
        image.pixels[16, 24, 0] > image.pixels[0, 0, 0]
    )  # row 0 is on top, the ball in the middle


def test_row_0_is_the_top_row(renderer):
    up = pg.load("sphere").with_(target=(0, -1.5, 0))  # looking down: the ball is above
    image = renderer.render(up)
    assert image.coverage[:16].sum() > image.coverage[16:].sum()


@pytest.mark.parametrize(
    "out",
    [
        np.zeros((32, 48, 3), np.uint8),
        np.zeros((48, 32, 4), np.uint8),
        np.zeros((32, 48, 4), np.float64),
        np.zeros((32, 48), np.uint8),
        [[1, 2]],
    ],
    ids=["rgb8", "turned", "float64", "flat", "list"],
)
def test_other_arrays_are_refused(renderer, out):
    with pytest.raises(pg.PlaygroundError, match=r"uint8 \(32, 48, 4\)"):
        renderer.render(pg.load("sphere"), out=out)


def test_a_view_into_an_array_is_written_too(renderer):
    wall = np.zeros((64, 96, 4), np.uint8)
    renderer.render(pg.load("sphere"), out=wall[16:48, 24:72])
    assert wall[32, 48].any()
    assert not wall[:16].any()


def test_scenes_without_lights_or_objects(renderer):
    setup = pg.load("sphere")
    dark = renderer.render(setup.with_(lights=()))
    assert np.array_equal(np.unique(dark.pixels[16, 24]), [0])
    empty = renderer.render(setup.with_(objects=()))
    assert not empty.coverage.any()
    np.testing.assert_allclose(empty.pixels, np.broadcast_to(setup.scene.background, (32, 48, 3)))


def test_a_hundred_lights(renderer):
    lights = tuple(
        pg.PointLight(position=(np.cos(a) * 4, 3, np.sin(a) * 4), diffuse=(0.01, 0.01, 0.01))
        for a in np.linspace(0, 6, 100)
    )
    one = pg.load("sphere").with_(lights=lights)
    assert 0.1 < renderer.render(one).pixels.max() < 60


def test_an_object_shrunk_to_nothing(renderer):
    """A mesh of many triangles, which GL draws by clusters, under a matrix of zeros."""
    setup = pg.load("sphere").with_(mesh="icosphere", tessellation=40)
    (item,) = setup.scene.objects
    gone = replace(item, transform=pg.Transform(size=0.0))
    with_it, without = (renderer.render(setup.with_(objects=x)) for x in ((gone, item), (item,)))
    assert np.array_equal(with_it.coverage, without.coverage)


@pytest.mark.gl
def test_more_lights_than_the_driver_takes(gl):
    setup = pg.load("sphere").with_(lights=(pg.PointLight(),) * 100_000)
    with pytest.raises(pg.PlaygroundError, match="renderer numpy"):
        pg.render(setup, SIZE, "gl")


@pytest.mark.gl
def test_a_texture_too_large_for_the_driver(gl, tmp_path):
    from PIL import Image

    side = gl.info["GL_MAX_TEXTURE_SIZE"] + 1
    Image.new("RGB", (side, 1)).save(tmp_path / "wide.png")
    setup = pg.load("textured").with_(texture=str(tmp_path / "wide.png"))
    with pytest.raises(pg.PlaygroundError, match="texture is too large"):
        pg.render(setup, SIZE, "gl")


@pytest.mark.gl
def test_earlier_scenes_are_forgotten(gl):
    meshes = [pg.Mesh.create(np.eye(3) * scale, [[0, 1, 2]]) for scale in np.linspace(1, 2, 40)]
    with pg.open_renderer(SIZE, "gl") as renderer:
        for mesh in meshes:
            renderer.render(pg.Setup(pg.Scene(objects=(pg.Object(arrays=mesh),))))
        assert len(renderer._meshes) <= 10


@pytest.mark.gl
def test_too_many_samples_are_noted(gl):
    setup = pg.load("sphere").with_(samples=16)
    image = pg.render(setup, SIZE, "gl")
    if gl.max_samples < 16:
        assert image.notes["samples"] == f"this driver draws {gl.max_samples} samples per pixel"


def test_a_near_distance_that_float32_cannot_hold():
    with pytest.raises(pg.PlaygroundError, match="near = 0"):
        pg.render(pg.load("sphere").with_(near=1e-7), SIZE, "numpy")


@pytest.mark.parametrize("size", [(90, 30), (30, 90)])
def test_what_fits_into_a_wide_picture_fits_into_a_tall_one(size):
    setup = pg.Setup(pg.Scene(objects=(pg.Object("torus"),))).framed((0.3, 0.5, 1))
    image = pg.render(setup, size, "numpy")
    edge = (*image.coverage[0], *image.coverage[-1], *image.coverage[:, 0], *image.coverage[:, -1])
    assert image.coverage.any()
    assert not any(edge)


def test_hostile_numbers_never_reach_a_pixel(renderer):
    """Lights on vertices, in the eye and far out; flattened objects; vanishing normals."""
    mesh = pg.Mesh.create(
        [[-1, -1, 0], [1, -1, 0], [0, 1, 0]], [[0, 1, 2]], [[0, 0, 1], [0, 0, -1], [1, 0, 0]]
    )
    objects = (
        pg.Object(arrays=mesh),
        pg.Object("sphere", transform=pg.Transform(scale=(1, 0, 1))),
        pg.Object("torus", transform=pg.Transform(scale=(1e-6, 1, 1e3))),
    )
    lights = (
        pg.PointLight(position=(0, 1, 0), attenuate=True, constant=0, linear=0, quadratic=1),
        pg.PointLight(position=(0, 0, 3)),
        pg.PointLight(position=(1e15, 0, 0), attenuate=True),
        pg.SpotLight(position=(0, 0, 3), axis=(0, 0, -1), inner_angle=0, outer_angle=0),
        pg.DirectionalLight(to_light=(1e-20, 0, 0)),
    )
    scene = pg.Scene(objects=objects, lights=lights)
    for shading in pg.Shading:
        for shininess in (0, 1e6):
            setup = pg.Setup(scene, pg.Camera(eye=(0, 0, 3)))
            image = renderer.render(setup.with_(shading=shading, shininess=shininess))
            assert np.isfinite(image.pixels).all()


@pytest.mark.parametrize("size", [(0, 10), (10, -1), (1.5, 2), (10,), "ab", (10**6, 2)])
def test_impossible_sizes(size):
    with pytest.raises(pg.PlaygroundError, match="1 to 32768"):
        pg.render(pg.load("sphere"), size, "numpy")


@pytest.mark.gl
def test_a_picture_too_large_for_the_driver(gl):
    with pytest.raises(pg.PlaygroundError, match="too large for this driver"):
        pg.render(pg.load("sphere"), (32768, 8), "gl")


def test_what_render_refuses():
    with pytest.raises(pg.PlaygroundError, match='load\\("teapot"\\)'):
        pg.render("teapot")
    with pytest.raises(pg.PlaygroundError, match="auto, embree, gl, numpy"):
        pg.render(pg.load("sphere"), renderer="cuda")
    with pytest.raises(pg.PlaygroundError, match="lightmap, radiosity, raster, ray-tracing"):
        pg.render(pg.load("sphere"), method="photons")
    with pytest.raises(pg.PlaygroundError, match="playground bake"):
        pg.render(pg.load("sphere"), method="lightmap")


@pytest.mark.parametrize("suffix", ["npy", "exr"])
def test_float_files_keep_every_bit(tmp_path, suffix):
    image = pg.render(pg.load("sphere"), SIZE, "numpy")
    image.save(tmp_path / f"a.{suffix}")
    assert np.array_equal(read_image(tmp_path / f"a.{suffix}").pixels, image.pixels)


def test_a_failed_save_leaves_the_old_file(tmp_path, monkeypatch):
    image = pg.render(pg.load("sphere"), SIZE, "numpy")
    file = tmp_path / "a.png"
    file.write_bytes(b"old")
    monkeypatch.setattr(os, "replace", lambda *_: (_ for _ in ()).throw(OSError("disk full")))
    with pytest.raises(pg.PlaygroundError, match="disk full"):
        image.save(file)
    assert file.read_bytes() == b"old"
    assert [p.name for p in tmp_path.iterdir()] == ["a.png"]


def test_damaged_pictures(tmp_path):
    image = pg.render(pg.load("sphere"), SIZE, "numpy")
    for suffix in ("png", "npy", "exr"):
        file = tmp_path / f"a.{suffix}"
        image.save(file)
        file.write_bytes(file.read_bytes()[:-40] if suffix != "exr" else file.read_bytes()[:100])
        with pytest.raises(pg.PlaygroundError, match="damaged"):
            read_image(file)


def test_notebooks_show_a_png():
    assert pg.render(pg.load("sphere"), (8, 8), "numpy")._repr_png_().startswith(b"\x89PNG")


def test_the_camera_against_pyrr():
    from pyrr import matrix44

    camera = pg.Camera(eye=(3, 2, 5), target=(1, -1, 0), up=(0.2, 1, 0.1), fov=50)
    theirs = matrix44.create_look_at(np.array(camera.eye), camera.target, camera.up, dtype="f8").T
    np.testing.assert_allclose(view_rotation(camera), theirs[:3, :3], atol=1e-15)
    clip = clip_matrix(camera, 1.5, 0.1, 10)
    point = np.array([0.3, 0.2, 0.1])
    projection = matrix44.create_perspective_projection(50, 1.5, 0.1, 10, dtype="f8").T
    want = projection @ theirs @ [*point, 1]
    got = clip @ [*(point - camera.eye), 1]
    np.testing.assert_allclose(got, want, atol=1e-12)


@pytest.mark.parametrize("up", [(0, 1, 0), (0, -1, 0), (0, 1e-9, 0)])
def test_looking_along_up_still_has_a_side(up):
    rotation = view_rotation(pg.Camera(eye=(0, 5, 0), target=(0, 0, 0), up=up))
    np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-15)
    assert np.linalg.det(rotation) == pytest.approx(1.0)


@pytest.mark.parametrize("changes", [{"curve": "srgb"}, {"exposure": 2.5}, {"clamp": False}])
def test_a_png_is_read_as_the_light_that_it_shows(tmp_path, changes):
    """Its codes come out again; light that was not cut is off by half a code at most."""
    setup = pg.load("sphere").with_(**changes)
    image = pg.render(setup, SIZE, "numpy")
    image.save(tmp_path / "a.png")
    read = read_image(tmp_path / "a.png")
    assert np.array_equal(read.codes(), image.codes())
    kept = ((image.pixels * setup.settings.exposure) <= 1.0).all(axis=-1)
    # The inverse curve is steepest at 1, where a code is 2.28 times as much light as without it.
    half = 0.5 / 255 * (2.28 if "curve" in changes else 1.0) / setup.settings.exposure
    # Half a code more or less moves along the curve, whose slope changes by 1 % at most on the way.
    assert np.abs(read.pixels - image.pixels)[kept].max() <= 1.01 * half

    # Without the setup inside, the picture that it is compared with tells.
    bare = image.codes()
    Pillow.fromarray(bare).save(tmp_path / "bare.png")
    assert np.array_equal(read_image(tmp_path / "bare.png", like=setup).pixels, read.pixels)
    assert np.array_equal(
        read_image(tmp_path / "bare.png").pixels, np.asarray(bare / 255.0, np.float32)
    )
