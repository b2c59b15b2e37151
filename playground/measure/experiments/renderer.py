"""GL beside NumPy on the same pictures."""

from __future__ import annotations

from collections.abc import Iterator

from playground.measure.experiments.sentences import of, sentence, times
from playground.measure.experiments.spheres import REFERENCE, exact_sphere, sphere
from playground.measure.pictures import picture, picture_errors
from playground.measure.record import Candidate, Errors, Experiment
from playground.measure.rows import Row, cases, ratio
from playground.measure.timing import frames_of
from playground.percent import percent
from playground.scene.library import load

RENDERERS = {"GL": "gl", "NumPy": "numpy"}
SIZES, QUICK_SIZES = ((160, 120), (320, 240), (640, 480)), ((160, 120), (240, 180))
TESSELLATION = 256  # fine enough for the error of the mesh to be small
SCENES = ("teapot", "textured")
SCENE_SIZE = (320, 240)


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """The sphere at several sizes against the exact one; library scenes against NumPy."""
    for size in QUICK_SIZES if quick else SIZES:
        yield [_sphere(name, size) for name in RENDERERS]
    for scene in () if quick else SCENES:
        yield [_scene(name, scene) for name in RENDERERS]


def _sphere(name: str, size: tuple[int, int]) -> Candidate:
    setup, renderer = sphere(TESSELLATION), RENDERERS[name]

    def errors() -> Errors:
        exact = exact_sphere(size)
        drawn = picture(setup, size, renderer)
        return picture_errors(drawn, exact.image, REFERENCE, exact.covered)

    case = f"sphere, {size[0]}x{size[1]}"
    return Candidate(name, {}, frames_of(setup, size, renderer), errors, case)


def _scene(name: str, scene: str) -> Candidate:
    setup, renderer = load(scene), RENDERERS[name]

    def errors() -> Errors:
        want = picture(setup, SCENE_SIZE, "numpy")
        return picture_errors(picture(setup, SCENE_SIZE, renderer), want, "NumPy in float64")

    case = f"{scene}, {SCENE_SIZE[0]}x{SCENE_SIZE[1]}"
    return Candidate(name, {}, frames_of(setup, SCENE_SIZE, renderer), errors, case)


def finding(rows: list[Row]) -> str:
    """The ratio of the times in each case, and both errors."""
    parts = []
    for case in cases(rows):
        here = [row for row in rows if row.case == case]
        gl, numpy = of(here, "GL"), of(here, "NumPy")
        if gl and numpy:
            words = f"{case}: NumPy takes {times(ratio(numpy[0], gl[0]))} the time of GL"
            if gl[0].error is not None and numpy[0].error is not None:
                words += f" (error {percent(numpy[0].error)}, GL {percent(gl[0].error)})"
            parts.append(words)
    return sentence(*parts)


EXPERIMENT = Experiment(
    "renderer",
    "Renderer",
    "How much faster is GL than the float64 reference in NumPy, and how far is each off?",
    groups,
    finding,
    f"{REFERENCE}; for scenes of the library the NumPy picture itself, whose error is therefore 0",
    show=("rmse", "max", "flip", "off"),
)
