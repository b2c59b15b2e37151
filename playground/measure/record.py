"""What an experiment is made of: candidates to time and to judge, and what came of them."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from contextlib import ExitStack
from dataclasses import asdict, dataclass, field, fields
from typing import Any

Knobs = Mapping[str, Any]


@dataclass(frozen=True)
class Batch:
    """The raw times of one candidate in one round, and what else was counted with each."""

    times: list[float]
    more: dict[str, list[float]] = field(default_factory=dict)


@dataclass(frozen=True)
class Errors:
    """How far a candidate is from the named reference; all but ``left_out`` are shares of 1.

    ``rmse``, ``max`` and ``mean`` (of the absolute difference) are of linear light unless the
    experiment says otherwise, over what candidate and reference both cover; ``left_out`` pixels
    only one of them covers. ``flip`` (the mean) and ``off`` (share of pixels off by more than one
    of 255 codes) are of the picture as shown. ``uncertainty`` holds one standard error
    for each number whose reference, or whose candidate, was sampled at random.
    """

    rmse: float
    max: float
    mean: float
    reference: str
    flip: float | None = None
    off: float | None = None
    left_out: int | None = None
    uncertainty: dict[str, float] = field(default_factory=dict)
    more: dict[str, float] = field(default_factory=dict)

    def to_dict(self) -> dict[str, Any]:
        """As JSON writes it."""
        return asdict(self)

    @staticmethod
    def from_dict(values: dict[str, Any]) -> Errors:
        """The inverse of `to_dict`."""
        return Errors(**{f.name: values[f.name] for f in fields(Errors)})


Timer = Callable[[], Batch]


@dataclass(frozen=True)
class Candidate:
    """One way of doing it, at one setting of its knobs.

    Candidates of one ``case`` answer the same question and may be compared. ``open`` makes
    the candidate ready and warm, and returns a function that times one round of it; what
    must be closed afterwards goes on the stack. ``errors`` is None where there is no reference.
    """

    method: str
    knobs: Knobs
    open: Callable[[ExitStack], Timer]
    errors: Callable[[], Errors] | None = None
    case: str = ""

    @property
    def key(self) -> str:
        """What tells it from the other candidates of its experiment."""
        return json.dumps([self.case, self.method, dict(self.knobs)], sort_keys=True)


Groups = Callable[[bool], Iterable[list[Candidate]]]


@dataclass(frozen=True)
class Experiment:
    """A question that is answered by measuring; one file of `playground.measure.experiments` each.

    Parameters
    ----------
    name, title, question : str
    groups : function of ``quick`` that gives lists of candidates
        Those of one list are held open together and timed in turn.
    finding : function of the rows that returns one sentence
        Every word of it must follow from the rows.
    reference : str
        What the errors are measured against.
    error, error_label : str
        Which field of `Errors` is the error of the plot, and what it is called.
    time_label : str
        What the times are, with their unit.
    show : tuple of str
        Further numbers for the table, of `Errors.more` or of what a `Batch` counted.
    ratio_to : str
        The method to which the times of the same case and round are compared; "" for none.
    """

    name: str
    title: str
    question: str
    groups: Groups
    finding: Callable[[list[Any]], str]
    reference: str
    error: str = "rmse"
    error_label: str = "RMSE of linear light"
    time_label: str = "ms per frame"
    needs_gl: bool = True
    show: tuple[str, ...] = ()
    ratio_to: str = ""
