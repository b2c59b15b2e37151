"""The door to ray tracing: arguments, errors, warnings, progress, what is told of cut-offs."""

import numpy as np
import pytest

import playground as pg
from playground.render.trace.traced_scene import prepare
from playground.render.trace.tracer import NumpyTracer, Tracing
from playground.render.trace.whitted import BATCH, PRIMARY, REFLECTION, primary, waves

SIZE = (40, 30)
CLEAR = (1.0, 1.0, 1.0)


def trace(setup, size=SIZE):
    return pg.render(setup, size, "numpy", method="ray-tracing")


@pytest.mark.parametrize(
    ("knobs", "words"),
    [
        ({"index": 0.0}, ("material.index", "0.01 to 100")),
        ({"index": -1.5}, ("material.index",)),
        ({"absorption": (-1, 0, 0)}, ("material.absorption",)),
        ({"reflectance": (0.5, 0.6, 0.1), "transmittance": (0.5,) * 3}, ("green", "1.1", "0.4")),
        ({"reflectance": (0, 0, 1.5)}, ("blue", "at most 1", "reflectance to 1")),
        ({"depth": -1}, ("settings.depth", "0 to 100")),
        ({"threshold": -0.1}, ("settings.threshold",)),
        ({"light_samples": 0}, ("settings.light_samples",)),
        ({"fresnel": "schlik"}, ("schlick",)),
    ],
)
def test_knobs_refuse_what_makes_no_sense(knobs, words):
    with pytest.raises(pg.PlaygroundError) as caught:
        pg.load("sphere").with_(**knobs)
    for word in words:
        assert word in str(caught.value)


def test_shares_that_are_1_together_are_welcome():
    for mirrored in np.linspace(0.0, 1.0, 101):
        pg.Material(reflectance=(mirrored,) * 3, transmittance=(1.0 - mirrored,) * 3)


def test_defaults_leave_a_surface_as_it_was():
    assert not any(pg.Material().reflectance) and not any(pg.Material().transmittance)
    image = trace(pg.load("sphere"))
    assert image.left_out.max == 0.0 and image.warnings == ()


@pytest.mark.parametrize("name", pg.library())
def test_every_setup_of_the_library_can_be_traced(name):
    image = trace(pg.load(name), (16, 12))
    assert np.isfinite(image.pixels).all()
    assert image.coverage.max() == 1.0


def test_renderer_names():
    with pg.open_renderer(SIZE, "auto", method="ray-tracing") as opened:
        assert opened.name == "numpy" or opened.name.startswith("gl")
    with pytest.raises(pg.PlaygroundError, match="unknown method"):
        pg.open_renderer(SIZE, "numpy", method="rays")


def test_the_tracer_writes_into_arrays():
    setup = pg.load("whitted-room").with_(depth=1)
    image = trace(setup)
    with NumpyTracer(SIZE) as tracer:
        codes = tracer.render(setup, out=np.empty((SIZE[1], SIZE[0], 4), np.uint8))
        floats = tracer.render(setup, out=np.empty((SIZE[1], SIZE[0], 4), np.float32))
        assert tracer.left_out.max == image.left_out.max > 0.0
        assert tracer.samples(setup.with_(samples=3)) == 3
    assert np.array_equal(codes[..., :3], image.codes())
    assert np.array_equal(floats[..., :3], image.pixels)
    assert np.array_equal(floats[..., 3], image.coverage)


def test_bugs_are_for_the_rasteriser():
    with pytest.raises(pg.PlaygroundError, match="makes no mistakes"):
        trace(pg.load("sphere").with_(bugs=("missing-max",)))


def test_a_picture_grows_sample_by_sample():
    """Every pixel has its first sample before any has its second; each step can be looked at."""
    setup = pg.load("sphere-row").with_(samples=3, depth=1)
    size = (BATCH // 60, 100)  # two batches for each sample, two waves for each batch
    tracing = Tracing(setup, size)
    assert not tracing.image().pixels.any()
    done, pictures = [], []
    for share in tracing.steps():
        done.append(share)
        pictures.append(tracing.image().pixels)
    assert done == sorted(done) and done[-1] == 1.0 and len(done) == 3 * (2 * 2 + 1)
    first = [picture.reshape(-1, 3) for picture in pictures[:5]]
    assert first[0][:BATCH].any() and not first[0][BATCH:].any()
    assert (first[1] >= first[0]).all() and (first[1] > first[0]).any()  # the mirrored light
    assert first[2][BATCH:].any()
    np.testing.assert_array_equal(pictures[-1], trace(setup, size).pixels)


def test_the_ray_tree_of_a_pixel_multiplies_out_to_its_colour():
    setup = pg.load("whitted-room")
    scene = prepare(setup, SIZE)
    pixel = 23 * SIZE[0] + 26
    origin, direction, limit = scene.camera_rays(np.array([pixel]), (0.5, 0.5))
    found = list(waves(scene, primary(scene, origin, direction, np.zeros(1, np.intp)), limit))
    colour = sum(wave.added.sum(axis=0) for wave in found)
    np.testing.assert_allclose(colour, trace(setup).pixels.reshape(-1, 3)[pixel], rtol=1e-6)

    # Every ray but the first names the ray that sent it out, from where that one ended.
    numbers, ends = {-1}, {}
    for wave in found:
        assert wave.first == len(numbers) - 1
        for i in range(len(wave.t)):
            parent = int(wave.rays.parent[i])
            assert parent in numbers
            if parent >= 0:
                gap = np.abs(wave.rays.origin[i] - ends[parent]).max()
                assert gap < 1e-12 and wave.rays.kind[i] >= REFLECTION
            else:
                assert wave.rays.kind[i] == PRIMARY and wave.depth == 0
        numbers |= {wave.first + i for i in range(len(wave.t))}
        ends |= {wave.first + int(i): p for i, p in zip(wave.hit, wave.met.position, strict=True)}
    assert len(numbers) > 6
    assert max(wave.depth for wave in found) >= 3


def warned(setup):
    return [text.split(":")[0] for text in trace(setup, (8, 6)).warnings]


def test_open_glass_is_named():
    assert warned(pg.load("teapot").with_(transmittance=CLEAR)) == ["open glass"]
    assert warned(pg.load("sphere").with_(transmittance=CLEAR)) == []
    assert warned(pg.load("glass-ring").with_(samples=1)) == []


def test_a_light_inside_a_solid_is_named_but_not_in_a_room():
    lamp = pg.PointLight(position=(0.1, 0.2, 0.0))
    setup = pg.load("sphere").with_(lights=(lamp,))
    assert warned(setup) == ["light inside a solid"]
    assert "nothing outside" in trace(setup, (8, 6)).warnings[0]
    assert "unbent" in trace(setup.with_(transmittance=CLEAR), (8, 6)).warnings[0]
    assert warned(setup.with_(eye=(0.0, 0.0, 0.5))) == []  # the sphere is a room
    assert warned(setup.with_(mesh="quad")) == []


def test_what_is_ignored_is_named():
    setup = pg.load("sphere")
    assert warned(setup.with_(shading="flat", precision="float16")) == ["shading", "precision"]


def test_holes_and_overlaps_do_no_harm():
    """Open meshes of glass, solids of equal priority within one another: finite, and no loop."""
    teapot = pg.load("teapot").with_(transmittance=(0.9,) * 3, index=1.4, depth=6)
    twice = teapot.with_(objects=teapot.scene.objects * 2)
    nested = pg.load("sphere").with_(transmittance=CLEAR).scene.objects
    inside = (*nested, *pg.load("sphere").with_(mesh="box", transmittance=CLEAR).scene.objects)
    for setup in (teapot, twice, teapot.with_(objects=inside)):
        assert np.isfinite(trace(setup, (24, 18)).pixels).all()


def test_an_empty_scene_is_its_background():
    image = trace(pg.Setup(pg.Scene(objects=(), background=(0.2, 0.3, 0.4))))
    np.testing.assert_allclose(image.pixels, np.full((30, 40, 3), (0.2, 0.3, 0.4)), rtol=1e-6)
    assert not image.coverage.any()


def test_area_lights_are_seen_in_mirrors():
    lamp = pg.RectangleLight(position=(0, 0, 6), facing=(0, 0, -1), width=20, height=20)
    floor = pg.preset("mirror")
    setup = pg.load("sphere").with_(
        objects=(pg.Object("quad", material=floor, transform=pg.Transform(rotate=(90, 0, 0))),),
        lights=(lamp,),
        eye=(0, 0, 3),
        terms=("emissive",),
    )
    assert trace(setup, (1, 1)).pixels[0, 0] == pytest.approx([0.9] * 3)
    hidden = setup.with_(lights=(pg.RectangleLight(position=(0, 0, 6), visible=False),))
    expected = 0.9 * np.array(setup.scene.background)
    assert trace(hidden, (1, 1)).pixels[0, 0] == pytest.approx(expected)


def test_presets_for_ray_tracing():
    for name in ("glass", "water", "diamond", "mirror", "gold mirror", "glossy plastic"):
        assert (
            trace(pg.load("sphere").with_(**_knobs(pg.preset(name))), (8, 6)).left_out is not None
        )
    assert pg.preset("diamond").index == 2.417
    assert pg.preset("gold", pg.preset("glass")) == pg.preset("gold")
    with pytest.raises(pg.PlaygroundError, match="Did you mean 'glass'"):
        pg.preset("glas")


def _knobs(material):
    from playground.scene.knob import knobs

    return {name: getattr(material, name) for name in knobs(pg.Material)}
