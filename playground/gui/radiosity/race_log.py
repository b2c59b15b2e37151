"""The race of the solvers as a value: who runs, and how far each has come."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from playground.gui.work.long_work import Progress
from playground.measure.solver_race import MOST_PATCHES, Lap, News
from playground.render.radiosity.depends import FACTORS
from playground.scene.knob import Declared, choice, names
from playground.scene.settings import SOLVERS, Settings
from playground.scene.setup import Setup

if TYPE_CHECKING:
    from playground.gui.state import State

CHANNELS = ("summed", "red", "green", "blue")
GOALS = ("1e-2", "1e-3", "1e-4", "1e-6", "1e-8", "1e-10")
PARTS = ("absorbed", "escaped", "unshot")  # of what is emitted, as they are stacked


@dataclass(frozen=True)
class Lane:
    """One solver: its steps so far, and how it ended; "" while it runs or if it has arrived."""

    solver: str
    laps: tuple[Lap, ...] = ()
    ended: bool = False
    error: str = ""


@dataclass(frozen=True)
class RaceLog(Declared):
    """The solvers of the last race, and which setup it is about."""

    label = "race"

    of: Setup | None = None
    running: bool = False
    progress: Progress = field(default_factory=Progress)
    patches: int = 0
    lanes: tuple[Lane, ...] = ()
    error: str = ""
    solvers: tuple[str, ...] = names(SOLVERS, SOLVERS, help="who takes part in the next race")
    goal: str = choice("1e-6", GOALS, help="share of the light left at which a solver has arrived")
    against: str = choice(
        "time", ("time", "steps"), help="seconds each would take alone, or sweeps and shots"
    )
    drawn: str = choice(
        "light left",
        ("light left", "error"),
        help="light left is what waits to be sent on; the error is that of the picture shown, "
        "against elimination",
    )
    books_of: str = choice("progressive", SOLVERS, help="whose energy is shown below")
    channel: str = choice("summed", CHANNELS, help="energy of all channels, or of one")

    def lane(self, solver: str) -> Lane | None:
        """The lane of a solver, if it took part."""
        return next((lane for lane in self.lanes if lane.solver == solver), None)

    def with_news(self, news: News) -> RaceLog:
        """The log with what has happened since."""
        fresh: dict[str, list[Lap]] = {}
        for solver, lap in news.laps:
            fresh.setdefault(solver, []).append(lap)
        ended = dict(news.ended)
        lanes = tuple(
            replace(
                lane,
                laps=(*lane.laps, *fresh.get(lane.solver, ())),
                ended=lane.ended or lane.solver in ended,
                error=ended.get(lane.solver, lane.error),
            )
            if lane.solver in fresh or lane.solver in ended
            else lane
            for lane in self.lanes
        )
        return replace(self, lanes=lanes, patches=news.patches)

    def to_csv(self) -> str:
        """A table with one row per step that was told; energies summed over the channels."""
        text = io.StringIO()
        table = csv.writer(text, lineterminator="\n")
        table.writerow(("solver", *Lap._fields))
        for lane in self.lanes:
            for lap in lane.laps:
                numbers = (sum(x) if isinstance(x, tuple) else x for x in lap)
                table.writerow((lane.solver, *numbers))
        return text.getvalue()


def started(state: State) -> State:
    """Race on the setup as it is; what was raced before goes."""
    log, setup = state.race, state.setup
    if setup.settings.patches > MOST_PATCHES:
        setup = setup.with_(patches=MOST_PATCHES)
    log = replace(
        log,
        of=replace(setup),  # a new object, noticed by identity
        running=True,
        progress=Progress(),
        lanes=tuple(Lane(solver) for solver in log.solvers),
        error="",
    )
    return replace(state, race=log)


def cancelled(state: State) -> State:
    """Stop the race; what it has shown stays."""
    return replace(state, race=replace(state.race, running=False))


def outdated(state: State) -> bool:
    """Whether the race was on another scene, or on other patches or form factors."""
    of, now = state.race.of, state.setup
    if of is None or (of.scene is now.scene and of.settings is now.settings):
        return False
    there, here = (_matters(setup.settings) for setup in (of, now))
    return there != here or of.scene != replace(now.scene, lightmap=of.scene.lightmap)


def _matters(settings: Settings) -> tuple[object, ...]:
    others = (getattr(settings, name) for name in FACTORS if name != "patches")
    return min(settings.patches, MOST_PATCHES), settings.weights, *others
