"""Situations of the panels that say what is lit, how it is shaded and shown, and why."""

from dataclasses import replace

from situations import FOLDS, SHOWS, prepare
from test_controls import UNFOLDED, opened

from playground.gui.picture.overlay_knobs import Overlays
from playground.gui.pixel.clue import Clue
from playground.gui.state import LIGHTMAP, PATHS, RADIOSITY, TRACED
from playground.render.gl.bugs import zoo
from playground.scene.knob import knobs
from playground.scene.settings import MARKS, TERMS

BUG = "missing-max"
CONTROLS, WIDGETS, COMFORTS, TRACING = (
    "test_controls",
    "test_widgets",
    "test_comforts",
    "test_tracing",
)
EXPLAIN, ZOO = "test_explain_panel", "test_bug_zoo"


def with_bug(hands):
    prepare(hands)
    hands.window.state = hands.state.opened(hands.state.setup.with_(bugs=(BUG,)))


def in_game(hands):
    prepare(hands)
    hands.do(lambda c: (opened(c, "Bug zoo"), c.item_click("Bug zoo/Guess the bug")))


def picked(hands):
    hands.load("teapot", shading="per-vertex")
    hands.window.state = replace(hands.state, pixel=(0.5, 0.5), clue=Clue())


def material(state):
    return state.setup.scene.objects[0].material


def lights(state):
    return state.setup.scene.lights


def overlay(name):
    return lambda old, new: getattr(new.overlays, name)


def sharpness(value):
    return lambda old, new: material(new).shininess == value


def metric(name):
    return lambda old, new: new.needs.metric == name


def shows_bug(name):
    return lambda old, new: new.setup.settings.bugs == (name,)


OF_SCENE = {  # panel, how to come there, its controls but for the knobs of the setup
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
