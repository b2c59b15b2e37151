"""What is lit and from where it is seen: meshes, where they stand, background, camera."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

from imgui_bundle import imgui

from playground.gui.panels.material import pick_object, with_object
from playground.gui.state import State
from playground.gui.widgets import LABELS, Ui, attempt, edit, row
from playground.scene.knob import Knob, knobs
from playground.scene.scene import Object
from playground.scene.shapes import SHAPES


def draw(state: State, ui: Ui) -> State:
    """The chosen object, the background, the camera."""
    state = pick_object(state)
    if state.setup.scene.objects:
        item = state.setup.scene.objects[state.chosen]
        state = with_object(state, _object(item, ui), item)
    setup = state.setup
    imgui.separator()
    scene = edit(ui, setup.scene, only=("background",))
    camera = setup.camera
    if imgui.tree_node("camera"):
        camera = edit(ui, camera)
        imgui.tree_pop()
    if scene is setup.scene and camera is setup.camera:
        return state
    return state.with_setup(replace(setup, scene=scene, camera=camera))


def _object(item: Object, ui: Ui) -> Object:
    item = _mesh(item, ui)
    if item.mesh in SHAPES and item.arrays is None:
        item = attempt(ui, item, "tessellation", _tessellation(item))
    item = edit(ui, item, only=("normals",))
    if imgui.tree_node("place"):
        item = attempt(ui, item, "transform", edit(ui, item.transform))
        imgui.tree_pop()
    return item


def _mesh(item: Object, ui: Ui) -> Object:
    """A generator from the list; a file stays as it is and can be left."""
    names = list(SHAPES) if item.mesh in SHAPES else [item.mesh, *SHAPES]
    imgui.align_text_to_frame_padding()
    imgui.text("mesh")
    imgui.same_line(LABELS * imgui.get_font_size())
    imgui.set_next_item_width(-1)
    changed, index = imgui.combo("##mesh", names.index(item.mesh), names)
    if changed and names[index] != item.mesh:
        item = replace(item, mesh=names[index], tessellation=0, arrays=None)
    return item


def _tessellation(item: Object) -> int:
    """The knob of the shape: its range is narrower than the declared one, 0 is its default."""
    shape, knob = SHAPES[item.mesh], _tessellation_knob(item.mesh)
    now = item.tessellation or shape.default_tessellation
    wanted = int(min(max(row(knob, "tessellation", now), shape.min), shape.max))
    return item.tessellation if wanted == now else wanted


@lru_cache(maxsize=len(SHAPES))
def _tessellation_knob(mesh: str) -> Knob:
    shape = SHAPES[mesh]
    return replace(
        knobs(Object)["tessellation"],
        low=shape.min,
        high=shape.max,
        default=shape.default_tessellation,
        help=shape.help,
    )
