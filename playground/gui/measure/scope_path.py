"""The popping scope as a value: the path of the camera, and what was measured along it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from math import atan2, degrees
from typing import TYPE_CHECKING

from playground.gui.guess import played
from playground.gui.work.long_work import Progress
from playground.measure.popping import Step, orbit
from playground.scene.camera import Camera
from playground.scene.knob import Declared, number
from playground.scene.settings import Settings
from playground.scene.setup import Setup

if TYPE_CHECKING:
    from playground.gui.state import State

ANGLES = tuple(3.0 * i for i in range(121))  # degrees: 0 to 360
SPEED = 24.0  # degrees per second
DRAWN = ("per-vertex", "per-fragment")
EXACT = ("reference",)
CLOSE = 1e-6  # of the distance: nearer than this to the path is on it


Texts = tuple[tuple[str, str], ...]  # files of shaders/ and what stands in them


@dataclass(frozen=True)
class Scope(Declared):
    """What is measured of which setup, and how far along.

    ``of`` is the setup that was asked for; its camera is where the path begins.
    """

    label = "scope"

    of: Setup | None = None
    shaders: Texts = ()  # texts in place of shader files
    running: bool = False
    drawn: tuple[Step, ...] = ()  # per-vertex and per-fragment
    exact: tuple[Step, ...] = ()  # the reference
    progress: Progress = Progress()
    error: str = ""
    playing: bool = False
    angle: float = number(0.0, 0.0, 360.0, unit="degrees", help="where on its path the camera is")


def measured(state: State) -> State:
    """Ask for the measurement of the setup as it is, with the shaders as they are."""
    setup, base = played(state, state.setup), path(state)
    setup = replace(setup, camera=base)  # a new object: the measuring notices by identity
    before = state.scope
    angle = angle_of(base, state.setup.camera, before.angle)
    asked = Scope(setup, shaders(state), True, playing=before.playing, angle=angle or 0.0)
    return replace(state, scope=asked)


def cancelled(state: State) -> State:
    """Stop measuring; what has been measured stays."""
    return replace(state, scope=replace(state.scope, running=False))


def outdated(state: State) -> bool:
    """Whether anything but the camera differs from what was measured."""
    of = state.scope.of
    if of is None or shaders(state) != state.scope.shaders:
        return True
    setup = played(state, state.setup)
    return of.scene != setup.scene or _but_shading(of) != _but_shading(setup)


def shaders(state: State) -> Texts:
    """What takes the place of shader files; of two texts for one file the later counts."""
    return (*state.on_disk, *state.edits)


def _but_shading(setup: Setup) -> Settings:
    return _unshaded(setup.settings)


@lru_cache(maxsize=8)
def _unshaded(settings: Settings) -> Settings:
    return replace(settings, shading=DRAWN[0], samples=1)


def path(state: State) -> Camera:
    """The camera at 0 degrees: that of the plot, or the present one if it has left the path."""
    of, camera = state.scope.of, state.setup.camera
    if of is None or angle_of(of.camera, camera, 0.0) is None:
        return camera
    return of.camera


def off_path(state: State) -> bool:
    """Whether the camera stands somewhere else than on the path of the plot."""
    of = state.scope.of
    return of is not None and angle_of(of.camera, state.setup.camera, 0.0) is None


@lru_cache(maxsize=16)
def angle_of(base: Camera, camera: Camera, near: float) -> float | None:
    """The angle at which ``camera`` stands on the path of ``base``; None if it does not.

    ``near`` decides between 0 and 360.
    """

    def level(of: Camera) -> float:
        return degrees(atan2(of.eye[0] - of.target[0], of.eye[2] - of.target[2]))

    angle = (level(camera) - level(base)) % 360.0
    there = orbit(base, angle)
    far = max(abs(e - t) for e, t in zip(base.eye, base.target, strict=True))
    apart = max(abs(a - b) for a, b in zip(there.eye, camera.eye, strict=True))
    if replace(camera, eye=there.eye) != there or apart > CLOSE * far:
        return None
    if abs(angle - near) > 180.0:
        return (
            angle + (360.0 if near > angle else -360.0) if min(angle, 360 - angle) < 1e-6 else angle
        )
    return angle


def scrubbed(state: State, angle: float) -> State:
    """The camera at ``angle`` degrees of the path of the plot."""
    base = state.scope.of.camera if state.scope.of is not None else state.setup.camera
    angle = min(max(angle, 0.0), 360.0)
    state = replace(state, scope=replace(state.scope, angle=angle))
    return state.with_setup(replace(state.setup, camera=orbit(base, angle)))


def walked(state: State, seconds: float) -> State:
    """The state a moment later, if the scope plays; a camera that left the path stops it."""
    scope = state.scope
    if not scope.playing:
        return state
    if state.playing or scope.of is None or off_path(state):
        return replace(state, scope=replace(scope, playing=False))
    return scrubbed(state, (scope.angle + SPEED * seconds) % 360.0)
