"""Baking a lightmap beside the window, and its texels: charts, dilation, what each one holds."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from imgui_bundle import imgui

from playground.errors import PlaygroundError
from playground.explain.texel_places import TexelPlaces
from playground.gui import actions
from playground.gui.lightmap import atlas_view, bake_log
from playground.gui.lightmap.atlas_look import AtlasLook
from playground.gui.lightmap.atlas_picture import fitting
from playground.gui.lightmap.atlas_pixels import around
from playground.gui.state import LIGHTMAP, State
from playground.gui.widget import plots
from playground.gui.widget.theme import PALETTES
from playground.gui.widgets import Ui, attempt, bare, edit, tooltip
from playground.gui.work import progress_bar
from playground.render.lightmap.lightmap import Lightmap
from playground.scene.knob import knobs

MEBIBYTE = 2.0**20
ROWS = 4  # of text about the texel under the mouse


def draw(state: State, ui: Ui) -> State:
    """Bake; then the atlas of the lightmap that the setup uses."""
    log = edit(ui, state.bake, only=("size", "rays"))
    state = replace(state, bake=log) if log is not state.bake else state
    state = _baking(state)
    palette = PALETTES[state.theme]
    if state.bake.error:
        plots.wrapped(state.bake.error, palette.alarm)
    try:
        found = fitting(state.setup.scene)
    except PlaygroundError as error:
        plots.wrapped(str(error), palette.alarm)
        return state
    if found is None:
        imgui.text_disabled("this setup has no lightmap yet")
        return state
    lightmap, places = found
    settings = edit(ui, state.setup.settings, only=("light_shown",))
    if settings is not state.setup.settings:
        state = actions.with_settings(state, settings)
    look = _look(state.atlas, ui)
    state = replace(state, atlas=look.within()) if look is not state.atlas else state
    if ui.atlas is not None:
        state = atlas_view.draw(state, lightmap, ui.atlas)
    _texel(state, lightmap, places)
    _memory(lightmap, places)
    if state.bake.told:
        plots.wrapped(state.bake.told, palette.faint)
    return state


def _baking(state: State) -> State:
    """Bake, or how far it has come and the way to stop it."""
    log = state.bake
    if log.running:
        return bake_log.cancelled(state) if progress_bar.draw(log.progress, "bake") else state
    if imgui.button("Bake###bake"):
        state = bake_log.asked(state)
    imgui.set_item_tooltip(
        "radiosity into a texture, in a process beside the window. The setup goes on with\n"
        "the lightmap it has until the new one is there; saving takes it along"
    )
    if not state.setup.scene.lightmap:
        return state
    imgui.same_line()
    drawn = state.method == LIGHTMAP
    if imgui.button("Draw otherwise###draw" if drawn else "Draw with it###draw"):
        state = actions.toggle_method(state, LIGHTMAP)
    imgui.set_item_tooltip("the method lightmap, or back to the rasteriser")
    imgui.same_line()
    if imgui.button("Forget it"):
        state = bake_log.forgotten(state)
    imgui.set_item_tooltip("the setup without its lightmap; undo brings it back")
    return state


def _look(look: AtlasLook, ui: Ui) -> AtlasLook:
    """What is marked, and how near one looks, in one line."""
    declared = knobs(AtlasLook)
    for name in ("borders", "dilated"):
        _, on = imgui.checkbox(name, getattr(look, name))
        tooltip(declared[name])
        look = attempt(ui, look, name, bool(on))
        imgui.same_line()
    imgui.set_next_item_width(-1)
    return attempt(ui, look, "zoom", bare(declared["zoom"], "zoom", look.zoom))


def _texel(state: State, lightmap: Lightmap, places: TexelPlaces) -> None:
    """What the texel under the mouse holds; as many lines whether or not there is one."""
    spot = state.atlas.spot
    if spot is None or max(spot.column, spot.row) >= lightmap.size:
        imgui.text_disabled("hover a texel, here or in the picture")
        for _ in range(ROWS - 1):
            imgui.text_disabled("")
        return
    row, column = spot.row, spot.column
    place = places.of_texel(column, row)
    chart = int(lightmap.chart[row, column])
    kind = f"on chart {chart}" if chart >= 0 else "on no chart, empty"
    if around(lightmap)[row, column]:
        kind = "on no chart, filled by dilation"
    imgui.text(f"texel {column}, {row}: {kind}")
    if place is None:
        imgui.text_disabled("of no object")
    else:
        item = state.setup.scene.objects[place.item]
        where = ", ".join(f"{x:.3g}" for x in place.position)
        imgui.text(f"{place.item}  {item.mesh.rsplit('/', 1)[-1]} at {where}")
    for name in ("direct", "indirect"):
        light = getattr(lightmap, name)[row, column].astype(np.float64)
        imgui.text(f"{name} {'  '.join(f'{x:.4g}' for x in light)}")


def _memory(lightmap: Lightmap, places: TexelPlaces) -> None:
    """How large texels and lightmap are."""
    size, covered = lightmap.size, float(lightmap.coverage.mean())
    stored = lightmap.direct.nbytes + lightmap.indirect.nbytes
    drawn = size * size * 3 * 4
    imgui.text(f"{size}×{size} texels, {100.0 * covered:.0f} % on charts")
    imgui.text(f"a texel is {places.spacing:.3g} wide in the world")
    imgui.text(f"{stored / MEBIBYTE:.3g} MiB, {drawn / MEBIBYTE:.3g} MiB as a texture to draw with")
    imgui.set_item_tooltip("direct and indirect light apart, three float32 numbers each")
