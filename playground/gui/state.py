"""Everything the window shows, as one frozen value: the interface is a function of it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path

from playground.gui.history import History
from playground.scene.knob import Declared, choice, number, switch
from playground.scene.scene import Scene
from playground.scene.settings import Shading
from playground.scene.setup import Setup

LAYOUTS = ("single", "side by side", "wipe", "terms")
SMALLEST_TEXT, LARGEST_TEXT = 0.8, 2.5


@dataclass(frozen=True)
class State(Declared):
    """The setup and how the window shows it.

    ``loaded`` is what reset goes back to, ``file`` where save writes. ``solo`` is the
    number of the light that shines alone. ``wish`` asks the window for what only it can
    do after this frame: ``"picture"`` or ``"quit"``.
    """

    label = "window"

    setup: Setup = field(default_factory=Setup)
    loaded: Setup = field(default_factory=Setup)
    history: History = field(default_factory=History)
    file: Path | None = None
    chosen: int = 0  # number of the object whose material and place are shown
    solo: int | None = None
    sheet: str = ""  # the sheet that lies over the window: "", "shortcuts" or "open"
    typed: str = ""  # what stands in the text field of the open sheet
    message: str = ""
    failed: bool = False
    wish: str = ""
    smooth: int = 1  # setups are opened with at least so many samples per pixel

    layout: str = choice("single", LAYOUTS, help="one picture, two to compare, or term by term")
    other: str = choice(
        Shading.PER_VERTEX.value,
        tuple(mode.value for mode in Shading),
        help="shading of the right picture",
    )
    wipe: float = number(0.5, 0.0, 1.0, help="where the divider stands; drag it in the picture")
    playing: bool = switch(False, help="the camera walks around the target")
    panel: bool = switch(True, help="show the controls")
    theme: str = choice("dark", ("dark", "light"), help="colours of the window")
    text_size: float = number(
        1.0, SMALLEST_TEXT, LARGEST_TEXT, help="size of the text; larger for a projector"
    )

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
        return replace(
            self, setup=setup, loaded=setup, file=file, chosen=0, solo=None, playing=False, sheet=""
        )


def start(setup: Setup, smooth: int = 1) -> State:
    """The state of a window that has just opened on ``setup``."""
    modes = (Shading.PER_VERTEX.value, Shading.PER_FRAGMENT.value)
    other = modes[setup.settings.shading == modes[0]]
    return State(other=other, smooth=smooth).opened(setup)


def shown(state: State) -> Setup:
    """The setup as the pictures show it: with the soloed light alone, if there is one."""
    lights = state.setup.scene.lights
    if state.solo is None or state.solo >= len(lights):
        return state.setup
    return replace(state.setup, scene=_alone(state.setup.scene, state.solo))


@lru_cache(maxsize=16)
def _alone(scene: Scene, light: int) -> Scene:
    # The same scene gives the same object again: renderers notice change by identity.
    return replace(scene, lights=(scene.lights[light],))
