"""Area lights as values: declared, refused, written, read, seen and explained."""

from dataclasses import replace

import numpy as np
import pytest

import playground as pg
from playground.errors import PlaygroundError
from playground.render.needs import needs
from playground.render.surface import surfaces
from playground.render.view import view_of
from playground.scene.assign import assign, parse_light
from playground.scene.light import PolygonLight, RectangleLight
from playground.scene.outline import area_vector
from playground.scene.setup_file import format_setup, parse_setup

STAR = tuple(
    (float(r * np.cos(a)), 2.0, float(r * np.sin(a)))
    for r, a in zip([2, 0.7] * 5, np.arange(10) * np.pi / 5, strict=True)
)


@pytest.mark.parametrize("facing", [(0, -1, 0), (0, 1, 0), (1, 0, 0), (0.3, -2.0, 0.5), (0, 0, -3)])
@pytest.mark.parametrize("turn", [0.0, 30.0])
def test_a_rectangle_faces_where_it_shines(facing, turn):
    light = RectangleLight(position=(1, 2, 3), facing=facing, turn=turn, width=2.0, height=0.5)
    direction = np.array(facing) / np.linalg.norm(facing)
    np.testing.assert_allclose(area_vector(light.corners), 2.0 * direction, atol=1e-14)
    np.testing.assert_allclose(light.centre, (1, 2, 3), atol=1e-14)
    edges = np.roll(light.corners, -1, axis=0) - np.array(light.corners)
    np.testing.assert_allclose(np.linalg.norm(edges, axis=1), [2.0, 0.5, 2.0, 0.5], rtol=1e-14)


@pytest.mark.parametrize(
    ("vertices", "what"),
    [
        (((0, 0, 0), (1, 0, 0)), "3 to 16 points"),
        (((0, 0, 0), (1, 0, 0), (2, 0)), "three numbers|points"),
        (((0, 0, 0), (1, 0, 0), (2, 0, 0)), "no area"),
        (((0, 0, 0), (1, 0, 0), (1, 1, 0.01), (0, 1, 0)), "one plane"),
        (((0, 0, 0), (1, 1, 0), (1, 0, 0), (0, 1.5, 0)), "cross themselves"),
        (((0, 0, 0), (1, 0, 0), (1, float("nan"), 0)), "valid"),
        ("no points", "valid"),
    ],
)
def test_what_is_no_outline_is_refused(vertices, what):
    with pytest.raises(PlaygroundError, match=what):
        PolygonLight(vertices=vertices)


def test_what_is_nearly_an_outline_is_taken():
    rounded = tuple(tuple(float(np.float32(x)) for x in point) for point in STAR)
    assert PolygonLight(vertices=rounded).corners == rounded
    PolygonLight(vertices=(*STAR[:1], *STAR))  # a corner twice
    PolygonLight(vertices=((0, 0, 0), (1, 0, 0), (2, 0, 0), (2, 2, 0)))  # three on a line
    PolygonLight(vertices=tuple((x + 1e6, y * 1e-6, z) for x, y, z in STAR))


def test_files_flags_and_sets_say_the_same():
    words = "/".join(",".join(str(v) for v in point) for point in STAR)
    light = parse_light(f"polygon vertices={words} two_sided=on visible=off")
    assert light == PolygonLight(vertices=STAR, two_sided=True, visible=False)
    setup = pg.load("sphere").with_(lights=(light, RectangleLight(width=3.0)))
    again = parse_setup(format_setup(setup), setup.name)
    assert again.scene.lights == setup.scene.lights
    before = format_setup(setup)
    assert format_setup(setup, before=before) == before
    assert assign(setup, "light.0.vertices=0,0,0/1,0,0/0,1,0").scene.lights[0].corners[1] == (
        1,
        0,
        0,
    )
    with pytest.raises(PlaygroundError):
        assign(setup, "light.0.vertices=0,0,0/1,0,0")


def test_moving_keeps_the_shape():
    for light in (RectangleLight(turn=20.0), PolygonLight(vertices=STAR)):
        moved = light.moved((1.0, -2.0, 0.5))
        np.testing.assert_allclose(
            np.subtract(moved.corners, light.corners),
            [(1, -2, 0.5)] * len(light.corners),
            atol=1e-15,
        )


def facing_light(**more):
    light = RectangleLight(position=(0, 0, 0), facing=(0, 0, 1), diffuse=(3, 2, 1), **more)
    return pg.load("sphere").with_(objects=(), lights=(light,), eye=(0, 0, 4), target=(0, 0, 0))


def test_the_light_itself_is_seen_from_its_front(renderer):
    centre = lambda setup: pg.render(setup, (41, 31), renderer=renderer).pixels[15, 20]  # noqa: E731
    front = facing_light()
    behind = front.with_(eye=(0.0, 0.0, -4.0))
    background = np.float32(front.scene.background)
    assert np.array_equal(centre(front), (3, 2, 1))
    assert np.array_equal(centre(behind), (0, 0, 0))
    assert np.array_equal(
        centre(facing_light(two_sided=True).with_(eye=(0.0, 0.0, -4.0))), (3, 2, 1)
    )
    assert np.array_equal(centre(facing_light(visible=False)), background)
    assert np.array_equal(centre(front.with_(terms=("diffuse", "specular"))), (0, 0, 0))


def test_only_a_scene_with_an_area_light_carries_its_code():
    for name, count in (("sphere", 0), ("area-light", 2)):
        setup = pg.load(name)
        everything = surfaces(setup.scene, setup.settings.weights)
        view = view_of(setup.camera, everything, (320, 240))
        found = needs(everything[0], view, setup.settings)
        assert (found.area_lights, found.area_corners) == (count, 3 * count)
    sides = [s for s in everything if s.emitter is not None]
    assert len(sides) == 4 and not any(needs(s, view, setup.settings).area_lights for s in sides)


def test_an_area_light_is_explained():
    setup = pg.load("area-light")
    why = pg.explain(setup, (120, 420))
    light = why.corners[0].lights[0]
    assert light.area and 0.0 < light.diffuse_factor < 1.0
    np.testing.assert_allclose(
        why.colour, pg.render(setup, renderer="numpy").pixels[420, 120], rtol=1e-6
    )
    assert "F s_d ⊗ m_d" in why.text() and "∫" in why.text() and "\\int" in why.latex()
    itself = pg.explain(setup, (60, 100))
    assert itself.to_dict()["light"] == 0 and itself.object is None
    assert "light 0 (rectangle) itself" in itself.text()
    np.testing.assert_allclose(itself.colour, setup.scene.lights[0].diffuse)


@pytest.fixture(params=["numpy", pytest.param("gl", marks=pytest.mark.gl)])
def renderer(request):
    """Both renderers, the GPU's where there is one."""
    if request.param == "gl":
        request.getfixturevalue("gl")
    return request.param


@pytest.mark.parametrize("shift", [0.0, 1e6])
@pytest.mark.parametrize("size", [1.0, 1e-6, 1e6])
def test_the_place_and_the_size_of_the_scene_do_not_matter(renderer, shift, size):
    """The same picture for a scene of another size, and far from the origin at that size."""
    base = pg.load("area-light").with_(samples=1)
    want = pg.render(base, (64, 40), renderer=renderer).pixels

    def place(point):
        return tuple(size * (x + s) for x, s in zip(point, (shift, 0.0, -shift), strict=True))

    lights = []
    for light in base.scene.lights:
        if isinstance(light, RectangleLight):
            lights.append(
                replace(
                    light,
                    position=place(light.position),
                    width=light.width * size,
                    height=light.height * size,
                )
            )
        else:
            lights.append(replace(light, vertices=tuple(place(v) for v in light.vertices)))
    objects = [
        replace(
            item,
            transform=replace(
                item.transform,
                translate=place(item.transform.translate),
                size=item.transform.size * size,
            ),
        )
        for item in base.scene.objects
    ]
    moved = base.with_(
        lights=lights, objects=objects, eye=place(base.camera.eye), target=place(base.camera.target)
    )
    got = pg.render(moved, (64, 40), renderer=renderer).pixels
    # Coordinates of 10^6 have 1e-10 left in float64: silhouettes may move by that, colours too.
    apart = np.abs(got - want).max(axis=-1) / want.max()
    assert np.quantile(apart, 0.99) <= (2e-5 if renderer == "gl" else 1e-6)
