"""Generated shapes against closed forms: normals, areas, volumes, topology."""

from __future__ import annotations

import numpy as np
import pytest

from playground.errors import PlaygroundError
from playground.scene.normals import direction, weld
from playground.scene.shapes import SHAPES, make
from playground.scene.shapes_curved import cone, cylinder, disc, icosphere, torus, uv_sphere
from playground.scene.shapes_flat import box, grid, quad
from playground.scene.shapes_lattice import circle

CLOSED = ["sphere", "icosphere", "torus", "box", "cylinder", "cone"]
OPEN = ["quad", "grid", "disc", "teapot"]
PI = np.pi

# Area and volume of the smooth surface
EXACT = {
    "sphere": (4 * PI, 4 * PI / 3),
    "icosphere": (4 * PI, 4 * PI / 3),
    "torus": (4 * PI**2 * 0.7 * 0.3, 2 * PI**2 * 0.7 * 0.3**2),
    "cylinder": (6 * PI, 2 * PI),
    "cone": (PI * (1 + np.sqrt(5)), 2 * PI / 3),
}


def area(mesh):
    first, second, third = np.moveaxis(mesh.positions[mesh.faces].astype(float), 1, 0)
    return 0.5 * np.linalg.norm(np.cross(second - first, third - first), axis=1).sum()


def euler_characteristic(mesh):
    faces = weld(mesh.positions)[mesh.faces]
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    return len(np.unique(faces)) - len(np.unique(edges, axis=0)) + len(faces)


def torus_gradient(p):
    ring = np.hypot(p[:, 0], p[:, 2])
    return np.stack([p[:, 0] * (1 - 0.7 / ring), p[:, 1], p[:, 2] * (1 - 0.7 / ring)], axis=1)


def cone_gradient(p):
    # x^2 + z^2 - ((1 - y) / 2)^2
    return np.stack([2 * p[:, 0], (1 - p[:, 1]) / 2, 2 * p[:, 2]], axis=1)


@pytest.mark.parametrize("tessellation", [3, 4, 7, 32, 101])
@pytest.mark.parametrize(
    ("make_shape", "gradient"),
    [(uv_sphere, lambda p: p), (icosphere, lambda p: p), (torus, torus_gradient)],
)
def test_normals_are_the_gradient_of_the_implicit_surface(make_shape, gradient, tessellation):
    mesh = make_shape(tessellation)
    exact = direction(gradient(mesh.positions.astype(float)))
    # Positions rounded to float32 stand 6e-8 off a surface of curvature 1 / 0.3
    np.testing.assert_allclose(mesh.normals, exact, atol=4e-7)


@pytest.mark.parametrize("tessellation", [3, 5, 32])
def test_normals_of_cylinder_and_cone(tessellation):
    p, n = cylinder(tessellation).positions.astype(float), cylinder(tessellation).normals
    on_cap = np.abs(n[:, 1]) > 0.5
    assert np.array_equal(n[on_cap], np.sign(p[on_cap]) * [0, 1, 0])
    np.testing.assert_allclose(n[~on_cap], p[~on_cap] * [1, 0, 1], atol=1.2e-7)

    p, n = cone(tessellation).positions.astype(float), cone(tessellation).normals
    side = (n[:, 1] > 0) & (p[:, 1] < 1)
    np.testing.assert_allclose(n[side], direction(cone_gradient(p[side])), atol=4e-7)
    assert np.array_equal(n[n[:, 1] < 0], np.tile([0, -1, 0], ((n[:, 1] < 0).sum(), 1)))


def test_the_apex_has_the_normal_of_each_segments_middle():
    mesh = cone(8)
    apex = np.flatnonzero(mesh.positions[:, 1] == 1)
    turn = 2 * PI * (np.arange(8) + 0.5) / 8
    expected = np.stack([2 * np.cos(turn), np.ones(8), -2 * np.sin(turn)], axis=1) / np.sqrt(5)
    np.testing.assert_allclose(mesh.normals[apex], expected, atol=1e-7)
    # and the middle of a flat side is where the geometric normal looks, seen from above
    for vertex, normal in zip(apex, expected, strict=True):
        (owner,) = np.flatnonzero((mesh.faces == vertex).any(axis=1))
        np.testing.assert_allclose(
            direction(mesh.triangle_normals[owner] * [1, 0, 1]),
            direction(normal * [1, 0, 1]),
            atol=1e-6,
        )


@pytest.mark.parametrize("name", EXACT)
def test_area_and_volume_converge_with_order_two(name):
    coarse, fine = make(name, 32), make(name, 64)
    for measure, exact in zip((area, lambda mesh: mesh.volume), EXACT[name], strict=True):
        error_coarse, error_fine = exact - measure(coarse), exact - measure(fine)
        assert 0 < error_fine < 0.01 * exact, "an inscribed surface is smaller"
        assert 3.8 < error_coarse / error_fine < 4.2


@pytest.mark.parametrize("tessellation", [1, 2, 7])
def test_flat_shapes_are_exact(tessellation):
    assert area(quad(tessellation)) == pytest.approx(4, rel=1e-6)
    assert area(grid(tessellation)) == pytest.approx(4, rel=1e-6)
    assert area(box(tessellation)) == pytest.approx(24, rel=1e-6)
    assert box(tessellation).volume == pytest.approx(8, rel=1e-6)
    assert len(quad(tessellation).faces) == 2 * tessellation**2
    assert len(box(tessellation).faces) == 12 * tessellation**2
    assert np.array_equal(
        quad(tessellation).normals, np.tile([0, 1, 0], ((tessellation + 1) ** 2, 1))
    )
    cube = box(tessellation)
    assert np.array_equal(
        np.einsum("ni,ni->n", cube.normals, cube.positions), np.ones(len(cube.normals))
    )


@pytest.mark.parametrize("tessellation", [3, 4, 7, 8, 32, 101])
def test_the_disc_is_a_regular_polygon_in_the_unit_circle(tessellation):
    mesh = disc(tessellation)
    turn = 2 * PI / tessellation
    # Corners on the circle, rounded to float32
    assert area(mesh) == pytest.approx(0.5 * tessellation * np.sin(turn), rel=1e-6)
    assert np.array_equal(mesh.normals, np.tile([0, 1, 0], (len(mesh.normals), 1)))
    assert not mesh.positions[:, 1].any()
    x, _, z = mesh.positions.T
    np.testing.assert_allclose(mesh.texcoords, 0.5 + 0.5 * np.stack([x, -z], axis=1), atol=1e-7)


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("tessellation", [None, "min", 5, 6, 23])
def test_topology(name, tessellation):
    shape = SHAPES[name]
    count = shape.min if tessellation == "min" else tessellation
    mesh = make(name, count)
    assert mesh.closed == (name in CLOSED)
    if name in CLOSED:
        assert euler_characteristic(mesh) == (0 if name == "torus" else 2)
        assert mesh.cullable and mesh.volume > 0
    if (name, count) != ("teapot", 1):
        assert len(np.unique(mesh.faces)) == len(mesh.positions), "no vertex is left over"
    assert mesh.name == name


@pytest.mark.parametrize("segments", range(3, 60))
def test_seams_close_at_every_tessellation(segments):
    assert all(shape(segments).closed for shape in (uv_sphere, torus, cylinder, cone))


@pytest.mark.parametrize("frequency", range(1, 40, 3))
def test_icosphere_shares_its_vertices(frequency):
    mesh = icosphere(frequency)
    assert mesh.closed
    assert len(mesh.faces) == 20 * frequency**2
    assert len(mesh.positions) == 10 * frequency**2 + 2


@pytest.mark.parametrize("name", SHAPES)
def test_triangles_and_texture_face_outwards(name):
    mesh = make(name)
    agreement = np.einsum("mi,mci->mc", mesh.triangle_normals, mesh.normals[mesh.faces])
    assert agreement.min() > 0
    if name == "icosphere":
        assert mesh.texcoords is None
        return
    assert mesh.texcoords.min() == 0 and mesh.texcoords.max() == 1
    # Counter-clockwise in the picture as in space: the picture is not mirrored
    a, b, c = np.moveaxis(mesh.texcoords[mesh.faces].astype(float), 1, 0)
    u, v = b - a, c - a
    assert (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]).min() > 0


@pytest.mark.parametrize("name", SHAPES)
def test_shapes_fit_around_the_origin(name):
    low, high = make(name).bounds
    assert np.abs([low, high]).max() <= (1.145 if name == "teapot" else 1.0)


def test_normals_are_unit_and_quarter_turns_exact():
    for name in SHAPES:
        length = np.linalg.norm(make(name).normals.astype(float), axis=1)
        assert np.abs(length - 1).max() < 9e-8
    cosine, sine = circle(8)
    assert cosine[[0, 2, 4, 6, 8]].tolist() == [1, 0, -1, 0, 1]
    assert sine[[0, 2, 4, 6, 8]].tolist() == [0, 1, 0, -1, 0]
    turn = 2 * PI * np.arange(14) / 13
    np.testing.assert_allclose(circle(13), [np.cos(turn), np.sin(turn)], atol=1e-15)


def test_make_remembers():
    assert make("sphere") is make("sphere", 32) is make("sphere", np.int64(32))
    assert len(make("quad").faces) == 2


def test_unknown_shapes_are_listed():
    with pytest.raises(
        PlaygroundError, match=r"unknown shape.*'spere'.*teapot.*Did you mean 'sphere'"
    ):
        make("spere")
    with pytest.raises(PlaygroundError, match="unknown shape"):
        make(["sphere"])


@pytest.mark.parametrize(
    "tessellation", [0, -1, 2, 513, 7.5, float("nan"), float("inf"), "32", True, [3]]
)
def test_tessellation_has_a_range(tessellation):
    with pytest.raises(PlaygroundError, match=r"tessellation of 'sphere'.*3 to 512.*32"):
        make("sphere", tessellation)


@pytest.mark.parametrize("shape", [uv_sphere, torus, disc, cylinder, cone, quad, box, icosphere])
def test_generators_refuse_too_few_parts(shape):
    with pytest.raises(PlaygroundError, match="too small"):
        shape(0)


def test_the_registry_is_sound():
    for name, shape in SHAPES.items():
        assert name == shape.name and shape.help
        assert shape.min <= shape.default_tessellation <= shape.max
