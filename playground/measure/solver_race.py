"""All solvers of radiosity on one system, side by side: what each has left after how much work.

A row of form factors is computed once for all of them and its time is noted; each solver is
charged with the rows that it asks for, when it first asks. So its clock shows what it would
have taken alone. Solvers take turns by these clocks: whose clock is behind makes the next step.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.render.radiosity.direct import direct_light
from playground.render.radiosity.factor.closure import is_closed
from playground.render.radiosity.factor.form_factors import open_rows
from playground.render.radiosity.factor.matrix import BATCH, FormFactors, Rows
from playground.render.radiosity.patch.divide import divide
from playground.render.radiosity.patch.patches import Patches
from playground.render.radiosity.solver.solve import SOLVERS, Step, System
from playground.render.radiosity.solver.whole import elimination
from playground.scene.settings import SOLVERS as NAMES
from playground.scene.setup import Setup
from playground.shading.floats import Array

MOST_PATCHES = 2500  # elimination takes N³, and every solver keeps rows of its own
THINNED = 0.02  # after many steps, one is told when it is this share further than the last
TELL = 0.05  # seconds between two pieces of news
ROWS = 0.5  # of the progress, as long as rows are computed

Rgb = tuple[float, float, float]


class Lap(NamedTuple):
    """What a solver had reached after a step."""

    done: int  # sweeps, iterations or shots
    seconds: float  # of its own clock
    left: float  # share of the light that waits, of the worst channel: `Step.residual`
    error: float  # Σ A |C − C*| / Σ A C* of the light shown, C* by elimination; NaN without it
    rows: int  # rows of the matrix that it has asked for
    emitted: Rgb
    absorbed: Rgb
    unshot: Rgb
    escaped: Rgb
    imbalance: float  # `Ledger.imbalance`


class News(NamedTuple):
    """What has happened since the last news: steps that are told, and solvers that have ended."""

    share: float
    patches: int
    laps: tuple[tuple[str, Lap], ...] = ()
    ended: tuple[tuple[str, str], ...] = ()  # with an error, or "" for one that has arrived


def racing(
    setup: Setup,
    solvers: Sequence[str] = NAMES,
    convergence: float = 1e-6,
    renderer: str = "auto",
) -> Iterator[News]:
    """Race ``solvers`` to the share ``convergence`` of the light left; refinement stays out.

    Raises
    ------
    PlaygroundError
        More than `MOST_PATCHES` patches, or what `divide` and `open_rows` refuse. An error of
        one solver ends that one, and is told as such.
    """
    patches = divide(setup)
    if len(patches.area) > MOST_PATCHES:
        raise PlaygroundError(
            "too many patches for a race of all solvers",
            got=len(patches.area),
            allowed=f"at most {MOST_PATCHES}",
            fix="Lower 'patches'.",
        )
    rows = open_rows(patches, setup.settings, renderer)
    try:
        shared = SharedRows(rows, len(patches.area))
        for share in shared.fill():
            yield News(ROWS * share, len(patches.area))
    finally:
        rows.close()
    yield from _raced(setup, patches, shared, solvers, convergence)


class SharedRows:
    """The rows of all patches, each computed once, with the seconds that it took."""

    def __init__(self, rows: Rows, size: int) -> None:
        self._rows = rows
        self.values = np.empty((size, size), np.float32)
        self.seconds = np.zeros(size)

    def fill(self) -> Iterator[float]:
        """Compute all of them; yields the share done."""
        size = len(self.seconds)
        for first in range(0, size, BATCH):
            some = np.arange(first, min(first + BATCH, size))
            began = perf_counter()
            self.values[some] = self._rows(some)
            self.seconds[some] = (perf_counter() - began) / len(some)
            yield (some[-1] + 1) / size


class Account:
    """Shared rows as one solver sees them: it pays for each when it first asks."""

    def __init__(self, shared: SharedRows) -> None:
        self._shared = shared
        self.used = np.zeros(len(shared.seconds), dtype=bool)

    def __call__(self, chosen: NDArray[Any]) -> Array:
        """Rows (k, N)."""
        self.used[chosen] = True
        return np.asarray(self._shared.values[chosen])

    @property
    def seconds(self) -> float:
        """What the rows asked for so far took."""
        return float(self._shared.seconds[self.used].sum())


@dataclass
class _Runner:
    """One solver on its way."""

    name: str
    account: Account
    system: System
    steps: Iterator[Step]
    convergence: float
    computing: float = 0.0  # seconds of its own
    told: int = -1  # `done` of the last step that was told
    left: float = 1.0

    @property
    def clock(self) -> float:
        """Seconds that it would have taken alone."""
        return self.computing + self.account.seconds

    @property
    def share(self) -> float:
        """How far it has come, by the logarithm of the light left."""
        if self.left <= self.convergence:
            return 1.0
        return max(float(np.log(self.left) / np.log(self.convergence)), 0.0)

    def step(self) -> Step | None:
        """The next step; None when there is none."""
        began = perf_counter()
        step = next(self.steps, None)
        self.computing += perf_counter() - began
        return step

    def lap(self, step: Step, solution: Array | None) -> Lap | None:
        """What there is to tell of a step; None if it is hardly further than the last."""
        self.left = step.residual
        last = step.residual <= self.convergence
        if not last and step.done - self.told < max(THINNED * step.done, 1.0):
            return None
        self.told = step.done
        error = np.nan
        if solution is not None:
            area = self.system.area[:, None]
            error = float((area * np.abs(step.light - solution)).sum() / (area * solution).sum())
        books = step.ledger
        return Lap(
            done=step.done,
            seconds=self.clock,
            left=step.residual,
            error=error,
            rows=int(self.account.used.sum()),
            emitted=_rgb(books.emitted),
            absorbed=_rgb(books.absorbed),
            unshot=_rgb(books.unshot),
            escaped=_rgb(books.escaped),
            imbalance=books.imbalance,
        )


def _rgb(energy: Array) -> Rgb:
    red, green, blue = energy.tolist()
    return red, green, blue


def _raced(
    setup: Setup, patches: Patches, shared: SharedRows, solvers: Sequence[str], convergence: float
) -> Iterator[News]:
    """The race itself, once all rows are there."""
    size, normalise = len(patches.area), setup.settings.normalise
    direct = direct_light(setup, patches)
    closed = is_closed(patches)

    def system(rows: Rows) -> System:
        factors = FormFactors(rows, patches, normalise, closed=closed)
        return System(factors, patches.area, patches.reflectance, patches.emission, direct)

    solution = _solution(system(Account(shared)))
    runners = []
    for name in solvers:
        account = Account(shared)
        mine = system(account)
        steps = SOLVERS[name](mine, convergence)
        runners.append(_Runner(name, account, mine, steps, convergence))
    running, laps, ended, told = list(runners), list[tuple[str, Lap]](), [], perf_counter()
    while running:
        behind = min(running, key=lambda runner: runner.clock)
        try:
            step = behind.step()
        except PlaygroundError as error:
            step = None
            ended.append((behind.name, str(error)))
        else:
            ended += [(behind.name, "")] if step is None else []
        if step is None:
            behind.left = 0.0
            running.remove(behind)
        elif (lap := behind.lap(step, solution)) is not None:
            laps.append((behind.name, lap))
        if not running or perf_counter() - told > TELL:
            far = min(runner.share for runner in runners)
            yield News(ROWS + (1.0 - ROWS) * far, size, tuple(laps), tuple(ended))
            laps, ended, told = [], [], perf_counter()


def _solution(system: System) -> Array | None:
    """The light by elimination, (N, 3); None if the equations have no solution that is light."""
    work = system.working
    try:
        light = elimination(system.form_factors.matrix(), work.rho, work.first)
    except np.linalg.LinAlgError:
        return None
    return work.wide(light) if light.min() >= 0.0 else None
