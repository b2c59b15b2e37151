"""What lies over the picture: lines that know its depth, cones, axes; chalk, not setup."""

from dataclasses import replace

import numpy as np
import pytest

from playground.gui.overlay_lines import edges, few, normal_lines
from playground.gui.picture.gizmo_math import seen, surfaces_of
from playground.gui.picture.overlay_knobs import Overlays
from playground.scene.knob import knobs
from playground.scene.library import load
from playground.scene.shapes import make


def test_every_edge_of_a_closed_mesh_is_there_once():
    for shape in ("box", "sphere", "torus"):
        mesh = make(shape, None)
        # Every triangle has three edges, and every edge two triangles.
        assert len(edges(mesh)) == 3 * len(mesh.faces) // 2
        places = mesh.positions[edges(mesh)]
        assert np.all(np.any(places[:, 0] != places[:, 1], axis=1))


def test_few_are_evenly_chosen():
    assert np.array_equal(few(np.arange(5), 9), np.arange(5))
    chosen = few(np.arange(1000), 10)
    assert len(chosen) == 10 and chosen[0] == 0 and chosen[-1] == 999


@pytest.mark.parametrize("faces", [False, True])
def test_normals_of_a_stretched_sphere_stand_on_it(faces):
    setup = load("sphere")
    item = setup.scene.objects[0]
    stretched = replace(item, transform=replace(item.transform, scale=(1, 3, 1)))
    surface = surfaces_of(setup.with_(objects=(stretched,)).scene)[0]
    start, end = np.moveaxis(normal_lines(surface, 0.5, faces), 1, 0)
    assert np.linalg.norm(end - start, axis=1) == pytest.approx(0.5)
    # The gradient of x² + y²/9 + z² is normal to the ellipsoid.
    gradient = (start - surface.origin) / (1.0, 9.0, 1.0)
    gradient /= np.linalg.norm(gradient, axis=1)[:, None]
    cosine = np.einsum("ni,ni->n", gradient, (end - start) / 0.5)
    # Faces of the default sphere turn by a few degrees from one to the next.
    assert cosine.min() > (np.cos(np.radians(12.0)) if faces else 1.0 - 1e-4)


@pytest.fixture
def overlays_module():
    pytest.importorskip("imgui_bundle")
    from playground.gui.picture import overlays

    return overlays


@pytest.mark.parametrize("angle", [0.0, 0.4, np.pi / 2, 2.5, np.pi])
def test_the_circle_of_a_cone_has_its_angle(overlays_module, angle):
    apex, ahead = np.array([1.0, 2.0, 3.0]), np.array([0.0, -2.0, 0.5])
    offset = overlays_module.circle(apex, ahead, angle) - apex
    length = np.linalg.norm(ahead)
    assert np.linalg.norm(offset, axis=1) == pytest.approx(length)
    assert offset @ ahead == pytest.approx(length**2 * np.cos(angle))
    assert offset[0] == pytest.approx(offset[-1])


def test_a_line_is_cut_where_it_passes_behind_the_eye(overlays_module):
    from playground.gui.picture.canvas import segment

    setup, size = load("teapot").with_(eye=(0, 0, 6), target=(0, 0, 0)), (900, 600)
    view = seen(setup.scene, setup.camera, size)
    assert segment(view, (0, 0, 7), (1, 1, 9), size) is None
    (x, y), end = segment(view, (0, 0, 0), (1, 0, 9), size)
    assert (x, y) == pytest.approx((450, 300))
    assert end[0] > 900 and end[1] == pytest.approx(300)


@pytest.mark.gl
@pytest.mark.parametrize("name", knobs(Overlays))
def test_each_is_switched_in_the_panel_seen_and_gone_again(hands, name):
    setup, before = hands.state.setup, hands.pixels()

    def script(c):
        c.set_ref("Controls")
        c.item_check(f"View/{name.replace('_', ' ')}")
        c.mouse_move_to_pos((2.0, 2.0))

    def back(c):
        c.set_ref("Controls")
        c.item_uncheck(f"View/{name.replace('_', ' ')}")
        c.mouse_move_to_pos((2.0, 2.0))

    hands.do(script)
    assert getattr(hands.state.overlays, name)
    changed = np.any(hands.pixels() != before, axis=2).mean()
    assert 0.0002 < changed < 0.4
    hands.do(back)
    hands.frames(3)
    np.testing.assert_array_equal(hands.pixels(), before)
    assert hands.state.setup is setup


@pytest.mark.gl
def test_hidden_lines_are_hidden(hands):
    """Of a box seen face on, the smaller frame of the back face does not show through."""
    item = replace(load("sphere").scene.objects[0], mesh="box", tessellation=1)
    setup = load("sphere").with_(objects=(item,), background=(0, 0, 0), terms=(), lights=())
    hands.window.state = hands.state.opened(setup.with_(eye=(0, 0, 6), target=(0, 0, 0), fov=30))
    hands.key("w")
    lit = hands.pixels().max(axis=2) > 0
    rows, columns = np.nonzero(lit)
    inner = lit[rows.min() + 4 : rows.max() - 3, columns.min() + 4 : columns.max() - 3]
    assert min(inner.shape) > 100
    # A diagonal crosses every row once and perhaps a second one does; a frame would fill some.
    assert inner.mean(axis=1).max() < 0.1 and inner.mean(axis=0).max() < 0.1
    assert inner.any()
