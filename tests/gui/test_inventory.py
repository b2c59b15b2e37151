"""Every control of the panels stands in the tables of situations, with what it does.

The panels are drawn in situations that together show all there is to press; what the test
engine finds there must be what the tables say. Whoever adds a control adds a row.
"""

import pytest
from situations import at_rest
from situations_light import OF_LIGHT
from situations_scene import OF_SCENE
from test_controls import PARTS, UNFOLDED, choose, opened

from playground.gui.panels import PANELS
from playground.scene.knob import knobs
from playground.scene.light import SpotLight

pytestmark = pytest.mark.gl
SEVERAL = {"colour": ("/##X", "/##Y", "/##Z", "/##ColorButton"), "vector": ("/$$0", "/$$1", "/$$2")}
PLOTS = ("##brightest point of the highlight", "##mean brightness", "##dots", "##race", "##energy")
PLOT_PARTS = 8  # ImPlot numbers the area and the axes of a plot after the plot
SITUATIONS = {**OF_SCENE, **OF_LIGHT}


def knob_paths(c, panel):
    """The controls of the knobs of a setup in one panel, by their labels."""
    for path, _, kind, names in PARTS:
        if path.split("/")[0] != panel or (path == UNFOLDED and kind is not SpotLight):
            continue
        for name in names:
            knob = knobs(kind)[name]
            buttons = [f"{path}/{choice}##{name}" for choice in knob.choices]
            if buttons and c.item_exists(buttons[0]):
                yield from buttons
            else:
                yield from (f"{path}/##{name}{part}" for part in SEVERAL.get(knob.kind, ("",)))


def found(hands, c, panel):
    """The numbers of all items in the controls, but headers of panels and parts of plots."""
    engine = hands.imgui.test_engine
    items = engine.TestItemList()
    c.gather_items(items, "//Controls", -1)
    numbers = {items[i].id_ for i in range(items.get_size())}
    headers = {c.get_id(f"//Controls/{name}") for name in PANELS}
    plots = [c.get_id(f"{panel}/{title}") for title in PLOTS]
    return {n for n in numbers - headers if not any(0 <= n - plot < PLOT_PARTS for plot in plots)}


def named(hands, c, number):
    """Label and place of an item that no row knows."""
    engine = hands.imgui.test_engine
    ref = engine.TestRef(number)
    c.scroll_to_item_y(ref)
    c.yield_(2)
    at = c.item_info(ref).rect_full.min
    return f"{engine.find_item_debug_label(c.ui_context, number)!r} at {at.x:.0f}, {at.y:.0f}"


def deed(c, path, value):
    """Press a control, choose a word from its list, or type a number into it."""
    c.set_ref("//Controls")
    if isinstance(value, str):
        choose(c, *path.split("/##"), value)
    elif value is not None:
        c.item_input_value(path, value)
    else:
        c.item_click(path)
    c.yield_(2)


@pytest.mark.parametrize("situation", SITUATIONS)
def test_every_control_is_in_the_tables_and_does_what_they_say(hands, situation, request):
    path, come, rows = SITUATIONS[situation]
    panel = path.split("/")[0]
    come(hands)
    at_rest(hands)
    request.getfixturevalue("held_back")  # what is begun below still goes on when one looks
    request.getfixturevalue("piece_by_piece")

    def script(c):
        opened(c, path)
        for folded in ("place", "camera") if panel == "Scene" else ():
            c.item_open(f"Scene/{folded}")
        c.yield_(2)
        listed = {*(f"{panel}/{label}" for label in rows), *knob_paths(c, panel)}
        numbers = {c.get_id(label): label for label in listed}
        drawn = found(hands, c, panel)
        assert not [named(hands, c, number) for number in drawn - set(numbers)]
        assert not [numbers[number] for number in set(numbers) - drawn]

    hands.do(script)
    before = hands.state
    for label, row in rows.items():
        if isinstance(row, str):
            continue
        value, check = (None, row) if callable(row) else row
        hands.do(lambda c, where=f"{panel}/{label}", value=value: deed(c, where, value))
        assert check(before, hands.state), label
        hands.window.state = before
        at_rest(hands)
    hands.do(lambda c: c.mouse_move_to_pos((2.0, 2.0)))


def test_every_panel_is_in_a_situation():
    assert {path.split("/")[0] for path, _, _ in SITUATIONS.values()} == set(PANELS)
