"""The panel "Lightmap": baking beside the window, the atlas and its texels, saving it along."""

from dataclasses import replace
from pathlib import Path
from time import monotonic

import numpy as np
import pytest
from one_panel import alone

import playground as pg
from playground.explain.texel_places import texel_places
from playground.gui import actions
from playground.gui.lightmap import bake_log, lightmap_store
from playground.gui.lightmap.atlas_look import AtlasLook, Spot
from playground.gui.lightmap.atlas_pixels import BORDER, around, atlas_codes, texels_at
from playground.gui.lightmap.bake_run import BakeRun
from playground.gui.state import LIGHTMAP, start
from playground.render.lightmap.lightmap_file import load_lightmap
from playground.shading.display import code8, display_colour

PANEL = "//Controls/Lightmap"
FEW = {"patches": 60}
TEXELS = 32


@pytest.fixture(scope="module")
def plates():
    setup = pg.load("facing-plates").with_(**FEW)
    return setup, pg.radiosity(setup, "numpy").bake(TEXELS)


@pytest.fixture
def plain():
    """Nothing but texels."""
    return AtlasLook(borders=False, dilated=False)


def test_an_atlas_of_its_own_size_is_its_texels(plates, plain):
    setup, lightmap = plates
    codes = atlas_codes(lightmap, plain, setup.settings, TEXELS)
    settings = setup.settings
    for shown in ("all", "direct", "indirect"):
        codes = atlas_codes(lightmap, plain, replace(settings, light_shown=shown), TEXELS)
        light = lightmap.texels(shown)[::-1]
        want = code8(display_colour(light, settings.exposure, settings.clamp, settings.curve))
        covered = lightmap.coverage[::-1]
        np.testing.assert_array_equal(codes[covered], want[covered])


def test_borders_and_dilated_texels_are_marked(plates, plain):
    setup, lightmap = plates
    bare = atlas_codes(lightmap, plain, setup.settings, TEXELS)
    lines = atlas_codes(lightmap, replace(plain, borders=True), setup.settings, TEXELS)
    changed = (bare != lines).any(axis=-1)
    assert (lines[changed] == BORDER).all() and changed[~lightmap.coverage[::-1]].sum() == 0
    chart = np.pad(lightmap.chart, 1, mode="edge")[::-1]
    inner = chart[1:-1, 1:-1]
    apart = np.zeros(inner.shape, dtype=bool)
    for i, j in ((0, 1), (2, 1), (1, 0), (1, 2)):
        apart |= chart[i : i + TEXELS, j : j + TEXELS] != inner
    np.testing.assert_array_equal((lines == BORDER).all(axis=-1), apart & (inner >= 0))
    tinted = atlas_codes(lightmap, replace(plain, dilated=True), setup.settings, TEXELS)
    added = around(lightmap)[::-1]
    np.testing.assert_array_equal((tinted != bare).any(axis=-1), added)


def test_what_dilation_fills_is_what_it_has_filled(plates):
    lightmap = plates[1]
    lit = lightmap.texels().any(axis=-1)
    np.testing.assert_array_equal(lit & ~lightmap.coverage, around(lightmap) & lit)
    assert not (lit & ~lightmap.coverage & ~around(lightmap)).any()


def test_zoom_keeps_what_is_under_the_mouse_and_a_drag_takes_it_along():
    look = AtlasLook()
    near = look.closer(4.0, 0.3, 0.6)
    assert near.zoom == 4.0
    np.testing.assert_allclose(near.at(0.3, 0.6), look.at(0.3, 0.6), rtol=1e-12)
    np.testing.assert_allclose(near.seen_at(*near.at(0.8, 0.1)), (0.8, 0.1), rtol=1e-12)
    moved = near.moved(0.1, 0.05)
    np.testing.assert_allclose(moved.at(0.4, 0.65), near.at(0.3, 0.6), rtol=1e-12)
    assert look.moved(0.5, 0.5) == look  # there is nothing beyond the atlas
    assert near.closer(0.01, 0.9, 0.9) == look


def test_pixels_know_their_texels():
    column, row = texels_at(8, AtlasLook(zoom=2.0, middle=(0.75, 0.75)), 8)
    assert column.tolist() == [4, 4, 5, 5, 6, 6, 7, 7]
    assert row.tolist() == [7, 7, 6, 6, 5, 5, 4, 4]


def test_a_texel_and_its_place_know_each_other(plates):
    setup, lightmap = plates
    places = texel_places(lightmap, setup.scene)
    covered = np.argwhere(lightmap.coverage)
    eye = np.array(setup.camera.eye)
    found = 0
    for row, column in covered[::7]:
        place = places.of_texel(int(column), int(row))
        assert place is not None
        item = setup.scene.objects[place.item]
        inner = np.linalg.solve(item.transform.matrix, [*place.position, 1.0])[:3]
        mesh = item.geometry().mesh.positions
        assert (inner >= mesh.min(axis=0) - 1e-6).all() and (inner <= mesh.max(axis=0) + 1e-6).all()
        seen = places.under_ray(eye, place.position - eye)
        found += seen is not None and (seen.column, seen.row) == (column, row)
    assert found > 0.3 * len(covered[::7])  # the others are hidden, or at the rim of a plate
    assert places.of_texel(0, 0) is None or lightmap.coverage[:4, :4].any()
    assert places.under_ray(eye, -(np.array(setup.camera.target) - eye)) is None


def test_the_width_of_a_texel(plates):
    setup, lightmap = plates
    places = texel_places(lightmap, setup.scene)
    column, row = np.argwhere(lightmap.coverage)[len(np.argwhere(lightmap.coverage)) // 2][::-1]
    here, there = (places.of_texel(int(column) + i, int(row)) for i in (0, 1))
    # Charts of planes are not stretched; float32 places of 32 texels are off by 32 EPS32 each.
    apart = np.linalg.norm(there.position - here.position)
    assert apart == pytest.approx(places.spacing, rel=1e-4)


def test_a_lightmap_goes_along_when_its_setup_is_saved(plates, tmp_path):
    setup, lightmap = plates
    file = lightmap_store.new_file(setup)
    lightmap.save(file)
    state = start(setup.with_(lightmap=str(file)))
    saved = actions.save_as(state, tmp_path / "mine.toml")
    assert not saved.failed
    file.unlink()
    again = pg.load(tmp_path / "mine.toml")
    assert Path(again.scene.lightmap).name == "mine.lightmap.npz"
    assert again.scene.lightmap == saved.setup.scene.lightmap
    np.testing.assert_array_equal(load_lightmap(again.scene.lightmap).direct, lightmap.direct)
    other = setup.with_(lightmap=str(tmp_path / "elsewhere.npz"))
    assert lightmap_store.beside(other, tmp_path / "b.toml") is other


def test_the_folder_keeps_few_lightmaps_and_never_loses_the_one_in_use(plates):
    setup = plates[0]
    first = lightmap_store.new_file(setup)
    first.write_bytes(b"")
    used = setup.with_(lightmap=str(first))
    for _ in range(lightmap_store.KEPT + 5):
        lightmap_store.new_file(used).write_bytes(b"")
    files = list(lightmap_store.folder().iterdir())
    assert len(files) <= lightmap_store.KEPT + 1 and first in files


def baked(state):
    """The state when the bake has ended."""
    run, until = BakeRun(), monotonic() + 300
    try:
        while state.bake.running and monotonic() < until:
            state = run.advance(state)
    finally:
        run.close()
    assert not state.bake.running
    return state


def small(state, **changes):
    return replace(state, bake=replace(state.bake, size=TEXELS, rays=0, **changes))


def test_the_setup_uses_what_was_baked_and_an_error_changes_nothing(plates):
    state = bake_log.asked(small(start(plates[0])))
    assert state.setup.scene.lightmap == ""
    done = baked(state)
    assert load_lightmap(done.setup.scene.lightmap).size == TEXELS and "texels" in done.bake.told
    dark = small(start(pg.load("sphere").with_(lights=())))
    failed = baked(bake_log.asked(dark))
    assert "light" in failed.bake.error and failed.setup is dark.setup


def test_a_lightmap_of_what_has_moved_meanwhile_is_thrown_away(plates):
    state = bake_log.asked(small(start(plates[0])))
    first, *others = state.setup.scene.objects
    away = replace(first, transform=replace(first.transform, translate=(0.0, 0.5, 0.0)))
    moved = state.with_setup(state.setup.with_(objects=(away, *others)))
    after = bake_log.finished(moved, "done")
    assert after.setup is moved.setup and "changed" in after.bake.error
    redder = state.with_setup(state.setup.with_(diffuse=(0.9, 0.1, 0.1)))
    assert bake_log.finished(redder, "done").setup.scene.lightmap  # it says itself that it is old


@pytest.fixture
def panel(hands):
    """The window on two plates with the panel open, and closed again."""
    hands.load("facing-plates", **FEW)
    hands.window.state = small(hands.state)
    with alone(hands, PANEL):
        yield hands


def click(hands, name):
    hands.do(lambda c: c.item_click(f"{PANEL}/{name}"))


def finish(hands):
    hands.until(lambda: not hands.state.bake.running)
    assert not hands.state.bake.error


def box_of(hands, label):
    """The rectangle of an item of the panel."""
    found = []

    def look(c):
        rect = c.item_info(f"{PANEL}/{label}").rect_full
        found.extend((rect.min.x, rect.min.y, rect.max.x, rect.max.y))

    hands.do(look)
    return found


@pytest.mark.gl
def test_the_window_bakes_and_draws_with_it(panel, held_back):
    before = panel.state.setup
    click(panel, "###bake")
    assert panel.state.bake.running and panel.state.setup is before
    held_back()
    finish(panel)
    lightmap = panel.state.setup.scene.lightmap
    assert lightmap and Path(lightmap).is_file()
    click(panel, "###draw")
    assert panel.state.method == LIGHTMAP and not panel.state.failed
    panel.window.state = actions.undo(actions.undo(panel.state))
    panel.frames(2)
    assert panel.state.setup == before
    panel.window.state = actions.redo(panel.state)
    click(panel, "Forget it")
    assert panel.state.setup.scene.lightmap == ""


@pytest.mark.gl
def test_a_cancelled_bake_leaves_the_old_lightmap(panel, plates, held_back):
    file = lightmap_store.new_file(panel.state.setup)
    plates[1].save(file)
    panel.window.state = panel.state.with_setup(panel.state.setup.with_(lightmap=str(file)))
    before = panel.state.setup
    click(panel, "###bake")
    assert panel.state.bake.running
    click(panel, "###bake")
    held_back()
    panel.frames(5)
    assert not panel.state.bake.running and panel.state.setup is before
    assert load_lightmap(file).size == TEXELS


@pytest.mark.gl
def test_the_mouse_links_texels_and_places(panel, plates):
    setup, lightmap = plates
    file = lightmap_store.new_file(setup)
    lightmap.save(file)
    panel.window.state = panel.state.with_setup(panel.state.setup.with_(lightmap=str(file)))
    panel.frames(3)
    x, y, right, _ = box_of(panel, "##atlas")
    wide = right - x
    places = texel_places(lightmap, panel.state.setup.scene)
    panel.io.add_mouse_pos_event(-1.0, -1.0)
    panel.frames(3)
    without = panel.pixels()
    chosen = None
    for row, column in np.argwhere(lightmap.coverage)[::11]:
        at = x + (column + 0.5) / TEXELS * wide, y + (1.0 - (row + 0.5) / TEXELS) * wide
        if at[1] > 660.0:
            continue  # below the edge of the window
        panel.io.add_mouse_pos_event(*at)
        panel.frames(3)
        assert panel.state.atlas.spot == Spot(column, row, True)
        chosen = chosen or (panel.pixels() != without).any()
    assert chosen  # it was marked in the picture
    eye, target = (np.array(v) for v in (setup.camera.eye, setup.camera.target))
    middle = places.under_ray(eye, target - eye)
    left, top, w, h = panel.window.view_box()
    panel.io.add_mouse_pos_event(left + w / 2.0, top + h / 2.0)
    panel.frames(3)
    spot = panel.state.atlas.spot
    if middle is None:
        assert spot is None
    else:  # the pixel's corner and its ray are half a pixel apart
        assert not spot.in_atlas and abs(spot.column - middle.column) <= 1


@pytest.mark.gl
def test_the_wheel_zooms_the_atlas_and_does_not_scroll_the_panel(panel, plates):
    file = lightmap_store.new_file(plates[0])
    plates[1].save(file)
    panel.window.state = panel.state.with_setup(panel.state.setup.with_(lightmap=str(file)))
    panel.frames(3)
    x, y, right, _ = box_of(panel, "##atlas")
    panel.wheel((x + right) / 2.0, y + 40.0, 2.0)
    assert panel.state.atlas.zoom == pytest.approx(1.25**2)
    assert box_of(panel, "##atlas")[1] == y
    before = panel.state.atlas.middle
    panel.drag((x + 100.0, y + 60.0), (x + 130.0, y + 60.0))
    assert panel.state.atlas.middle[0] < before[0]
    panel.window.state = replace(panel.state, atlas=AtlasLook())


@pytest.mark.gl
def test_a_lightmap_that_is_gone_is_told(panel):
    panel.window.state = panel.state.with_setup(panel.state.setup.with_(lightmap="gone.npz"))
    panel.frames(3)
    assert panel.state.atlas.spot is None and not panel.state.failed
