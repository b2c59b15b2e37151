"""The controls: each panel is a function ``draw(state, ui) -> state``.

A new panel is a module with such a function and a row in `PANELS`.
"""

from __future__ import annotations

from collections.abc import Callable

from playground.gui.panels import (
    bug_zoo,
    display,
    explain,
    form_factors,
    lightmap,
    lights,
    material,
    needs,
    popping,
    radiosity,
    scene,
    snell,
    solvers,
    speed,
    terms,
    tracing,
    view,
)
from playground.gui.state import State
from playground.gui.widgets import Ui

Panel = Callable[[State, Ui], State]

PANELS: dict[str, Panel] = {
    "Explain": explain.draw,
    "View": view.draw,
    "Ray tracing": tracing.draw,
    "Radiosity": radiosity.draw,
    "Form factors": form_factors.draw,
    "Solvers": solvers.draw,
    "Lightmap": lightmap.draw,
    "Terms": terms.draw,
    "Material": material.draw,
    "Lights": lights.draw,
    "Scene": scene.draw,
    "Display": display.draw,
    "Snell bench": snell.draw,
    "Bug zoo": bug_zoo.draw,
    "Popping scope": popping.draw,
    "Speed and error": speed.draw,
    "What the scene needs": needs.draw,
}
OPEN_AT_FIRST = ("View", "Terms", "Material")
