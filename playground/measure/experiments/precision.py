"""The same picture shaded in 16, 32 and 64 bits, on the GPU and in NumPy."""

from __future__ import annotations

from collections.abc import Iterator

from playground.errors import PlaygroundError
from playground.measure.experiments.sentences import of, sentence, times
from playground.measure.experiments.spheres import sphere
from playground.measure.pictures import picture, picture_errors
from playground.measure.record import Candidate, Errors, Experiment
from playground.measure.rows import Row, cases, ratio
from playground.measure.timing import frames_of
from playground.percent import percent

PRECISIONS = ("float16", "float32", "float64")
RENDERERS = {"GL": "gl", "NumPy": "numpy"}
SHININESS, QUICK_SHININESS = (5.0, 80.0, 1000.0, 10000.0), (5.0, 1000.0)
TESSELLATION = 64
SIZE, QUICK_SIZE = (320, 240), (160, 120)
REFERENCE = "the same mesh in NumPy and float64"


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """Each precision that each renderer takes, at one shininess, in turn."""
    size = QUICK_SIZE if quick else SIZE
    taken = [(name, p) for name in RENDERERS for p in PRECISIONS if _takes(RENDERERS[name], p)]
    for shininess in QUICK_SHININESS if quick else SHININESS:
        yield [_candidate(name, p, shininess, size) for name, p in taken]


def _takes(renderer: str, precision: str) -> bool:
    try:
        picture(sphere(8).with_(precision=precision), (8, 8), renderer)
    except PlaygroundError:
        return False
    return True


def _candidate(name: str, precision: str, shininess: float, size: tuple[int, int]) -> Candidate:
    setup = sphere(TESSELLATION, shininess).with_(precision=precision)

    def errors() -> Errors:
        want = picture(setup.with_(precision="float64"), size, "numpy")
        got = picture(setup, size, RENDERERS[name])
        covered = None if want.coverage is None else want.coverage > 0.5
        return picture_errors(got, want, REFERENCE, covered)

    opened = frames_of(setup, size, RENDERERS[name])
    case = f"shininess {shininess:g}"
    return Candidate(f"{name} {precision}", {}, opened, errors, case)


def finding(rows: list[Row]) -> str:
    """The largest errors of each precision in each case, and what float16 and float64 cost."""
    parts = []
    for case in cases(rows):
        here = [row for row in rows if row.case == case]
        words = [
            f"{row.method} {percent(row.errors.max)}"
            for row in here
            if row.errors is not None and row.errors.max > 1.0 / 255.0
        ]
        fine = "every precision stays within one step of 8 bits"
        parts.append(f"{case}: {', '.join(words) + ' off at worst' if words else fine}")
        base = of(here, "GL float32")
        for other in ("GL float16", "GL float64"):
            if base and (found := of(here, other)):
                parts[-1] += (
                    f", {other} takes {times(ratio(found[0], base[0]))} the time of float32"
                )
    return sentence(*parts)


EXPERIMENT = Experiment(
    "precision",
    "Precision",
    "What do more bits cost, and which highlight needs them?",
    groups,
    finding,
    REFERENCE,
    show=("rmse", "max", "flip", "off", "pixels not finite"),
)
