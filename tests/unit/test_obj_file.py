"""The text of .obj files: each dialect is understood, each flaw names its line."""

from __future__ import annotations

import numpy as np
import pytest

from playground.errors import PlaygroundError
from playground.scene.mesh_file import load_mesh

SQUARE_OBJ = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"


def file(folder, name, text):
    path = folder / name
    path.write_bytes(text.encode())
    return path


def test_far_from_the_origin_keeps_its_detail(tmp_path):
    lines = "".join(f"v {1e7 + x:.17g} {y} {-3e8 + z:.17g}\n" for x, y, z in np.eye(3) * 0.001)
    mesh, offset = load_mesh(file(tmp_path, "far.obj", lines + "f 1 2 3\n"))
    np.testing.assert_allclose(offset, [1e7 + 0.0005, 0.0005, -3e8 + 0.0005], rtol=1e-15)
    # float64 itself steps by 6e-8 at 3e8
    np.testing.assert_allclose(mesh.positions, np.eye(3) * 0.001 - 0.0005, atol=1e-7)


def test_polygons_become_fans(tmp_path):
    ring = [(np.cos(t), np.sin(t)) for t in np.linspace(0, 2 * np.pi, 6, endpoint=False)]
    text = "".join(f"v {x} {y} 0\n" for x, y in ring) + "f 1 2 3 4 5 6\nf 4 3 2 1\nf 1 3 2\n"
    mesh, _ = load_mesh(file(tmp_path, "hexagon.obj", text))
    expected = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [3, 2, 1], [3, 1, 0], [0, 2, 1]]
    assert mesh.faces.tolist() == expected


def test_negative_indices_count_from_their_line(tmp_path):
    text = (
        SQUARE_OBJ + "f -4 -3 -2\n" + SQUARE_OBJ.replace(" 0\n", " 5\n") + "f -4 -3 -2\nf 1 2 4\n"
    )
    mesh, offset = load_mesh(file(tmp_path, "relative.obj", text))
    assert mesh.faces.tolist() == [[0, 1, 2], [4, 5, 6], [0, 1, 3]]
    assert offset.tolist() == [0.5, 0.5, 2.5]


def test_mixed_corners_comments_and_line_ends(tmp_path):
    text = (
        "# a square\r\nmtllib missing.mtl\r\no thing\r\nusemtl steel\r\n"
        + SQUARE_OBJ.replace("\n", " 1.0 # w\r\n")
        + "vt 0 0\r\nvt 1 0\r\nvt 1 1\r\nvn 0 0 2\r\ns off\r\n"
        + "  f 1/1/1 2/2/1 3/3/1 # first\r\nf\t1//1 \\\r\n 3//1 4//1\r\n"
    )
    mesh, _ = load_mesh(file(tmp_path, "mixed.obj", text))
    assert len(mesh.faces) == 2
    assert np.array_equal(mesh.normals, np.tile([0, 0, 1], (len(mesh.normals), 1)))
    corners = mesh.texcoords[mesh.faces].tolist()
    assert corners == [[[0, 0], [1, 0], [1, 1]], [[0, 0], [0, 0], [0, 0]]]


def test_without_normals_equal_positions_are_smooth(tmp_path):
    # A seam in the texture must not become a crease
    text = SQUARE_OBJ.replace("1 1 0", "1 1 1") + "vt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 1/2 3/2 4/2\n"
    mesh, _ = load_mesh(file(tmp_path, "seam.obj", text))
    assert len(mesh.positions) == 6
    first, second = mesh.faces
    assert np.array_equal(mesh.normals[first[0]], mesh.normals[second[0]])


def test_bad_normals_and_texcoords_of_the_file_do_not_spoil_it(tmp_path):
    text = SQUARE_OBJ + "vn 0 0 0\nvn nan 0 1\nvt nan 0\nf 1/1/1 2/1/1 3/1/2\n"
    mesh, _ = load_mesh(file(tmp_path, "bad.obj", text))
    assert mesh.texcoords is None
    assert mesh.normals.tolist() == [[0, 0, 1]] * 3


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("f 1 2 9\n", ["line 5", "'f 1 2 9'", "1 to 4"]),
        ("f 0 1 2\n", ["line 5", "'f 0 1 2'", "1 to 4"]),
        ("f 1 2 3\nf -1 -2 -5\n", ["line 6", "'f -1 -2 -5'"]),
        ("f 1/1 2/1 3/1\n", ["line 5", "no 'vt'"]),
        ("vn 0 0 1\nf 1//1 2//2 3//1\n", ["line 6", "'vn'", "1 to 1"]),
        ("vn 0 0 1\nf 1//-1 2//-2 3//-1\n", ["line 6", "'vn'"]),
        ("f 1 2\n", ["line 5", "malformed", "three or more"]),
        ("f 1 2 x\n", ["line 5", "malformed", "'f 1 2 x'"]),
        ("f 1 2 3.5\n", ["line 5", "malformed"]),
        ("f 1/2/3/4 2 3\n", ["line 5", "malformed"]),
        ("f 1 2 99999999999999999999\n", ["line 5", "malformed"]),
        ("v nan 0 0\nf 1 2 3\n", ["line 5", "'v nan 0 0'", "finite"]),
        ("v 1 inf 0\nf 1 2 3\n", ["line 5", "finite"]),
        ("v 1 1e999 0\nf 1 2 3\n", ["line 5", "finite"]),
        ("v 1 2\nf 1 2 3\n", ["line 5", "'v 1 2'", "3 finite numbers"]),
        ("v 1 2 z\nf 1 2 3\n", ["line 5", "'v 1 2 z'"]),
        ("v\nf 1 2 3\n", ["line 5"]),
        ("vt 0 x\nf 1 2 3\n", ["line 5", "'vt 0 x'", "2 finite numbers"]),
        ("vn 0 0\nf 1 2 3\n", ["line 5", "'vn 0 0'", "3 finite numbers"]),
        ("", ["no triangles"]),
        ("l 1 2\n", ["no triangles"]),
        ("f 1 1 2\n", ["no triangle with an area"]),
    ],
)
def test_flawed_obj(tmp_path, text, words):
    path = file(tmp_path, "flawed.obj", SQUARE_OBJ + text)
    with pytest.raises(PlaygroundError) as caught:
        load_mesh(path)
    message = str(caught.value)
    assert str(path) in message
    assert caught.value.got is not None and caught.value.allowed and caught.value.fix
    for word in words:
        assert word in message
