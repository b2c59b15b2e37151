"""Every method's form factor of a pair, with its error and its time, as a table."""

from __future__ import annotations

from imgui_bundle import imgui

from playground.explain.patch_pair import MethodTold, PatchPair
from playground.explain.patch_words import percent
from playground.render.radiosity.factor.form_factors import METHODS

TITLES = ("method", "Fᵢⱼ", "error", "ms a row")
FLAGS = imgui.TableFlags_.row_bg.value | imgui.TableFlags_.sizing_fixed_fit.value


def draw(pair: PatchPair, chosen: str) -> None:
    """The table, ``chosen`` marked: the method of the settings; a tooltip says the rest."""
    if not imgui.begin_table("methods", len(TITLES), FLAGS):
        return
    for number, title in enumerate(TITLES):
        stretch = imgui.TableColumnFlags_.width_stretch if number == 0 else 0
        imgui.table_setup_column(title, stretch)
    imgui.table_headers_row()
    for method in reversed(METHODS):
        told = pair.told(method)
        cells = cells_of(told) if told else ("...", "", "")
        for cell in (f"{method} *" if method == chosen else method, *cells):
            imgui.table_next_column()
            imgui.text(cell)
            if told and imgui.is_item_hovered():
                imgui.set_tooltip(more(told))
    imgui.table_next_column()
    partly = 0.0 < pair.visible < 1.0
    imgui.text_disabled(f"exact × {100.0 * pair.visible:.0f} %" if partly else "exact")
    imgui.set_item_tooltip("the closed form of two polygons, times the share that gets through")
    imgui.table_next_column()
    imgui.text_disabled(f"{pair.expected[0]:.5g}")
    imgui.end_table()


def cells_of(told: MethodTold) -> tuple[str, str, str]:
    """What stands in a row behind its name."""
    return f"{told.factors[0]:.5g}", percent(told.error), f"{1e3 * told.seconds:.1f}"


def more(told: MethodTold) -> str:
    """What a row has no room for."""
    (there, back), (one, other) = told.factors, told.sums
    return (
        f"{told.method}\nFᵢⱼ = {there:.6g}, Fⱼᵢ = {back:.6g}\n"
        f"AᵢFᵢⱼ − AⱼFⱼᵢ = {told.exchange:.2e}\nrow sums {one:.5f} of i, {other:.5f} of j"
    )
