"""The command where the machine, or what lies on it, is not as one would wish."""

import os
import signal
import subprocess
import sys

import numpy as np
import pytest
from test_cli import SMALL, ok, refused

import playground as pg
from playground import cli, commands
from playground.render.image_file import read_image

posix = pytest.mark.skipif(os.name != "posix", reason="a matter of POSIX systems")


# Pictures whose setup cannot be understood

DAMAGED = {
    "list": "[]",
    "number": "5",
    "cut": "{",
    "deep": "[" * 100_000,
    "digits": "1" * 5000,
    "section": '{"scen": {}}',
    "null": r'{"object": [{"mesh": "a\u0000.obj"}]}',
}


def picture_with(text, file):
    from PIL import Image
    from PIL.PngImagePlugin import PngInfo

    info = PngInfo()
    info.add_itxt("playground-setup", text)
    Image.new("RGB", (16, 12), (255, 0, 0)).save(file, pnginfo=info)


@pytest.mark.parametrize("case", DAMAGED)
def test_a_damaged_setup_in_a_picture(tmp_path, case):
    file = tmp_path / "a.png"
    picture_with(DAMAGED[case], file)
    image = read_image(file)
    assert image.setup is None
    assert pg.compare(image, image).max == 0
    with pytest.raises(pg.PlaygroundError, match=r"a\.png: the setup inside the picture is dam"):
        pg.load(file)


def test_the_command_compares_a_picture_with_a_damaged_setup(tmp_path):
    picture_with("[]", tmp_path / "a.png")
    ok("compare", tmp_path / "a.png", tmp_path / "a.png", "--tolerance", "0")
    assert "damaged" in refused("render", tmp_path / "a.png", "-o", tmp_path / "b.png")
    assert not (tmp_path / "b.png").exists()


NO_PICTURES = {
    "text": (np.full((4, 4, 3), "x"), "values of type <U1"),
    "complex": (np.ones((4, 4, 3), complex), "complex128"),
    "dates": (np.zeros((4, 4, 3), "M8[s]"), "datetime64"),
    "records": (np.zeros((4, 4, 3), [("a", "f4")]), "real numbers"),
    "too large": (np.full((4, 4, 3), 1e300), r"the pixel \(0, 0\) is not finite"),
    "nan": (np.full((4, 4, 3), np.nan, np.float32), "not finite"),
}


@pytest.mark.parametrize("case", NO_PICTURES)
def test_arrays_that_are_no_picture(tmp_path, case):
    values, words = NO_PICTURES[case]
    np.save(tmp_path / "a.npy", values)
    with pytest.raises(pg.PlaygroundError, match=words):
        read_image(tmp_path / "a.npy")


@pytest.mark.parametrize("dtype", [np.uint8, np.int64, np.float16, np.float64, np.longdouble])
def test_arrays_of_any_real_numbers_are_pictures(tmp_path, dtype):
    np.save(tmp_path / "a.npy", np.ones((2, 3, 4), dtype))
    image = read_image(tmp_path / "a.npy")
    assert image.pixels.dtype == np.float32 and image.size == (3, 2)


# Where the output goes


def test_no_name_of_a_file(tmp_path):
    image = read_image(_some_picture(tmp_path))
    with pytest.raises(pg.PlaygroundError, match="cannot be the name of a file"):
        image.save(tmp_path / "a\0.png")
    for name in ("a\0b.toml", "a\0b.obj", "a\0b.png"):
        with pytest.raises(pg.PlaygroundError, match="cannot be the name of a file"):
            pg.load(name)


def _some_picture(folder):
    np.save(folder / "some.npy", np.zeros((2, 2, 3), np.float32))
    return folder / "some.npy"


def test_a_link_stays_a_link(tmp_path):
    real, link = tmp_path / "real.png", tmp_path / "link.png"
    real.write_bytes(b"old")
    link.symlink_to("real.png")
    ok("render", "sphere", "-o", link, *SMALL)
    assert link.is_symlink()
    assert real.read_bytes()[:4] == b"\x89PNG"


def test_a_folder_of_tables_that_is_a_file(tmp_path):
    (tmp_path / "file").write_text("precious")
    assert "a file of that name" in refused("measure", "-o", tmp_path / "file", "frames")
    assert (tmp_path / "file").read_text() == "precious"


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no /dev/full here")
def test_a_full_disk():
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [sys.executable, "-m", "playground", "explain", "sphere", "--pixel", "32", "24"],
            stdout=full, stderr=subprocess.PIPE, text=True, check=False,
        )  # fmt: skip
    assert done.returncode == 2
    assert "No space left" in done.stderr
    assert "Traceback" not in done.stderr and "Exception" not in done.stderr


def test_a_terminal_without_greek_letters():
    poor = {"LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0"}
    done = ok("explain", "teapot", "--pixel", 320, 200, env=poor)
    assert "shininess" in done.stdout or "specular" in done.stdout


def test_a_picture_too_large_for_the_memory(monkeypatch, capsys):
    def exhausted(options):
        raise MemoryError("Unable to allocate 12.0 GiB")

    monkeypatch.setattr(commands, "doctor", exhausted)
    assert cli.main(["doctor"]) == 2
    error = capsys.readouterr().err
    assert "too large for this machine's memory" in error and "--size" in error


@posix
@pytest.mark.parametrize(
    "raised", ["KeyboardInterrupt", "ImportError('PyCapsule_Import could not import')"]
)
def test_ctrl_c_while_libraries_load(raised):
    """A signal during an import, and what NumPy makes of it."""
    code = (
        "import os, signal, sys\n"
        "class Slow:\n"
        "    def find_spec(self, name, *more):\n"
        "        if name == 'playground.cli':\n"
        "            try:\n"
        "                os.kill(os.getpid(), signal.SIGINT)\n"
        "            except KeyboardInterrupt:\n"
        f"                raise {raised}\n"
        "import playground.__main__ as command\n"
        "sys.meta_path.insert(0, Slow())\n"
        "sys.exit(command.main())\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 128 + signal.SIGINT
    assert done.stderr == "playground: stopped\n"


# Files that change, and folders that one leaves

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


def test_a_model_that_was_written_anew_is_read_anew(tmp_path):
    file = tmp_path / "st.obj"
    file.write_text(TRIANGLE)
    before = pg.load(file)
    file.write_text(TRIANGLE + "v 1 1 0\nf 2 4 3\n")
    after = pg.load(file)
    assert len(after.scene.objects[0].geometry().mesh.faces) == 2
    assert len(before.scene.objects[0].geometry().mesh.faces) == 1, "a setup never changes"


def test_a_relative_name_means_the_folder_one_is_in(tmp_path, monkeypatch):
    for folder, text in (("one", TRIANGLE), ("two", TRIANGLE + "v 1 1 0\nf 2 4 3\n")):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "st.obj").write_text(text)
    counts = []
    for folder in ("one", "two"):
        monkeypatch.chdir(tmp_path / folder)
        counts.append(len(pg.Object("st.obj").geometry().mesh.faces))
    assert counts == [1, 2]


def test_a_texture_that_was_painted_anew_is_read_anew(tmp_path):
    from PIL import Image

    from playground.render.texels import load_texture

    for second, colour in enumerate(((255, 0, 0), (0, 255, 0))):
        Image.new("RGB", (2, 2), colour).save(tmp_path / "t.png")
        os.utime(tmp_path / "t.png", (second, second))  # some clocks of files go in steps of 10 ms
        texels = load_texture(str(tmp_path / "t.png"))
        assert (texels[0, 0] * 255).tolist() == list(colour)


def test_a_picture_of_a_model_renders_in_another_folder(tmp_path):
    (tmp_path / "sub").mkdir()
    (tmp_path / "st.obj").write_text(TRIANGLE)
    ok("render", "st.obj", "-o", "q.png", *SMALL, cwd=tmp_path)
    ok("render", "../q.png", "-o", "q2.png", *SMALL, cwd=tmp_path / "sub")
    one, other = tmp_path / "q.png", tmp_path / "sub" / "q2.png"
    np.testing.assert_array_equal(read_image(one).pixels, read_image(other).pixels)
    # Each names the model as it is found from its own folder: st.obj, and its whole path.
    assert pg.load(one) == pg.load(other).with_(name=pg.load(one).name)


def test_names_of_files_in_a_saved_setup(tmp_path, monkeypatch):
    """Relative where the file lies in the folder, bare where it is ours, else absolute."""
    from PIL import Image

    (tmp_path / "here").mkdir()
    (tmp_path / "st.obj").write_text(TRIANGLE + "vt 0 0\nf 1/1 2/1 3/1\n")
    Image.new("RGB", (2, 2)).save(tmp_path / "here" / "own.png")
    monkeypatch.chdir(tmp_path)
    textures = ("tiles.png", "here/own.png")
    objects = [pg.Object("st.obj", material=pg.Material(texture=name)) for name in textures]
    pg.save(pg.Setup(pg.Scene(objects=objects)), "here/s.toml")
    text = (tmp_path / "here" / "s.toml").read_text()
    assert 'texture = "tiles.png"' in text
    assert 'texture = "own.png"' in text
    assert f'mesh = "{(tmp_path / "st.obj").as_posix()}"' in text
    pg.render(pg.load("here/s.toml"), (16, 12), "numpy")


def test_only_a_bare_name_is_one_of_our_textures(tmp_path):
    from playground.render.texels import load_texture

    assert load_texture("tiles.png").ndim == 3
    with pytest.raises(pg.PlaygroundError, match=r"there is no file gone.tiles\.png"):
        load_texture("gone/tiles.png")


def test_a_texture_needs_texture_coordinates():
    from playground.render.texels import check_texcoords

    mesh = pg.Mesh.create([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], name="plate")
    item = pg.Object(arrays=mesh, material=pg.Material(texture="tiles.png"))
    with pytest.raises(pg.PlaygroundError, match=r"'plate' has no texture coordinates.*Remove"):
        check_texcoords(item, mesh)
    check_texcoords(pg.Object(arrays=mesh), mesh)


@pytest.mark.gl
def test_fewer_samples_than_asked_for_are_told(gl, tmp_path):
    file = tmp_path / "a.png"
    done = ok("render", "sphere", "-o", file, "--size", "32x24", "--set", "samples=16")
    assert ("samples per pixel, not 16" in done.stderr) == (gl.max_samples < 16)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="names of Linux libraries")
def test_a_machine_without_gl_libraries(tmp_path):
    """The loader looks for libraries that are not there, as on a bare machine."""
    bare = {"GLCONTEXT_LINUX_LIBGL": "none.so", "GLCONTEXT_LINUX_LIBEGL": "none.so", "DISPLAY": ""}
    done = ok("render", "sphere", "-o", tmp_path / "a.png", "--size", "32x24", env=bare)
    assert "numpy" in done.stderr
    assert "apt-get install" in done.stderr
    asked = ("render", "sphere", "-o", tmp_path / "b.png", "--renderer", "gl")
    assert "no GL driver" in refused(*asked, env=bare)
    assert not (tmp_path / "b.png").exists()
