"""Frames of a Phong-lit mesh beside the shortest program that draws it, and beside VTK."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from functools import lru_cache
from importlib.util import find_spec
from typing import Any

import numpy as np
from numpy.typing import NDArray

from playground.measure import metrics
from playground.measure.experiments.sentences import of, sentence, times
from playground.measure.floor import Floor
from playground.measure.frames_scene import SIZE, eye, frames_setup
from playground.measure.record import Batch, Candidate, Errors, Experiment, Timer
from playground.measure.rows import Row, cases
from playground.measure.timing import WARM_UP, timed
from playground.render.renderer import open_renderer

FRAMES = {"1k": 12, "100k": 6, "1M": 2}  # frames of one candidate in one round
CASES = (("1k", 1), ("100k", 1), ("1M", 1), ("1k", 4), ("100k", 4))  # triangles, samples
QUICK_CASES = (("1k", 1),)
REFERENCE = "per-fragment shading of the same mesh in NumPy and float64, as 8-bit codes"
SAME_WORST, SAME_OFF = "worst code, same shading", "% off by > 1 code, same shading"


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """The floor, our shadings and VTK where it is there; one case after another."""
    for triangles, samples in QUICK_CASES if quick else CASES:
        shadings = ("per-fragment", "per-vertex", "flat") if samples == 1 else ("per-fragment",)
        yield [
            _floor(triangles, samples, quick),
            *(_ours(triangles, samples, shading, quick) for shading in shadings),
            *([_peer(triangles, samples)] if find_spec("vtkmodules") else []),
        ]


def _case(triangles: str, samples: int) -> str:
    return f"{triangles} triangles, {samples} sample{'s' if samples > 1 else ''}"


def _floor(triangles: str, samples: int, quick: bool) -> Candidate:
    def make() -> Floor:
        setup = frames_setup(triangles)
        return Floor(setup.scene.objects[0].geometry().mesh, samples)

    def errors() -> Errors:
        return _errors(make().frame(0)[::-1], triangles, "per-fragment", quick)

    def opened(_: ExitStack) -> Timer:
        return _orbit(make().frame, FRAMES[triangles])

    judged = errors if samples == 1 else None
    return Candidate("floor", {}, opened, judged, _case(triangles, samples))


def _ours(triangles: str, samples: int, shading: str, quick: bool) -> Candidate:
    setup = frames_setup(triangles, shading, samples)

    def errors() -> Errors:
        with ExitStack() as stack:
            codes = _drawing(setup, stack)(0)
            return _errors(codes, triangles, shading, quick)

    def opened(stack: ExitStack) -> Timer:
        return _orbit(_drawing(setup, stack), FRAMES[triangles])

    judged = errors if samples == 1 else None
    return Candidate(shading, {}, opened, judged, _case(triangles, samples))


def _peer(triangles: str, samples: int) -> Candidate:
    def opened(stack: ExitStack) -> Timer:
        peer = Peer()
        stack.callback(peer.close)
        peer.time(triangles, samples, WARM_UP)
        return lambda: Batch(peer.time(triangles, samples, FRAMES[triangles]))

    return Candidate("VTK", {}, opened, None, _case(triangles, samples))


def _drawing(setup: Any, stack: ExitStack) -> Callable[[int], Any]:
    renderer = stack.enter_context(open_renderer(SIZE, "gl"))
    codes = np.empty((SIZE[1], SIZE[0], 4), np.uint8)
    return lambda step: renderer.render(setup.with_(eye=eye(step)), out=codes)


def _orbit(draw: Callable[[int], Any], frames: int) -> Timer:
    """Times frames while the camera walks on, one step each."""
    step = 0

    def frame() -> None:
        nonlocal step
        step += 1
        draw(step)

    timed(frame, WARM_UP)
    return lambda: Batch(timed(frame, frames))


@lru_cache(maxsize=3)
def _reference(triangles: str, shading: str) -> NDArray[np.uint8]:
    codes = np.empty((SIZE[1], SIZE[0], 4), np.uint8)
    with open_renderer(SIZE, "numpy") as oracle:
        oracle.render(frames_setup(triangles, shading), out=codes)
    return codes


def _errors(got: NDArray[np.uint8], triangles: str, shading: str, quick: bool) -> Errors:
    """The error against per-fragment shading; how exact the drawing is, against its own shading."""
    own = np.abs(got[..., :3].astype(int) - _reference(triangles, shading)[..., :3]).max(axis=-1)
    a, b = got[..., :3] / 255.0, _reference(triangles, "per-fragment")[..., :3] / 255.0
    return Errors(
        rmse=metrics.rmse(a, b),
        max=metrics.largest(a, b),
        mean=float(np.mean(np.abs(a - b))),
        reference=REFERENCE,
        flip=None if quick else float(np.mean(metrics.flip_map(b, a))),
        more={SAME_WORST: float(own.max()), SAME_OFF: 100.0 * float((own > 1).mean())},
    )


class Peer:
    """VTK in its own process."""

    def __init__(self) -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-m", "playground.measure.peer_vtk"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        assert self.process.stdout is not None
        self.process.stdout.readline()

    def time(self, triangles: str, samples: int, frames: int) -> list[float]:
        """Milliseconds of each of so many frames."""
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        self.process.stdin.write(f"{triangles} {samples} {frames}\n")
        self.process.stdin.flush()
        found: list[float] = json.loads(self.process.stdout.readline())
        return found

    def close(self) -> None:
        """End the process."""
        self.process.kill()
        self.process.communicate()


def finding(rows: list[Row]) -> str:
    """Per-fragment shading beside the floor and VTK in each case."""
    parts = []
    for case in cases(rows):
        here = [row for row in rows if row.case == case]
        ours, peer = of(here, "per-fragment"), of(here, "VTK")
        if ours and ours[0].ratio is not None:
            words = f"{case}: ours takes {times(ours[0].ratio)} the time of the floor"
            if peer and peer[0].ratio is not None:
                words += f", VTK {times(peer[0].ratio)}"
            parts.append(words)
    return sentence(*parts)


EXPERIMENT = Experiment(
    "frames",
    "Frames",
    "A moving camera, 8-bit RGBA read into an array, "
    f"{SIZE[0]}x{SIZE[1]}: how close is a frame to the shortest program that draws it?",
    groups,
    finding,
    REFERENCE,
    error_label="RMSE of the codes / 255",
    show=("rmse", "max", "flip", SAME_WORST, SAME_OFF),
    ratio_to="floor",
)
