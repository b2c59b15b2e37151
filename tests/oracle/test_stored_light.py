"""Stored light: the bytes that GL and NumPy draw differ by one code at most.

Edges are left out as in `test_gl_against_numpy`; its bound of 2e-4 for what the rasteriser
interpolates holds for light at vertices. Coordinates in a lightmap are off by as much of a
triangle, and the light here changes by 9.4 + 6.3 per side of the image at most: on a triangle of a
tenth of it by less than 5e-4, an eighth of a code. A filter with weights of 8 bits adds half a step
of them times the change from texel to texel, 1/512 · (0.15 + 0.1), as much again.
"""

import numpy as np
import pytest
from test_gl_against_numpy import SHADINGS, SIZE, near_edges

import playground as pg
from playground.render.gl.stored import GLStored
from playground.render.stored import StoredLight
from playground.render.stored_renderer import NumpyStored

pytestmark = pytest.mark.gl


class Given:
    """Stored light that is simply there."""

    warnings = ()

    def __init__(self, *stored):
        self.given = stored

    def prepare(self, setup):
        return iter(())

    def stored(self, setup):
        return self.given

    def note(self):
        return ""

    def close(self):
        pass


def smooth(points):
    """Light that changes evenly with the place, (V, 3), from 0.1 to 0.9."""
    low, high = points.min(axis=0), points.max(axis=0)
    return (0.1 + 0.8 * (points - low) / np.where(high > low, high - low, 1.0)).astype(np.float32)


def lightmap(size=64):
    """Waves that meet at the border; they change by 0.15 and 0.1 from texel to texel."""
    y, x = (np.indices((size, size)) + 0.5) / size
    wave = np.sin(6 * np.pi * x) * np.sin(4 * np.pi * y)
    return np.stack([0.5 + 0.5 * wave, 0.5 - 0.4 * wave, 0.47 + 0 * x], -1).astype(np.float32)


def lit(setup, kind):
    """Each object with light per vertex, or in one lightmap for all."""
    texels = lightmap()
    stored = []
    for item in setup.scene.objects:
        mesh = item.geometry().mesh
        if kind == "vertex":
            stored.append(StoredLight(mesh, light=smooth(mesh.positions)))
        else:
            coordinates = mesh.texcoords
            if coordinates is None:
                coordinates = smooth(mesh.positions)[:, :2]
            stored.append(StoredLight(mesh, texcoords=coordinates, texels=texels))
    return Given(*stored)


def drawn(renderer, setup):
    out = np.empty((SIZE[1], SIZE[0], 4), np.uint8)
    return renderer.render(setup, out=out)[..., :3].astype(int)


@pytest.mark.parametrize("kind", ["vertex", "lightmap"])
@pytest.mark.parametrize("shading", SHADINGS)
@pytest.mark.parametrize("name", ["teapot", "textured", "stretched", "coloured-lights"])
def test_both_draw_the_same_bytes(gl, name, shading, kind):
    setup = pg.load(name).with_(shading=shading, samples=1)
    light = lit(setup, kind)
    with GLStored(SIZE, light) as ours, NumpyStored(SIZE, light) as reference:
        off = np.abs(drawn(ours, setup) - drawn(reference, setup)).max(axis=-1)
    clear = ~near_edges(setup)
    assert clear.mean() > 0.5
    assert off[clear].max() <= 1


@pytest.mark.parametrize("precision", ["float16", "float64"])
@pytest.mark.parametrize("kind", ["vertex", "lightmap"])
def test_another_precision_is_the_same_in_both(gl, kind, precision):
    setup = pg.load("textured").with_(precision=precision)
    light = lit(setup, kind)
    with GLStored(SIZE, light) as ours, NumpyStored(SIZE, light) as reference:
        off = np.abs(drawn(ours, setup) - drawn(reference, setup)).max(axis=-1)
    clear = ~near_edges(setup)
    assert (off[clear] == 0).mean() > 0.99
    assert off[clear].max() <= 1


def test_a_still_scene_keeps_its_picture_when_its_colours_become_constants(gl):
    setup = pg.load("textured")
    with GLStored(SIZE, lit(setup, "lightmap")) as renderer:
        first = drawn(renderer, setup)
        for _ in range(12):
            later = drawn(renderer, setup)
    assert np.abs(first - later).max() <= 1
