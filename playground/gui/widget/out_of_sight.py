"""A panel that is scrolled out of sight takes its room, and nothing else.

Building a panel costs the same whether or not any of it can be seen; of all panels open, a
window shows a quarter at a time.
"""

from __future__ import annotations

from collections.abc import Callable

from imgui_bundle import imgui

from playground.gui.state import State
from playground.gui.widgets import Ui

MARGIN = 2.0  # lines beyond the edge of the window that count as in sight


def drawn(panel: Callable[[State, Ui], State], state: State, ui: Ui) -> State:
    """Draw ``panel``, or leave as much room as it took when it was last in sight.

    While a text is written or a list is open everything is drawn, so that neither is lost.
    """
    storage, key = imgui.get_state_storage(), imgui.get_id("height of the panel")
    height, top = storage.get_float(key, -1.0), imgui.get_cursor_screen_pos().y
    busy = imgui.get_io().want_text_input or imgui.is_popup_open(
        "", imgui.PopupFlags_.any_popup_id.value | imgui.PopupFlags_.any_popup_level.value
    )
    if height > 0.0 and not busy and _beyond(top, top + height):
        imgui.dummy(imgui.ImVec2(0.0, height - imgui.get_style().item_spacing.y))
        return state
    state = panel(state, ui)
    storage.set_float(key, imgui.get_cursor_screen_pos().y - top)
    return state


def _beyond(top: float, bottom: float) -> bool:
    """Whether what lies between is out of sight."""
    start, margin = imgui.get_window_pos().y, MARGIN * imgui.get_text_line_height_with_spacing()
    return bottom < start - margin or top > start + imgui.get_window_height() + margin
