"""Situations of the panels that trace rays, solve radiosity, and measure."""

from dataclasses import replace

from situations import SHOWS, TITLE, at_rest, prepare
from test_controls import opened

from playground.gui.lightmap import bake_log
from playground.gui.pixel.clue import Clue
from playground.gui.radiosity import race_log
from playground.gui.radiosity.factor_table import TITLES
from playground.gui.radiosity.factor_view import FactorView
from playground.gui.rays.snell import MEDIA, Bench
from playground.gui.state import LIGHTMAP, RADIOSITY, TRACED
from playground.measure.popping import orbit
from playground.scene.settings import SOLVERS

SIDES = ("above", "below")
RAYS, BENCH, RACE = "test_tracing_rays", "test_snell_bench", "test_solver_race"
FACTORS, ATLAS, SCOPE = "test_form_factor_panel", "test_lightmap_panel", "test_popping_panel"


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
    hands.until(lambda: hands.state.factors.of is not None)
    view = replace(hands.state.factors, one=1, other=len(hands.state.factors.of) - 2)
    hands.window.state = replace(hands.state, factors=view)
    at_rest(hands)


def after_race(hands):
    """One solver has run to its end."""
    hands.load("furnace", patches=60)
    race = replace(hands.state.race, solvers=("conjugate-gradients",), books_of="jacobi")
    hands.window.state = race_log.started(replace(hands.state, race=race))
    hands.until(lambda: not hands.state.race.running)
    race = replace(hands.state.race, solvers=SOLVERS, books_of="conjugate-gradients")
    hands.window.state = replace(hands.state, race=race)


def with_lightmap(hands):
    """A setup that was baked."""
    hands.load("facing-plates", patches=60)
    small = replace(hands.state.bake, size=32, rays=0)
    hands.window.state = bake_log.asked(replace(hands.state, bake=small))
    hands.until(lambda: not hands.state.bake.running)
    assert hands.state.setup.scene.lightmap


def off_path(hands):
    """The scope was measuring, was stopped, and then the camera left."""
    hands.load("popping")
    hands.do(lambda c: (opened(c, "Popping scope"), c.item_click("Popping scope/###measure")))
    hands.window.state = hands.state.with_setup(hands.state.setup.with_(target=(0.1, 0.2, 0.3)))


def with_dots(hands):
    hands.load("popping")
    hands.do(lambda c: opened(c, "Speed and error"))
    hands.frames(3)
    hands.until(lambda: hands.state.speed.of is None)


def back(state):
    return state.setup.camera.target == orbit(state.scope.of.camera, 0.0).target


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


OF_LIGHT = {  # panel, how to come there, its controls but for the knobs of the setup
    "rays": (
        "Explain",
        followed,
        {
            "×##forget": lambda old, new: new.pixel is None,
            "−##bounce": lambda old, new: new.rays.step == old.rays.step - 1,
            "+##bounce": lambda old, new: new.rays.grows_to(2) == 3.0,
            "###grow": lambda old, new: new.rays.playing,
            "##tree": RAYS,
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
            "##ray": BENCH,
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
}
