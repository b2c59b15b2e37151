"""The ray tracer on the GPU, float32, against the one in NumPy, float64.

A pixel may differ by a quarter of an 8-bit step, 1/1024. A difference beyond that comes from a ray
that grazes: on one of the two sides of a silhouette, of a shadow's edge, of total internal
reflection or of the threshold a ray of the GPU's goes the other way. So it shows the colour of a
neighbour, within the range of the 3 × 3 pixels around. Curved glass magnifies angles, tenfold
and more at every crossing: the 2⁻²⁴ of the first hit are 10⁻³ after four, and the texture of such
places is finer than a pixel. Counted at 160 × 120, 19200 pixels: at most 96 differ (glass-ring has
79), at most 10 of them leave the range of their neighbours (glass-ring has 6); without
mirrors and glass at most 4, of which none does.
"""

import re
from dataclasses import replace

import numpy as np
import pytest

import playground as pg
from playground.errors import PlaygroundError
from playground.render.gl.trace.features import symbols_of
from playground.render.gl.trace.layout import layout_of
from playground.render.gl.trace.program import sources_of
from playground.render.gl.trace.standing import STEADY
from playground.render.gl.trace.tracer import GLTracer
from playground.render.gl.trace.trees import trees_of
from playground.render.trace.traced_scene import prepare
from playground.render.trace.tracer import NumpyTracer
from playground.scene.material import Material
from playground.scene.scene import Object
from playground.scene.transform import Transform

pytestmark = pytest.mark.gl
SIZE = (160, 120)
STEP = 1.0 / 1024.0


def traced(setup, size=SIZE):
    with GLTracer(size) as tracer:
        return tracer.render(setup)


def reference(setup, size=SIZE):
    with NumpyTracer(size) as tracer:
        return tracer.render(setup)


def neighbours(pixels, extreme):
    wide = np.pad(pixels, ((1, 1), (1, 1), (0, 0)), "edge")
    height, width = pixels.shape[:2]
    shifted = [wide[i : i + height, j : j + width] for i in range(3) for j in range(3)]
    return extreme(shifted, axis=0)


def assert_one_picture(drawn, expected, differing, elsewhere):
    assert (drawn.coverage == expected.coverage).mean() > 0.999
    off = np.abs(drawn.pixels - expected.pixels).max(axis=-1) > STEP
    low = neighbours(expected.pixels, np.min) - STEP
    high = neighbours(expected.pixels, np.max) + STEP
    outside = ((drawn.pixels < low) | (drawn.pixels > high)).any(axis=-1)
    assert off.sum() <= differing, f"{off.sum()} pixels differ"
    assert outside.sum() <= elsewhere, f"{outside.sum()} pixels are like none of their neighbours"


def bounces(setup):
    materials = [item.material for item in setup.scene.objects]
    return any(any(m.reflectance) or any(m.transmittance) for m in materials)


@pytest.mark.parametrize("name", pg.library())
def test_every_setup_of_the_library(gl, name):
    setup = pg.load(name).with_(samples=1)
    drawn, expected = traced(setup), reference(setup)
    assert_one_picture(drawn, expected, *((96, 10) if bounces(setup) else (4, 0)))
    assert drawn.warnings == expected.warnings
    assert abs(drawn.left_out.mean - expected.left_out.mean) <= 0.03 * expected.left_out.mean


@pytest.mark.parametrize("dtype", [np.uint8, np.float32])
@pytest.mark.parametrize("name", ["whitted-room", "glass-of-water", "teapot"])
def test_what_is_left_out_of_a_picture_in_an_array_is_told_when_asked(gl, name, dtype):
    """Its weights are not kept: they are traced again, and the picture stays as it is."""
    setup = pg.load(name).with_(samples=1, depth=2)
    first, again = (np.empty((*SIZE[::-1], 4), dtype) for _ in range(2))
    with GLTracer(SIZE) as tracer:
        expected = tracer.render(setup)
        tracer.render(setup, out=first)
        np.testing.assert_array_equal(tracer.left_out.weights, expected.left_out.weights)
        tracer.render(setup, out=again)
        np.testing.assert_array_equal(again, first)
        if dtype == np.float32:
            np.testing.assert_array_equal(first[..., :3], expected.pixels)


@pytest.mark.parametrize(
    "change",
    [
        {"clear_shadows": False},
        {"fresnel": "schlick"},
        {"depth": 0},
        {"depth": 12, "threshold": 0.0},
        {"highlight": "blinn", "gate": True},
        {"surfaces": "triangles"},
        {"samples": 3},
    ],
)
def test_every_knob_of_the_room(gl, change):
    setup = pg.load("whitted-room").with_(**change)
    assert_one_picture(traced(setup), reference(setup), 96, 10)


def test_a_stretched_mesh_has_the_normals_of_the_rasteriser(gl):
    setup = pg.load("stretched").with_(surfaces="triangles")
    assert any(s.surface.stretched and s.kind == "mesh" for s in prepare(setup, SIZE).solids)
    assert_one_picture(traced(setup), reference(setup), 4, 0)


def solids(**glass):
    """A stretched ball, a cylinder, a disc, a turned square and a box, in this material."""
    material = Material(diffuse=(0.2, 0.3, 0.4), **glass)

    def item(mesh, at, **transform):
        return Object(mesh=mesh, material=material, transform=Transform(translate=at, **transform))

    base = pg.load("whitted-room")
    things = (
        item("sphere", (-1.0, -1.2, 0.0), scale=(0.7, 0.4, 0.5), rotate=(20, 30, 40)),
        item("cylinder", (0.9, -1.0, -0.2), scale=(0.4, 0.7, 0.5), rotate=(15, 0, 25)),
        item("disc", (0.0, 0.6, -0.5), rotate=(60, 10, 20)),
        item("quad", (-1.1, 0.5, -0.6), size=0.5, rotate=(50, 10, 70)),
        item("box", (0.0, -1.3, 1.3), size=0.35, rotate=(10, 40, 5)),
    )
    scene = replace(base.scene, objects=(*base.scene.objects[:6], *things))
    return replace(base, scene=scene)


def test_every_shape(gl):
    setup = solids()
    assert_one_picture(traced(setup), reference(setup), 4, 0)


@pytest.mark.parametrize("absorption", [(0.0, 0.0, 0.0), (0.3, 1.0, 2.0)])
def test_every_shape_of_glass(gl, absorption):
    setup = solids(transmittance=(0.9, 0.9, 0.9), index=1.3, absorption=absorption)
    assert_one_picture(traced(setup), reference(setup), 96, 10)


def placed_anew(setup, factor, by):
    """The same setup, all of it ``factor`` times as large, then moved."""

    def place(point):
        return tuple(factor * x + d for x, d in zip(point, by, strict=True))

    def larger(item):
        scale = tuple(factor * x for x in item.transform.scale)
        at = place(item.transform.translate)
        return replace(item, transform=replace(item.transform, translate=at, scale=scale))

    scene, camera = setup.scene, setup.camera
    objects = tuple(larger(item) for item in scene.objects)
    lights = tuple(replace(light, position=place(light.position)) for light in scene.lights)
    camera = replace(camera, eye=place(camera.eye), target=place(camera.target))
    return replace(setup, scene=replace(scene, objects=objects, lights=lights), camera=camera)


@pytest.mark.parametrize(("factor", "by"), [(1e-3, 0.0), (1e6, 0.0), (1.0, 1e6)])
def test_size_and_place_do_not_matter(gl, factor, by):
    setup = pg.load("whitted-room")
    anew = placed_anew(setup, factor, (by, -by, by))
    assert_one_picture(traced(anew), reference(setup), 96, 10)


def test_a_still_scene_with_a_moving_camera_keeps_its_picture(gl):
    setup = pg.load("whitted-room")
    with GLTracer(SIZE) as tracer:
        for _ in range(STEADY + 2):
            still = tracer.render(setup)
        x, y, z = setup.camera.eye
        moved = replace(setup, camera=replace(setup.camera, eye=(x + 0.4, y - 0.3, z)))
        assert tracer._standing.steady
        assert_one_picture(still, reference(setup), 96, 10)
        assert_one_picture(tracer.render(moved), reference(moved), 96, 10)
        assert tracer._standing.steady


def test_codes_are_those_of_the_linear_picture(gl):
    setup = pg.load("whitted-room").with_(curve="srgb", exposure=1.3)
    for samples in (1, 2):
        some = setup.with_(samples=samples)
        with GLTracer(SIZE) as tracer:
            codes = tracer.render(some, np.empty((SIZE[1], SIZE[0], 4), np.uint8))
            exact = tracer.render(some).codes()
        assert np.abs(codes[..., :3].astype(int) - exact).max() <= 1  # the driver's own rounding
        assert (codes[..., 3] == 255).all()


def live(setup):
    """The fragment stage without the parts that the preprocessor drops, and without comments."""
    scene = prepare(setup, SIZE)
    layout, trees = layout_of(scene), trees_of(scene.solids)
    text = sources_of(symbols_of(scene, layout, trees, False, False))[1].text
    symbols, kept, stack = {}, [], []
    for line in re.sub(r"\\\n", " ", re.sub(r"//[^\n]*", "", text)).splitlines():
        word = line.split()[0] if line.split() else ""
        if word in ("#if", "#ifdef", "#ifndef"):
            stack.append(_holds(line, symbols) if all(stack) else False)
        elif word == "#else":
            stack[-1] = all(stack[:-1]) and not stack[-1]
        elif word == "#endif":
            stack.pop()
        elif all(stack):
            kept.append(line)
            if word == "#define":
                name, *value = line.split(maxsplit=2)[1:]
                symbols[name] = value[0] if value else ""
    return "\n".join(kept)


def _holds(line, symbols):
    word, condition = line.split(maxsplit=1)
    if word != "#if":
        return (condition.strip() in symbols) == (word == "#ifdef")
    condition = condition.replace("__VERSION__", "330")
    named = re.sub(r"[A-Za-z_]\w*", lambda found: str(symbols.get(found[0], 0)), condition)
    named = named.replace("&&", " and ").replace("||", " or ").replace("!", " not ")
    return bool(eval(named))


def test_the_program_has_only_what_the_scene_needs(gl):
    plain, room = live(pg.load("sphere")), live(pg.load("whitted-room"))
    for word in ("refraction(", "fresnel(", "struct Ray {", "bvh_nodes", "medium_absorption"):
        assert word not in plain, word
    assert "refraction(" in room and "struct Ray {" in room
    assert "bvh_nodes" not in room and "medium_absorption" not in room
    assert "uniform uint around_eye" not in room, "one ball of glass needs no memory"
    assert "bvh_nodes" in live(pg.load("teapot"))


def test_mirrors_alone_need_no_stack(gl):
    text = live(pg.load("sphere-row"))
    assert "struct Ray {" in text
    assert "Ray stack[DEPTH]" not in text or "refraction(" in text


def test_no_mistakes_and_not_too_much_glass(gl):
    setup = pg.load("sphere")
    with pytest.raises(PlaygroundError, match="makes no mistakes"):
        traced(setup.with_(bugs=("missing-max",)))
    glass = Material(transmittance=(1.0, 1.0, 1.0))
    many = tuple(Object(material=glass) for _ in range(33))
    with pytest.raises(PlaygroundError, match="too many solids of glass"):
        traced(replace(setup, scene=replace(setup.scene, objects=many)))


def test_more_images_than_the_driver_looks_up_at_once(gl):
    most = int(gl.info["GL_MAX_TEXTURE_IMAGE_UNITS"])
    setup = pg.load("textured")
    tiles = setup.scene.objects[0].material

    def many(count):
        materials = [replace(tiles, shininess=1.0 + k) for k in range(count)]
        objects = tuple(Object(mesh="quad", material=material) for material in materials)
        return replace(setup, scene=replace(setup.scene, objects=objects))

    traced(many(most), (4, 3))
    with pytest.raises(PlaygroundError, match="too many textures") as raised:
        traced(many(most + 1), (4, 3))
    assert "--renderer numpy" in str(raised.value)
