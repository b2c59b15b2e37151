"""Baked light against closed forms, constants, and the solution itself; no light through walls."""

from dataclasses import replace

import numpy as np
import pytest
from lit_scenes import BLACK, GREY, box, lamp, looked_up, room, setup

import playground as pg
from playground.render.lightmap.atlas import unwrap
from playground.render.lightmap.bake import bake, baking
from playground.render.lightmap.gather import Points
from playground.render.lightmap.solved import Solved
from playground.render.lightmap.surroundings import frames, hemisphere
from playground.render.radiosity.result import radiosity
from playground.scene.light import PointLight
from playground.scene.material import Material
from playground.scene.scene import Object
from playground.scene.transform import Transform

SINGLE = float(np.finfo(np.float32).eps)


def baked(the_setup, size=64, rays=64, **settings):
    return bake(radiosity(the_setup.with_(**settings)), size, rays)


@pytest.mark.parametrize("rays", [0, 16])
@pytest.mark.parametrize("mesh", ["room", "sphere"])
def test_in_a_furnace_all_is_one(rays, mesh):
    """E/(1 − ρ) = 0.5 at every texel that a lookup reads; straight from the walls, E.

    The sphere, of hundreds of glowing patches, is seen from within: they are met by rays.
    """
    glowing = Material(diffuse=(0.8, 0.5, 0.2), emissive=(0.1, 0.25, 0.4), specular=(0, 0, 0))
    ball = Object(mesh="sphere", tessellation=16, transform=Transform(scale=(1.0, 1.0, -1.0)))
    shape = room((-1, 1), (0, 1), (-2, 3)) if mesh == "room" else _inside_out(ball)
    scene = setup([replace(shape, material=glowing)], [], patches=300, normalise=True)
    lightmap = baked(scene, rays=rays)
    for light, want in (
        (lightmap.texels(), 0.5),
        (lightmap.direct, np.array(glowing.emissive)),
        (lightmap.indirect, 0.5 - np.array(glowing.emissive)),
    ):
        # The solver stops at 1e-10; the closed form of the six walls is off by 2e-15 + 1e-13 F;
        # then the sum of two float32 numbers below 1 is off by their three roundings.
        assert np.abs(light - want)[lightmap.coverage].max() < 1e-9 + 2.0 * SINGLE


def _inside_out(item):
    from playground.scene.mesh import Mesh

    mesh = item.geometry().mesh
    faces = mesh.faces[:, ::-1]
    return Object(mesh="ball", arrays=Mesh.create(mesh.positions, faces, -mesh.normals))


def test_a_lamp_over_a_floor():
    """The form factor from points of a plane to a parallel square, corner by corner.

    F = ±1/(2π) Σ over corners of a/√(a²+h²) atan(b/√(a²+h²)) + b/√(b²+h²) atan(a/√(b²+h²)).
    Source: Howell, A Catalog of Radiation Heat Transfer Configuration Factors, B-4.
    """
    height, half = 1.5, 0.5
    floor = Object(mesh="quad", material=BLACK)
    scene = setup([floor], [lamp((0.0, height, 0.0), 2 * half, (3.0, 2.0, 1.0))], patches=50)
    result = radiosity(scene)
    lightmap = bake(result, 64, 16)
    points, shown = looked_up(lightmap, scene.scene, 0, np.random.default_rng(1))
    total = np.zeros(len(points))
    for sx in (-1, 1):
        for sz in (-1, 1):
            a, b = sx * half - points[:, 0], sz * half - points[:, 2]
            ra, rb = np.hypot(a, height), np.hypot(b, height)
            total += sx * sz * (a / ra * np.arctan(b / ra) + b / rb * np.arctan(a / rb))
    want = total[:, None] / (2.0 * np.pi) * np.array([3.0, 2.0, 1.0])
    # A bilinear lookup is off by at most 1/8 of the second differences along u and v, and at the
    # edges of the chart by the light's change over 1/64 texel; F″ < 1 for a square this near.
    texel = 2.0 / 60.0
    assert np.abs(shown - want).max() < 3.0 * (2.0 / 8.0 * texel**2 + texel / 64.0)
    assert not lightmap.indirect.any()


def test_a_point_light_with_a_shadow():
    """s_d n·l where the light is seen, nothing where the box hides it."""
    floor = Object(mesh="quad", material=BLACK, transform=Transform(scale=(2.0, 1.0, 2.0)))
    block = box((0.0, 0.5, 0.0), (0.5, 0.05, 0.5), BLACK)
    light = PointLight(position=(0.0, 2.0, 0.0), diffuse=(2.0, 2.0, 2.0), attenuate=False)
    scene = setup([floor, block], [light], patches=100)
    lightmap = baked(scene, size=128)
    points, shown = looked_up(lightmap, scene.scene, 0, np.random.default_rng(1))
    texel = 4.0 / 60.0  # at most: half of the atlas is the box's
    # The upper face of the box, at 0.55, casts the wider shadow: as far as 0.5 · 2/1.45.
    away = np.abs(points[:, [0, 2]]).max(axis=1) - 0.5 * 2.0 / (2.0 - 0.55)
    outside, inside = away > 1.5 * texel, away < -1.5 * texel
    distance = np.linalg.norm(points - light.position, axis=1)
    want = 2.0 * 2.0 / distance
    assert np.abs(shown[outside] - want[outside, None]).max() < 2.0 * texel**2 + texel / 8.0
    assert not shown[inside].any()


@pytest.fixture(scope="module")
def divided():
    """A black room, lit on its left; a thin wall stands on the floor and reaches the ceiling."""
    wall = box((0.0, 0.5, 0.0), (0.1, 0.5, 1.0), GREY)
    objects = [room((-2, 2), (0, 1), (-1, 1), BLACK), wall]
    scene = setup(objects, [lamp((-1.0, 0.99, 0.0), 0.8)], patches=300)
    return scene, baked(scene, size=192)


def test_no_light_comes_through_a_wall(divided):
    """The wall is four texels thick: no lookup in the dark room reads a texel of the lit one."""
    scene, lightmap = divided
    for number, count in ((0, 40_000), (1, 10_000)):
        points, shown = looked_up(lightmap, scene.scene, number, np.random.default_rng(3), count)
        dark = points[:, 0] >= 0.1
        assert dark.sum() > 1000 and not shown[dark].any()


def test_no_darkness_comes_through_a_wall(divided):
    """Close to the wall the lit floor is as bright as without it: buried texels do not count."""
    scene, lightmap = divided
    without = replace(scene, scene=replace(scene.scene, objects=scene.scene.objects[:1]))
    plain = baked(without, size=192)
    rng = np.random.default_rng(4)
    points, shown = looked_up(lightmap, scene.scene, 0, rng, 40_000, "direct")
    _, free = looked_up(plain, without.scene, 0, np.random.default_rng(4), 40_000, "direct")
    floor = (points[:, 1] == 0.0) & (points[:, 0] < -0.1)
    near = floor & (points[:, 0] > -0.15)
    assert near.sum() > 100
    # Texels within the wall were moved by up to 1.5 texels. The light of a lamp at height h falls
    # by at most 2/h of itself per length: as h²/(x² + h²)², where x = h. Half a texel is for
    # bilinear lookups in two atlases.
    texel = 1.0 / min(unwrap(s.scene, 192).density for s in (scene, without))
    assert np.abs(shown / np.maximum(free, 1e-6) - 1.0)[near].max() < 2.0 / 0.99 * 2.0 * texel


def test_through_a_wall_thinner_than_a_texel_light_comes_one_texel_far():
    """No texel can be on both sides: that is told, and bounded by the diagonal of a lookup."""
    wall = box((0.0, 0.5, 0.0), (0.001, 0.5, 1.0), GREY)
    objects = [room((-2, 2), (0, 1), (-1, 1), BLACK), wall]
    scene = setup(objects, [lamp((-1.0, 0.99, 0.0), 0.8)], patches=300)
    work = baking(radiosity(scene), 96, 16)
    while True:
        try:
            next(work)
        except StopIteration as end:
            found = end.value
            break
    assert found.split > 0 and "a wall between them" in str(found)
    points, shown = looked_up(found.lightmap, scene.scene, 0, np.random.default_rng(3), 40_000)
    texel = 1.0 / unwrap(scene.scene, 96).density
    far = points[:, 0] > 0.001 + 2.0 * texel  # charts are stretched by less than √2
    assert far.sum() > 1000 and not shown[far].any()


def test_the_error_falls_with_the_size():
    """Light of the patches, texel by texel, against the same between their corners."""
    scene = pg.load("cornell-box").with_(patches=300)
    result = radiosity(scene).solve()
    solved = Solved(result.patches, result.indirect)
    errors = []
    for size in (64, 128, 256):
        lightmap = bake(result, size, 0)
        squares = []
        for number in (1, 2, 3):  # walls that nothing stands on
            points, shown = looked_up(
                lightmap, scene.scene, number, np.random.default_rng(5), shown="indirect"
            )
            at = points - result.patches.origin
            side = _side(result.patches, number, at)
            want = solved.at(Points(at, side, side), np.full(len(at), number))
            squares.append((shown - want) ** 2)
        errors.append(np.sqrt(np.mean(np.concatenate(squares))))
    assert errors[1] < 0.6 * errors[0] and errors[2] < 0.6 * errors[1]


def _side(patches, owner, points):
    """The normals of an owner's patches nearest to points."""
    own = np.flatnonzero(patches.owner == owner)
    apart = np.linalg.norm(patches.centre[own][None] - points[:, None], axis=2)
    return patches.normal[own[np.argmin(apart, axis=1)]]


def test_gutters_hold_the_light_of_their_chart():
    glowing = replace(GREY, emissive=(0.25, 0.25, 0.25))
    lightmap = baked(setup([room((0, 1), (0, 1), (0, 1), glowing)], [], patches=60), rays=4)
    around = np.zeros_like(lightmap.coverage)
    for y in (-1, 0, 1):
        for x in (-1, 0, 1):
            around |= np.roll(lightmap.coverage, (y, x), axis=(0, 1))
    assert (around & ~lightmap.coverage).sum() > 100
    assert np.abs(lightmap.texels()[around] - 0.5).max() < 1e-9 + 2.0 * SINGLE


def test_the_same_every_time():
    scene = pg.load("indirect-room").with_(patches=100)
    one, other = baked(scene), baked(scene)
    assert np.array_equal(one.direct, other.direct)
    assert np.array_equal(one.indirect, other.indirect)


def test_progress_rises_to_one_and_can_be_dropped():
    scene = setup([room((0, 1), (0, 1), (0, 1))], [lamp((0.5, 0.9, 0.5), 0.2)], patches=60)
    shares = []
    bake(radiosity(scene), 32, 4, shares.append)
    assert len(shares) > 3 and shares == sorted(shares)
    assert shares[0] > 0.0 and 0.9 < shares[-1] <= 1.0
    work = baking(radiosity(scene), 32, 4)
    next(work)
    work.close()


@pytest.mark.parametrize("rays", [-1, 1.5, True, 10**9])
def test_numbers_of_rays_that_are_none(rays):
    with pytest.raises(pg.PlaygroundError, match="rays per texel"):
        next(baking(radiosity(pg.load("furnace")), 32, rays))


def test_more_texels_than_fit_are_refused_before_any_work(monkeypatch):
    monkeypatch.setattr("playground.render.lightmap.bake.available", lambda: 1000 * 100**2)
    result = radiosity(pg.load("furnace").with_(patches=24), "numpy")
    with pytest.raises(pg.PlaygroundError, match=r"101 x 101 texels.*about 100 texels"):
        bake(result, 101)
    assert result.step is None, "nothing was solved"
    assert bake(result, 100, 0).size == 100


def test_the_hemisphere():
    """Evenly spread as the cosine: its mean direction is (0, 0, 2/3), and every ray is a unit."""
    rays = hemisphere(4096)
    assert np.abs(np.linalg.norm(rays, axis=1) - 1.0).max() < 1e-15
    # A lattice of n points misses the integral of a smooth function by a few 1/n.
    assert np.abs(rays.mean(axis=0) - (0.0, 0.0, 2.0 / 3.0)).max() < 8.0 / 4096


def test_only_light_that_there_is_can_be_shown():
    result = radiosity(pg.load("furnace").with_(patches=24), "numpy")
    for ask in (result.bake(16).image, lambda shown: result.stored(shown=shown)):
        with pytest.raises(pg.PlaygroundError, match="'both'; allowed: all, direct, indirect"):
            ask("both")


def test_frames(rng):
    normals = rng.normal(size=(500, 3))
    normals = np.concatenate([normals, np.eye(3), -np.eye(3)])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    axes = frames(normals)
    assert np.abs(axes @ axes.swapaxes(1, 2) - np.eye(3)).max() < 1e-14
    assert np.array_equal(axes[:, 2], normals)


@pytest.mark.parametrize("renderer", ["numpy", pytest.param("gl", marks=pytest.mark.gl)])
def test_drawn_from_its_lightmap_a_furnace_is_even(request, renderer, tmp_path):
    if renderer == "gl":
        request.getfixturevalue("gl")
    scene = pg.load("furnace").with_(patches=60, solver="gauss-seidel", convergence=1e-10)
    bake(radiosity(scene), 64, 4).save(tmp_path / "a.npz")
    file = str(tmp_path / "a.npz")
    image = pg.render(scene.with_(lightmap=file), (48, 36), renderer, "lightmap")
    # Of float32: the texels, four weights, their sum, times m_d, plus m_e: ten roundings of 0.5.
    assert np.abs(image.pixels - 0.5).max() < 1e-9 + 10.0 * SINGLE
    dark = pg.render(scene.with_(lightmap=file, light_shown="direct"), (8, 6), renderer, "lightmap")
    material = scene.scene.objects[0].material
    straight = np.array(material.emissive) * (1.0 + np.array(material.diffuse))
    assert np.abs(dark.pixels - straight).max() < 1e-9 + 10.0 * SINGLE


@pytest.mark.parametrize("renderer", ["numpy", pytest.param("gl", marks=pytest.mark.gl)])
def test_direct_and_indirect_light_make_the_whole_picture(request, renderer, tmp_path):
    if renderer == "gl":
        request.getfixturevalue("gl")
    scene = pg.load("cornell-box").with_(patches=60, background=(0.3, 0.2, 0.1))
    scene = scene.with_(specular=(0.3, 0.3, 0.3), emissive=(0.0, 0.05, 0.0))
    bake(radiosity(scene), 64, 0).save(tmp_path / "a.npz")
    scene = scene.with_(lightmap=str(tmp_path / "a.npz"))
    whole, direct, indirect = (
        pg.render(scene.with_(light_shown=shown), (48, 36), renderer, "lightmap").pixels
        for shown in ("all", "direct", "indirect")
    )
    # Ten roundings, as above, of each; the lamp shows 21
    np.testing.assert_allclose(direct + indirect, whole, rtol=20.0 * SINGLE, atol=1e-6)
    assert (whole != direct).any() and (indirect[0, 0] == 0.0).all()


def test_what_cannot_be_drawn(tmp_path):
    scene = pg.load("furnace")
    with pytest.raises(pg.PlaygroundError, match="no lightmap to draw with"):
        pg.render(scene, (8, 6), "numpy", "lightmap")
    bake(radiosity(scene.with_(patches=60)), 32, 1).save(tmp_path / "a.npz")
    other = pg.load("cornell-box").with_(lightmap=str(tmp_path / "a.npz"))
    with pytest.raises(pg.PlaygroundError, match="other geometry"):
        pg.render(other, (8, 6), "numpy", "lightmap")


def test_a_lightmap_of_other_lights_says_so(tmp_path):
    scene = pg.load("furnace").with_(patches=60)
    bake(radiosity(scene), 32, 1).save(tmp_path / "a.npz")
    scene = scene.with_(lightmap=str(tmp_path / "a.npz"))
    assert pg.render(scene, (8, 6), "numpy", "lightmap").warnings == ()
    changed = pg.render(scene.with_(diffuse=(0.1, 0.1, 0.1)), (8, 6), "numpy", "lightmap")
    assert any("Bake it again" in said for said in changed.warnings)
