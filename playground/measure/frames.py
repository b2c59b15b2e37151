"""``playground measure frames``: frames per second beside the floor and a peer, with the error.

In one run, interleaved: every round times a few frames of each candidate in turn, so that
a machine that slows down slows all of them. Reported are medians with their 10th and 90th
percentiles, the median ratio to the floor of the same round, and how far the picture is
from the float64 reference.
"""

from __future__ import annotations

import json
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any

import numpy as np

from playground.measure.floor import Floor
from playground.measure.frames_scene import SIZE, eye, frames_setup
from playground.render.renderer import open_renderer

Timer = Callable[[int], list[float]]  # a number of frames -> milliseconds of each
FRAMES = {"1k": 12, "100k": 6, "1M": 2}  # frames of one candidate in one round
WARM_UP = 12
CASES = [("1k", 1), ("100k", 1), ("1M", 1), ("1k", 4), ("100k", 4)]


@dataclass(frozen=True)
class Row:
    """One candidate in one case; times in milliseconds per frame."""

    triangles: str
    samples: int
    candidate: str
    median: float
    low: float
    high: float
    ratio: float
    worst: float | None  # codes of 255 off the float64 reference, at the worst pixel
    off: float | None  # share of pixels off by more than one code


def measure_frames(rounds: int = 9) -> Iterator[Row]:
    """Rows, case by case, as they are finished."""
    peer = _Peer() if find_spec("vtkmodules") else None
    for triangles, samples in CASES:
        timers, errors = _ours(triangles, samples)
        if peer is not None:
            timers["VTK"] = lambda n, t=triangles, s=samples: peer.time(t, s, n)  # type: ignore[misc]
        for timer in timers.values():
            timer(WARM_UP)
        times: dict[str, list[list[float]]] = {name: [] for name in timers}
        for _ in range(rounds):
            for name, timer in timers.items():
                times[name].append(timer(FRAMES[triangles]))
        floor = [float(np.median(batch)) for batch in times["floor"]]
        for name, batches in times.items():
            per_round = [float(np.median(batch)) for batch in batches]
            ratio = float(np.median(np.divide(per_round, floor)))
            low, median, high = np.percentile(np.concatenate(batches), [10, 50, 90])
            worst, off = errors.get(name, (None, None))
            yield Row(triangles, samples, name, median, low, high, ratio, worst, off)


def _ours(triangles: str, samples: int) -> tuple[dict[str, Timer], dict[str, tuple[float, float]]]:
    """The floor and our three shadings as timers, and the error of those with a reference."""
    setup = frames_setup(triangles)
    mesh = setup.scene.objects[0].geometry().mesh
    floor = Floor(mesh, samples)
    timers = {"floor": _timer(floor.frame)}
    shadings = ("per-fragment", "per-vertex", "flat") if samples == 1 else ("per-fragment",)
    errors = {}
    for shading in shadings:
        draw = _drawing(frames_setup(triangles, shading, samples))
        timers[shading] = _timer(draw)
        if samples == 1:
            with open_renderer(SIZE, "numpy") as oracle:
                reference = np.empty((SIZE[1], SIZE[0], 4), np.uint8)
                oracle.render(frames_setup(triangles, shading), out=reference)
            errors[shading] = _error(draw(0), reference)
            if shading == "per-fragment":
                errors["floor"] = _error(floor.frame(0)[::-1], reference)
    return timers, errors


def _drawing(setup: Any) -> Callable[[int], Any]:
    renderer = open_renderer(SIZE, "gl")
    codes = np.empty((SIZE[1], SIZE[0], 4), np.uint8)
    return lambda step: renderer.render(setup.with_(eye=eye(step)), out=codes)


def _timer(draw: Callable[[int], Any]) -> Timer:
    step = 0

    def timer(frames: int) -> list[float]:
        nonlocal step
        times = []
        for _ in range(frames):
            step += 1
            start = time.perf_counter()
            draw(step)
            times.append(1e3 * (time.perf_counter() - start))
        return times

    return timer


def _error(got: Any, want: Any) -> tuple[float, float]:
    difference = np.abs(got[..., :3].astype(int) - want[..., :3]).max(axis=-1)
    return float(difference.max()), float((difference > 1).mean())


class _Peer:
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
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        self.process.stdin.write(f"{triangles} {samples} {frames}\n")
        self.process.stdin.flush()
        times: list[float] = json.loads(self.process.stdout.readline())
        return times
