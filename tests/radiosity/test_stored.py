"""Stored light as it is drawn: the formula, term by term, and what it costs others."""

import numpy as np
import pytest

import playground as pg
from playground.render.gl.program import sources_for
from playground.render.needs import needs
from playground.render.stored import StoredLight, stored_surfaces
from playground.render.stored_renderer import NumpyStored
from playground.render.surface import surfaces
from playground.render.view import view_of

SIZE = (64, 48)
ARRIVING = np.array([0.25, 0.5, 0.75])  # exact in float32


class Everywhere:
    """The same light at every vertex, or in every texel, of every object."""

    warnings = ("a warning",)

    def __init__(self, lightmap=False, **more):
        self.lightmap, self.more = lightmap, more

    def prepare(self, setup):
        return iter(())

    def stored(self, setup):
        return tuple(self.light(item.geometry().mesh) for item in setup.scene.objects)

    def light(self, mesh):
        light = np.tile(ARRIVING, (len(mesh.positions), 1)).astype(np.float32)
        if not self.lightmap:
            return StoredLight(mesh, light=light, **self.more)
        texels = np.broadcast_to(ARRIVING, (4, 4, 3)).astype(np.float32)
        return StoredLight(mesh, texcoords=light[:, :2], texels=texels, **self.more)

    def note(self):
        return "a note"

    def close(self):
        pass


def drawn(setup, light=None):
    with NumpyStored(SIZE, light or Everywhere()) as renderer:
        return renderer.render(setup)


@pytest.mark.parametrize("lightmap", [False, True])
@pytest.mark.parametrize("shading", ["flat", "per-vertex", "per-fragment"])
def test_what_is_shown_is_emitted_and_reflected(lightmap, shading):
    glowing = {"diffuse": (0.5, 0.25, 1.0), "emissive": (0.0, 0.125, 0.25)}
    setup = pg.load("sphere").with_(**glowing, specular=(0, 0, 0), shading=shading)
    image = drawn(setup, Everywhere(lightmap))
    seen = image.pixels[image.coverage > 0]
    expected = ARRIVING * glowing["diffuse"] + glowing["emissive"]
    assert len(seen) > 100
    # The weights of the three corners sum to 1 within a few roundings, then float32.
    np.testing.assert_allclose(seen, np.broadcast_to(expected, seen.shape), rtol=1e-6)
    assert image.warnings == ("a warning",) and image.notes["light"] == "a note"


def test_weights_scale_the_terms_and_ambient_light_is_left_out():
    setup = pg.load("sphere").with_(specular=(0, 0, 0), emissive=(1.0, 0.0, 0.0))
    lights = (pg.DirectionalLight(ambient=(5.0, 5.0, 5.0)),)
    half = setup.with_(lights=lights, diffuse_weight=0.5, emissive_weight=2.0)
    seen = drawn(half).pixels[24, 32]
    m_d = np.array(setup.scene.objects[0].material.diffuse)
    np.testing.assert_allclose(seen, 0.5 * m_d * ARRIVING + [2.0, 0.0, 0.0], rtol=1e-6)
    dark = drawn(setup.with_(terms=("ambient", "specular"), lights=lights))
    assert not dark.pixels[dark.coverage > 0].any()


@pytest.mark.parametrize("shading", ["flat", "per-vertex", "per-fragment"])
def test_the_specular_term_is_that_of_the_local_model(shading):
    setup = pg.load("coloured-lights").with_(shading=shading)
    highlights = pg.render(setup.with_(terms=("specular",)), SIZE, "numpy")
    both, without = drawn(setup), drawn(setup.with_(terms=("diffuse", "emissive")))
    seen = both.coverage > 0
    added = both.pixels[seen] - without.pixels[seen]
    assert highlights.pixels[seen].max() > 0.5
    # Both pictures are rounded to float32 at up to 2: half a unit each, 2.4e-7 in all.
    np.testing.assert_allclose(added, highlights.pixels[seen], atol=3e-7)


def test_texels_filter_what_arrives():
    setup = pg.load("textured").with_(specular=(0, 0, 0))
    texels = pg.render(
        setup.with_(lights=(), emissive=(0, 0, 0)), SIZE, "numpy"
    )  # black: nothing is lit
    image = drawn(setup)
    seen = image.coverage > 0
    assert not texels.pixels[seen].any()
    ratio = image.pixels[seen] / ARRIVING
    assert np.ptp(ratio, axis=0).max() > 0.1  # the pattern of the image
    material = setup.scene.objects[0].material
    assert ratio.max() <= max(material.diffuse) * (1.0 + 1e-6)


def test_nothing_arrives_at_a_back():
    scene = pg.Scene(objects=(pg.Object("quad", material=pg.Material(emissive=(1, 1, 1))),))
    above = pg.Setup(scene, pg.Camera(eye=(0.1, 2, 0), target=(0, 0, 0)))
    below = pg.Setup(scene, pg.Camera(eye=(0.1, -2, 0), target=(0, 0, 0)))
    front, back = drawn(above), drawn(below)
    assert front.pixels[front.coverage > 0].min() > 1.0
    assert (back.coverage > 0).sum() > 100
    assert not back.pixels[back.coverage > 0].any()


def test_a_mesh_with_the_axes_of_the_world_is_drawn_where_it_stands():
    place = pg.Transform(translate=(0.5, -0.25, 1.0), rotate=(0, 90, 0), scale=(2.0, 1.0, -1.0))
    item = pg.Object("box", transform=place)
    setup = pg.Setup(pg.Scene(objects=(item,)), pg.Camera(eye=(3, 2, 6)))
    mesh, world = item.geometry().mesh, place.matrix
    origin = np.array([0.25, 0.0, 0.5])
    moved = mesh.positions @ world[:3, :3].T + world[:3, 3] - origin
    normals = mesh.normals @ np.linalg.inv(world[:3, :3])
    there = pg.Mesh.create(moved, mesh.faces[:, ::-1], normals)  # mirrored: turned around again

    class There(Everywhere):
        def stored(self, setup):
            return (self.light(there),)

    image, own = drawn(setup, There(origin=origin)), drawn(setup)
    assert np.array_equal(image.coverage, own.coverage)
    np.testing.assert_allclose(image.pixels, own.pixels, atol=1e-6)


def test_others_compile_nothing_of_it():
    setup = pg.load("textured")
    everything = surfaces(setup.scene, setup.settings.weights)
    view = view_of(setup.camera, everything, SIZE)
    plain = needs(everything[0], view, setup.settings)
    assert not plain.stored and not plain.lightmap
    for source in sources_for(plain):
        assert "object_light" not in source.text and "stored.glsl" not in source.text
    light = Everywhere(lightmap=True).stored(setup)
    stored = stored_surfaces(setup.scene, setup.settings.weights, light)
    wanted = needs(stored[0], view, setup.settings)
    assert wanted.stored and wanted.lightmap and wanted.texture and not wanted.diffuse
    dull = setup.with_(specular=(0, 0, 0))
    stored = stored_surfaces(dull.scene, dull.settings.weights, light)
    wanted = needs(stored[0], view, dull.settings)
    assert wanted.directional_lights == wanted.point_lights == 0  # light costs one lookup


def test_the_bug_zoo_is_refused():
    with pytest.raises(pg.PlaygroundError, match="bugs"):
        drawn(pg.load("sphere").with_(bugs=("missing-max",)))
