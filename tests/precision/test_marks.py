"""Marks: what a picture would hide shows in false colours, the same on GPU and CPU."""

import numpy as np
import pytest

import playground as pg
from playground.cli import main
from playground.render.gl import probe
from playground.render.image import Image
from playground.scene.settings import MARKS
from playground.shading.marks import COLOURS, KINDS, MEANING, kinds_of, marked

SIZE = (160, 120)
SMALLEST = 2.0**-14  # of float16
ALL = (1 << len(KINDS)) - 1


def codes_of(setup, renderer):
    codes = np.empty((SIZE[1], SIZE[0], 4), np.uint8)
    with pg.open_renderer(SIZE, renderer) as opened:
        opened.render(setup, out=codes)
    return codes[..., :3]


def mark_shown(codes):
    """The number of the mark that each pixel shows, -1 for none."""
    same = (codes[..., None, :] == COLOURS).all(axis=-1)
    return np.where(same.any(axis=-1), np.argmax(same, axis=-1), -1)


def broken():
    """A setup whose float16 picture holds NaN, infinite, denormal and clamped numbers.

    In a row, balls that send out 1e5, which is infinite, 2e-5, which is denormal, 3 and 0.5.
    Above them one in an infinite light, which is NaN where its share is 0.
    """
    dark = {"diffuse": (0, 0, 0), "specular": (0, 0, 0), "ambient": (0, 0, 0)}
    objects = tuple(
        pg.Object(
            "sphere",
            transform=pg.Transform(translate=(1.2 * i - 1.8, 0, 0), size=0.5),
            material=pg.Material(emissive=(amount, amount, amount), **dark),
        )
        for i, amount in enumerate((1e5, 2e-5, 3.0, 0.5))
    )
    nan = pg.Object(
        "sphere",
        transform=pg.Transform(translate=(0, 1.3, 0), size=0.5),
        material=pg.Material(diffuse=(1, 1, 1), specular=(0, 0, 0), ambient=(0, 0, 0)),
    )
    light = pg.DirectionalLight(to_light=(1, 0, 0), diffuse=(1e5, 1e5, 1e5), ambient=(0, 0, 0))
    scene = pg.Scene(objects=(*objects, nan), lights=(light,))
    return pg.Setup(scene, pg.Camera(eye=(0, 0.4, 6))).with_(precision="float16", marks=MARKS)


def test_the_names_are_the_same_everywhere():
    assert MARKS == KINDS == tuple(MEANING)
    assert len(COLOURS) == len(KINDS)


def test_which_kind_shows():
    nan, inf = np.nan, np.inf
    colours = [(nan, 2, 0), (-inf, 0, 0), (-1, 2, 0), (1e-6, 2, 0), (0, 0.6, 0), (0, 0.5, 1e-3)]
    found = kinds_of(colours, 2.0, SMALLEST)
    assert [np.flatnonzero(row).tolist() for row in found] == [
        [0, 4],
        [1, 2],
        [2, 4],
        [3, 4],
        [4],
        [],
    ]
    shown = marked(np.full((6, 3), 0.25), colours, 2.0, SMALLEST, ALL)
    assert np.array_equal(shown[:5], COLOURS / 255.0)
    assert np.array_equal(shown[5], (0.25, 0.25, 0.25))
    only = marked(np.full((6, 3), 0.25), colours, 2.0, SMALLEST, 1 << KINDS.index("clamped"))
    assert np.array_equal(only[0], COLOURS[4] / 255.0)
    assert np.array_equal(only[1], (0.25, 0.25, 0.25))


@pytest.mark.gl
@pytest.mark.parametrize("wanted", [ALL, 1, 16, 0b01010, 0])
def test_marks_on_the_gpu(gl, rng, wanted):
    special = np.array([0.0, -0.0, np.nan, np.inf, -np.inf, -0.5, 1e-6, -1e-6, 0.4, 0.5, 0.6, 7.0])
    colours = np.concatenate([rng.choice(special, (2000, 3)), rng.normal(size=(500, 3))])
    colours = colours.astype(np.float32)
    shown = np.full((len(colours), 3), 0.25, np.float32)
    got = probe.call("marks", "marked", shown, colours, 2.0, SMALLEST, constant=wanted)
    want = marked(shown, colours, 2.0, SMALLEST, wanted)
    assert np.abs(got - want).max() <= 2.0**-23  # a code over 255: one division


@pytest.mark.gl
@pytest.mark.parametrize("shading", ["flat", "per-vertex", "per-fragment"])
def test_a_broken_scene_shows_all_of_it(gl, shading):
    setup = broken().with_(shading=shading)
    ours, theirs = mark_shown(codes_of(setup, "gl")), mark_shown(codes_of(setup, "numpy"))
    if shading == "per-vertex":  # ∞ interpolated is ∞ or NaN, as the rasteriser subtracts
        ours, theirs = np.where(ours == 1, 0, ours), np.where(theirs == 1, 0, theirs)
    # They may differ at silhouettes alone, which round otherwise: see tests/oracle.
    assert (ours == theirs).mean() >= 0.995
    kinds = ("nan", "infinite", "denormal", "clamped")
    for kind in kinds[:1] + kinds[2:] if shading == "per-vertex" else kinds:
        assert (ours == KINDS.index(kind)).sum() > 50, kind
    counts = pg.render(setup, SIZE, "gl").marks()
    if shading != "per-vertex":
        assert counts["nan"] == (ours == 0).sum()
    assert counts["denormal"] == (ours == KINDS.index("denormal")).sum()


@pytest.mark.gl
@pytest.mark.parametrize("change", [{}, {"curve": "srgb"}, {"exposure": 3.0}, {"clamp": False}])
def test_negative_light_and_the_steps_of_the_display(gl, change):
    """The GPU marks while it draws; the CPU marks the picture of floats: the same pixels."""
    setup = pg.load("teapot").with_(bugs=("missing-max",), marks=MARKS, terms=("diffuse",))
    setup = setup.with_(**change)
    drawn = codes_of(setup, "gl")
    image = pg.render(setup, SIZE, "gl")
    assert np.array_equal(mark_shown(drawn), mark_shown(image.codes()))
    assert (mark_shown(drawn) == KINDS.index("negative")).sum() > 50


@pytest.mark.parametrize("renderer", ["numpy", pytest.param("gl", marks=pytest.mark.gl)])
def test_nan_is_never_black(renderer, request):
    if renderer == "gl":
        request.getfixturevalue("gl")
    setup = broken()
    nan = np.isnan(pg.render(setup, SIZE, renderer).pixels).any(axis=-1)
    assert nan.sum() > 50
    codes = codes_of(setup, renderer)
    assert (codes[nan] == COLOURS[0]).all()
    plain = Image(np.full((1, 1, 3), np.nan, np.float32), setup=setup.with_(marks=()))
    assert not plain.codes().any()  # what a screen makes of it, and no warning


def test_the_background_is_marked_too(gl):
    setup = pg.load("sphere").with_(background=(2.0, 0.0, 0.0), marks=("clamped",))
    for renderer in ("gl", "numpy"):
        assert (codes_of(setup, renderer)[0, 0] == COLOURS[4]).all()


def test_from_the_command_line(tmp_path, capsys):
    from PIL import Image as Picture

    out = tmp_path / "out.png"
    arguments = ["render", "sphere", "--precision", "float16", "--marks", "--renderer", "numpy"]
    assert main([*arguments, "--size", "80x60", "-o", str(out)]) == 0
    said = capsys.readouterr().err
    expected = pg.load("sphere").with_(precision="float16", marks=MARKS)
    image = pg.render(expected, (80, 60), "numpy")
    assert f"{image.marks()['clamped']} clamped" in said
    assert np.array_equal(np.asarray(Picture.open(out)), image.codes())
    again = pg.load(str(out)).settings  # a picture carries its setup
    assert (again.precision, again.marks) == ("float16", MARKS)
    assert main([*arguments[:2], "--precision", "float8", "-o", str(out)]) == 2
    assert "float16, float32, float64" in capsys.readouterr().err
