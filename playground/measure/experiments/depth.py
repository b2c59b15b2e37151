"""How deep to follow rays: time against what the cut-offs leave out."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache

from playground.measure.experiments.sentences import of, reach, sentence, times, took
from playground.measure.pictures import picture, picture_errors
from playground.measure.record import Candidate, Errors, Experiment
from playground.measure.rows import Row, cases, ratio
from playground.measure.timing import frames_of
from playground.percent import percent
from playground.render.image import Image
from playground.scene.library import load

SCENES, QUICK_SCENES = ("whitted-room", "sphere-row", "glass-of-water"), ("whitted-room",)
DEPTHS, QUICK_DEPTHS = (0, 1, 2, 3, 4, 5, 6, 8), (0, 2, 5)
DEEPEST = 16
SIZE, QUICK_SIZE = (320, 240), (160, 120)
FOLLOWED, CUT = "every ray", "no ray that weighs < 0.004"  # the two thresholds, as methods
THRESHOLDS = {FOLLOWED: 0.0, CUT: 0.004}
LEFT_OUT = "weight left out"
REFERENCE = f"depth {DEEPEST}, every ray followed"


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """Every depth of a scene with and without a threshold, in turn."""
    size = QUICK_SIZE if quick else SIZE
    for scene in QUICK_SCENES if quick else SCENES:
        depths = QUICK_DEPTHS if quick else DEPTHS
        yield [_candidate(scene, method, depth, size) for depth in depths for method in THRESHOLDS]


def _candidate(scene: str, method: str, depth: int, size: tuple[int, int]) -> Candidate:
    setup = load(scene).with_(depth=depth, threshold=THRESHOLDS[method])

    def errors() -> Errors:
        got = picture(setup, size, "gl", "ray-tracing")
        judged = picture_errors(got, _deepest(scene, size), REFERENCE)
        assert got.left_out is not None
        return replace(judged, more={**judged.more, LEFT_OUT: got.left_out.mean})

    opened = frames_of(setup, size, "gl", "ray-tracing")
    return Candidate(method, {"depth": depth}, opened, errors, scene)


@lru_cache(maxsize=4)
def _deepest(scene: str, size: tuple[int, int]) -> Image:
    return picture(load(scene).with_(depth=DEEPEST, threshold=0.0), size, "gl", "ray-tracing")


def finding(rows: list[Row]) -> str:
    """In each scene the fastest depth within 1 %, and what the threshold saves at the deepest."""
    parts = []
    for case in cases(rows):
        here = [row for row in rows if row.case == case]
        best = reach(here, 0.01)
        if best is None:
            words = f"{case}: no depth comes within 1 %"
        else:
            words = f"{case}: depth {best.knobs['depth']} ({took(best)}) is off by "
            words += percent(best.error or 0.0)
        most = max(int(row.knobs["depth"]) for row in here)
        whole, cut = of(here, FOLLOWED, depth=most), of(here, CUT, depth=most)
        if whole and cut and whole[0].error is not None and cut[0].error is not None:
            words += (
                f"; at depth {most} the threshold takes {times(ratio(cut[0], whole[0]))} the time "
                f"and changes the error from {percent(whole[0].error)} to "
                f"{percent(cut[0].error)}"
            )
        parts.append(words)
    return sentence(*parts)


EXPERIMENT = Experiment(
    "depth",
    "Recursion depth",
    "How deep must rays be followed, and what does it cost?",
    groups,
    finding,
    REFERENCE,
    show=("rmse", "max", "flip", "off", LEFT_OUT),
)
