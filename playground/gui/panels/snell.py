"""The Snell bench: a ray to drag, two media, and Fresnel's curve with the ray's point on it."""

from __future__ import annotations

from dataclasses import replace

from playground.gui.rays import snell_bench
from playground.gui.state import State
from playground.gui.widgets import Ui


def draw(state: State, ui: Ui) -> State:
    """The bench on its own; nothing of it is part of the setup."""
    bench = snell_bench.draw(state.bench, ui, state.theme)
    return state if bench is state.bench else replace(state, bench=bench)
