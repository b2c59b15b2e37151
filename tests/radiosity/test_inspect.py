"""Surfaces that are broken on purpose, and what the report says of them."""

import numpy as np
import pytest

import playground as pg
from playground.render.radiosity.patch.divide import divide
from playground.render.radiosity.patch.inspect import inspect
from playground.scene.mesh import Mesh

LAMP = pg.PointLight()


def report_of(*objects, lights=(LAMP,), patches=1):
    scene = pg.Scene(objects=objects, lights=lights)
    return inspect(divide(pg.Setup(scene).with_(patches=patches)))


def box_without(*faces, turned=()):
    """A cube of quads; faces left out or turned inside out by number."""
    mesh = pg.Object("box").geometry().mesh
    triangles = mesh.faces.reshape(6, 2, 3).copy()
    for number in turned:
        triangles[number] = triangles[number][:, ::-1]
    kept = [k for k in range(6) if k not in faces]
    found = Mesh.create(mesh.positions, triangles[kept].reshape(-1, 3), mesh.normals)
    return pg.Object(arrays=found)


@pytest.mark.parametrize("patches", [1, 600])
def test_a_sound_box_from_outside(patches):
    report = report_of(pg.Object("box"), patches=patches)
    assert report.sound and not len(report.leaks) and not report.closed
    assert len(report.facing_nothing) == len(report.patches)
    assert "patches facing nothing: light leaves the scene" in str(report)


@pytest.mark.parametrize("patches", [1, 600])
def test_a_room_is_closed(patches):
    report = report_of(*pg.load("furnace").scene.objects, patches=patches)
    assert report.sound and report.closed
    assert str(report) == "No leak, T-vertex, overlap or face inside out."


@pytest.mark.parametrize(("patches", "edges"), [(1, 4), (500, 40)])
def test_a_missing_face_leaks(patches, edges):
    report = report_of(box_without(2), patches=patches)
    assert len(report.leaks) == edges
    assert str(report).startswith(f"{edges} open edges: light can pass there\n  patch ")
    assert "of object 1, at (" in str(report)


def test_walls_that_meet_leak_nowhere_however_they_are_cut():
    """A block on a floor: its open bottom is closed by the floor, which is cut otherwise."""
    floor = pg.Object("quad", transform=pg.Transform(size=3.0, translate=(0.1, -1.0, 0.2)))
    report = report_of(floor, box_without(box_bottom()), patches=300)
    block = report.patches.owner[report.leaks] == 1
    assert not block.any(), "only the rim of the floor is open"
    assert len(report.leaks) == 2 * report.patches.parents.grid[0].sum()


def box_bottom():
    mesh = pg.Object("box").geometry().mesh
    return int(np.argmin(mesh.triangle_normals.reshape(6, 2, 3)[:, 0, 1]))


def test_a_gap_is_found_whatever_its_size():
    for gap in (1e-4, 1e-2):
        walls = (
            pg.Object("quad", transform=pg.Transform(rotate=(0, 0, 90), translate=(1 + gap, 0, 0))),
            pg.Object("quad", transform=pg.Transform(translate=(0, -1, 0))),
        )
        assert len(report_of(*walls).leaks) == 8
    touching = pg.Object("quad", transform=pg.Transform(rotate=(0, 0, 90), translate=(1, 0, 0)))
    assert len(report_of(touching, walls[1]).leaks) == 6


def test_a_t_vertex_is_found():
    corners = [
        [0, 0, 0],
        [2, 0, 0],
        [2, 1, 0],
        [0, 1, 0],
        [1, 1, 0],
        [0, 2, 0],
        [1, 2, 0],
        [2, 2, 0],
    ]
    quads = [[0, 1, 2, 3], [3, 4, 6, 5], [4, 2, 7, 6]]
    faces = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    report = report_of(pg.Object(arrays=Mesh.create(corners, faces)))
    assert len(report.t_vertices) == 1 and not report.sound
    patch, point = report.t_vertices[0]
    assert patch == 0 and report.patches.points[point].tolist() == [1, 1, 0]
    assert "1 T-vertex: shading is torn there\n  patch 0 of object 1, at (1, 1, 0)" in str(report)


def test_faces_inside_out_are_found():
    report = report_of(box_without(turned=(3,)), patches=600)
    assert len(report.inside_out) == 100 and not report.sound
    assert (report.patches.parent[report.inside_out] == 3).all()
    assert "100 faces inside out" in str(report)
    # Of two that disagree the smaller one is wrong
    lid = Mesh.create(
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [3, 0, 0], [3, 1, 0]],
        [[0, 1, 2], [0, 2, 3], [1, 2, 4], [4, 2, 5]],
    )
    report = report_of(pg.Object(arrays=lid))
    wrong = report.patches.centre[report.inside_out]
    np.testing.assert_allclose(wrong, [[0.5, 0.5, 0.0]], atol=1e-12)


def test_a_lamp_that_looks_into_the_wall_faces_its_back():
    wall = pg.Object("quad", transform=pg.Transform(size=3.0))
    lamp = pg.RectangleLight(position=(0.0, -1.0, 0.0), facing=(0.0, 1.0, 0.0))
    report = report_of(wall, lights=(lamp,))
    assert report.patches.owner[report.facing_backs].tolist() == [1]
    assert "1 patch facing a back: hidden inside a solid" in str(report)
    assert report.patches.owner[report.facing_nothing].tolist() == [0]


@pytest.mark.parametrize("upside_down", [0.0, 180.0])
def test_overlaps_in_one_plane_are_found(upside_down):
    floor = pg.Object("quad", transform=pg.Transform(size=3.0, rotate=(10, 0, 20)))
    inner = pg.Transform(size=0.5, rotate=(10 + upside_down, 0, 20))
    rug = pg.Object("quad", transform=inner)
    report = report_of(floor, rug, patches=100)
    assert report.overlaps.tolist() == [[0, 1]] and not report.sound
    assert "1 overlap in one plane: either hides the other" in str(report)
    # Side by side in one plane, or one above the other, they do not overlap
    above = pg.Transform(size=0.5, rotate=inner.rotate, translate=(0.0, 0.01, 0.0))
    assert not len(report_of(floor, pg.Object("quad", transform=above)).overlaps)
    beside = pg.Object("quad", transform=pg.Transform(translate=(2.0, 0.0, 0.5)))
    assert not len(report_of(pg.Object("quad"), beside).overlaps)
    across = pg.Object("quad", transform=pg.Transform(rotate=(0, 45, 0), translate=(1.8, 0, 1.8)))
    assert not len(report_of(pg.Object("quad"), across).overlaps)
    assert len(report_of(pg.Object("quad"), across, beside).overlaps) == 1


@pytest.mark.parametrize("name", pg.library())
def test_every_setup_of_the_library_is_sound(name):
    setup = pg.load(name).with_(patches=1)
    tame = {"diffuse": (0.5, 0.5, 0.5)} if name in ("red-on-blue", "yellow") else {}
    lights = setup.scene.lights or (LAMP,)
    report = inspect(divide(setup.with_(lights=lights, **tame)))
    assert report.sound, str(report)
