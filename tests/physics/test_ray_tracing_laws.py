"""What must hold of rays whatever the scene: energy, Snell's law, series, shadows.

Rays are followed one by one where a law is about rays; pictures are compared where it is about
pictures, which are float32: 2^-24 of a colour is then the rounding.
"""

import numpy as np
import pytest

import playground as pg
from playground.render.trace.traced_scene import prepare
from playground.render.trace.whitted import REFRACTION, primary, waves
from playground.shading.optics import cosine_transmitted, fresnel, plate_shift
from playground.shading.vector import unit

SINGLE = 2.0**-23
BLACK = {"diffuse": (0, 0, 0), "specular": (0, 0, 0), "ambient": (0, 0, 0)}
SIZE = (64, 48)


def glass(index=1.5, transmittance=(1, 1, 1), **more):
    return pg.Material(**BLACK, transmittance=transmittance, index=index, **more)


def mirror(share, **more):
    return pg.Material(**{**BLACK, **more}, reflectance=(share,) * 3)


def setup_of(*objects, lights=(), background=(0, 0, 0), eye=(0, 0, 5), target=(0, 0, 0), **changes):
    scene = pg.Scene(objects=objects, lights=lights, background=background)
    setup = pg.Setup(scene, pg.Camera(eye=eye, target=target))
    return setup.with_(**{"depth": 20, "threshold": 0.0, **changes})


def trace(setup, size=SIZE):
    return pg.render(setup, size, "numpy", method="ray-tracing")


def follow(setup, origin, direction):
    """Every wave of one ray; world coordinates, from anywhere."""
    scene = prepare(setup, SIZE)
    start = scene.view.relative(np.array([origin], dtype=float))
    rays = primary(scene, start, unit(np.array([direction], dtype=float)), np.zeros(1, np.intp))
    rays = rays._replace(inside=np.zeros_like(rays.inside))
    return scene, list(waves(scene, rays, np.array([np.inf])))


def straight_through(found):
    """The last refracted ray of each depth: origins in the world, directions and weights."""
    scene, followed = found
    rays = []
    for wave in followed:
        chosen = np.flatnonzero(wave.rays.kind == REFRACTION)
        if wave.depth == len(rays) + 1 and len(chosen):
            ray = wave.rays.at(chosen[-1:])
            rays.append((scene.view.world(ray.origin[0]), ray.direction[0], ray.weight[0]))
    return rays


@pytest.mark.parametrize("angle", [0.0, 10.0, 45.0, 80.0, 89.0])
@pytest.mark.parametrize("index", [1.0001, 1.5, 2.4])
def test_a_plate_moves_a_ray_aside_and_does_not_turn_it(index, angle):
    plate = pg.Object("box", material=glass(index), transform=pg.Transform(scale=(1e3, 0.5, 1e3)))
    sine, cosine = np.sin(np.radians(angle)), np.cos(np.radians(angle))
    direction = np.array([sine, -cosine, 0.0])
    origin = np.array([0.0, 0.5, 0.0]) - direction
    _, (leaves, towards, weight) = straight_through(follow(setup_of(plate), origin, direction))[:2]
    np.testing.assert_allclose(towards, direction, atol=1e-14)
    aside = np.linalg.norm(np.cross(leaves - origin, direction))
    # 1e3 is the size of the plate, whose points are known to some roundings of it.
    assert aside == pytest.approx(plate_shift(1.0, cosine, sine, 1.0, index), abs=1e-12)
    share = fresnel(cosine, sine, 1.0, index)
    np.testing.assert_allclose(weight, (1.0 - share) ** 2, rtol=1e-10)


@pytest.mark.parametrize("height", [0.0, 0.3, 0.7, 0.95])
def test_a_glass_ball_turns_a_ray_by_twice_what_snell_says(height):
    ball = pg.Object("sphere", material=glass(1.5))
    _, (_, towards, _) = straight_through(follow(setup_of(ball), (0, height, 5), (0, 0, -1)))[:2]
    turned = 2.0 * (np.arcsin(height) - np.arcsin(height / 1.5))
    # towards the axis, and a height near 1 is an angle known to √u only in reverse
    np.testing.assert_allclose(towards, [0, -np.sin(turned), -np.cos(turned)], atol=1e-14)


@pytest.mark.parametrize("depth", [0, 1, 5, 40])
@pytest.mark.parametrize("share", [0.5, 0.9, 1.0])
def test_two_facing_mirrors_are_a_geometric_series(share, depth):
    material = mirror(share, emissive=(1, 1, 1))
    walls = (
        pg.Object("quad", material=material, transform=pg.Transform(translate=(0, -1, 0))),
        pg.Object("quad", material=material, transform=pg.Transform(translate=(0, 1, 0))),
    )
    setup = setup_of(*walls, eye=(0, 0, 0), target=(0, 1, 0), depth=depth)
    image = trace(setup, (1, 1))
    series = sum(share**k for k in range(depth + 1))
    np.testing.assert_allclose(image.pixels, series, rtol=SINGLE)
    assert image.left_out.max == pytest.approx(share ** (depth + 1), rel=SINGLE)


SOLIDS = {
    "sphere": pg.Object("sphere"),
    "box": pg.Object("box", transform=pg.Transform(rotate=(20, 30, 0))),
    "cylinder": pg.Object("cylinder", transform=pg.Transform(rotate=(40, 0, 10))),
    "stretched": pg.Object(
        "sphere", transform=pg.Transform(scale=(1, 0.3, -1.4), rotate=(9, 9, 9))
    ),
    "torus": pg.Object("torus", tessellation=16, transform=pg.Transform(rotate=(60, 0, 0))),
    "faceted": pg.Object("icosphere", tessellation=2, normals="flat"),
    "smooth": pg.Object("icosphere", tessellation=2, normals="smooth"),
}


@pytest.mark.parametrize("fresnel", ["exact", "schlick"])
@pytest.mark.parametrize("index", [0.7, 1.0, 1.5, 2.4])
@pytest.mark.parametrize("solid", SOLIDS)
def test_in_a_white_world_glass_is_white_but_for_what_is_left_out(solid, index, fresnel):
    """Energy: whatever way light takes through glass that absorbs nothing, none is lost."""
    for reflectance in (0.0, 0.3):
        transmittance = (1.0 - reflectance,) * 3
        material = pg.Material(
            **BLACK, transmittance=transmittance, reflectance=(reflectance,) * 3, index=index
        )
        item = pg.Object(**{**vars(SOLIDS[solid]), "material": material})
        setup = setup_of(item, background=(1, 1, 1), depth=4, threshold=0.02, fresnel=fresnel)
        image = trace(setup, (24, 18))
        assert image.left_out.max > 0.0 or index == 1.0
        # Both pictures are float32, and some dozens of roundings in float64
        total = image.pixels.astype(float) + image.left_out.weights
        np.testing.assert_allclose(total, 1.0, atol=2 * SINGLE)


def test_deep_recursion_leaves_next_to_nothing_out():
    setup = setup_of(pg.Object("sphere", material=glass(1.5)), background=(1, 1, 1), threshold=1e-4)
    image = trace(setup)
    # Each bounce inside keeps at most the share F of a ray that came in: below the critical angle
    # F = 1 is never met from outside, and the sum of what is cut is of the order of the threshold.
    assert image.left_out.mean < 1e-4
    np.testing.assert_allclose(image.pixels, 1.0, atol=1e-3)


@pytest.mark.parametrize("solid", SOLIDS)
def test_glass_of_equal_index_is_not_there(solid):
    behind = pg.Object("torus", transform=pg.Transform(translate=(0, 0, -3), rotate=(70, 0, 0)))
    light = pg.PointLight(position=(3, 4, 5))
    item = pg.Object(**{**vars(SOLIDS[solid]), "material": glass(1.0)})
    image = trace(setup_of(behind, item, lights=(light,)))
    without = trace(setup_of(behind, lights=(light,)))
    # The eye-relative scale is a power of two and so the same ray; at each surface its origin moves
    # by some roundings, which the highlight of shininess 20 makes visible to 1e-12. A pixel whose
    # ray passes an edge of the torus within that could differ: there is none.
    np.testing.assert_allclose(image.pixels, without.pixels, atol=2 * SINGLE)


def test_light_fades_in_glass_as_beer_and_lambert_say():
    absorption = (0.1, 0.5, 2.0)
    block = pg.Object("box", material=glass(1.0, absorption=absorption))
    _, rays = None, straight_through(follow(setup_of(block), (0, 0, 5), (0, 0, -1)))
    np.testing.assert_allclose(rays[1][2], np.exp(-2.0 * np.array(absorption)), rtol=1e-12)
    lit = setup_of(block, background=(1, 1, 1))
    centre = trace(lit, (1, 1)).pixels[0, 0]
    np.testing.assert_allclose(centre, np.exp(-2.0 * np.array(absorption)), rtol=2 * SINGLE)


def test_the_shadow_of_coloured_glass_is_coloured():
    """Straight through: the transmittance once for either surface, absorption for the way."""
    block = pg.Object("box", material=glass(1.5, (1.0, 0.5, 0.8), absorption=(0.3, 0.0, 0.0)))
    floor = pg.Object(
        "quad",
        material=pg.Material(**{**BLACK, "diffuse": (1, 1, 1)}),
        transform=pg.Transform(translate=(0, -2, 0)),
    )
    light = pg.DirectionalLight(to_light=(0, 1, 0), specular=(0, 0, 0))
    setup = setup_of(block, floor, lights=(light,))
    _, (wave, *_) = follow(setup, (0, -1.5, 0), (0, -1, 0))
    np.testing.assert_allclose(wave.local[0], [np.exp(-0.6), 0.25, 0.64], rtol=1e-12)
    _, (wave, *_) = follow(setup.with_(clear_shadows=False), (0, -1.5, 0), (0, -1, 0))
    assert not wave.local.any()


def layers(*thick, overlap):
    """Glass, water and glass upon one another; the water reaches into the glass by ``overlap``."""
    place = pg.Transform

    def slab(top, bottom, index, priority):
        middle, half = (top + bottom) / 2, (top - bottom) / 2
        where = place(translate=(0, middle, 0), scale=(50, half, 50))
        return pg.Object("box", material=glass(index, priority=priority), transform=where)

    return (
        slab(3.0, 2.0, 1.5, 1),
        slab(2.0 + overlap, 1.0 - overlap, 1.33, 0),
        slab(1.0, 0.0, 1.5, 1),
    )


@pytest.mark.parametrize("angle", [0.0, 30.0, 70.0])
def test_water_between_glass_is_where_its_priority_lets_it_be(angle):
    """Four boundaries, not six: the water's own, inside the glass, are none."""
    sine, cosine = np.sin(np.radians(angle)), np.cos(np.radians(angle))
    direction = np.array([sine, -cosine, 0.0])
    origin = np.array([0.0, 3.0, 0.0]) - direction
    rays = straight_through(follow(setup_of(*layers(overlap=0.25), depth=4), origin, direction))
    assert len(rays) == 4
    indices, weight, along = [1.0, 1.5, 1.33, 1.5, 1.0], 1.0, sine
    for n_i, n_t, (_, towards, found) in zip(indices, indices[1:], rays, strict=False):
        slant = along / n_i
        weight *= 1.0 - fresnel(np.sqrt(1.0 - slant**2), slant, n_i, n_t)
        np.testing.assert_allclose(towards[0], along / n_t, atol=1e-13)
        np.testing.assert_allclose(towards[1], -cosine_transmitted(slant, n_i, n_t), atol=1e-13)
        np.testing.assert_allclose(found, weight, rtol=1e-9)
    down = [float(place[1]) for place, _, _ in rays]
    np.testing.assert_allclose(down, [3.0, 2.0, 1.0, 0.0], atol=1e-12)


def test_an_eye_under_water_sees_from_under_water():
    """Looking up from within, the whole sky fills a cone of half the angle asin(1/n)."""
    water = pg.Object("box", material=glass(1.33), transform=pg.Transform(scale=(100, 1, 100)))
    setup = setup_of(water, background=(1, 1, 1), depth=1, eye=(0, 0, 0), target=(0, 1, 0), fov=130)
    image = trace(setup, (201, 201))
    y, x = np.mgrid[-100:101, -100:101] * np.tan(np.radians(65)) / 100.5
    angle = np.degrees(np.arctan(np.hypot(x, y)))
    critical = np.degrees(np.arcsin(1 / 1.33))
    seen = image.pixels[..., 0]
    assert (seen[angle > critical + 1e-9] == 0.0).all()  # total reflection, and depth ends there
    assert (seen[angle < critical - 1e-9] > 0.0).all()
    assert seen[100, 100] == pytest.approx(1 - (0.33 / 2.33) ** 2, rel=SINGLE)


def room(size=1.0, at=(0.0, 0.0, 0.0)):
    def place(x, y, z, s=1.0, **more):
        there = tuple(size * c + o for c, o in zip((x, y, z), at, strict=True))
        return pg.Transform(translate=there, size=s * size, **more)

    def point(*p):
        return tuple(size * c + o for c, o in zip(p, at, strict=True))

    tinted = glass(1.5, (0.9, 1, 0.9), absorption=(0.5 / size, 0, 0))
    objects = (
        pg.Object("box", transform=place(0, 0, 0, 2.0)),
        pg.Object("sphere", material=mirror(0.8), transform=place(-0.9, -1.1, -0.5, 0.9)),
        pg.Object("sphere", material=tinted, transform=place(0.9, -1.1, 0.3, 0.9)),
        pg.Object("torus", material=tinted, tessellation=12, transform=place(0, 0.5, -1, 0.5)),
        pg.Object("cylinder", transform=place(0.2, -1.5, 1.2, 0.3, rotate=(30, 0, 20))),
    )
    lights = (
        pg.PointLight(
            position=point(0.3, 1.8, 0.4), attenuate=True, linear=0.2 / size, quadratic=0
        ),
        pg.RectangleLight(
            position=point(-1, 1.9, 0), width=0.5 * size, height=0.7 * size, diffuse=(2, 2, 2)
        ),
    )
    scene = pg.Scene(objects=objects, lights=lights)
    camera = pg.Camera(eye=point(0.1, 0.2, 1.9), target=point(0, -0.5, 0), fov=80)
    return pg.Setup(scene, camera).with_(light_samples=4)


@pytest.mark.parametrize("size", [1e-3, 3e3, 1e6])
def test_the_size_of_the_world_does_not_matter(size):
    assert_same_but_for_edges(trace(room(size)), trace(room()))


@pytest.mark.parametrize("distance", [1e3, 1e6])
def test_where_the_world_lies_does_not_matter(distance):
    # 2^-52 of the distance is what the positions themselves lose
    at = (distance, -distance, 2 * distance)
    assert_same_but_for_edges(trace(room(at=at)), trace(room()), 1e-15 * distance)


def assert_same_but_for_edges(image, other, moved=0.0):
    """Equal to float32, but for pixels within rounding of an edge in some reflection.

    ``moved`` is by how much the scene is another one: glass magnifies it, some bounces make it
    1e4 of that; at the rims of spheres without bound.
    """
    error = np.abs(image.pixels.astype(float) - other.pixels).max(axis=-1)
    assert np.median(error) <= SINGLE
    assert (error > 4 * SINGLE + 1e4 * moved).mean() <= 2e-3


def test_the_shadow_of_a_disc_is_a_disc():
    """A point light h over the floor, a disc of radius r at height z: the radius is r h/(h − z)."""
    white = pg.Material(**{**BLACK, "diffuse": (1, 1, 1)})
    floor = pg.Object("quad", material=white, transform=pg.Transform(size=10.0))
    plate = pg.Object("disc", transform=pg.Transform(translate=(0, 1, 0), size=0.5))
    light = pg.PointLight(position=(0, 3, 0), ambient=(0, 0, 0))
    setup = setup_of(floor, plate, lights=(light,), eye=(0, 0.9, 0), target=(0, 0, 0.0), fov=120)
    scene, (wave, *_) = one_wave(setup, (101, 101))
    lit = wave.local[:, 0] > 0.0
    from_axis = np.hypot(*scene.view.world(wave.met.position)[:, ::2].T)
    assert (lit[from_axis > 0.75 + 1e-12]).all() and not lit[from_axis < 0.75 - 1e-12].any()
    assert 100 < lit.sum() < len(lit) - 100


def one_wave(setup, size):
    scene = prepare(setup, size)
    origin, direction, limit = scene.camera_rays(np.arange(size[0] * size[1]), (0.5, 0.5))
    rays = primary(scene, origin, direction, np.arange(size[0] * size[1]))
    return scene, list(waves(scene, rays, limit))


@pytest.mark.parametrize("count", [16, 64, 256])
@pytest.mark.parametrize("turn", [0.0, 30.0])
def test_a_soft_shadow_fades_as_much_of_the_lamp_as_is_hidden(count, turn):
    """Half of the sky over the floor is covered: at x, the lamp's part beyond the edge is seen.

    The lamp is so small and high that its weight is the same all over, and the visible share that
    of its area. The lattice knows an area within a half-plane to about 2/n.
    """
    white = pg.Material(**{**BLACK, "diffuse": (1, 1, 1)})
    floor = pg.Object("quad", material=white, transform=pg.Transform(size=3.0))
    cover = pg.Object(
        "quad", transform=pg.Transform(translate=(-1e3, 10.0, 0), scale=(1e3, 1, 1e3))
    )
    lamp = pg.RectangleLight(
        position=(0, 20, 0), width=0.2, height=0.2, turn=turn, visible=False, ambient=(0, 0, 0)
    )
    setup = setup_of(floor, cover, lights=(lamp,), eye=(0, 0.1, 0), target=(0, 0, 0.0), fov=60)
    setup = setup.with_(light_samples=count)
    scene, (wave, *_) = one_wave(setup, (64, 3))
    x = scene.view.world(wave.met.position)[:, 0]
    share = wave.local[:, 0] / wave.local[:, 0].max()

    # The edge at height 10, half-way up, divides the lamp at −x: what lies beyond is seen.
    corners = np.array(lamp.corners)[:, [0, 2]]
    exact = np.array([area_beyond(corners, -at) for at in x]) / 0.04
    assert exact.min() == 0.0 and exact.max() == pytest.approx(1.0)
    assert np.abs(share - exact).max() <= 2.5 / count + 1e-3


def area_beyond(corners, edge):
    """The area of a polygon (K, 2) where x > edge, by clipping and the shoelace formula."""
    kept = []
    for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        if a[0] > edge:
            kept.append(a)
        if (a[0] > edge) != (b[0] > edge):
            kept.append(a + (edge - a[0]) / (b[0] - a[0]) * (b - a))
    x, y = np.array(kept).T if kept else (np.zeros(1), np.zeros(1))
    return abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2.0


def test_what_weighs_too_little_is_not_shot_but_reported():
    setup = setup_of(pg.Object("sphere", material=mirror(0.1)), background=(1, 1, 1))
    whole = trace(setup)
    cut = trace(setup.with_(threshold=0.2))
    assert whole.left_out.max == 0.0
    assert cut.left_out.max == pytest.approx(0.1, rel=SINGLE)
    np.testing.assert_allclose(cut.pixels + cut.left_out.weights, whole.pixels, atol=SINGLE)
    assert 0.0 < cut.left_out.mean < cut.left_out.max
