"""The ray tracer on the GPU in float32 beside NumPy in float64."""

from __future__ import annotations

from collections.abc import Iterator

from playground.measure.experiments.sentences import of, sentence, times
from playground.measure.pictures import picture, picture_errors
from playground.measure.record import Candidate, Errors, Experiment
from playground.measure.rows import Row, cases, ratio
from playground.measure.timing import frames_of
from playground.percent import percent
from playground.scene.library import load

SCENES = ("whitted-room", "sphere-row", "glass-of-water", "glass-ring", "area-light", "teapot")
QUICK_SCENES = ("whitted-room",)
RENDERERS = {"GL": "gl", "NumPy": "numpy"}
SIZE, QUICK_SIZE = (160, 120), (80, 60)
REFERENCE = "NumPy in float64"


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """Both renderers on one scene, in turn."""
    size = QUICK_SIZE if quick else SIZE
    for scene in QUICK_SCENES if quick else SCENES:
        yield [_candidate(name, scene, size) for name in RENDERERS]


def _candidate(name: str, scene: str, size: tuple[int, int]) -> Candidate:
    setup, renderer = load(scene), RENDERERS[name]

    def errors() -> Errors:
        want = picture(setup, size, "numpy", "ray-tracing")
        got = picture(setup, size, renderer, "ray-tracing")
        return picture_errors(got, want, REFERENCE)

    opened = frames_of(setup, size, renderer, "ray-tracing")
    return Candidate(name, {}, opened, errors, scene)


def finding(rows: list[Row]) -> str:
    """In each scene how many pixels differ visibly, by how much, and the ratio of the times."""
    parts = []
    for case in cases(rows):
        here = [row for row in rows if row.case == case]
        gl, numpy = of(here, "GL"), of(here, "NumPy")
        if gl and numpy and gl[0].errors is not None:
            off = gl[0].errors.off
            words = f"{case}: float32 is off by {percent(gl[0].errors.rmse)}"
            words += f", {percent(gl[0].errors.max)} at worst"
            words += f", in {percent(off)} of the pixels by more than one code" if off else ""
            parts.append(f"{words}; NumPy takes {times(ratio(numpy[0], gl[0]))} the time")
    return sentence(*parts)


EXPERIMENT = Experiment(
    "trace-precision",
    "Ray tracing in float32",
    "How far does float32 on the GPU lead rays astray, after several bounces?",
    groups,
    finding,
    REFERENCE,
    show=("rmse", "max", "flip", "off"),
)
