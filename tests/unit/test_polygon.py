"""Polygons become triangles that cover them once, whatever their outline."""

import numpy as np
import pytest

from playground.scene.mesh_file import load_mesh
from playground.scene.polygon import triangles

NOTCHED = [(0, 0), (2, 0), (2, 2), (1, 0.5), (0, 2)]


def areas(corners, cut):
    """Twice the signed area of each triangle of a polygon in the xy plane."""
    a, b, c = np.moveaxis(corners[cut], 1, 0)
    return (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]


def outline_area(corners):
    x, y = corners[:, 0], corners[:, 1]
    return float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def flat(points):
    return np.column_stack([np.array(points, float), np.zeros(len(points))])


@pytest.mark.parametrize("turn", range(5))
@pytest.mark.parametrize("step", [1, -1])
def test_a_notch_stays_open(turn, step):
    corners = np.roll(flat(NOTCHED), turn, axis=0)[::step]
    found = areas(corners, triangles(corners, np.array([5])))
    assert np.all(found * step > 0)
    assert found.sum() == pytest.approx(step * 5.0)


@pytest.mark.parametrize("count", [4, 7, 20, 150])
def test_a_star_is_covered_once_in_any_plane(count):
    random = np.random.default_rng(count)
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    corners = flat(
        np.column_stack([np.cos(angle), np.sin(angle)]) * random.uniform(0.2, 1, (count, 1))
    )
    turned = corners @ np.linalg.qr(random.normal(size=(3, 3)))[0] * 1e-3 + 5.0
    cut = triangles(turned, np.array([count]))
    found = areas(corners, cut)
    assert len(cut) == count - 2
    assert found.min() >= -1e-12
    assert found.sum() == pytest.approx(outline_area(corners), rel=1e-12)


def test_a_slit_to_a_hole():
    outside, inside = (
        [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0)],
        [(1, 1), (1, 3), (3, 3), (3, 1), (1, 1)],
    )
    corners = flat(outside + inside)
    found = areas(corners, triangles(corners, np.array([10])))
    assert found.min() > 0
    assert found.sum() == pytest.approx(2 * (16 - 4))


def test_polygons_keep_their_order_and_convex_ones_their_fans():
    square = flat([(0, 0), (1, 0), (1, 1), (0, 1)])
    corners = np.concatenate([square, flat(NOTCHED), square[:3], square])
    cut = triangles(corners, np.array([4, 5, 3, 4]))
    assert cut[:2].tolist() == [[0, 1, 2], [0, 2, 3]]
    assert sorted({*cut[2:5].ravel()}) == [4, 5, 6, 7, 8]
    assert cut[5:].tolist() == [[9, 10, 11], [12, 13, 14], [12, 14, 15]]


@pytest.mark.parametrize(
    "points",
    [[(0, 0), (1, 1), (1, 0), (0, 1)], [(0, 0)] * 5, [(0, 0), (1, 0), (2, 0), (1, 0)]],
    ids=["crossing itself", "one point", "one line"],
)
def test_what_is_no_polygon_still_gives_triangles(points):
    cut = triangles(flat(points), np.array([len(points)]))
    assert cut.shape == (len(points) - 2, 3)


def test_a_concave_face_of_an_obj_file(tmp_path):
    lines = "".join(f"v {x} {y} 0\n" for x, y in NOTCHED)
    (tmp_path / "notch.obj").write_text(lines + "f 1 2 3 4 5\n")
    mesh, _ = load_mesh(tmp_path / "notch.obj")
    found = areas(mesh.positions.astype(float), mesh.faces)
    assert np.all(found > 0) and found.sum() == pytest.approx(5.0)
