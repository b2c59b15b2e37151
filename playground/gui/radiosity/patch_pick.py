"""Clicks into a picture choose the two patches of a form factor."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from playground.explain.patch_at import patch_at
from playground.gui.picture.comparison import pictures
from playground.gui.picture.gizmo_math import ray, seen
from playground.gui.picture.pointer import moving, pointed, pressing, tapped
from playground.gui.radiosity.factor_view import FactorView
from playground.gui.state import State

PANEL = "Form factors"


def picked(state: State, origin: imgui.ImVec2, size: tuple[int, int]) -> State:
    """What the mouse over the last item, the view, points at, chooses or forgets.

    Parameters
    ----------
    state : State
    origin : ImVec2
        Upper left corner of the view.
    size : tuple of int
        Of the view, in pixels of the framebuffer.
    """
    view = state.factors
    if tapped(1):
        return replace(state, factors=view.forgotten())
    clicked = tapped(0)
    if not imgui.is_item_hovered():
        view = view if view.under is None else replace(view, under=None)
    elif clicked or ((moving() or view.under is None) and not pressing()):
        under = _under(state, origin, size)
        view = view if view.under == under else replace(view, under=under)
        if clicked and under is not None:
            view = view.clicked(under, imgui.get_io().key_shift)
    return state if view is state.factors else _with(state, view)


def _with(state: State, view: FactorView) -> State:
    """The state with the choice; a new one opens the panel."""
    chosen = (view.one, view.other) != (state.factors.one, state.factors.other)
    return replace(state, factors=view, unfold=PANEL if chosen else state.unfold)


def _under(state: State, origin: imgui.ImVec2, size: tuple[int, int]) -> int | None:
    """The patch under the mouse."""
    patches, shown = state.factors.of, pictures(state, *size)
    found = pointed(shown, origin)
    if found is None or patches is None:
        return None
    picture = shown[found[0]]
    box, setup = picture.box[2:], picture.setup
    view = seen(setup.scene, setup.camera, box)
    pixel = (found[1][0] * box[0], found[1][1] * box[1])
    return patch_at(patches, view.eye, ray(view, box, pixel))
