"""How many rays per second: in one mesh of 70 k triangles, and in a room of formulas."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing
from functools import lru_cache
from importlib.util import find_spec
from typing import Any

import numpy as np
from numpy.typing import NDArray

from playground.measure.experiments.sentences import listed, of, sentence, times
from playground.measure.peer_mitsuba import INSTALLED as MITSUBA_INSTALLED
from playground.measure.peer_mitsuba import NAME as MITSUBA
from playground.measure.peer_mitsuba import mitsuba_asked
from playground.measure.pictures import picture, picture_errors
from playground.measure.ray_kinds import Rays, bumpy_ball, ray_kinds
from playground.measure.record import Batch, Candidate, Errors, Experiment, Timer
from playground.measure.room_floor import DEPTH, RoomFloor, room_setup, swayed
from playground.measure.rows import Row, cases
from playground.measure.timing import timed
from playground.render.gl.context import headless
from playground.render.gl.trace.ray_batch import RayBatch
from playground.render.image import Image
from playground.render.renderer import open_renderer
from playground.render.trace import embree, walk
from playground.render.trace.bvh import bvh_of
from playground.render.trace.solids import Walker

SIZE, QUICK_SIZE = (640, 480), (160, 120)
FLOOR = "written by hand"
KINDS = ("primary", "shadow", "diffuse")
ROOM = "room"
RATE, PICTURE = "million rays per second", "ms per picture"
WARM_UP = 12  # pictures: enough for a still scene to get its constants built in
REPEATS = 3  # calls of one candidate in one round on the GPU; NumPy is slow enough for one
JUDGED = 3  # step of the camera: not in the middle, where rays run along the edges of two walls
REFERENCE = "NumPy in float64"
WALKERS: dict[str, Walker] = {"NumPy": walk}
if find_spec("embreex"):
    WALKERS["Embree"] = embree
BACKENDS = ("GL", *WALKERS, *([MITSUBA] if MITSUBA_INSTALLED else []))
Size = tuple[int, int]


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """Each kind of ray in the mesh, then the room, by both backends in turn."""
    size = QUICK_SIZE if quick else SIZE
    for kind in KINDS:
        yield [_mesh(kind, method, size) for method in BACKENDS]
    yield [_room(FLOOR, size), _room("GL", size), _room("NumPy", size)]


@lru_cache(maxsize=2)
def _rays(size: Size) -> dict[str, Rays]:
    return {rays.kind: rays for rays in ray_kinds(bvh_of(_ball()), size)}


@lru_cache(maxsize=1)
def _ball() -> Any:
    return bumpy_ball()


def _asked(kind: str, size: Size, method: str = "NumPy") -> Callable[[], NDArray[np.float64]]:
    """What the CPU does: t of each ray; of shadow rays 1 if blocked, −1 if not."""
    rays, bvh = _rays(size)[kind], bvh_of(_ball())
    if method == MITSUBA:
        return mitsuba_asked(_ball(), rays)
    walker = WALKERS[method]
    given = rays.origin, rays.direction, rays.limit
    if rays.any_hit:
        return lambda: np.where(walker.blocked(bvh, *given), 1.0, -1.0)
    return lambda: walker.closest(bvh, *given)[0]


def _batch(kind: str, size: Size) -> RayBatch:
    rays = _rays(size)[kind]
    given = rays.origin, rays.direction, rays.limit
    return RayBatch(headless(), bvh_of(_ball()), *given, any_hit=rays.any_hit)


def _mesh(kind: str, method: str, size: Size) -> Candidate:
    def opened(stack: ExitStack) -> Timer:
        if method == "GL":
            batch = _batch(kind, size)
            stack.callback(batch.release)
            run: Callable[[], object] = batch.run
        else:
            run = _asked(kind, size, method)
        return _rates(run, len(_rays(size)[kind].origin), method, {})

    def errors() -> Errors:
        want = _asked(kind, size)()
        if method != "GL":
            return hit_errors(_asked(kind, size, method)(), want)
        batch = _batch(kind, size)
        batch.run()
        t, triangle, _ = batch.hits()
        batch.release()
        any_hit = _rays(size)[kind].any_hit
        return hit_errors(np.where(triangle >= 0, 1.0 if any_hit else t, -1.0), want)

    return Candidate(method, {}, opened, errors, f"{kind} rays")


def hit_errors(got: NDArray[Any], want: NDArray[Any]) -> Errors:
    """How far t (N,) is off for rays that hit in both; ``left_out`` are those that hit in one."""
    both = (got >= 0.0) & (want >= 0.0)
    off = np.abs(got - want)[both].astype(np.float64)
    lone = int(((got >= 0.0) != (want >= 0.0)).sum())
    rmse = float(np.sqrt(np.mean(off**2))) if len(off) else 0.0
    worst, mean = (float(off.max()), float(off.mean())) if len(off) else (0.0, 0.0)
    return Errors(rmse, worst, mean, REFERENCE, left_out=lone)


def _rates(run: Callable[[], object], count: int, method: str, more: dict[str, float]) -> Timer:
    """Nanoseconds per ray of ``count``, and what else each time means."""
    timed(run, 1)

    def batch() -> Batch:
        taken = timed(run, 1 if method == "NumPy" else REPEATS)
        rates = [count / t / 1e3 for t in taken]
        return Batch([1e6 * t / count for t in taken], {RATE: rates, **_pictures(taken, more)})

    return batch


def _pictures(taken: list[float], more: dict[str, float]) -> dict[str, list[float]]:
    return {name: [factor * t for t in taken] for name, factor in more.items()}


def _room(method: str, size: Size) -> Candidate:
    case = f"{ROOM}, {size[0]}x{size[1]}, depth {DEPTH}"

    def opened(stack: ExitStack) -> Timer:
        step, draw = 0, _drawing(method, size, stack)

        def frame() -> None:
            nonlocal step
            step += 1
            draw(step)

        timed(frame, 1 if method == "NumPy" else WARM_UP)
        return _rates(frame, size[0] * size[1], method, {PICTURE: 1.0})

    def errors() -> Errors:
        setup = swayed(room_setup(), JUDGED)
        want = picture(setup, size, "numpy", "ray-tracing")
        if method != FLOOR:
            renderer = "gl" if method == "GL" else "numpy"
            return picture_errors(picture(setup, size, renderer, "ray-tracing"), want, REFERENCE)
        with closing(RoomFloor(size, "f4")) as floor:
            pixels = floor.frame(JUDGED)[::-1, :, :3].astype(np.float32)
        return picture_errors(Image(pixels, setup=setup), want, REFERENCE)

    return Candidate(method, {}, opened, errors, case)


def _drawing(method: str, size: Size, stack: ExitStack) -> Callable[[int], object]:
    """Draws one step of the camera into an array of 8-bit RGBA."""
    if method == FLOOR:
        return stack.enter_context(closing(RoomFloor(size))).frame
    renderer = "gl" if method == "GL" else "numpy"
    tracer = stack.enter_context(open_renderer(size, renderer, method="ray-tracing"))
    codes, setup = np.empty((size[1], size[0], 4), np.uint8), room_setup()
    return lambda step: tracer.render(swayed(setup, step), out=codes)


def finding(rows: list[Row]) -> str:
    """Rates of each kind by each backend, and the room beside the shader written by hand."""
    parts = []
    meshes = [case for case in cases(rows) if not case.startswith(ROOM)]
    for method in ("GL", "NumPy", "Embree", MITSUBA):
        found = [of([r for r in rows if r.case == case], method) for case in meshes]
        rates = [f"{r[0].more[RATE]:.3g} {r[0].case}" for r in found if r]
        if rates:
            parts.append(f"{method}: {listed(rates)} per second, in millions")
    for case in (case for case in cases(rows) if case.startswith(ROOM)):
        here = [row for row in rows if row.case == case]
        gl, numpy = of(here, "GL"), of(here, "NumPy")
        if gl and gl[0].ratio is not None:
            words = f"{case}: GL takes {gl[0].more[PICTURE]:.3g} ms, {times(gl[0].ratio)} "
            words += "the time of the shader written by hand"
            words += f"; NumPy {numpy[0].more[PICTURE]:.0f} ms" if numpy else ""
            parts.append(words)
    return sentence(*parts)


EXPERIMENT = Experiment(
    "rays",
    "Rays per second",
    "How many rays per second go through 70 k triangles, and how close is a traced room to a "
    "shader written by hand for exactly that room?",
    groups,
    finding,
    f"{REFERENCE}: t for rays, linear light for the room",
    error_label="RMSE",
    time_label="ns per ray (room: per pixel)",
    show=("rmse", "max", "off", "left_out", RATE, PICTURE),
    ratio_to=FLOOR,
)
