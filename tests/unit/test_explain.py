"""`explain`: the numbers it tells are those of the picture."""

import numpy as np
import pytest

import playground as pg

SIZE = (80, 60)


@pytest.mark.parametrize("shading", ["flat", "per-vertex", "per-fragment"])
@pytest.mark.parametrize("name", pg.library())
def test_every_pixel_is_explained_as_it_was_drawn(name, shading):
    setup = pg.load(name).with_(shading=shading)
    image = pg.render(setup, SIZE, "numpy")
    for x, y in [(40, 30), (20, 25), (55, 35), (0, 0), (79, 59)]:
        why = pg.explain(setup, pixel=(x, y), size=SIZE)
        np.testing.assert_allclose(why.colour, image.pixels[y, x], atol=1e-6)
        # The picture is float32: a value half-way between two codes may go either way there.
        steps = 255.0 * np.array(why.shown)
        sure = np.abs(steps % 1.0 - 0.5) > 255.0 * 1e-6
        assert np.all((why.codes == image.codes()[y, x])[:3] | ~sure)
        assert (why.object is None and why.light is None) == (image.coverage[y, x] == 0)


def test_terms_lights_and_weights_add_up():
    setup = pg.load("coloured-lights").with_(shading="per-vertex")
    why = pg.explain(setup, (40, 40), SIZE)
    told = why.to_dict()
    assert sum(told["weights"]) == pytest.approx(1.0)
    assert len(told["points"]) == 3
    assert all(len(point["lights"]) == 3 for point in told["points"])
    total = np.sum(list(told["terms"].values()), axis=0)
    np.testing.assert_allclose(total, why.colour, atol=1e-12)
    mixed = np.einsum("c,cx->x", told["weights"], [p["colour"] for p in told["points"]])
    np.testing.assert_allclose(mixed, why.colour, atol=1e-12)


def test_vectors_are_those_of_the_formula():
    why = pg.explain(pg.load("sphere"), (40, 30), SIZE)
    (point,) = why.corners
    (light,) = point.lights
    for v in (point.normal, point.to_eye, light.to_light, light.reflection):
        assert np.linalg.norm(v) == pytest.approx(1.0)
    n, l, r = point.normal, light.to_light, light.reflection  # noqa: E741
    np.testing.assert_allclose(r, 2 * n * (n @ l) - l, atol=1e-15)
    assert light.rho == pytest.approx(np.degrees(np.arccos(light.r_dot_v)))
    assert light.diffuse_factor == pytest.approx(max(n @ l, 0))
    # On the unit sphere the normal is the point, up to the mesh's own flatness.
    np.testing.assert_allclose(point.position, n, atol=5e-3)


def test_the_words_of_the_lecture():
    setup = pg.load("teapot").with_(exposure=2.0, diffuse_weight=0.5)
    why = pg.explain(setup, (40, 30), SIZE)
    for words in ("w · max(n·l, 0) s_d ⊗ m_d = 0.5 · ", "⊗", "exposed × 2", "emissive"):
        assert words in why.text()
    assert r"\max(n\cdot l,0)\,s_d\otimes m_d" in why.latex()
    assert "background" in pg.explain(setup, (0, 0), SIZE).text()
    blinn = pg.explain(setup.with_(highlight="blinn"), (40, 30), SIZE)
    assert "max(n·h, 0)" in blinn.text()


def numbers(text):
    import re

    return [float(x) for x in re.findall(r"-?\d+\.?\d*(?:e-?\d+)?", text)]


@pytest.mark.parametrize(
    "change",
    [
        {},
        {"highlight": "blinn"},
        {"diffuse_weight": 0.5, "specular_weight": 2.0, "ambient_weight": 0.25},
        {"lights": (pg.PointLight(position=(3, 4, 5), attenuate=True),)},
        {"lights": (pg.SpotLight(attenuate=True, linear=0.1),)},
        {"shading": "flat"},
    ],
    ids=str,
)
def test_the_printed_equations_are_true(change):
    """What stands left of the last = multiplies out to what stands right of it."""
    why = pg.explain(pg.load("sphere").with_(**change), (45, 27), SIZE)
    checked = 0
    for line in why.text().splitlines():
        words = line.split()
        if words and words[0] in ("diffuse", "specular", "ambient"):
            left, right = line.rsplit(" = ", 1)
            left = left.split(" = ", 1)[1]
            scale, colours = left.split("(", 1)[0], numbers(left.split("(", 1)[1])
            factor = np.prod(
                [
                    float(b) ** float(e or 1)
                    for b, _, e in (part.partition("^") for part in scale.replace("·", " ").split())
                ]
            )
            product = factor * np.multiply(colours[:3], colours[3:])
            # Four digits are printed; a power of 32 multiplies the last one's error by 32.
            np.testing.assert_allclose(product, numbers(right), atol=5e-3)
            checked += 1
    assert checked == 3


def test_what_is_off_is_said_to_be_off():
    setup = pg.load("sphere").with_(terms=("diffuse",), gate=True)
    text = pg.explain(setup, (40, 30), SIZE).text()
    assert text.count("switched off") == 3
    assert "m_a" not in pg.explain(setup, (40, 30), SIZE).latex()
    behind = setup.with_(terms=("specular",), lights=(pg.DirectionalLight(to_light=(0, 0, -1)),))
    assert "gated: n·l" in pg.explain(behind, (40, 30), SIZE).text()
    blinn = pg.explain(setup.with_(terms=("specular",), highlight="blinn"), (40, 30), SIZE)
    assert r"n\cdot h" in blinn.latex()
    assert "halfway" in blinn.text()


def test_the_dictionary_has_the_names_of_the_vocabulary():
    told = pg.explain(pg.load("teapot"), (40, 30), SIZE).to_dict()
    assert set(told["material"]) == {"diffuse", "specular", "ambient", "emissive"}
    assert told["term_weights"]["diffuse"] == 1.0
    (light,) = told["points"][0]["lights"]
    assert {"to_light", "reflection", "halfway", "rho", "strength"} <= set(light)


def test_a_pixel_outside_is_refused():
    for pixel in [(80, 0), (0, -1), (1.5, 2), "ab", (1,)]:
        with pytest.raises(pg.PlaygroundError, match="x from 0 to 79"):
            pg.explain(pg.load("sphere"), pixel, SIZE)
