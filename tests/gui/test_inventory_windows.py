"""The shaders, the menus and the sheets: every control is in a table, and does what it says.

As in `test_inventory`: what the test engine finds in a window must be what its table says.
The menus are built from the table of actions; here each is chosen by the mouse.
"""

from dataclasses import replace
from pathlib import Path

import pytest
from situations import TITLE
from test_controls import choose, opened
from test_inventory import found, named
from test_needs_panel import measured

from playground.gui.measure.needs_log import NOTHING, dropped
from playground.gui.shader.shader_edit import running
from playground.gui.shortcuts import ACTIONS
from playground.gui.state import CODE_VIEWS, FIVE, TWINS
from playground.measure.advice import METRICS
from playground.scene.library import library
from playground.scene.settings import TERMS, Shading

pytestmark = pytest.mark.gl
EDITOR = "test_shaders_panel"  # where what can be done with code is tested
NEEDS, DROPS = "What the scene needs", "drops a part"
POINT = (380.0, 320.0)  # in the window, on the teapot
CHECKED = 1 << 23  # ImGuiItemStatusFlags_Checked, which only the test engine has
NONSENSE = (("shade.glsl", "nonsense\n"),)


def gathered(hands, c, where):
    items = hands.imgui.test_engine.TestItemList()
    c.gather_items(items, where, -1)
    return {items[i].id_ for i in range(items.get_size())}


def compared(hands, window, rows, scrolling=""):
    """The items of a window are its rows; those in the part that scrolls count as one."""

    def script(c):
        numbers = {c.get_id(f"//{window}/{label}"): label for label in rows}
        drawn = gathered(hands, c, f"//{window}")
        if scrolling:
            part = c.window_info(f"//{window}/{scrolling}").window.id_
            drawn -= gathered(hands, c, hands.imgui.test_engine.TestRef(part))
        assert not [named(hands, c, number) for number in drawn - set(numbers)]
        assert not [numbers[number] for number in set(numbers) - drawn]

    hands.do(script)


def used(hands, window, rows):
    """Press every control of the table that has a check."""
    before = hands.state
    for label, check in rows.items():
        if isinstance(check, str):
            continue
        hands.do(lambda c, where=f"//{window}/{label}": (c.item_click(where), c.yield_(2)))
        assert check(before, hands.state), label
        hands.window.state = before
        hands.frames(2)


def lib(old, new):
    return new.code_file == "lib/phong.glsl"


def files_of_teapot(state):
    """A tab per file that runs; pressing one shows the file."""
    tabs = {f"###{file}".replace("/", "\\/"): "shows a file" for file in running(state)}
    return tabs | {"###lib\\/phong.glsl": lib}


CODE_VIEW = {
    f"{view}##code_view": lambda old, new, view=view: new.code_view == view for view in CODE_VIEWS
}
FRAME = {"×": lambda old, new: not new.shaders, "edge": "dragged in test_shaders_panel"}


def test_the_shaders(hands):
    hands.load("teapot")
    hands.window.state = replace(hands.state, shaders=True, edits=NONSENSE, code_view="files")
    hands.frames(4)
    rows = {
        **FRAME,
        **CODE_VIEW,
        **files_of_teapot(hands.state),
        "##twin": "chosen below",
        "##file": EDITOR,
        "##twin code": EDITOR,
        "Revert file": lambda old, new: new.edits == (),
        "Revert all": lambda old, new: new.edits == (),
        "###error": lambda old, new: new.code_file == "shade.glsl",
    }
    compared(hands, "Shaders", rows)
    used(hands, "Shaders", rows)
    for twin in TWINS:
        hands.do(lambda c, twin=twin: choose(c, "//Shaders", "twin", twin))
        assert hands.state.twin == twin


def test_the_shaders_move_the_code(hands):
    hands.load("teapot", shading="per-fragment")
    hands.window.state = replace(hands.state, shaders=True, edits=NONSENSE, code_view=CODE_VIEWS[1])
    hands.frames(4)
    rows = {
        **FRAME,
        **CODE_VIEW,
        "Revert all": lambda old, new: new.edits == (),
        "###error": lambda old, new: (new.code_file, new.code_view) == ("shade.glsl", "files"),
        "per-vertex/##move": EDITOR,
        "per-fragment/##move": EDITOR,
        "per-vertex/gouraud.vert: the model once per vertex": shading("per-vertex"),
        "per-fragment/phong.frag: the model once per fragment": shading("per-fragment"),
    }
    compared(hands, "Shaders", rows)
    used(hands, "Shaders", rows)


def shading(mode):
    return lambda old, new: new.setup.settings.shading == mode


def term(name):
    return lambda old, new: {*new.setup.settings.terms} ^ {*old.setup.settings.terms} == {name}


def overlay(name):
    return lambda old, new: getattr(new.overlays, name) != getattr(old.overlays, name)


def camera(old, new):
    return new.setup.camera != old.setup.camera and new.setup.scene is old.setup.scene


def turned(name):
    return lambda old, new: getattr(new, name) != getattr(old, name)


def sheet(name):
    return lambda old, new: new.sheet == name


CHOSEN = {  # what each line of the menus does, on the teapot with a pixel and a step to undo
    "Open...": sheet("open"),
    "Save setup": lambda old, new: Path("teapot.toml").is_file(),
    "Save as...": sheet("save"),
    "Save picture": lambda old, new: Path("teapot.png").is_file(),
    "Copy as command line": lambda old, new: "copied" in new.message,
    "Quit": "ends the window",
    "Undo": lambda old, new: new.setup != old.setup,
    "Redo": lambda old, new: new.message == "nothing to be done again",
    "Reset to the loaded setup": lambda old, new: new.setup == new.loaded,
    **{mode.value: shading(mode.value) for mode in Shading},
    "Ray tracing, or back": turned("method"),
    "Radiosity, or back": turned("method"),
    "Lightmap, or back": turned("method"),
    "Solve on, or wait": lambda old, new: new.solving.playing != old.solving.playing,
    "One step": lambda old, new: new.solving.singles == old.solving.singles + 1,
    "Solve from the beginning": lambda old, new: new.solving.restarts > old.solving.restarts,
    "One scene, five answers": lambda old, new: new.layout == FIVE,
    **{f"{name} on or off": term(name) for name in TERMS},
    **dict.fromkeys(("Go on", "Back", "Close the lesson"), "need a lesson: test_lesson"),
    "Frame the objects": camera,
    "Walk around, or stop": turned("playing"),
    "Arrows from the side, or back": lambda old, new: new.stand is not None,
    **{f"Orbit {way}": camera for way in ("left", "right", "up", "down")},
    **{f"Move {way}": camera for way in ("left", "right", "up", "down")},
    "Nearer": camera,
    "Farther": camera,
    "Compare: next layout": turned("layout"),
    "Presentation: black, white": turned("presentation"),
    "End the presentation": "hides the menu: test_comforts",
    "Full screen, or back": "is the window's: test_comforts",
    "Beginner or full layout": turned("level"),
    "Show or hide the controls": turned("panel"),
    "Shaders, to read and edit": turned("shaders"),
    "Wireframe": overlay("wireframe"),
    "Normals": overlay("vertex_normals"),
    "Axes": overlay("axes"),
    "Handles of the lights": overlay("move_lights"),
    "Handles of the object": overlay("move_object"),
    "Dark or light": turned("theme"),
    "Larger text": turned("text_size"),
    "Smaller text": turned("text_size"),
    "Usual text": lambda old, new: new.text_size == 1.0,
    "Forget the explained pixel": lambda old, new: new.pixel is None,
    "Keys": sheet("shortcuts"),
}


def test_every_line_of_the_menus_does_what_it_says(hands, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert {*CHOSEN} == {action.name for action in ACTIONS}
    hands.load("teapot")
    hands.click(*POINT)
    hands.key("left_arrow")
    hands.frames(30)  # the mouse may have rested on something
    before = hands.state
    assert before.pixel is not None and before.setup != before.loaded
    for action in ACTIONS:
        check = CHOSEN[action.name]
        if isinstance(check, str):
            continue
        path = f"//##MainMenuBar/{action.menu}/{action.name}"
        hands.do(lambda c, path=path: (c.menu_click(path), c.yield_(3)))
        assert check(before, hands.state) or action.name == before.setup.settings.shading, path
        hands.window.state = before
        hands.frames(2)


def test_the_menus_tick_what_is_on(hands):
    hands.load("teapot", terms=("diffuse",))
    switches = [action for action in ACTIONS if action.on is not None]
    names = {action.name for action in switches}
    assert {mode.value for mode in Shading} | {f"{name} on or off" for name in TERMS} <= names
    assert {"Wireframe", "Normals", "Axes", "Show or hide the controls"} <= names
    engine = hands.imgui.test_engine

    def script(c):
        c.set_ref("//##MainMenuBar")
        for menu in dict.fromkeys(action.menu for action in switches):
            c.menu_action(engine.TestAction.open, menu)
            c.yield_(2)
            for action in switches:
                if action.menu != menu:
                    continue
                flags = c.item_info(f"//###Menu_00/{action.name}").status_flags
                assert bool(flags & CHECKED) == action.on(hands.state), action.name

    hands.do(script)
    hands.key("escape")


def test_setups_and_recent_files_open_from_the_menus(hands, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    hands.key("s", "ctrl")
    saved = str(tmp_path / "teapot.toml")
    for name in library():
        hands.do(lambda c, name=name: c.menu_click(f"//##MainMenuBar/Setups/{name}"))
        assert hands.state.loaded.name == name
    line = saved.replace("/", "\\/")
    hands.do(lambda c: c.menu_click(f"//##MainMenuBar/File/Open recent/{line}"))
    assert hands.state.file == Path(saved)


def test_escape_closes_a_menu_and_nothing_else(hands):
    hands.load("teapot")
    hands.click(*POINT)
    engine = hands.imgui.test_engine
    anything, seen = hands.imgui.PopupFlags_.any_popup.value, []

    def menu(c):
        c.menu_action(engine.TestAction.open, "//##MainMenuBar/File")

    def combo(c):
        c.item_click("//Controls/View/##layout")

    for open_it in (menu, combo):

        def script(c, open_it=open_it):
            open_it(c)
            c.yield_(2)
            seen.append(hands.imgui.is_popup_open("", anything))
            c.key_press(hands.imgui.Key.escape.value)
            c.yield_(2)
            seen.append(hands.imgui.is_popup_open("", anything))

        hands.do(script)
        assert hands.state.pixel is not None
    assert seen == [True, False, True, False]
    hands.key("escape")
    assert hands.state.pixel is None


def test_escape_forgets_the_pixel_before_it_ends_the_presentation(hands):
    hands.load("teapot")
    hands.key("f5")
    hands.click(*POINT)
    hands.key("escape")
    assert hands.state.pixel is None and hands.state.presentation == "black"
    hands.key("escape")
    assert hands.state.presentation == "off"


def test_the_sheets(hands, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "folder").mkdir()
    (tmp_path / "notes.txt").write_text("no setup")
    (tmp_path / "mine.toml").write_text("[settings]\nshading = 'flat'\n")
    hands.load("teapot")
    hands.key("slash", "shift")
    compared(hands, "###sheet", {})
    closed_by_its_cross(hands)
    hands.key("s", "ctrl", "shift")
    rows = {
        "##path": "typed in test_comforts",
        "Save": lambda old, new: new.file == Path("teapot.toml") and new.sheet == "",
    }
    compared(hands, "###sheet", rows)
    used(hands, "###sheet", rows)
    closed_by_its_cross(hands)
    hands.key("o", "ctrl")
    assert hands.state.typed == ""  # the name to save is not one to open
    opened = {
        "../": lambda old, new: new.typed == f"{tmp_path.parent}/",
        "folder/": lambda old, new: new.typed == f"{tmp_path}/folder/",
        "mine.toml": lambda old, new: new.loaded.name == "mine" and new.sheet == "",
        "teapot.toml": lambda old, new: new.loaded.name == "teapot" and new.sheet == "",
    }
    rows = {"##path": "typed in test_window", "Open": sheet("open"), "files": "pressed below"}
    compared(hands, "###sheet", rows, "files")
    used(hands, "###sheet", rows)
    for label, check in opened.items():
        before = hands.state
        hands.do(lambda c, label=label: list_click(hands, c, label))
        assert check(before, hands.state), label
        hands.window.state = before
        hands.frames(2)
    closed_by_its_cross(hands)


def closed_by_its_cross(hands):
    hands.do(lambda c: c.window_close("//###sheet"))
    assert hands.state.sheet == ""


def list_click(hands, c, line):
    """Click a line of the list of files, which scrolls by itself."""
    tests = hands.imgui.test_engine
    part = tests.TestRef(c.window_info("//###sheet/files").window.id_)
    lines = {}
    for number in gathered(hands, c, part):
        c.item_info(tests.TestRef(number))  # the engine notes labels of what it was asked for
        lines[tests.find_item_debug_label(c.ui_context, number)] = number
    c.item_click(tests.TestRef(lines[line]))


def test_what_the_scene_needs_once_it_is_measured(hands, piece_by_piece):
    hands.load("sphere")
    hands.window.state = measured()
    hands.do(lambda c: (opened(c, NEEDS), c.yield_(2)))
    hands.frames(2)
    names = [finding.candidate.name for finding in hands.state.needs.findings]
    rows = {
        "##budget": "test_inventory",
        **{f"{name}##metric": "test_inventory" for name in METRICS},
        "###measure": lambda old, new: new.needs.running,
        "Apply proposal": lambda old, new: new.setup == old.needs.advice.proposed,
        "Restore all": "pressed below",
        **{f"needs/$${i}/{title}": TITLE for i, title in enumerate(("drop", "RMSE", "ms less"))},
        **{f"needs/##{name}".replace("/", "\\/").replace("\\/", "/", 1): DROPS for name in names},
    }

    def script(c):
        numbers = {c.get_id(f"//Controls/{NEEDS}/{label}"): label for label in rows}
        drawn = found(hands, c, NEEDS)
        assert not [named(hands, c, number) for number in drawn - set(numbers)]
        assert not [numbers[number] for number in set(numbers) - drawn]

    hands.do(script)
    used(hands, f"Controls/{NEEDS}", rows)
    whole = hands.state.setup
    for name in names:
        box = f"//Controls/{NEEDS}/needs/##{name}"
        hands.do(lambda c, box=box: (c.item_click(box), c.yield_(2)))
        assert {lack.name for lack in dropped(hands.state)} == {name}
        hands.do(lambda c: (c.item_click(f"//Controls/{NEEDS}/Restore all"), c.yield_(2)))
        assert dropped(hands.state) == NOTHING and hands.state.setup == whole
