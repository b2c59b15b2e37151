"""A person's mistakes: one clear message, status 2, nothing lost."""

import pytest
from test_cli import SMALL, refused

BAD = {
    "no such setup": (("render", "teapott", "-o", "a.png"), "Did you mean 'teapot'?"),
    "missing file": (("render", "nothing.toml", "-o", "a.png"), "there is no file nothing.toml"),
    "missing model": (("render", "nothing.obj", "-o", "a.png"), "nothing.obj"),
    "unknown kind": (("render", "a.xyz", "-o", "a.png"), ".toml"),
    "unknown format": (("render", "sphere", "-o", "a.gif"), ".exr, .npy, .png"),
    "no folder": (("render", "sphere", "-o", "none/a.png", *SMALL), "Make the folder"),
    "zero size": (("render", "sphere", "-o", "a.png", "--size", "0x10"), "1 to 32768"),
    "odd size": (("render", "sphere", "-o", "a.png", "--size", "ten"), "WxH"),
    "huge size": (("render", "sphere", "-o", "a.png", "--size", "99999x2"), "1 to 32768"),
    "unknown renderer": (("render", "sphere", "-o", "a.png", "--renderer", "cuda"), "auto, embree, gl, numpy"),
    "unknown shading": (("render", "sphere", "-o", "a.png", "--shading", "flatt"), "Did you mean 'flat'?"),
    "unknown term": (("render", "sphere", "-o", "a.png", "--terms", "diffuse,glow"), "ambient, diffuse"),
    "shininess range": (("render", "sphere", "-o", "a.png", "--shininess", "-1"), "0 to 1e+06"),
    "shininess text": (("render", "sphere", "-o", "a.png", "--shininess", "big"), "got 'big'"),
    "unknown key": (("render", "sphere", "-o", "a.png", "--set", "shinines=1"), "Did you mean 'shininess'?"),
    "no value": (("render", "sphere", "-o", "a.png", "--set", "shininess"), "key=value"),
    "no such light": (("render", "sphere", "-o", "a.png", "--set", "light.3.diffuse=1,1,1"), "0 to 0"),
    "bad light": (("render", "sphere", "-o", "a.png", "--light", "laser"), "directional, point, polygon, rectangle, spot"),
    "bad cone": (("render", "sphere", "-o", "a.png", "--light", "spot inner_angle=40 outer_angle=30"),
                 "Swap them"),
    "unknown method": (("render", "sphere", "-o", "a.png", "--method", "photons"), "radiosity, raster"),
    "no lightmap": (("render", "sphere", "-o", "a.png", "--method", "lightmap"), "playground bake"),
    "no light": (("render", "sphere", "-o", "a.png", "--method", "radiosity", "--light", "point diffuse=0,0,0"),
                 "nothing in the scene sends out light"),
    "unknown sheet": (("render", "sphere", "-o", "a.png", "--sheet", "all"), "shading, shininess, terms"),
    "pixel outside": (("explain", "sphere", "--pixel", "640", "0"), "x from 0 to 639"),
    "sizes differ": (("compare", "one.png", "two.png"), "one.png"),
    "no command": (("rendr", "x", "-o", "a.png"), "unrecognized"),
    "unknown experiment": (("measure", "warp"), "frames"),
    "endless name": (("render", "a" * 300, "-o", "a.png"), "unknown setup"),
    "endless output": (("render", "sphere", "-o", "a" * 300 + ".png", *SMALL), "name too long"),
    "no digit": (("render", "sphere", "-o", "a.png", "--set", "light.².diffuse=1,0,0"), "0 to 0"),
    "endless digits": (("render", "sphere", "-o", "a.png", "--set", "light." + "1" * 5000 + ".diffuse=1,0,0"), "0 to 0"),
    "no digit in the size": (("render", "sphere", "-o", "a.png", "--size", "²x5"), "'²x5' is no size"),
    "tolerance nan": (("compare", "sphere", "sphere", "--tolerance", "nan"), "'nan' is no tolerance"),
    "tolerance below 0": (("compare", "sphere", "sphere", "--tolerance=-1"), "'-1' is no tolerance"),
    "difference format": (("compare", "sphere", "sphere", "-o", "d.gif"), ".exr, .npy, .png"),
    "unbuilt method of a sheet": (("render", "sphere", "-o", "a.png", "--sheet", "terms", "--method", "ray-tracing"),
                                  "drawn by --method raster"),
    "depth below 0": (("render", "sphere", "-o", "a.png", "--method", "ray-tracing", "--depth", "-2"), "0 to 100"),
    "index of nothing": (("render", "sphere", "-o", "a.png", "--set", "index=0"), "0.01 to 100"),
    "light from nowhere": (("render", "sphere", "-o", "a.png", "--set", "reflectance=1,2,1"),
                           "would create light in green"),
    "all objects": (("render", "sphere", "-o", "a.png", "--set", "objects=1"), "Write object.0.mesh=box"),
    "all lights": (("render", "sphere", "-o", "a.png", "--set", "lights=1"), "Write light.0.diffuse=1,0,0"),
    "whole camera": (("render", "sphere", "-o", "a.png", "--set", "camera=1"), "Write camera.eye=0,0,4"),
    "name of a setup": (("render", "sphere", "-o", "a.png", "--set", "name=1"), "unknown quantity; got 'name'"),
    "folder that takes no files": (("render", "sphere", "-o", "/proc/a.png", *SMALL), "takes no files"),
    "program name": (("render", "sphere"), "playground render: error: the following arguments are required"),
}  # fmt: skip


@pytest.mark.parametrize("case", BAD)
def test_a_mistake_gets_one_message(tmp_path, case):
    arguments, words = BAD[case]
    message = refused(*arguments, cwd=tmp_path)
    assert words in message
    assert list(tmp_path.iterdir()) == []


BAD_SETUPS = {
    "not TOML": ("[scene\n", "line 1"),
    "unknown section": ("[scen]\n", "Did you mean 'scene'?"),
    "unknown key": ("[camera]\nfow = 3\n", "Did you mean 'fov'?"),
    "wrong type": ("[camera]\nfov = 'wide'\n", "camera.fov"),
    "out of range": ("[camera]\nfov = 500\n", "0.01 to 170 degrees"),
    "two numbers": ("[[light]]\nto_light = [1, 2]\n", "light[0].to_light"),
    "not finite": ("[[light]]\nto_light = [1, 2, nan]\n", "light[0].to_light"),
    "no direction": ("[[light]]\nto_light = [0, 0, 0]\n", "no direction"),
    "single bracket": ("[light]\ntype = 'point'\n", "[[light]]"),
    "unknown mesh": ("[[object]]\nmesh = 'spere'\n", "Did you mean 'sphere'?"),
    "missing mesh file": ("[[object]]\nmesh = 'no.obj'\n", "no.obj"),
    "missing texture": ("[[object]]\nmesh='box'\nmaterial = {texture = 'no.png'}\n", "no.png"),
    "huge tessellation": ("[[object]]\nmesh='teapot'\ntessellation=4000\n", "64"),
    "eye at target": ("[camera]\neye = [0, 0, 0]\n", "same point"),
    "list as a type": ("[[light]]\ntype = ['a']\n", "light[0].type"),
    "table as a type": ("[[light]]\ntype = {}\n", "directional, point, polygon, rectangle, spot"),
    "nested without end": ("a = " + "[" * 100_000, "too many brackets"),
    "endless digits": ("a = " + "1" * 5000, "too many digits"),
    "endless hexadecimal": ("[camera]\nfov = 0x" + "f" * 6000, "camera.fov"),
    "null in a mesh": ('[[object]]\nmesh = "a\\u0000.obj"\n', r"'a\x00.obj'"),
    "null in a texture": ('[[object]]\nmaterial = {texture = "a\\u0000.png"}\n', r"'a\x00.png'"),
    "text for a number": ("[camera]\nfov = '40'\n", "got '40'"),
    "our texture in another folder": (
        "[[object]]\nmaterial = {texture = 'gone/tiles.png'}\n",
        "gone/tiles.png",
    ),
}


@pytest.mark.parametrize("case", BAD_SETUPS)
def test_a_bad_setup_file_is_told_where(tmp_path, case):
    text, words = BAD_SETUPS[case]
    (tmp_path / "s.toml").write_text(text)
    (tmp_path / "a.png").write_bytes(b"precious")
    message = refused("render", "s.toml", "-o", "a.png", *SMALL, cwd=tmp_path)
    assert words in message
    assert (tmp_path / "a.png").read_bytes() == b"precious"


BAD_MODELS = {
    "index.obj": ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "9"),
    "nan.obj": ("v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "nan"),
    "empty.obj": ("", "empty.obj"),
    "points.obj": ("v 0 0 0\nv 1 0 0\n", "points.obj"),
    "flat.obj": ("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "area"),
    "short.ply": ("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n", "short.ply"),
    "short.glb": ("glTF", "short.glb"),
    "cut.png": ("\x89PNG\r\n", "cut.png"),
    "text.png": ("hello", "another kind of file"),
    "cut.stl": ("\x07" * 80 + "d\0\0\0" + "\x01" * 700, "784 bytes where the header promises 5084"),
    "broken.gltf": ('{"asset":', "not valid JSON"),
    "huge.obj": ("v 0 0 0\nv 1e38 0 0\nv 0 1 0\nf 1 2 3\n", "a coordinate of 1e+38"),
    "endless.obj": ("v 0 0 0\nv 1e300 0 0\nv 0 1 0\nf 1 2 3\n", "a coordinate of 1e+300"),
}


@pytest.mark.parametrize("name", BAD_MODELS)
def test_a_bad_model_or_picture_is_told(tmp_path, name):
    text, words = BAD_MODELS[name]
    (tmp_path / name).write_bytes(text.encode("latin-1"))
    message = refused("render", name, "-o", "a.png", *SMALL, cwd=tmp_path)
    assert words in message
    assert not (tmp_path / "a.png").exists()
