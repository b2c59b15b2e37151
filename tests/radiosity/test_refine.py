"""Patches are divided where light changes; no corner ends up in the middle of an edge."""

import numpy as np
import pytest

import playground as pg
from playground.errors import PlaygroundError
from playground.render.radiosity.patch import memory
from playground.render.radiosity.patch.corner_light import corner_light
from playground.render.radiosity.patch.divide import divide
from playground.render.radiosity.patch.inspect import inspect
from playground.render.radiosity.patch.refine import refine


def patches_of(*objects, patches=100):
    scene = pg.Scene(objects=objects, lights=(pg.PointLight(),))
    return divide(pg.Setup(scene).with_(patches=patches))


def shadow(patches, at=0.237):
    """Light with an edge that crosses all surfaces askew."""
    x, y, z = (patches.centre + patches.origin).T
    return np.where(x + 0.3 * y + 0.2 * z > at, 1.0, 0.1)[:, None] * [1.0, 0.8, 0.6]


ITEMS = [
    pg.Object("quad", transform=pg.Transform(rotate=(0, 20, 0))),
    pg.Object("box"),
    pg.Object("icosphere", tessellation=2),
    pg.Object("sphere", tessellation=8),
    pg.Object("cylinder", tessellation=6, transform=pg.Transform(scale=(-1, 1, 1))),
    pg.Object("cone", tessellation=5, normals="flat"),
    pg.Object("teapot", tessellation=1),
]


@pytest.mark.parametrize("item", ITEMS, ids=lambda item: item.mesh)
def test_rounds_of_division_stay_conforming_and_keep_the_surface(item):
    patches = patches_of(item)
    start = inspect(patches)
    assert not len(start.t_vertices)
    whole = patches.area.sum()
    for _ in range(3):
        finer = refine(patches, shadow(patches))
        assert len(finer) > len(patches)
        report = inspect(finer)
        assert not len(report.t_vertices) and not len(report.inside_out)
        assert finer.area.sum() == pytest.approx(whole, rel=1e-12)
        # Every piece lies on its parent and looks the same way
        corners = finer.parents.corners[finer.parent]
        area = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
        facing = np.einsum("ni,ni->n", finer.normal, area / np.linalg.norm(area, axis=1)[:, None])
        assert facing.min() > 1.0 - 1e-6
        total = np.bincount(finer.parent, finer.area)
        np.testing.assert_allclose(total, np.bincount(patches.parent, patches.area), rtol=1e-9)
        assert np.array_equal(finer.parents.first, np.searchsorted(finer.parent, range(len(total))))
        assert (np.diff(finer.parent) >= 0).all()
        patches = finer


@pytest.mark.parametrize("item", ITEMS, ids=lambda item: item.mesh)
def test_only_what_lies_at_the_shadows_edge_becomes_small(item):
    patches = patches_of(item)
    before = patches.area.max()
    for _ in range(3):
        patches = refine(patches, shadow(patches))
    x, y, z = patches.centre.T
    away = np.abs(x + 0.3 * y + 0.2 * z - 0.237)
    size = np.sqrt(patches.area)
    assert size[away < 0.01].max() < 0.5 * np.sqrt(before)
    assert size[away > 0.5].mean() > 2.0 * size[away < 0.05].mean()


def test_no_piece_becomes_a_sliver():
    patches = patches_of(pg.Object("quad"), patches=25)
    for _ in range(5):
        patches = refine(patches, shadow(patches))
    polygon = patches.polygon
    longest = np.linalg.norm(np.roll(polygon, -1, axis=1) - polygon, axis=-1).max(axis=1)
    # The worst transition piece of a square: half of a half, (1/4)/(5/4) of its longest squared
    assert (patches.area / longest**2).min() >= 0.2 - 1e-9


def test_neighbours_differ_by_one_halving():
    patches = patches_of(pg.Object("quad"), patches=16)
    for _ in range(4):
        spot = (np.abs(patches.centre - [0.3, 0.0, 0.3]).max(axis=1) < 0.01)[:, None] * np.ones(3)
        nearest = np.argmin(np.linalg.norm(patches.centre - [0.3, 0.0, 0.3], axis=1))
        spot[nearest] = 1.0
        patches = refine(patches, spot)
    cells = patches.cells
    corners = patches.points[cells.corners]
    side = np.linalg.norm(corners[:, 1] - corners[:, 0], axis=1)
    assert set(np.round(np.log2(0.5 / side)).astype(int)) == {0, 1, 2, 3, 4}
    low, high = corners.min(axis=1)[:, [0, 2]], corners.max(axis=1)[:, [0, 2]]
    # Cells with an edge in common overlap along one axis, and meet along the other
    touch = np.minimum(high[:, None], high) - np.maximum(low[:, None], low)
    along_edge = (touch.max(axis=-1) > 1e-9) & (np.abs(touch.min(axis=-1)) < 1e-9)
    ratio = side[:, None] / side
    assert ratio[along_edge].max() <= 2.0 + 1e-9


def test_creases_are_conforming_but_not_blended():
    patches = patches_of(pg.Object("box"), patches=54)
    light = np.where(patches.parent == 0, 1.0, 0.5)[:, None] * np.ones(3)
    assert refine(patches, light) is patches, "a step over a crease is no gradient"
    light[7] = 3.0
    finer = refine(patches, light)
    assert not len(inspect(finer).t_vertices)
    face = finer.parent.astype(float)[:, None] * np.ones(3)
    at_points = corner_light(finer, face)
    np.testing.assert_allclose(at_points[finer.corners], face[:, None].repeat(4, 1), atol=1e-12)
    np.testing.assert_allclose(
        finer.normals[finer.corners], finer.normal[:, None].repeat(4, 1), atol=1e-7
    )


def test_even_light_divides_nothing():
    patches = patches_of(pg.Object("sphere", tessellation=6))
    assert refine(patches, np.ones((len(patches), 3))) is patches
    assert refine(patches, np.zeros((len(patches), 3))) is patches


def test_parents_that_were_not_divided_stay_regular():
    patches = patches_of(pg.Object("box"), pg.Object("quad"), patches=150)
    light = np.ones((len(patches), 3))
    inside = patches.parents.first[2] + 12  # in the middle of the third face
    light[inside] = 9.0
    finer = refine(patches, light)
    assert finer.parents.regular.tolist() == [True, True, False, True, True, True, True]
    for parent in np.flatnonzero(finer.parents.regular):
        old, new = patches.parent == parent, finer.parent == parent
        np.testing.assert_array_equal(finer.polygon[new], patches.polygon[old])
    assert refine(finer, np.ones((len(finer), 3))) is finer


def test_colours_owners_and_textures_are_handed_on():
    textured = pg.Object("quad", material=pg.Material(texture="tiles.png", diffuse=(0.9,) * 3))
    glow = pg.Object("box", material=pg.Material(emissive=(1.0, 2.0, 3.0)))
    patches = patches_of(textured, glow)
    finer = refine(patches, shadow(patches))
    for owner in (0, 1):
        old, new = patches.owner == owner, finer.owner == owner
        for what in ("reflectance", "emission"):
            total = patches.area[old] @ getattr(patches, what)[old]
            np.testing.assert_allclose(
                finer.area[new] @ getattr(finer, what)[new], total, rtol=1e-12
            )
    own = finer.corners[finer.owner == 0]
    x, _, z = np.moveaxis(finer.points[own], -1, 0)
    expected = 0.5 + 0.5 * np.stack([x, -z], axis=-1)
    np.testing.assert_allclose(finer.texcoords[own], expected, atol=1e-12)


def test_division_stops_where_memory_ends(monkeypatch):
    patches = patches_of(pg.Object("box"))
    monkeypatch.setattr(memory, "available", lambda: 8 * (len(patches) + 10) ** 2)
    with pytest.raises(PlaygroundError, match="do not fit into memory"):
        refine(patches, shadow(patches))
