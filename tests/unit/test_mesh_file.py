"""Mesh files: what is sound comes through unchanged, what is not gives one clear error."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import trimesh

from playground.errors import PlaygroundError
from playground.scene.mesh_file import load_mesh
from playground.scene.shapes import make

SQUARE_OBJ = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"


def as_trimesh(mesh, **extra):
    return trimesh.Trimesh(mesh.positions, mesh.faces, process=False, **extra)


def file(folder, name, content):
    path = folder / name
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return path


def in_file(mesh, offset):
    """Triangles in the file's own coordinates, sorted: the order of vertices is free."""
    corners = mesh.positions.astype(float)[mesh.faces] + offset
    return corners[np.lexsort(corners.reshape(-1, 9).T.round(4))]


def failure(path):
    with pytest.raises(PlaygroundError) as caught:
        load_mesh(path)
    error = caught.value
    assert str(path) in str(error)
    assert error.got is not None and error.allowed and error.fix
    return str(error)


# Sound files


@pytest.mark.parametrize("suffix", ["obj", "ply", "stl", "glb", "gltf"])
def test_round_trip_through_trimesh(tmp_path, suffix):
    shape = make("torus", 16)
    source = as_trimesh(shape, vertex_normals=shape.normals)
    path = tmp_path / f"ring.{suffix}"
    if suffix == "gltf":
        path = _gltf_with_buffers(tmp_path, source)
    else:
        options = {"include_normals": True} if suffix in ("obj", "glb") else {}
        source.export(path, **options)
    mesh, offset = load_mesh(path)
    assert offset.dtype == np.float64 and offset.shape == (3,)
    assert len(mesh.faces) == len(shape.faces) and mesh.closed and mesh.name == path.stem
    np.testing.assert_allclose(in_file(mesh, offset), in_file(shape, 0), atol=1e-6)
    np.testing.assert_allclose(mesh.centre, 0, atol=1e-7)
    if suffix != "stl":
        assert len(mesh.positions) == len(shape.positions)
        np.testing.assert_allclose(mesh.normals, shape.normals, atol=1e-6)


def _gltf_with_buffers(folder, mesh):
    from trimesh.exchange.gltf import export_gltf

    for name, content in export_gltf(trimesh.Scene(mesh), include_normals=True).items():
        file(folder, name, content)
    return folder / "model.gltf"


@pytest.mark.parametrize("suffix", ["obj", "ply", "glb"])
def test_texcoords_come_through(tmp_path, suffix):
    shape = make("sphere", 12)
    picture = trimesh.visual.TextureVisuals(uv=shape.texcoords)
    path = tmp_path / f"ball.{suffix}"
    options = {} if suffix == "ply" else {"include_normals": True}
    source = as_trimesh(shape, vertex_normals=shape.normals, visual=picture)
    source.export(path, **({"vertex_normal": True} if suffix == "ply" else options))
    mesh, _ = load_mesh(path)
    got = np.concatenate([mesh.positions, mesh.normals, mesh.texcoords], axis=1)
    sent = np.concatenate([shape.positions, shape.normals, shape.texcoords], axis=1)
    assert len(got) == len(sent)
    got, sent = (rows[np.lexsort(rows.T.round(4))] for rows in (got, sent))
    np.testing.assert_allclose(got, sent, atol=1e-6)


def test_stl_is_welded_and_smooth(tmp_path):
    shape = make("icosphere", 6)
    as_trimesh(shape).export(tmp_path / "ball.stl")
    mesh, _ = load_mesh(tmp_path / "ball.stl")
    assert len(mesh.positions) == len(shape.positions)
    assert mesh.closed
    np.testing.assert_allclose(mesh.normals, mesh.positions, atol=0.01)


def test_text_stl(tmp_path):
    shape = make("box")
    as_trimesh(shape).export(tmp_path / "box.stl", file_type="stl_ascii")
    mesh, _ = load_mesh(tmp_path / "box.stl")
    assert len(mesh.positions) == 8 and len(mesh.faces) == 12 and mesh.volume == pytest.approx(8)


@pytest.mark.parametrize("encoding", ["ascii", "binary"])
def test_both_kinds_of_ply(tmp_path, encoding):
    shape = make("cone", 9)
    as_trimesh(shape).export(tmp_path / "cone.ply", encoding=encoding)
    mesh, offset = load_mesh(tmp_path / "cone.ply")
    np.testing.assert_allclose(in_file(mesh, offset), in_file(shape, 0), atol=1e-6)


def test_scene_graph_with_mirror_and_stretch(tmp_path):
    shape = make("sphere", 8)
    scene = trimesh.Scene()
    mirrored = np.diag([-2.0, 1.0, 1.0, 1.0])
    mirrored[:3, 3] = [10, 0, 0]
    for matrix in (np.eye(4), mirrored):
        source = as_trimesh(shape, vertex_normals=shape.normals)
        scene.add_geometry(source, transform=matrix)
    file(tmp_path, "two.glb", scene.export(file_type="glb", include_normals=True))
    mesh, offset = load_mesh(tmp_path / "two.glb")
    assert len(mesh.faces) == 2 * len(shape.faces)
    assert mesh.closed and mesh.volume == pytest.approx(3 * shape.volume, rel=1e-5)
    np.testing.assert_allclose(offset, [(-1 + 12) / 2, 0, 0], atol=1e-6)
    # The gradient of ((x - 10) / 2)^2 + y^2 + z^2 on the stretched one
    places = mesh.positions + offset
    far = places[:, 0] > 5
    gradient = (places - [10, 0, 0])[far] / [4, 1, 1]
    gradient /= np.linalg.norm(gradient, axis=1, keepdims=True)
    np.testing.assert_allclose(mesh.normals[far], gradient, atol=1e-5)


def test_far_away_in_a_scene_graph(tmp_path):
    scene = trimesh.Scene()
    matrix = np.eye(4)
    matrix[:3, 3] = [1e6, 0, 0]
    scene.add_geometry(as_trimesh(make("sphere", 8)), transform=matrix)
    file(tmp_path, "far.glb", scene.export(file_type="glb"))
    mesh, offset = load_mesh(tmp_path / "far.glb")
    assert offset[0] == pytest.approx(1e6)
    assert mesh.closed and mesh.volume == pytest.approx(make("sphere", 8).volume, rel=1e-6)


# Flawed files


def test_missing_folder_unknown_and_empty(tmp_path):
    assert "no such file" in failure(tmp_path / "missing.obj")
    (tmp_path / "folder.ply").mkdir()
    assert "a folder" in failure(tmp_path / "folder.ply")
    assert "a folder" in failure(tmp_path)
    assert "'.fbx'" in failure(file(tmp_path, "model.fbx", "x"))
    assert "no suffix" in failure(file(tmp_path, "model", "x"))
    for suffix in ("obj", "ply", "stl", "glb", "gltf"):
        assert "empty" in failure(file(tmp_path, f"empty.{suffix}", ""))
        assert "empty" in failure(file(tmp_path, f"blank.{suffix}", " \n\n"))


def test_unreadable(tmp_path, monkeypatch):
    def refuse(path):
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr(Path, "read_bytes", refuse)
    assert "Permission denied" in failure(file(tmp_path, "locked.obj", SQUARE_OBJ))


def test_a_name_no_system_accepts(tmp_path):
    failure(tmp_path / ("x" * 5000 + ".obj"))


@pytest.mark.parametrize("suffix", ["obj", "ply", "stl", "glb", "gltf"])
def test_garbage(tmp_path, suffix):
    noise = np.random.default_rng(3).integers(0, 256, 5000, dtype=np.uint8).tobytes()
    failure(file(tmp_path, f"noise.{suffix}", noise))
    failure(file(tmp_path, f"zeros.{suffix}", bytes(5000)))
    failure(file(tmp_path, f"text.{suffix}", "once upon a time\n" * 50))


@pytest.mark.parametrize("kind", ["glb", "stl", "stl_ascii", "ply", "ply_ascii"])
@pytest.mark.parametrize("share", [0.02, 0.3, 0.6, 0.9, 0.99])
def test_truncated(tmp_path, kind, share):
    source = as_trimesh(make("sphere", 12))
    suffix, _, text = kind.partition("_")
    if suffix == "ply":
        whole = source.export(file_type="ply", encoding=text or "binary")
    else:
        whole = source.export(file_type=kind)
    whole = whole.encode() if isinstance(whole, str) else whole
    failure(file(tmp_path, f"cut.{suffix}", whole[: int(share * len(whole))]))


def test_gltf_with_a_missing_buffer(tmp_path):
    path = _gltf_with_buffers(tmp_path, as_trimesh(make("box")))
    for buffer in tmp_path.glob("*.bin"):
        buffer.unlink()
    failure(path)


def test_gltf_that_is_no_gltf(tmp_path):
    failure(file(tmp_path, "list.gltf", "[1, 2, 3]"))
    failure(file(tmp_path, "none.gltf", json.dumps({"asset": {"version": "2.0"}})))


def test_point_clouds_and_bad_vertices(tmp_path):
    points = trimesh.PointCloud(np.eye(3))
    for suffix in ("ply", "glb"):
        file(tmp_path, f"cloud.{suffix}", points.export(file_type=suffix))
        assert "no triangles" in failure(tmp_path / f"cloud.{suffix}")
    for bad in (np.nan, np.inf):
        vertices = np.array([[0, 0, 0], [1, 0, 0], [0, bad, 0]])
        for suffix in ("ply", "stl", "glb"):
            source = trimesh.Trimesh(vertices, [[0, 1, 2]], process=False)
            with np.errstate(invalid="ignore"):
                content = source.export(file_type=suffix)
            assert "vertex 2" in failure(file(tmp_path, f"bad.{suffix}", content))


@pytest.mark.parametrize("index", [7, -1])
def test_ply_index_out_of_range(tmp_path, index):
    text = (
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        f"0 0 0\n1 0 0\n0 1 0\n3 0 1 {index}\n"
    )
    message = failure(file(tmp_path, "index.ply", text))
    assert str(index) in message
    load_mesh(file(tmp_path, "fine.ply", text.replace(str(f"1 {index}\n"), "1 2\n")))


def test_ply_with_quads_and_triangles(tmp_path):
    text = (
        "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
        "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n4 0 1 2 3\n3 1 4 2\n"
    )
    mesh, _ = load_mesh(file(tmp_path, "quads.ply", text))
    assert len(mesh.faces) == 3
    assert np.array_equal(mesh.triangle_normals, np.tile([0, 0, 1], (3, 1)))


@pytest.mark.parametrize("kind", ["obj", "glb", "stl", "stl_ascii", "ply", "ply_ascii"])
def test_flipped_bytes_give_a_sound_mesh_or_one_clear_error(tmp_path, kind, caplog, capsys):
    shape, generator = make("box"), np.random.default_rng(5)
    suffix, _, text = kind.partition("_")
    options = {"encoding": text or "binary"} if suffix == "ply" else {}
    whole = as_trimesh(shape).export(file_type=suffix if options else kind, **options)
    whole = np.frombuffer(whole.encode() if isinstance(whole, str) else whole, np.uint8)
    for _ in range(60):
        broken = whole.copy()
        places = generator.integers(0, len(whole), generator.integers(1, 4))
        broken[places] = generator.integers(0, 256, len(places))
        path = file(tmp_path, f"broken.{suffix}", broken.tobytes())
        try:
            mesh, offset = load_mesh(path)
        except PlaygroundError as error:
            assert str(path) in str(error)
        else:
            arrays = (mesh.positions, mesh.normals, mesh.triangle_normals, offset)
            assert all(np.isfinite(array).all() for array in arrays)
    assert not caplog.records and capsys.readouterr() == ("", "")
