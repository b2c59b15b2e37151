"""Every control of the panels stands in the tables below, with what it does.

The panels are drawn in situations that together show all there is to press; what the test
engine finds there must be what the tables say. Whoever adds a control adds a row.
"""

from dataclasses import replace
from time import monotonic

import pytest
from test_controls import PARTS, UNFOLDED, choose, opened

from playground.gui.lightmap import bake_log
from playground.gui.panels import PANELS
from playground.gui.picture.overlay_knobs import Overlays
from playground.gui.pixel.clue import Clue
from playground.gui.radiosity import race_log
from playground.gui.radiosity.factor_table import TITLES
from playground.gui.radiosity.factor_view import FactorView
from playground.gui.rays.snell import MEDIA, Bench
from playground.gui.state import LIGHTMAP, PATHS, RADIOSITY, TRACED
from playground.measure.popping import orbit
from playground.render.gl.bugs import zoo
from playground.scene.knob import knobs
from playground.scene.library import load
from playground.scene.light import SpotLight
from playground.scene.settings import MARKS, SOLVERS, TERMS

pytestmark = pytest.mark.gl
BUG = "missing-max"
SIDES = ("above", "below")
SEVERAL = {"colour": ("/##X", "/##Y", "/##Z", "/##ColorButton"), "vector": ("/$$0", "/$$1", "/$$2")}
# Rows with a check only are pressed, rows with a value choose or type it. Other rows say where
# the control is used instead, or that it has nothing to do with the state.
CONTROLS, FOLDS, SHOWS, TITLE = "test_controls", "folds", "shows a colour", "of a column"
WIDGETS, EXPLAIN, ZOO = "test_widgets", "test_explain_panel", "test_bug_zoo"
SCOPE, COMFORTS, TRACING = "test_popping_panel", "test_comforts", "test_tracing"
FACTORS = "test_form_factor_panel"
RACE, ATLAS = "test_solver_race", "test_lightmap_panel"


def prepare(hands, **changes):
    """A spot light that fades, two objects, the first with a texture."""
    base = load("textured")
    pair = (*base.scene.objects, *load("teapot").scene.objects)[:2]
    hands.load("textured", lights=(SpotLight(attenuate=True),), objects=pair)
    hands.window.state = replace(hands.state, layout="wipe", **changes)
    hands.frames(3)


def with_bug(hands):
    prepare(hands)
    hands.window.state = hands.state.opened(hands.state.setup.with_(bugs=(BUG,)))


def in_game(hands):
    prepare(hands)
    hands.do(lambda c: (opened(c, "Bug zoo"), c.item_click("Bug zoo/Guess the bug")))


def picked(hands):
    hands.load("teapot", shading="per-vertex")
    hands.window.state = replace(hands.state, pixel=(0.5, 0.5), clue=Clue())


def at_bench(hands):
    """From glass into air: there is a critical angle."""
    prepare(hands, bench=Bench(above=1.5, below=1.0, angle=20.0))


def followed(hands):
    """A pixel of the glass sphere, its rays up to the first of two bounces."""
    hands.load("whitted-room", depth=2)
    hands.window.state = replace(hands.state, method=TRACED, pixel=(0.66, 0.63), clue=Clue())
    hands.frames(3)
    hands.window.state = replace(hands.state, rays=replace(hands.state.rays, step=1))


def solving(hands):
    hands.load("cornell-box", patches=60)
    shown = replace(hands.state.solving, by_bounce=True)
    hands.window.state = replace(hands.state, method=RADIOSITY, solving=shown)
    hands.frames(3)


def paired(hands):
    """Two patches that face each other, and all that is told of them."""
    hands.load("facing-plates", patches=60)
    hands.window.state = replace(hands.state, factors=FactorView(picking=True))
    until = monotonic() + 60
    while hands.state.factors.of is None and monotonic() < until:
        hands.frames(1)
    view = replace(hands.state.factors, one=1, other=len(hands.state.factors.of) - 2)
    hands.window.state = replace(hands.state, factors=view)
    at_rest(hands)


def at_rest(hands):
    """Wait until all is told of the chosen patches: what arrives moves the controls below it."""
    until = monotonic() + 60
    hands.frames(2)
    while hands.window.slots.factors.now.working and monotonic() < until:
        hands.frames(1)
    hands.frames(2)


def after_race(hands):
    """One solver has run to its end."""
    hands.load("furnace", patches=60)
    race = replace(hands.state.race, solvers=("conjugate-gradients",), books_of="jacobi")
    hands.window.state = race_log.started(replace(hands.state, race=race))
    until = monotonic() + 60
    while hands.state.race.running and monotonic() < until:
        hands.frames(1)
    race = replace(hands.state.race, solvers=SOLVERS, books_of="conjugate-gradients")
    hands.window.state = replace(hands.state, race=race)


def with_lightmap(hands):
    """A setup that was baked."""
    hands.load("facing-plates", patches=60)
    small = replace(hands.state.bake, size=32, rays=0)
    hands.window.state = bake_log.asked(replace(hands.state, bake=small))
    until = monotonic() + 60
    while hands.state.bake.running and monotonic() < until:
        hands.frames(1)


def off_path(hands):
    """The scope was measuring, was stopped, and then the camera left."""
    hands.load("popping")
    hands.do(lambda c: (opened(c, "Popping scope"), c.item_click("Popping scope/###measure")))
    hands.window.state = hands.state.with_setup(hands.state.setup.with_(target=(0.1, 0.2, 0.3)))


def with_dots(hands):
    hands.load("popping")
    hands.do(lambda c: opened(c, "Speed and error"))
    hands.frames(3)
    until = monotonic() + 60
    while hands.state.speed.of is not None and monotonic() < until:
        hands.frames(1)


def material(state):
    return state.setup.scene.objects[0].material


def lights(state):
    return state.setup.scene.lights


def back(state):
    return state.setup.camera.target == orbit(state.scope.of.camera, 0.0).target


def overlay(name):
    return lambda old, new: getattr(new.overlays, name)


def sharpness(value):
    return lambda old, new: material(new).shininess == value


def metric(name):
    return lambda old, new: new.needs.metric == name


def of_medium(side, name):
    return lambda old, new: getattr(new.bench, side) == MEDIA[name]


def leaves_out(name):
    return lambda old, new: name not in new.race.solvers


def coloured(name):
    return lambda old, new: new.factors.colouring == name


def cuts_off(ray):
    return lambda old, new: new.rays.pruned == {ray}


def chooses_ray(ray):
    return lambda old, new: new.rays.chosen == ray


def shows_bug(name):
    return lambda old, new: new.setup.settings.bugs == (name,)


SITUATIONS = {  # panel, how to come there, its controls but for the knobs of the setup
    "view": (
        "View",
        prepare,
        {
            "raster##method": TRACING,
            "ray-tracing##method": lambda old, new: new.method == TRACED,
            "radiosity##method": lambda old, new: new.method == RADIOSITY,
            "lightmap##method": lambda old, new: new.method == LIGHTMAP,
            "##layout": WIDGETS,
            "##first": ("path-traced", lambda old, new: new.first == PATHS),
            "##other": ("reference", lambda old, new: new.other == "reference"),
            "Frame": lambda old, new: new.setup.camera != old.setup.camera,
            "###orbit": lambda old, new: new.playing,
            "Reset": lambda old, new: new.setup == old.loaded,
            **{name.replace("_", " "): overlay(name) for name in knobs(Overlays)},
        },
    ),
    "terms": ("Terms", prepare, dict.fromkeys(TERMS, CONTROLS)),
    "material": (
        "Material",
        prepare,
        {
            "##object": ("1  sphere", lambda old, new: new.chosen == 1),
            "##preset": COMFORTS,
            **{f"{value:g}##sh": sharpness(value) for value in (5.0, 10.0, 20.0, 80.0)},
        },
    ),
    "lights": (
        UNFOLDED,
        prepare,
        {
            "Add a light": lambda old, new: len(lights(new)) == 2,
            "$$0/##swatch": SHOWS,
            "$$0/###light": FOLDS,
            "$$0/###light/##type": CONTROLS,
            "$$0/###light/solo": lambda old, new: new.solo == 0,
            "$$0/###light/×": lambda old, new: lights(new) == (),
        },
    ),
    "scene": (
        "Scene",
        prepare,
        {
            "##object": ("1  sphere", lambda old, new: new.chosen == 1),
            "##mesh": CONTROLS,
            "place": FOLDS,
            "camera": FOLDS,
        },
    ),
    "display": (
        "Display",
        prepare,
        {
            "light##theme": lambda old, new: new.theme == "light",
            "dark##theme": lambda old, new: new.theme == "dark",
            "##text_size": (1.25, lambda old, new: new.text_size == 1.25),
            **{f"##colour of {kind}": SHOWS for kind in MARKS},
        },
    ),
    "zoo": (
        "Bug zoo",
        with_bug,
        {
            "Guess the bug": lambda old, new: new.guess.number == 1,
            "##series": (7, lambda old, new: new.guess.series == 7),
            "Hold: drawn right": ZOO,
            "All off": lambda old, new: new.setup.settings.bugs == (),
            **{f"{name}/{bug.title}": CONTROLS for name, bug in zoo().items()},
            **{f"{name}/Show me": shows_bug(name) for name in zoo()},
            **{f"{name}/in the shader": FOLDS for name in zoo()},
        },
    ),
    "game": (
        "Bug zoo",
        in_game,
        {
            **{f"###{name}": ZOO for name in zoo()},
            "###next": lambda old, new: new.guess.over,
            "Hold: drawn right": ZOO,
            "End": lambda old, new: new.guess.number == 0,
        },
    ),
    "explain": (
        "Explain",
        picked,
        {
            "×##forget": lambda old, new: new.pixel is None,
            **{f"###corner {name}": EXPLAIN for name in "ABC"},
            **{f"##vertex {name}": SHOWS for name in "ABC"},
            "###light 0": EXPLAIN,
            "##light 0": SHOWS,
            **{f"##{name} 0": SHOWS for name in TERMS[:3]},
            **{f"##{name}": SHOWS for name in ("emissive", "corner", "sum", "shown")},
            **{f"{name}##filter": EXPLAIN for name in TERMS[:3]},
        },
    ),
    "rays": (
        "Explain",
        followed,
        {
            "×##forget": lambda old, new: new.pixel is None,
            "−##bounce": lambda old, new: new.rays.step == old.rays.step - 1,
            "+##bounce": lambda old, new: new.rays.grows_to(2) == 3.0,
            "###grow": lambda old, new: new.rays.playing,
            "##tree": TRACING,
            "##pixel": SHOWS,
            "##left": SHOWS,
            **{f"##ray {i}": SHOWS for i in range(5)},
            **{f"##keep {i}": cuts_off(i) for i in range(5)},
            **{f"###row {i}": chooses_ray(i) for i in range(5)},
        },
    ),
    "tracing": (
        "Ray tracing",
        prepare,
        {
            "##boxes": lambda old, new: new.chalk.boxes,
            "##level": (3, lambda old, new: new.chalk.level == 3),
            "##tests": lambda old, new: new.chalk.tests,
        },
    ),
    "radiosity": (
        "Radiosity",
        solving,
        {
            "###play": lambda old, new: not new.solving.playing,
            "Step": lambda old, new: new.solving.singles == old.solving.singles + 1,
            "Restart": lambda old, new: new.solving.restarts == old.solving.restarts + 1,
            "flat patches": lambda old, new: new.setup.settings.shading == "flat",
            "outlines of the patches": lambda old, new: new.solving.outlines,
            "mark who shoots": lambda old, new: new.solving.shooter,
            "by bounce": lambda old, new: not new.solving.by_bounce,
            "##bounces": (3, lambda old, new: new.solving.bounces == 3),
        },
    ),
    "race": (
        "Solvers",
        after_race,
        {
            **{f"lanes/##{name}": leaves_out(name) for name in SOLVERS},
            **{
                f"lanes/$${i}/{title}": TITLE
                for i, title in enumerate(("solver", "steps", "time", "rows", "left"))
            },
            "##goal": ("1e-3", lambda old, new: new.race.goal == "1e-3"),
            "time##against": RACE,
            "steps##against": lambda old, new: new.race.against == "steps",
            "light left##drawn": RACE,
            "error##drawn": lambda old, new: new.race.drawn == "error",
            "###race": lambda old, new: new.race.running,
            "Copy as CSV": lambda old, new: "copied" in new.message,
            "##books_of": ("direct", lambda old, new: new.race.books_of == "direct"),
            "##channel": ("red", lambda old, new: new.race.channel == "red"),
        },
    ),
    "lightmap": (
        "Lightmap",
        with_lightmap,
        {
            "##size": (64, lambda old, new: new.bake.size == 64),
            "##rays": (16, lambda old, new: new.bake.rays == 16),
            "###bake": lambda old, new: new.bake.running,
            "###draw": lambda old, new: new.method == LIGHTMAP,
            "Forget it": lambda old, new: new.setup.scene.lightmap == "",
            "all##light_shown": ATLAS,
            "direct##light_shown": lambda old, new: new.setup.settings.light_shown == "direct",
            "indirect##light_shown": lambda old, new: new.setup.settings.light_shown == "indirect",
            "borders": lambda old, new: not new.atlas.borders,
            "dilated": lambda old, new: not new.atlas.dilated,
            "##zoom": (4.0, lambda old, new: new.atlas.zoom == 4.0),
            "##atlas": ATLAS,
        },
    ),
    "factors": (
        "Form factors",
        paired,
        {
            "##picking": lambda old, new: not new.factors.picking,
            "Swap##pair": lambda old, new: new.factors.one == old.factors.other,
            "×##pair": lambda old, new: new.factors.one is None,
            "##resolution": (16, lambda old, new: new.factors.resolution == 16),
            **{f"{name}##colouring": coloured(name) for name in ("light", "delta", "patch")},
            "##hemicube": FACTORS,
            "##across": (0.25, lambda old, new: new.factors.across == 0.25),
            "##along": (0.75, lambda old, new: new.factors.along == 0.75),
            **{f"methods/$${i}/{title}": TITLE for i, title in enumerate(TITLES)},
        },
    ),
    "bench": (
        "Snell bench",
        at_bench,
        {
            **{f"{name}##{side}": of_medium(side, name) for name in MEDIA for side in SIDES},
            "##above": (1.7, lambda old, new: new.bench.above == 1.7),
            "##below": (1.2, lambda old, new: new.bench.below == 1.2),
            "##angle": (33.0, lambda old, new: new.bench.angle == 33.0),
            "##ray": TRACING,
            "The other way": lambda old, new: new.bench.above == old.bench.below,
            "To the critical angle": lambda old, new: new.bench.angle == old.bench.critical,
        },
    ),
    "scope": (
        "Popping scope",
        off_path,
        {
            "###play": lambda old, new: new.scope.playing,
            "##angle": SCOPE,
            "###measure": lambda old, new: new.scope.running,
            "Back to the path": lambda old, new: back(new),
            "jumps/$$0/largest jump": TITLE,
            "jumps/$$1/brightest": TITLE,
            "jumps/$$2/mean": TITLE,
        },
    ),
    "speed": (
        "Speed and error",
        with_dots,
        {
            "measure what I try": lambda old, new: not new.speed.automatic,
            "###measure": lambda old, new: new.speed.of is not None,
            "Copy as CSV": lambda old, new: "copied" in new.message,
            "Clear": lambda old, new: old.speed.dots and new.speed.dots == (),
        },
    ),
    "needs": (
        "What the scene needs",
        prepare,
        {
            "##budget": (0.25, lambda old, new: new.needs.budget == 0.25),
            **{f"{name}##metric": metric(name) for name in ("rmse", "flip", "max")},
            "###measure": lambda old, new: new.needs.running,
        },
    ),
}
PLOTS = ("##brightest point of the highlight", "##mean brightness", "##dots", "##race", "##energy")
PLOT_PARTS = 8  # ImPlot numbers the area and the axes of a plot after the plot


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
def test_every_control_is_in_the_tables_and_does_what_they_say(hands, situation):
    path, come, rows = SITUATIONS[situation]
    panel = path.split("/")[0]
    come(hands)

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
