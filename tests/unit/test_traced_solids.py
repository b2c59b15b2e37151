"""What rays meet: shapes with a formula are the surfaces that the generators' meshes lie on."""

import numpy as np
import pytest

import playground as pg
from playground.render.trace import analytic
from playground.render.trace.hits import arriving, closest
from playground.render.trace.lamp import facing_of, points_on, square_points
from playground.render.trace.traced_scene import prepare
from playground.scene.shapes import make
from playground.scene.shapes_curved import uv_sphere
from playground.shading.ray import offset_ray
from playground.shading.vector import dot, unit

SIZE = (32, 24)
ROUNDED = 2.0**-22  # of float32 numbers up to 1, and of what follows from a few of them


def vertices(generator):
    """Corners, normals, texture coordinates of a mesh; without poles, where u is a choice."""
    mesh = make(generator, 24)
    places, normals = mesh.positions.astype(float), mesh.normals.astype(float)
    texcoords = mesh.texcoords if mesh.texcoords is not None else np.zeros((len(places), 2))
    kept = np.hypot(places[:, 0], places[:, 2]) > 1e-6
    return places[kept], normals[kept], texcoords[kept].astype(float)


def rays_to(places, normals):
    """From a little outside of each corner, not along the normal, straight to it."""
    start = places + 0.25 * normals + 0.1 * np.roll(normals, 1, axis=1)
    return start, unit(places - start)


@pytest.mark.parametrize("generator", [g for g in analytic.GENERATORS if g != "icosphere"])
def test_the_corners_of_a_mesh_lie_on_the_shape(generator):
    """A corner on an edge has several normals and places in the texture; it is met from within."""
    shape = analytic.GENERATORS[generator]
    places, normals, texcoords = vertices(generator)
    if shape in ("box", "quad"):
        inner = (np.sort(np.abs(places), axis=1)[:, 1] < 1.0 - 1e-6) | (shape == "quad")
        inner &= (np.abs(places)[:, [0, 2]] < 1.0 - 1e-6).all(axis=1) | (shape == "box")
        places, normals, texcoords = places[inner], normals[inner], texcoords[inner]
    if shape in ("disc", "cylinder"):
        rim = np.abs(np.hypot(places[:, 0], places[:, 2]) - 1.0) < 1e-6
        end = np.abs(np.abs(places[:, 1]) - 1.0) < 1e-6
        inner = ~rim if shape == "disc" else ~(rim & end)
        places, normals, texcoords = places[inner], normals[inner], texcoords[inner]
    assert len(places) > 10
    start, direction = rays_to(places, normals)
    t = analytic.meeting(shape, start, direction)
    np.testing.assert_allclose(t, np.linalg.norm(places - start, axis=1), atol=ROUNDED)
    found = analytic.on_surface(shape, start, direction, t)
    np.testing.assert_allclose(found, places, atol=ROUNDED)
    np.testing.assert_allclose(analytic.normal(shape, found), normals, atol=ROUNDED)
    off = np.abs(analytic.texcoord(shape, found) - texcoords)
    off[:, 0] = np.minimum(off[:, 0], 1.0 - off[:, 0])  # u = 0 and u = 1 are one seam
    # Texture angles at radius r turn by ROUNDED/r for a step of that size; rings start at r = 0.13.
    assert off.max() <= ROUNDED / 0.1


def test_an_icosphere_is_the_sphere():
    item = pg.Object("icosphere", tessellation=1)
    scene = prepare(pg.Setup(pg.Scene(objects=(item,))), SIZE)
    assert scene.solids[0].kind == "sphere" and scene.solids[0].bvh is None


@pytest.mark.parametrize(
    ("change", "kind"),
    [
        ({}, "sphere"),
        ({"normals": "flat"}, "mesh"),
        ({"normals": "smooth"}, "mesh"),
        ({"surfaces": "triangles"}, "mesh"),
        ({"mesh": "torus"}, "mesh"),
        ({"mesh": "disc"}, "disc"),
        ({"mesh": "grid"}, "quad"),
    ],
)
def test_what_has_a_formula_is_not_triangulated(change, kind):
    scene = prepare(pg.load("sphere").with_(**change), SIZE)
    assert [solid.kind for solid in scene.solids] == [kind]
    assert (scene.solids[0].bvh is not None) == (kind == "mesh")


def test_a_mesh_of_ones_own_and_a_flattened_shape_are_triangles():
    own = pg.Object("sphere", arrays=uv_sphere(5))
    flat = pg.Object("sphere", transform=pg.Transform(scale=(1, 0, 2)))
    nothing = pg.Object("sphere", transform=pg.Transform(size=0.0))
    scene = prepare(pg.Setup(pg.Scene(objects=(own, flat, nothing))), SIZE)
    assert [(solid.kind, solid.closed) for solid in scene.solids] == [
        ("mesh", True),
        ("mesh", False),
    ]


def test_instances_share_their_tree():
    pair = (pg.Object("torus"), pg.Object("torus", transform=pg.Transform(translate=(3, 0, 0))))
    first, second = prepare(pg.Setup(pg.Scene(objects=pair)), SIZE).solids
    assert first.bvh is second.bvh is not None


PLACES = {
    "plain": pg.Transform(),
    "turned": pg.Transform(rotate=(20, 130, -70), translate=(0.2, 0.1, 0)),
    "stretched": pg.Transform(scale=(1.5, -0.2, 0.7), rotate=(40, 10, 30)),
    "needle": pg.Transform(scale=(1e-4, 1.0, 1e-4), rotate=(40, 10, 30)),
    "far": pg.Transform(translate=(3e5, 0, -2e5), rotate=(5, 6, 7)),
}


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("mesh", ["sphere", "quad", "disc", "box", "cylinder", "torus"])
def test_a_point_is_within_its_error_and_a_ray_that_leaves_does_not_come_back(rng, mesh, place):
    item = pg.Object(mesh, transform=PLACES[place])
    camera = pg.Camera(eye=(0.5, 3.0, 9.0))
    scene = prepare(pg.Setup(pg.Scene(objects=(item,)), camera), SIZE)
    solid = scene.solids[0]
    middle, radius = solid.ball
    count = 2000
    start = middle + radius * unit(rng.normal(size=(count, 3))) * rng.uniform(1.1, 4, (count, 1))
    inside = rng.uniform(-0.6, 0.6, (count, 3))
    inside[:, 1] *= mesh not in ("quad", "disc")
    aims = middle + inside @ solid.matrix.T
    direction = unit(aims - start)
    hits = closest((solid,), start, direction, np.full(count, np.inf))
    met = hits.solid == 0
    assert met.sum() > 20
    rays = start[met], direction[met]
    at = solid.points(*rays, hits.t[met], hits.triangle[met], hits.weights[met])

    # From the point, the ray meets the point: a plane's distance over the slant, and some roundings
    slant = np.abs(dot(at.outward, direction[met]))
    off = np.linalg.norm(start[met] + hits.t[met, None] * direction[met] - at.position, axis=1)
    size = np.abs(start[met]).max(axis=1) + hits.t[met]
    assert (off * np.minimum(slant, 1.0) <= 40 * at.error + 2e-15 * size).all()

    # No self-hit: leaving on either side, along directions of that side, meets nothing near by.
    for sign in (1.0, -1.0):
        side = sign * at.outward
        away = unit(side + 0.999 * unit(rng.normal(size=side.shape)))
        again = closest((solid,), offset_ray(at.position, side, at.error), away, 1e3 * at.error)
        assert (again.solid < 0).all()


def test_closest_is_the_nearest_of_all_and_stops_at_the_limit():
    row = tuple(
        pg.Object(mesh, transform=pg.Transform(translate=(0, 0, -3.0 * i)))
        for i, mesh in enumerate(("sphere", "box", "torus"))
    )
    scene = prepare(pg.Setup(pg.Scene(objects=row), pg.Camera(eye=(0, 0, 6))), SIZE)
    ahead = np.array([[0.0, 0.0, -1.0]])
    numbers, limits = [], [np.inf, 4.9 * scene.view.scale]
    for limit in limits:
        numbers.append(
            int(closest(scene.solids, np.zeros((1, 3)), ahead, np.array([limit])).solid[0])
        )
    assert numbers == [0, -1]
    behind = closest(scene.solids[1:], np.zeros((1, 3)), ahead, np.array([np.inf]))
    assert behind.t[0] == pytest.approx(8.0 * scene.view.scale, rel=1e-15)


def test_shadow_rays_end_at_the_light():
    wall = pg.Object("quad", transform=pg.Transform(rotate=(90, 0, 0)))
    scene = prepare(pg.Setup(pg.Scene(objects=(wall,)), pg.Camera(eye=(0, 0, 4))), SIZE)
    ahead, start = np.array([[0.0, 0.0, -1.0]]), np.zeros((1, 3))
    for length, share in ((3.9, 1.0), (4.1, 0.0)):
        limit = np.array([length * scene.view.scale])
        assert (arriving(scene.solids, start, ahead, limit) == share).all()


@pytest.mark.parametrize("count", [1, 7, 16, 64])
def test_each_sample_has_a_strip_of_the_lamp_to_itself(count):
    points = square_points(count)
    assert sorted(np.floor(points[:, 0] * count)) == list(range(count))
    assert ((points > 0.0) & (points < 1.0)).all()
    # The golden ratio leaves no gap wider than φ² of 1/n: the three-gap theorem.
    around = np.sort(points[:, 1])
    gaps = np.diff([*around, around[0] + 1.0])
    assert gaps.max() <= 2.62 / count


def test_samples_lie_on_the_lamp_each_for_the_same_area():
    rectangle = np.array(pg.RectangleLight(turn=30, width=3).corners)
    inward = points_on(rectangle, 50) - rectangle[0]
    sides = np.stack([rectangle[1] - rectangle[0], rectangle[3] - rectangle[0]])
    shares = inward @ np.linalg.pinv(sides)
    assert ((shares > 0) & (shares < 1)).all()
    np.testing.assert_allclose(shares @ sides, inward, atol=1e-14)
    # An L of three squares: two thirds of its area below, one above
    corners = np.array([(0, 0, 0), (2, 0, 0), (2, 1, 0), (1, 1, 0), (1, 2, 0), (0, 2, 0)], float)
    points = points_on(corners, 300)
    assert (points[:, 0] > 1).sum() == pytest.approx(100, abs=6)
    assert not ((points[:, 0] > 1) & (points[:, 1] > 1)).any()
    np.testing.assert_allclose(points.mean(axis=0), [5 / 6, 5 / 6, 0], atol=0.01)
    np.testing.assert_allclose(facing_of(corners), [0, 0, 1], atol=1e-15)
    np.testing.assert_allclose(facing_of(rectangle), [0, -1, 0], atol=1e-15)
