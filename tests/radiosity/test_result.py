"""`radiosity` from end to end: a setup in, light and pictures out; nothing computed in vain."""

import json
from dataclasses import replace

import numpy as np
import pytest

import playground as pg
from playground.cli import main
from playground.explain.stored_pixel import explain_stored
from playground.render.gl.stored import GLStored
from playground.render.radiosity import light_source
from playground.render.radiosity.light_source import RadiosityLight
from playground.render.stored_renderer import NumpyStored

SIZE = (48, 36)
FURNACE = np.array([0.1, 0.25, 0.4])  # what its walls emit; E / (1 − ρ) is 0.5


def furnace(**more):
    """96 patches in NumPy: quick, and exact as far as the rows sum to 1."""
    quick = {"patches": 96, "form_factors": "closed-form", "solver": "gauss-seidel"}
    return pg.load("furnace").with_(**{**quick, "convergence": 1e-9, **more})


def room(**more):
    """A closed room with a lamp and a glossy block, few patches."""
    quick = {"patches": 60, "form_factors": "point-to-polygon", "solver": "jacobi"}
    return pg.load("indirect-room").with_(**{**quick, **more})


def prepared(light, setup):
    """How many steps it takes until the light is there."""
    return sum(1 for _ in light.prepare(setup))


@pytest.mark.parametrize("renderer", ["gpu", "embree", None])
def test_a_renderer_that_computes_no_form_factors(renderer):
    with pytest.raises(pg.PlaygroundError, match=r"unknown renderer.*auto, gl, numpy"):
        pg.radiosity(furnace(), renderer)


@pytest.mark.parametrize("solver", ["jacobi", "gauss-seidel", "conjugate-gradients", "direct"])
def test_the_furnace_is_even(solver):
    result = pg.radiosity(furnace(solver=solver), "numpy").solve()
    # The share of the light left is 1e-9; at ρ = 0.8 up to 5 times as much may be missing.
    np.testing.assert_allclose(result.light, 0.5, rtol=5e-9)
    np.testing.assert_allclose(result.direct, np.broadcast_to(FURNACE, result.light.shape))
    np.testing.assert_allclose(result.arriving, 0.5, rtol=3e-8)


def test_shooting_is_as_even_as_the_form_factors_are():
    result = pg.radiosity(furnace(solver="progressive"), "numpy").solve()
    sums = result.form_factors.raw_sums()
    off = np.abs(sums - 1.0).max()
    assert 0.0 < off < 1e-3
    # What a patch gets is a column: corrected by the sum of every other row, not its own.
    # An error of F of that size in each of the reflections, at most 1 / (1 − 0.8) in all.
    assert np.abs(result.light / 0.5 - 1.0).max() <= 5.0 * 2.0 * off


def test_the_picture_of_the_furnace_is_grey_to_a_millionth(gl):
    for renderer in ("numpy", "gl"):
        image = pg.render(furnace(), SIZE, renderer, method="radiosity")
        assert image.coverage.all()
        np.testing.assert_allclose(image.pixels, 0.5, atol=1e-6)
        assert image.warnings == ()


def test_both_renderers_draw_the_same_solution(gl):
    setup = pg.load("cornell-box").with_(patches=200)
    pixels = [pg.render(setup, SIZE, r, method="radiosity").pixels for r in ("numpy", "gl")]
    off = np.abs(pixels[0] - pixels[1]).max(axis=-1)
    # Hemicubes in two rasterisers: an edge of an item buffer may go to the neighbour.
    assert np.quantile(off, 0.9) <= 1.0 / 255.0


def test_nothing_is_computed_before_it_is_asked_for():
    result = pg.radiosity(room(solver="progressive"), "numpy")
    assert not {"patches", "form_factors", "system"} & set(vars(result))
    assert len(result.patches) >= 60
    assert "form_factors" not in vars(result)
    assert result.form_factors.computed == 0
    steps = result.steps()
    next(steps)
    next(steps)
    assert 0 < result.form_factors.computed < len(result.patches)


@pytest.mark.parametrize("solver", ["jacobi", "progressive"])
def test_steps_go_on_where_they_stopped(solver):
    whole, broken = (pg.radiosity(room(solver=solver), "numpy") for _ in range(2))
    shares = []
    while not broken.done:
        for count, _ in enumerate(broken.steps()):
            shares.append(broken.progress)
            if count == 2:
                break
    assert np.array_equal(broken.light, whole.solve().light)
    assert broken.step.done == whole.step.done
    assert 0.0 <= min(shares) <= max(shares) <= broken.progress == 1.0
    assert list(broken.steps()) == []


def test_light_is_what_is_emitted_and_what_arrives_is_reflected():
    result = pg.radiosity(room(convergence=1e-10), "numpy")
    patches = result.patches
    expected = patches.emission + patches.reflectance * result.arriving
    np.testing.assert_allclose(result.light, expected, rtol=1e-12)
    parts = result.direct + result.indirect
    np.testing.assert_allclose(parts, result.arriving, rtol=1e-12)
    # Light reflected once or more is never below what one reflection of the direct light brings.
    once = result.form_factors.gather(patches.reflectance * result.direct)
    assert (result.indirect >= once - 1e-9).all()


def test_a_lamp_is_direct_light():
    """A spot light in an open scene of one surface: all its light is direct."""
    scene = pg.Scene(
        objects=(pg.Object("quad"),), lights=(pg.DirectionalLight(to_light=(0, 1, 0)),)
    )
    result = pg.radiosity(pg.Setup(scene).with_(patches=16, form_factors="closed-form"), "numpy")
    np.testing.assert_allclose(result.arriving, 1.0, rtol=1e-12)
    assert not result.indirect.any()


def test_only_what_counts_starts_a_solution(monkeypatch):
    made = []
    real = light_source.Radiosity
    monkeypatch.setattr(light_source, "Radiosity", lambda *a: made.append(1) or real(*a))
    light, setup = RadiosityLight("numpy"), room()
    assert prepared(light, setup) > 1
    same = (
        setup.with_(eye=(1.0, 1.0, 1.5), fov=50.0),
        setup.with_(exposure=2.0, curve="srgb", samples=4),
        setup.with_(light_shown="indirect", shading="flat"),
        setup.with_(shininess=99.0, specular=(0.1, 0.2, 0.3), highlight="blinn"),
        setup.with_(depth=2, background=(1, 0, 0), specular_weight=0.0, ambient_weight=2.0),
    )
    for other in same:
        assert prepared(light, other) == 0
        light.stored(other)
    assert len(made) == 1
    others = (
        setup.with_(diffuse=(0.1, 0.2, 0.3)),
        setup.with_(emissive=(0.1, 0.0, 0.0)),
        setup.with_(diffuse_weight=0.5),
        setup.with_(patches=30),
        setup.with_(convergence=1e-3),
        setup.with_(occlusion=False),
        setup.with_(lights=(*setup.scene.lights, pg.PointLight())),
        setup.with_(objects=setup.scene.objects[:-1]),
    )
    for count, other in enumerate(others, 2):
        assert prepared(light, other) > 0
        assert len(made) == count


def test_form_factors_are_kept_while_only_colours_change():
    light, setup = RadiosityLight("numpy"), room()
    prepared(light, setup)
    factors = light.result.form_factors
    rows = factors.calls
    prepared(light, setup.with_(diffuse=(0.3, 0.2, 0.1)))
    prepared(light, setup.with_(solver="gauss-seidel"))
    assert light.result.form_factors is factors
    assert factors.calls == rows == len(factors)
    prepared(light, setup.with_(patches=40))
    assert light.result.form_factors is not factors


def test_an_interrupted_solution_is_continued():
    light, setup = RadiosityLight("numpy"), room(solver="progressive")
    steps = light.prepare(setup)
    next(steps)
    steps.close()
    result = light.result
    assert prepared(light, setup) > 0
    assert light.result is result and result.done


@pytest.mark.parametrize("form_factors", ["hemicube", "closed-form"])
def test_what_was_drawn_before_leaves_no_trace_in_a_solution(gl, form_factors):
    """The rasteriser culls and tests depths; form factors on the same GPU must not be."""
    setup = room(form_factors=form_factors)
    first = pg.radiosity(setup, "gl", gl).solve()
    pg.render(pg.load("sphere").with_(samples=4, gate=True), SIZE, "gl")
    again = pg.radiosity(setup, "gl", gl).solve()
    assert first.light.any() and np.array_equal(first.light, again.light)


@pytest.mark.parametrize(
    ("method", "solver", "told"),
    [
        ("hemicube", "southwell", True),
        ("hemicube", "jacobi", False),
        ("closed-form", "southwell", False),
    ],
)
def test_blotches_are_told_of_once(method, solver, told):
    setup = room(patches=24, refinement=2, form_factors=method, solver=solver, hemicube=16)
    result = pg.radiosity(setup.with_(convergence=0.1), "numpy").solve()
    assert result.round == 2
    assert sum("blotches" in text for text in result.warnings) == told


def test_refinement_divides_where_light_changes_and_solves_again():
    setup = room(refinement=1)
    result = pg.radiosity(setup, "numpy")
    coarse = len(result.patches)
    rounds = [(result.round, len(result.patches)) for _ in result.steps()]
    assert {number for _, number in rounds} == {coarse, len(result.patches)}
    assert result.round == 1
    assert coarse < rounds[-1][1] == len(result.patches) == len(result.light)
    assert result.progress == 1.0 and len(result.stored()) == len(setup.scene.objects)
    area = pg.radiosity(setup, "numpy").patches.area.sum()
    np.testing.assert_allclose(result.patches.area.sum(), area, rtol=1e-12)


def test_progress_is_told_while_rows_are_computed():
    result = pg.radiosity(room(), "numpy")
    shares = list(result.solving())
    rows = -(-len(result.patches) // 64)
    assert len(shares) > rows and shares == sorted(shares) and shares[-1] <= 1.0
    assert result.form_factors.calls == len(result.patches)


def test_stopping_writes_nothing(tmp_path, monkeypatch, capsys):
    def stopped(self):
        yield 0.1
        raise KeyboardInterrupt

    monkeypatch.setattr("playground.render.radiosity.result.Radiosity.solving", stopped)
    words = ["render", "furnace", "--method", "radiosity", "-o", str(tmp_path / "a.png")]
    assert main(words) == 130
    assert "stopped" in capsys.readouterr().err and list(tmp_path.iterdir()) == []


def test_the_camera_moves_and_nothing_is_prepared_anew(gl, monkeypatch):

    asked = []
    light, setup = RadiosityLight("auto", gl), room()
    real = light.stored
    monkeypatch.setattr(light, "stored", lambda s: asked.append(1) or real(s))
    with GLStored(SIZE, light, gl) as renderer:
        for x in np.linspace(0.0, 1.0, 5):
            renderer.render(setup.with_(eye=(float(x), 1.0, 1.0)))
    assert len(asked) == 1


@pytest.mark.parametrize("shading", ["per-fragment", "flat"])
@pytest.mark.parametrize("name", ["numpy", "gl"])
def test_direct_and_indirect_light_make_the_whole_picture(name, shading, gl):
    # A lamp and a glowing floor that are seen, highlights, a background: all of them direct.
    setup = room().with_(samples=4, patches=90, shading=shading, background=(0.3, 0.2, 0.1))
    floor = setup.scene.objects[0]
    shiny = replace(floor.material, specular=(0.5,) * 3, emissive=(0.1, 0.0, 0.05))
    objects = (replace(floor, material=shiny), *setup.scene.objects[1:])
    setup = replace(setup, scene=replace(setup.scene, objects=objects))
    light = RadiosityLight("numpy")
    with NumpyStored(SIZE, light) if name == "numpy" else GLStored(SIZE, light, gl) as renderer:
        whole, direct, indirect = (
            renderer.render(setup.with_(light_shown=shown)).pixels.astype(np.float64)
            for shown in ("all", "direct", "indirect")
        )
    # Three roundings of light at corners and three of pixels, to float32
    np.testing.assert_allclose(direct + indirect, whole, rtol=6 * 2.0**-24, atol=1e-6)
    assert indirect.max() > 0.01 and direct.max() > 0.5
    for shown in ("direct", "indirect"):
        stored = light.result.stored(shading == "flat", shown)
        assert all(part.light.min() >= 0.0 for part in stored)


def test_of_indirect_light_neither_lamps_nor_the_background_are_seen():
    setup = pg.load("cornell-box").with_(patches=60, background=(0.3, 0.2, 0.1))
    with NumpyStored((64, 48), RadiosityLight("numpy")) as renderer:
        whole, indirect = (
            renderer.render(setup.with_(light_shown=shown)) for shown in ("all", "indirect")
        )
    behind = whole.coverage == 0.0
    assert behind.any() and np.allclose(whole.pixels[behind], (0.3, 0.2, 0.1))
    assert not indirect.pixels[behind].any()
    lamp = (whole.pixels == np.float32(setup.scene.lights[0].diffuse)).all(axis=-1)
    assert lamp.any() and not indirect.pixels[lamp].any()


def test_where_a_lamp_begins_to_list_its_corners_changes_no_light():
    setup = pg.load("cornell-box").with_(patches=60)
    found = []
    for turn in range(4):
        (lamp,) = setup.scene.lights
        corners = (*lamp.corners[turn:], *lamp.corners[:turn])
        turned = pg.PolygonLight(vertices=corners, diffuse=lamp.diffuse)
        scene = replace(setup.scene, lights=(turned,))
        result = pg.radiosity(replace(setup, scene=scene), "numpy").solve()
        others = result.patches.owner < len(scene.objects)
        found.append(result.direct[others])
    # The lamp's own pieces are the same, listed in another order: some hundred roundings
    np.testing.assert_allclose(found, [found[0]] * 4, rtol=1e-6, atol=1e-12)


def test_only_what_the_scene_has_is_said_to_be_missing():
    names = lambda setup: {x.split(":")[0] for x in pg.radiosity(setup).not_modelled}  # noqa: E731
    assert names(furnace()) == set()
    assert names(pg.load("whitted-room")) >= {"mirrors", "glass"}
    sphere = pg.load("sphere")
    assert names(sphere) == {"ambient", "specular interreflection", "highlights"}
    assert names(sphere.with_(terms=("diffuse", "emissive"))) == set()
    assert names(sphere.with_(specular=(0, 0, 0))) == {"ambient"}


def test_the_report_says_what_can_be_checked():
    result = pg.radiosity(furnace(), "numpy")
    report = result.report()
    assert report.ledger.imbalance < 1e-9
    assert report.residual <= 1e-9
    text = str(report)
    for words in ("96 patches", "row sums", "reciprocity", "closed", "divided by its sum"):
        assert words in text
    assert "96 patches, gauss-seidel" in result.brief()


def test_flat_shading_shows_patches():
    setup = room().with_(terms=("diffuse",), shading="flat")
    light = RadiosityLight("numpy")
    with NumpyStored(SIZE, light) as renderer:
        flat = renderer.render(setup)
    patches = light.result.patches
    material = {i: np.array(x.material.diffuse) for i, x in enumerate(setup.scene.objects)}
    reflected = [
        material.get(o, np.zeros(3)) * h
        for o, h in zip(patches.owner, light.result.arriving, strict=True)
    ]
    known = np.array([*reflected, *patches.emission]).astype(np.float32)
    seen = np.unique(flat.pixels[flat.coverage > 0], axis=0)
    nearest = np.abs(seen[:, None] - known).max(axis=-1).min(axis=1)
    assert len(np.unique(seen.round(5), axis=0)) > 5
    assert nearest.max() <= 1e-6 * max(1.0, seen.max())  # weights of corners sum to 1, in float64


def test_explain_adds_up_to_the_pixel():
    setup = room(shading="flat")
    image = pg.render(setup, SIZE, "numpy", method="radiosity")
    why = explain_stored(setup, (20, 25), SIZE, "radiosity")
    np.testing.assert_allclose(why.colour, image.pixels[25, 20], rtol=1e-5)
    np.testing.assert_allclose(why.diffuse + why.specular + why.emissive, why.colour, rtol=1e-12)
    np.testing.assert_allclose(why.direct + why.indirect, why.arriving, rtol=1e-6)
    assert why.patch is not None and why.to_dict()["patch"] == why.patch
    assert "indirect" in why.text() and "otimes" in why.latex()


def test_the_command_line_draws_and_explains(tmp_path, capsys):
    out = tmp_path / "room.png"
    words = ["indirect-room", "--size", "48x36", "--set", "patches=60", "--method", "radiosity"]
    assert main(["render", *words, "-o", str(out)]) == 0
    said = capsys.readouterr().err
    assert out.is_file() and "rows of form factors" in said and "ambient:" in said
    assert main(["explain", *words, "--pixel", "20", "25", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["method"] == "radiosity" and len(told["indirect"]) == 3
    words[0] = "furnace"
    assert main(["render", *words, "-o", str(out)]) == 0
    assert main(["compare", str(out), *words, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["max"] <= 0.5 / 255.0 + 1e-6  # the PNG's rounding
