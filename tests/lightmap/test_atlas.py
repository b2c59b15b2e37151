"""The atlas: charts apart from each other, of one density, the same every time."""

from dataclasses import replace

import numpy as np
import pytest

import playground as pg
from playground.render.lightmap.atlas import BORDER, GUTTER, unwrap
from playground.render.lightmap.cover import cover
from playground.scene.scene import Object, Scene
from playground.scene.transform import Transform

NAMES = ("cornell-box", "teapot", "sphere-row", "textured")


@pytest.fixture(scope="module", params=NAMES)
def laid_out(request):
    scene = pg.load(request.param).scene
    return scene, unwrap(scene, 128)


def flat(part, size):
    return part.texcoords[part.faces].astype(np.float64) * size


def charts_of(part):
    return part.charts[part.faces[:, 0]]


def test_the_triangles_are_those_of_the_mesh(laid_out):
    scene, atlas = laid_out
    for item, part in zip(scene.objects, atlas.parts, strict=True):
        mesh = item.geometry().mesh
        assert np.array_equal(part.vertices[part.faces], mesh.faces)
        assert np.array_equal(part.mesh(mesh).positions[part.faces], mesh.positions[mesh.faces])
        assert (part.charts[part.faces] == charts_of(part)[:, None]).all()


def test_charts_keep_apart(laid_out):
    """Around every texel that a lookup on a chart reads, `GUTTER` texels are no other chart's.

    The image repeats, so that holds across its border too.
    """
    _, atlas = laid_out
    owner = np.full((atlas.size, atlas.size), -1)
    triangles = np.concatenate([flat(part, atlas.size) for part in atlas.parts])
    chart = np.concatenate([charts_of(part) for part in atlas.parts])
    assert len(np.unique(chart)) == atlas.charts
    for number in range(atlas.charts):
        found = cover(triangles[chart == number], atlas.size)
        assert (owner[found.row, found.column] == -1).all(), "two charts need one texel"
        owner[found.row, found.column] = number
    for y in range(-GUTTER, GUTTER + 1):
        for x in range(-GUTTER, GUTTER + 1):
            near = np.roll(owner, (y, x), axis=(0, 1))
            assert ((near == owner) | (near == -1) | (owner == -1)).all()


def test_all_lies_inside(laid_out):
    _, atlas = laid_out
    for part in atlas.parts:
        texels = part.texcoords.astype(np.float64) * atlas.size
        assert texels.min() >= BORDER + 0.5 - 1e-4
        assert texels.max() <= atlas.size - BORDER - 0.5 + 1e-4


def test_texels_are_of_one_size_in_the_world(laid_out):
    """Charts are stretched by less than a texel, so that their edges meet the middles of texels.

    One that is smaller than a texel becomes one texel wide; nothing can be said of those.
    """
    scene, atlas = laid_out
    for item, part in zip(scene.objects, atlas.parts, strict=True):
        corners = item.geometry().mesh.positions[item.geometry().mesh.faces].astype(np.float64)
        corners = corners @ item.transform.matrix[:3, :3].T
        a, b, c = np.moveaxis(corners, 1, 0)
        world = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        places = flat(part, atlas.size)
        u, v = places[:, 1] - places[:, 0], places[:, 2] - places[:, 0]
        texels = np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])
        for number in np.unique(charts_of(part)):
            mine = charts_of(part) == number
            density = np.sqrt(texels[mine].sum() / world[mine].sum())
            extent = np.ptp(places[mine].reshape(-1, 2), axis=0).min()
            if extent > 1.5:
                assert abs(density / atlas.density - 1.0) <= 1.0 / (extent - 1.0)


def test_the_same_every_time(laid_out):
    scene, atlas = laid_out
    again = unwrap(scene, atlas.size)
    assert again.density == atlas.density
    for one, other in zip(atlas.parts, again.parts, strict=True):
        for name in ("vertices", "faces", "texcoords", "charts"):
            assert np.array_equal(getattr(one, name), getattr(other, name))


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e9])
def test_at_every_scale(scale):
    box = Object(mesh="box", transform=Transform(scale=(scale,) * 3))
    atlas = unwrap(Scene(objects=(box,)), 64)
    assert atlas.charts == 6
    unit = unwrap(Scene(objects=(Object(mesh="box"),)), 64)
    assert atlas.density * scale == pytest.approx(unit.density, rel=0.02)  # twice what is left over


def test_what_is_shrunk_to_nothing_takes_no_space():
    item = Object(mesh="box")
    flat_one = replace(item, transform=Transform(scale=(0.0, 0.0, 0.0)))
    atlas = unwrap(Scene(objects=(flat_one, item)), 64)
    assert atlas.parts[0] is None and atlas.charts == 6
    with pytest.raises(pg.PlaygroundError, match="no surface"):
        unwrap(Scene(objects=(flat_one,)), 64)


@pytest.mark.parametrize("size", [0, 15, 8193, -4, True, 64.0, "64"])
def test_sizes_that_are_none(size):
    with pytest.raises(pg.PlaygroundError, match="size of a lightmap"):
        unwrap(Scene(), size)


def test_too_many_charts_for_the_size():
    with pytest.raises(pg.PlaygroundError, match="do not fit"):
        unwrap(pg.load("teapot").scene, 16)
