"""The real command, in a process of its own, as a person or a script would run it."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest

import playground as pg


def run(*arguments, cwd=None, env=None):
    return subprocess.run(
        [sys.executable, "-m", "playground", *map(str, arguments)],
        capture_output=True, text=True, cwd=cwd, timeout=300, check=False,
        env={**os.environ, "PYTHONPATH": str(pg.__path__[0] + "/.."), **(env or {})},
    )  # fmt: skip


def ok(*arguments, **more):
    done = run(*arguments, **more)
    assert done.returncode == 0, done.stderr
    return done


def refused(*arguments, **more):
    """The message of a mistake: status 2, one message, no traceback, nothing on stdout."""
    done = run(*arguments, **more)
    assert done.returncode == 2, done.stderr
    assert "Traceback" not in done.stderr
    assert done.stdout == ""
    return done.stderr


SMALL = ("--size", "64x48", "--renderer", "numpy")


@pytest.mark.parametrize("suffix", ["png", "npy", "exr"])
def test_render_writes_each_format(tmp_path, suffix):
    file = tmp_path / f"a.{suffix}"
    ok("render", "sphere", "-o", file, *SMALL)
    from playground.render.image_file import read_image

    image = read_image(file)
    want = pg.render(pg.load("sphere"), (64, 48), "numpy")
    tolerance = 0.5 / 255 + 1e-6 if suffix == "png" else 0
    assert (
        np.abs(np.clip(want.pixels, 0, 1 if suffix == "png" else 9) - image.pixels).max()
        <= tolerance
    )


@pytest.mark.gl
def test_render_takes_gl_where_it_is(gl, tmp_path):
    done = ok("render", "sphere", "-o", tmp_path / "a.png", "--size", "64x48")
    assert done.stderr.strip().endswith("gl")


def without_gl(*arguments):
    """The command on a machine without a driver."""
    code = (
        "import playground.render.gl.context as c\n"
        "def none(): raise c.NoDriverError('no GL driver was found', fix=c.INSTALL_DRIVER)\n"
        "c.headless = none\n"
        "from playground.cli import main\n"
        f"raise SystemExit(main({list(map(str, arguments))!r}))"
    )
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)


@pytest.mark.parametrize(
    "arguments",
    [
        ("render", "sphere", "-o", "OUT", "--size", "32x24"),
        ("render", "sphere", "--sheet", "shininess", "-o", "OUT", "--size", "32x24"),
        ("compare", "sphere", "yellow", "-o", "OUT", "--size", "32x24"),
    ],
    ids=["picture", "sheet", "compare"],
)
def test_pictures_fall_back_to_numpy_without_gl(tmp_path, arguments):
    file = tmp_path / "a.png"
    done = without_gl(*[file if word == "OUT" else word for word in arguments])
    assert done.returncode == 0, done.stderr
    assert "  numpy" in done.stderr
    assert "apt-get install" in done.stderr
    assert file.stat().st_size > 100


def test_measuring_without_gl():
    frames = without_gl("measure", "frames")
    assert frames.returncode == 2
    assert "no GL driver was found" in frames.stderr and "apt-get install" in frames.stderr
    assert frames.stdout == ""
    first = json.loads(without_gl("measure", "first-image", "--rounds", "1", "--json").stdout)
    assert first["machine"]["gl"] is None
    assert "playground render sphere" in [row["command"] for row in first["first-image"]]


def test_a_picture_renders_again(tmp_path):
    first, second = tmp_path / "a.png", tmp_path / "b.png"
    ok("render", "teapot", "-o", first, "--shading", "flat", "--shininess", "80",
       "--set", "camera.fov=50", "--light", "point position=1,2,3 diffuse=1,0.5,0.25", *SMALL)  # fmt: skip
    ok("render", first, "-o", second, *SMALL)
    done = ok("compare", first, second, "--json")
    assert json.loads(done.stdout)["max"] == 0
    setup = pg.load(first)
    assert setup.settings.shading == "flat"
    assert setup.camera.fov == 50
    assert setup.scene.lights == (pg.PointLight(position=(1, 2, 3), diffuse=(1, 0.5, 0.25)),)


@pytest.mark.parametrize("sheet", ["terms", "shininess", "shading"])
def test_sheets(tmp_path, sheet):
    file = tmp_path / "s.png"
    ok("render", "yellow", "--sheet", sheet, "-o", file, "--size", "60x45", "--renderer", "numpy")
    from PIL import Image

    with Image.open(file) as picture:
        assert picture.width > 4 * 60


@pytest.mark.parametrize(("sheet", "option"), [("terms", "terms"), ("shininess", "shininess")])
def test_a_sheet_says_what_it_does_not_heed(tmp_path, sheet, option):
    done = ok("render", "sphere", "--sheet", sheet, "-o", tmp_path / "s.png", f"--{option}",
              {"terms": "diffuse", "shininess": "3"}[option], *SMALL)  # fmt: skip
    assert f"--{option} has no effect" in done.stderr
    assert (
        "no effect"
        not in ok("render", "sphere", "--sheet", sheet, "-o", tmp_path / "s.png", *SMALL).stderr
    )


def test_a_sheet_whose_sum_is_wrong_ends_with_status_1(tmp_path, monkeypatch, capsys):
    from playground.cli import main
    from playground.explain import sheet

    monkeypatch.setattr(sheet, "_sum_error", lambda *_: 0.002)
    file = tmp_path / "s.png"
    assert main(["render", "sphere", "--sheet", "terms", "-o", str(file), *SMALL]) == 1
    assert "check failed" in capsys.readouterr().err
    assert file.exists()


def test_compare_reports_five_numbers(tmp_path):
    done = ok("compare", "sphere", "red-on-blue", "--json", "-o", tmp_path / "d.png", *SMALL)
    numbers = json.loads(done.stdout)
    assert set(numbers) == {"rmse", "max", "psnr", "ssim", "flip"}
    assert 0 < numbers["rmse"] < numbers["max"]
    assert (tmp_path / "d.png").exists()


def test_compare_fails_with_status_1(tmp_path):
    assert run("compare", "sphere", "yellow", "--tolerance", "0.01", *SMALL).returncode == 1
    assert run("compare", "sphere", "sphere", "--tolerance", "0", *SMALL).returncode == 0


def test_explain_prints_the_equation():
    done = ok("explain", "teapot", "--pixel", 320, 200)
    for words in ("max(n·l, 0) s_d ⊗ m_d", "max(r·v, 0)^40", "s_a ⊗ m_a", "m_e", "clamped", "ρ ="):
        assert words in done.stdout
    vertex = ok("explain", "teapot", "--pixel", 320, 200, "--shading", "per-vertex")
    for words in ("vertex A", "vertex C", "weight", "mix"):
        assert words in vertex.stdout


def test_explain_json_agrees_with_the_picture():
    done = ok("explain", "teapot", "--pixel", 32, 30, "--json", "--size", "64x48")
    why = json.loads(done.stdout)
    image = pg.render(pg.load("teapot"), (64, 48), "numpy")
    assert np.allclose(why["colour"], image.pixels[30, 32], atol=1e-6)
    total = np.sum(
        [why["terms"][t] for t in ("diffuse", "specular", "ambient", "emissive")], axis=0
    )
    assert np.allclose(total, why["colour"], atol=1e-12)


def test_doctor_and_version():
    assert "Python" in ok("doctor").stdout
    found = json.loads(ok("doctor", "--json").stdout)
    assert set(found) == {"python", "packages", "gl", "display", "window"}
    assert ok("--version").stdout.startswith("playground ")


def test_a_model_file_gets_a_sensible_view(tmp_path):
    """A small model away from the origin fills a good part of the picture, lit."""
    import trimesh

    ball = trimesh.creation.icosphere(3, radius=1e-2)
    ball.apply_translation([100, -200, 50])
    ball.export(tmp_path / "ball.ply")
    image = pg.render(pg.load(tmp_path / "ball.ply"), (80, 60), "numpy")
    assert 0.2 < image.coverage.mean() < 0.8
    assert 0.3 < image.pixels.max() <= 2


def test_ray_tracing_from_the_command_line(tmp_path):
    """Depth and samples reach the picture, and what the cut-off left out is told."""
    file = tmp_path / "a.npy"
    traced = ("--method", "ray-tracing", "--depth", "2", "--samples", "4")
    done = ok("render", "whitted-room", "-o", file, *SMALL, *traced)
    setup = pg.load("whitted-room").with_(depth=2, samples=4)
    image = pg.render(setup, (64, 48), "numpy", method="ray-tracing")
    assert np.array_equal(np.load(file), image.pixels)
    assert image.left_out.max > 0.0 and str(image.left_out) in done.stderr
    assert "GL driver" not in done.stderr


def test_ray_tracing_says_what_the_picture_will_show(tmp_path):
    glass = ("--method", "ray-tracing", "--set", "transmittance=1,1,1", "--shading", "flat")
    done = ok("render", "teapot", "-o", tmp_path / "a.png", "--size", "16x12", *glass)
    assert "open glass: object 0 (teapot)" in done.stderr
    assert "shading: flat is ignored" in done.stderr
