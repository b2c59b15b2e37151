"""Setups become patches: counts, areas, normals, which points are shared, what is refused."""

import numpy as np
import pytest

import playground as pg
from playground.errors import PlaygroundError
from playground.render.radiosity.patch import memory
from playground.render.radiosity.patch.divide import divide
from playground.scene.mesh import Mesh

LAMP = pg.PointLight()
# Sums and products of float64 over float32 positions, all known to 2^-24 of their size
SINGLE = 2.0**-23


def setup_of(*objects, lights=(LAMP,), **settings):
    return pg.Setup(pg.Scene(objects=objects, lights=lights)).with_(**settings)


def area_of(mesh, matrix):
    corners = (mesh.positions.astype(float) @ matrix[:3, :3].T)[mesh.faces]
    first, second, third = np.moveaxis(corners, 1, 0)
    return 0.5 * np.linalg.norm(np.cross(second - first, third - first), axis=1).sum()


def edges_met(patches):
    """How often each edge, named by its two points, is used in either direction."""
    pairs = np.concatenate(
        [np.stack([c, np.roll(c, -1)], axis=1) for c in patches.corners.astype(np.int64)]
    )
    return np.unique(np.sort(pairs[pairs[:, 0] != pairs[:, 1]], axis=1), axis=0, return_counts=True)


@pytest.mark.parametrize("wanted", [1, 2, 4, 100, 600, 2376])
def test_a_square_is_cut_into_about_as_many_patches_as_asked_for(wanted):
    patches = divide(setup_of(pg.Object("quad"), patches=wanted))
    side = round(np.sqrt(len(patches)))
    assert len(patches) == side**2 and len(patches.parents.corners) == 1
    # No whole number's square is nearer, by ratio
    assert all(
        abs(np.log(len(patches) / wanted)) <= abs(np.log(other**2 / wanted)) + 1e-12
        for other in (side - 1, side + 1)
        if other > 0
    )
    np.testing.assert_allclose(patches.area, 4.0 / len(patches), rtol=1e-12)
    np.testing.assert_array_equal(patches.normal, np.tile([0.0, 1.0, 0.0], (len(patches), 1)))
    assert len(patches.points) == (side + 1) ** 2, "neighbours share their corners"


def test_a_box_gives_back_its_six_faces():
    patches = divide(setup_of(pg.Object("box"), patches=600))
    assert len(patches) == 600 and len(patches.parents.corners) == 6
    assert not patches.parents.triangle.any() and not patches.triangle.any()
    assert patches.parents.grid.tolist() == [[10, 10]] * 6
    assert patches.parents.first.tolist() == [0, 100, 200, 300, 400, 500]
    assert patches.area.sum() == pytest.approx(24.0, rel=1e-12)
    outward = np.einsum("ni,ni->n", patches.normal, patches.centre + patches.origin)
    np.testing.assert_allclose(outward, 1.0, rtol=1e-12)
    # Every face has its own points: light does not blend around a sharp edge
    assert len(patches.points) == 6 * 11**2


def test_edges_of_a_stretched_box_are_cut_to_one_length():
    item = pg.Object("box", transform=pg.Transform(scale=(4.0, 1.0, 2.0)))
    patches = divide(setup_of(item, patches=700))
    # 2 (8·2 + 2·4 + 8·4) = 112 of area in squares of side 2/5: 700 patches
    assert len(patches) == 700
    np.testing.assert_allclose(patches.area, 0.16, rtol=1e-12)


@pytest.mark.parametrize("name", ["sphere", "icosphere", "torus", "disc", "cylinder", "cone"])
@pytest.mark.parametrize("wanted", [1, 5000])
def test_curved_shapes_keep_their_area_and_are_closed(name, wanted):
    transform = pg.Transform(scale=(1.0, 2.0, 0.5), rotate=(20, 30, 40), translate=(5, 6, 7))
    item = pg.Object(name, tessellation=8, transform=transform)
    patches = divide(setup_of(item, patches=wanted))
    mesh = item.geometry().mesh
    assert patches.area.sum() == pytest.approx(area_of(mesh, transform.matrix), rel=1e-6)
    parents = len(patches.parents.corners)
    assert parents < len(mesh.faces) or name == "icosphere", "coplanar halves go together"
    assert len(patches) == parents if wanted == 1 else abs(np.log(len(patches) / wanted)) < 0.7
    if wanted == 1:
        assert f"The meshes have {parents} pieces" in patches.warnings[0]
    agreement = np.einsum("ni,nci->nc", patches.normal, patches.normals[patches.corners])
    assert agreement.min() > 0.0
    total = (patches.area[:, None] * patches.normal).sum(axis=0)
    if name != "disc":
        assert np.abs(total).max() < 1e-6 * patches.area.sum(), "closed surfaces look everywhere"


@pytest.mark.parametrize(
    "item",
    [
        pg.Object("box", transform=pg.Transform(scale=(3, 1, 2), rotate=(10, 20, 30))),
        pg.Object("quad", tessellation=3),
        pg.Object("icosphere", tessellation=2),
        pg.Object("sphere", tessellation=6),
        pg.Object("cone", tessellation=5, transform=pg.Transform(scale=(-1, 1, 1))),
        pg.Object("disc", tessellation=9, transform=pg.Transform(scale=(1, 1, 3))),
    ],
    ids=lambda item: item.mesh,
)
def test_a_patch_is_found_from_where_a_point_lies_on_its_parent(item, rng):
    patches = divide(setup_of(item, patches=800))
    parents = patches.parents
    assert parents.regular.all()
    chosen = rng.integers(len(parents.corners), size=4000)
    s, t = rng.random((2, 4000))
    folded = parents.triangle[chosen] & (s + t > 1.0)
    s, t = np.where(folded, 1.0 - s, s), np.where(folded, 1.0 - t, t)
    a, b, c, d = np.moveaxis(parents.corners[chosen], 1, 0)
    flat = parents.triangle[chosen][:, None]
    s, t = s[:, None], t[:, None]
    bilinear = (1 - s) * (1 - t) * a + s * (1 - t) * b + s * t * c + (1 - s) * t * d
    point = np.where(flat, a + s * (b - a) + t * (c - a), bilinear)
    found = parents.patch_at(chosen, s[:, 0], t[:, 0])
    assert np.array_equal(patches.parent[found], chosen)

    # Inside means to the left of every edge, less the rounding of positions of size 3
    polygon, normal = patches.polygon[found], patches.normal[found]
    edge = np.roll(polygon, -1, axis=1) - polygon
    left = np.einsum("nci,ni->nc", np.cross(edge, point[:, None] - polygon), normal)
    length = np.linalg.norm(edge, axis=-1)
    assert (left >= -1e-5 * SINGLE**0.5 * length - 4 * SINGLE * length).all()


def test_patches_of_a_parent_follow_one_another():
    patches = divide(setup_of(pg.Object("sphere", tessellation=7), pg.Object("box"), patches=900))
    grid, first = patches.parents.grid, patches.parents.first
    assert np.array_equal(np.repeat(np.arange(len(grid)), grid.prod(axis=1)), patches.parent)
    assert np.array_equal(np.searchsorted(patches.parent, np.arange(len(grid))), first)
    corner = patches.parents.corners[:, 0]
    np.testing.assert_allclose(patches.polygon[first, 0], corner, atol=1e-12)


@pytest.mark.parametrize(
    ("name", "sharp"), [("icosphere", 0), ("sphere", 0), ("box", 12 * 3), ("cylinder", 2 * 8 * 3)]
)
def test_smooth_neighbours_share_points_and_creases_do_not(name, sharp):
    item = pg.Object(name, tessellation=1 if name == "box" else 8)
    whole = divide(setup_of(item, patches=1))
    fine = divide(setup_of(item, patches=9 * len(whole)))
    assert len(fine) == 9 * len(whole)
    (_, once), (_, fine_once) = edges_met(whole), edges_met(fine)
    assert set(once) <= {1, 2}
    # A sphere's seam and the two sides of a crease have points of their own: other texture
    # coordinates, or other normals; elsewhere each edge is met from both sides
    seams = 8 if name == "sphere" else 0
    assert 3 * (once == 1).sum() == (fine_once == 1).sum()
    if name in ("icosphere", "box"):
        assert (once == 1).sum() * 3 == 2 * sharp + 6 * seams


def test_flat_normals_share_nothing_and_still_make_quads():
    item = pg.Object("sphere", tessellation=8, normals="flat")
    patches = divide(setup_of(item, patches=1))
    smooth = divide(setup_of(pg.Object("sphere", tessellation=8), patches=1))
    assert len(patches) == len(smooth)
    agreement = np.einsum("ni,nci->nc", patches.normal, patches.normals[patches.corners])
    assert agreement.min() > 1.0 - 1e-6
    corners = patches.corners.reshape(-1)
    assert len(np.unique(corners)) == (4 - patches.triangle).sum()


def test_quads_of_a_file_stay_quads(tmp_path):
    file = tmp_path / "strip.obj"
    file.write_text("v 0 0 0\nv 3 0 0\nv 4 1 0\nv 1 1 0\nv 9 0 0\nv 8 1 0\nf 1 2 3 4\nf 2 5 6 3\n")
    patches = divide(setup_of(pg.Object(str(file)), patches=1))
    assert patches.polygon[:, :, :2].tolist() == [
        [[0, 0], [3, 0], [4, 1], [1, 1]],
        [[3, 0], [9, 0], [8, 1], [4, 1]],
    ]
    np.testing.assert_allclose(patches.area, [3.0, 5.0], rtol=1e-12)
    # Of a trapezoid with sides 6 and 4: (6 + 2·4)/(6 + 4)/3 above the long one
    np.testing.assert_allclose(patches.centre[1], [6.0, 7 / 15, 0.0], atol=1e-12)


def test_a_concave_corner_is_not_bridged():
    arrow = Mesh.create([[0, 0, 0], [2, 0, 0], [0.5, 0.5, 0], [0, 2, 0]], [[0, 1, 2], [0, 2, 3]])
    patches = divide(setup_of(pg.Object(arrays=arrow), patches=1))
    assert patches.triangle.tolist() == [True, True]


def test_a_bend_is_not_flattened():
    roof = Mesh.create([[0, 0, 0], [1, 0, 0], [1, 1, 0.01], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
    assert len(divide(setup_of(pg.Object(arrays=roof), patches=1))) == 2


def test_mirrored_objects_look_outwards():
    for scale in ((-1, 1, 1), (1, -2, 1), (-1, -1, -1)):
        item = pg.Object("box", transform=pg.Transform(scale=scale))
        patches = divide(setup_of(item, patches=24))
        outward = np.einsum("ni,ni->n", patches.normal, patches.centre)
        assert outward.min() > 0.0
        shading = np.einsum("ni,nci->nc", patches.normal, patches.normals[patches.corners])
        np.testing.assert_allclose(shading, 1.0, rtol=1e-12)


def test_a_flattened_box_is_two_sheets_back_to_back():
    transform = pg.Transform(scale=(1, 0, 1), rotate=(30, 40, 50))
    patches = divide(setup_of(pg.Object("box", transform=transform), patches=2))
    assert len(patches) == 2
    np.testing.assert_allclose(patches.area, 4.0, rtol=1e-12)
    np.testing.assert_allclose(patches.normal[0], -patches.normal[1], atol=1e-12)
    shading = np.einsum("ni,nci->nc", patches.normal, patches.normals[patches.corners])
    np.testing.assert_allclose(shading, 1.0, rtol=1e-12)
    assert "8 triangles have no area in object 1 (box)" in patches.warnings[0]


def test_far_away_patches_keep_their_digits():
    here = divide(setup_of(pg.Object("sphere", tessellation=8), patches=1))
    there = pg.Transform(translate=(2.0**40, 0.0, -(2.0**40)))
    far = divide(setup_of(pg.Object("sphere", tessellation=8, transform=there), patches=1))
    assert here.origin.tolist() == [0, 0, 0]
    assert np.array_equal(far.points + (far.origin - there.translate), here.points)


def test_what_patches_reflect_and_send_out():
    lamp = pg.Material(diffuse=(0.1, 0.2, 0.3), emissive=(5.0, 4.0, 3.0))
    light = pg.RectangleLight(diffuse=(7.0, 8.0, 9.0), two_sided=True, width=1.0, height=1.0)
    setup = setup_of(pg.Object("quad", material=lamp), lights=(light, LAMP), patches=40)
    patches = divide(setup.with_(diffuse_weight=2.0, emissive_weight=0.5))
    own = patches.owner == 0
    assert patches.owner.max() == 1
    np.testing.assert_allclose(patches.reflectance[own], np.tile([0.2, 0.4, 0.6], (own.sum(), 1)))
    np.testing.assert_allclose(patches.emission[own], np.tile([2.5, 2.0, 1.5], (own.sum(), 1)))
    assert not patches.reflectance[~own].any()
    np.testing.assert_array_equal(patches.emission[~own], np.tile([7.0, 8, 9], ((~own).sum(), 1)))
    down = patches.normal[~own][:, 1] < 0.0
    assert patches.area[~own][down].sum() == pytest.approx(1.0)
    assert patches.area[~own][~down].sum() == pytest.approx(1.0)


def test_one_sided_lights_shine_from_their_front():
    light = pg.PolygonLight(vertices=((0, 3, 0), (1, 3, 0), (0.2, 3, 0.2), (0, 3, 1)))
    patches = divide(setup_of(pg.Object("quad"), lights=(light,), patches=1))
    assert patches.triangle[patches.owner == 1].tolist() == [True, True]
    np.testing.assert_allclose(patches.normal[patches.owner == 1], [[0, -1, 0]] * 2, atol=1e-12)
    assert patches.area[patches.owner == 1].sum() == pytest.approx(0.2, rel=1e-12)


def test_a_texture_gives_each_patch_its_mean(tmp_path):
    from PIL import Image

    codes = np.array([[0, 51, 102, 153], [204, 255, 0, 51]], dtype=np.uint8)
    Image.fromarray(np.repeat(codes[..., None], 3, axis=2)).save(tmp_path / "steps.png")
    # Each texel 16 times over: away from its rim a bilinear lookup sees one value
    wide = np.kron(codes, np.ones((16, 16), dtype=np.uint8))
    Image.fromarray(np.repeat(wide[..., None], 3, axis=2)).save(tmp_path / "wide.png")
    material = pg.Material(diffuse=(0.9, 0.5, 0.1), texture=str(tmp_path / "wide.png"))
    item = pg.Object("quad", material=material, transform=pg.Transform(scale=(2.0, 1.0, 1.0)))
    patches = divide(setup_of(item, patches=8))
    assert patches.parents.grid.tolist() == [[2, 4]]
    # The texture lies as the quad is seen from above, -z up
    x, _, z = patches.centre.T
    column, row = np.int64(np.floor(x)) + 2, np.int64(z < 0.0)
    # Half a texel at each of four sides fades to a neighbour: within 1/16 of the whole contrast
    grey = codes[1 - row, column] / 255.0
    np.testing.assert_allclose(patches.reflectance[:, 0], 0.9 * grey, atol=0.9 / 16)
    np.testing.assert_allclose(patches.reflectance[:, 2], 0.1 * grey, atol=0.1 / 16)
    # All fading is between patches: the sum of all is that of the picture
    total = patches.reflectance[:, 1].mean()
    assert total == pytest.approx(0.5 * codes.mean() / 255.0, rel=1e-6)


def test_only_some_objects_have_texture_coordinates():
    textured = pg.Object("quad", material=pg.Material(texture="tiles.png", diffuse=(0.9,) * 3))
    patches = divide(setup_of(textured, pg.Object("icosphere", tessellation=1), patches=30))
    own = patches.corners[patches.owner == 0]
    assert patches.texcoords[own].min() == 0.0 and patches.texcoords[own].max() == 1.0
    assert not patches.texcoords[patches.corners[patches.owner == 1]].any()
    assert divide(setup_of(pg.Object("icosphere", tessellation=1), patches=30)).texcoords is None


@pytest.mark.parametrize("colour", [(1.0, 0.5, 0.5), (0.2, 1.5, 0.2)])
def test_surfaces_that_reflect_everything_are_refused(colour):
    objects = pg.Object("quad"), pg.Object("sphere", material=pg.Material(diffuse=colour))
    with pytest.raises(
        PlaygroundError, match=r"object 2 \(sphere\) reflects all.*less than 1.*Lower (red|green)"
    ):
        divide(setup_of(*objects))
    with pytest.raises(PlaygroundError, match=r"0.7 times diffuse_weight 2.*or diffuse_weight"):
        divide(setup_of(objects[0]).with_(diffuse_weight=2.0))


def test_darkness_is_refused():
    dark = pg.PointLight(diffuse=(0.0, 0.0, 0.0))
    for lights in ((), (dark,)):
        with pytest.raises(PlaygroundError, match=r"nothing in the scene sends out light.*Add a"):
            divide(setup_of(pg.Object("quad"), lights=lights))
    glow = pg.Object("quad", material=pg.Material(emissive=(0.0, 0.1, 0.0)))
    assert divide(setup_of(glow, lights=())).emission.any()
    with pytest.raises(PlaygroundError, match="sends out light"):
        divide(setup_of(glow, lights=()).with_(terms=("diffuse",)))


def test_nothing_to_divide_is_refused():
    with pytest.raises(PlaygroundError, match=r"no surface.*without objects"):
        divide(setup_of())
    line = pg.Object("box", transform=pg.Transform(scale=(1, 0, 0)))
    with pytest.raises(PlaygroundError, match=r"no surface.*12 triangles have no area in object 1"):
        divide(setup_of(line))
    point = pg.Object("sphere", transform=pg.Transform(size=0.0))
    assert len(divide(setup_of(point, pg.Object("quad"), patches=1))) == 1


def test_slivers_are_left_out_and_counted():
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [2, 0, 0]], dtype=np.float32)
    faces = np.array([[0, 1, 2], [0, 1, 3]], dtype=np.int32)
    mesh = Mesh(corners, np.tile(np.float32([0, 0, 1]), (4, 1)), faces, name="splinter")
    patches = divide(setup_of(pg.Object(arrays=mesh), patches=1))
    assert len(patches) == 1 and np.isfinite(patches.normal).all()
    assert "1 triangle has no area in object 1 (splinter)" in patches.warnings[0]


def test_numbers_that_are_none_are_refused():
    good = pg.Object("quad").geometry().mesh
    broken = good.positions.copy()
    broken[2, 1] = np.nan
    mesh = Mesh(broken, good.normals, good.faces, name="hole")
    with pytest.raises(PlaygroundError, match=r"object 1 \(hole\) has corners that are no places"):
        divide(setup_of(pg.Object(arrays=mesh)))
    normals = good.normals.copy()
    normals[:, 0] = np.nan
    mesh = Mesh(good.positions, normals, good.faces)
    assert np.isfinite(divide(setup_of(pg.Object(arrays=mesh), patches=1)).normals).all()


def test_a_scene_too_large_for_memory_is_refused_before_any_work(monkeypatch):
    monkeypatch.setattr(memory, "available", lambda: 8 * 500**2)
    with pytest.raises(PlaygroundError, match=r"of 600 patches do not fit.*patches = 500"):
        divide(setup_of(pg.Object("box"), patches=600))
    with pytest.raises(PlaygroundError, match=r"The meshes alone have 1922 pieces: lower their"):
        divide(setup_of(pg.Object("torus", tessellation=62, normals="flat"), patches=1))
    assert len(divide(setup_of(pg.Object("box"), patches=486))) == 486
    monkeypatch.setattr(memory, "available", lambda: None)
    assert len(divide(setup_of(pg.Object("box"), patches=600))) == 600


def test_free_memory_is_known_on_linux():
    free = memory.available()
    assert free is None or 2**20 < free < 2**50


def test_a_container_has_no_more_memory_than_it_may(monkeypatch, tmp_path):
    machine = memory.available()
    file = tmp_path / "memory.max"
    monkeypatch.setattr(memory, "LIMITS", (str(file), str(tmp_path / "none")))
    assert machine is None or memory.available() >= 2**20
    file.write_text("1048576\n")
    assert memory.available() == 2**20
    file.write_text("max\n")
    assert machine is None or memory.available() > 2**20


def test_the_same_setup_gives_the_same_patches():
    setup = pg.load("teapot").with_(patches=100, tessellation=3, diffuse=(0.5, 0.5, 0.5))
    one, other = divide(setup), divide(setup)
    assert np.array_equal(one.points, other.points) and np.array_equal(one.corners, other.corners)


def test_a_fine_mesh_leaves_no_wall_whole():
    ball = pg.Object("sphere", tessellation=32)
    wall = pg.Object("quad", transform=pg.Transform(translate=(0.0, -2.0, 0.0), size=20.0))
    patches = divide(setup_of(ball, wall, patches=100))
    alone = divide(setup_of(ball, patches=100))
    of_wall = len(patches) - len(alone)
    assert len(alone) > 100 and 50 <= of_wall <= 200
    assert any("large ones are cut" in text for text in patches.warnings)
