"""Everything the window shows, as one frozen value: the interface is a function of it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

from playground.gui.guess import Guess
from playground.gui.history import History
from playground.gui.lesson.lesson_course import Course
from playground.gui.lightmap.atlas_look import AtlasLook
from playground.gui.lightmap.bake_log import BakeLog
from playground.gui.measure.needs_log import NeedsLog
from playground.gui.measure.scope_path import Scope
from playground.gui.measure.speed_log import SpeedLog
from playground.gui.picture.gizmos import Grip
from playground.gui.picture.mark_log import MarkLog
from playground.gui.picture.overlay_knobs import Overlays
from playground.gui.picture.stand import Stand
from playground.gui.pixel.clue import Clue
from playground.gui.presentation import backdrop
from playground.gui.radiosity.factor_view import FactorView
from playground.gui.radiosity.race_log import RaceLog
from playground.gui.radiosity.solving import Solving
from playground.gui.rays.ray_view import RayView
from playground.gui.rays.snell import Bench
from playground.gui.rays.trace_knobs import TraceChalk
from playground.gui.reading import Reading
from playground.scene.knob import Declared, choice, number, switch
from playground.scene.scene import Scene
from playground.scene.settings import Shading
from playground.scene.setup import Setup

CODE_VIEWS = ("files", "move the code")
TWINS = ("none", "NumPy", "HLSL", "Cg")
Texts = tuple[tuple[str, str], ...]  # files of shaders/ and what stands in them
FIVE = "five answers"
LAYOUTS = ("single", "side by side", "wipe", "terms", "difference", FIVE)
REFERENCE = "reference"  # the float64 picture of the NumPy renderer, among the shadings
PATHS = "path-traced"  # the picture by chance, for checking, also by NumPy
RASTER, TRACED, RADIOSITY, LIGHTMAP = METHODS = ("raster", "ray-tracing", "radiosity", "lightmap")
PAIRED = ("side by side", "wipe", "difference")  # layouts with two pictures
CHOSEN = "as chosen"  # the first of two is made by the method and the shading
STORED = (RADIOSITY, LIGHTMAP)  # these show light that was computed before
SMALLEST_TEXT, LARGEST_TEXT = 0.8, 2.5


class Moment(NamedTuple):
    """What undo and redo lead to."""

    setup: Setup
    method: str


@dataclass(frozen=True)
class State(Declared):
    """The setup and how the window shows it.

    ``loaded`` is what reset goes back to, ``file`` where save writes. ``solo`` is the
    number of the light that shines alone. ``wish`` asks the window for what only it can
    do after this frame: ``"picture"``, ``"command"``, ``"full screen"`` or ``"quit"``.
    """

    label = "window"

    setup: Setup = field(default_factory=Setup)
    loaded: Setup = field(default_factory=Setup)
    history: History[Moment] = field(default_factory=History)
    file: Path | None = None
    chosen: int = 0  # number of the object whose material and place are shown
    solo: int | None = None
    sheet: str = ""  # the sheet that lies over the window: "", "shortcuts" or "open"
    typed: str = ""  # what stands in the text field of the open sheet
    message: str = ""
    failed: bool = False
    wish: str = ""
    reading: Reading | None = None  # the file that is being read beside the window
    source: str = ""  # what the loaded setup is called on a command line
    recent: tuple[str, ...] = ()  # files that were opened or saved, the newest first
    kept: tuple[bool, str, float, bool] | None = None  # of the window, while presenting
    code_file: str = "shade.glsl"  # the shader file that is shown
    edits: Texts = ()  # what the user made of shader files; never part of the setup
    on_disk: Texts = ()  # shader files that have changed on disk since the window opened
    shader_error: str = ""  # why the last good shaders run in place of the edited ones
    lesson: Course | None = None  # the lesson that is open beside the picture
    guess: Guess = field(default_factory=Guess)
    scope: Scope = field(default_factory=Scope)
    speed: SpeedLog = field(default_factory=SpeedLog)
    needs: NeedsLog = field(default_factory=NeedsLog)
    mark_log: MarkLog = field(default_factory=MarkLog)
    race: RaceLog = field(default_factory=RaceLog)
    bake: BakeLog = field(default_factory=BakeLog)
    atlas: AtlasLook = AtlasLook()
    pixel: tuple[float, float] | None = None  # that is explained: shares of width and height
    clue: Clue = field(default_factory=Clue)
    stand: Stand | None = None  # where the viewer of that pixel stands, seen from the side
    unfold: str = ""  # the panel to open at the next frame
    overlays: Overlays = Overlays()
    grip: Grip | None = None  # the handle in the picture that the mouse holds
    lamp: int = 0  # number of the light whose handle the mouse touched last: it has arrows
    hint: str = ""  # what can be done with what is under the mouse
    rays: RayView = RayView()  # how the rays behind the pixel are shown
    chalk: TraceChalk = TraceChalk()
    solving: Solving = Solving()
    bench: Bench = Bench()
    factors: FactorView = FactorView()
    smooth: int = 1  # setups are opened with at least so many samples per pixel

    method: str = choice(
        RASTER, METHODS, help="how the picture is made: by triangles, by rays, or of light stored"
    )
    layout: str = choice("single", LAYOUTS, help="one picture, two to compare, or term by term")
    first: str = choice(
        CHOSEN,
        (CHOSEN, REFERENCE, PATHS),
        help="what is compared: by the method above, or by NumPy",
    )
    other: str = choice(
        Shading.PER_VERTEX.value,
        (*(mode.value for mode in Shading), REFERENCE, TRACED, RADIOSITY, LIGHTMAP, PATHS),
        help="what it is compared with; reference: per-fragment in float64; "
        "path-traced: diffuse light by chance, to check radiosity; both by NumPy",
    )
    wipe: float = number(0.5, 0.0, 1.0, help="where the divider stands; drag it in the picture")
    magnify: float = number(
        4.0, 1.0, 255.0, scale="log", help="the difference 1/magnify and more is yellow"
    )
    playing: bool = switch(False, help="the camera walks around the target")
    panel: bool = switch(True, help="show the controls")
    shaders: bool = switch(False, help="show the shaders below the picture")
    shaders_share: float = number(0.55, 0.2, 0.8, help="of the height; drag the edge")
    code_view: str = choice(
        "files", CODE_VIEWS, help="the files that run, or where the call of the model stands"
    )
    twin: str = choice("NumPy", TWINS, help="the same code in another language, beside the file")
    level: str = choice("full", ("beginner", "full"), help="how many panels are shown")
    presentation: str = choice(
        "off", ("off", "black", "white"), help="the picture alone, on this background"
    )
    theme: str = choice("dark", ("dark", "light"), help="colours of the window")
    text_size: float = number(
        1.0, SMALLEST_TEXT, LARGEST_TEXT, help="size of the text; larger for a projector"
    )

    @property
    def moment(self) -> Moment:
        """What undo leads back to."""
        return Moment(self.setup, self.method)

    @property
    def mode(self) -> str:
        """What the first picture is called where two are compared."""
        if self.first != CHOSEN and self.layout in PAIRED:
            return self.first
        return self.setup.settings.shading if self.method == RASTER else self.method

    def say(self, message: str) -> State:
        """The same with a message in the status line."""
        return replace(self, message=message, failed=False)

    def fail(self, message: object) -> State:
        """The same with an error in the status line."""
        return replace(self, message=str(message), failed=True)

    def with_setup(self, setup: Setup) -> State:
        """The same with another setup; the history is kept by the frame, not here."""
        return replace(self, setup=setup)

    def opened(self, setup: Setup, file: Path | None = None) -> State:
        """The same window with another setup loaded; undo leads back to the old one."""
        if setup.settings.samples < self.smooth:
            setup = setup.with_(samples=self.smooth)
        same = self.other == setup.settings.shading  # there would be nothing to compare
        return replace(
            self,
            other=unlike(setup) if same else self.other,
            setup=setup,
            loaded=setup,
            file=file,
            source="",
            chosen=0,
            solo=None,
            playing=False,
            sheet="",
            reading=None,
            guess=Guess(series=self.guess.series),  # no hidden mistake in what is opened next
        ).unpicked()

    def unpicked(self) -> State:
        """The same without a pixel to explain."""
        return replace(self, pixel=None, clue=replace(self.clue, lit="", seen=None))


def start(setup: Setup, smooth: int = 1) -> State:
    """The state of a window that has just opened on ``setup``."""
    return State(other=unlike(setup), smooth=smooth).opened(setup)


def unlike(setup: Setup) -> str:
    """The shading that a setup is compared with at first."""
    modes = (Shading.PER_VERTEX.value, Shading.PER_FRAGMENT.value)
    return modes[setup.settings.shading == modes[0]]


def shown(state: State) -> Setup:
    """The setup as the pictures show it: with the soloed light alone, if there is one."""
    setup, lights = state.setup, state.setup.scene.lights
    background = backdrop(state)
    if background:
        setup = replace(setup, scene=_before(setup.scene, background))
    if state.solo is None or state.solo >= len(lights):
        return setup
    return replace(setup, scene=_alone(setup.scene, state.solo))


@lru_cache(maxsize=16)
def _before(scene: Scene, background: tuple[float, float, float]) -> Scene:
    return replace(scene, background=background)


@lru_cache(maxsize=16)
def _alone(scene: Scene, light: int) -> Scene:
    # The same scene gives the same object again: renderers notice change by identity.
    return replace(scene, lights=(scene.lights[light],))
