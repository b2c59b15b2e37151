"""Rows and experiments made up for the tests."""

from playground.measure.record import Batch, Candidate, Errors, Experiment
from playground.measure.rows import Row, with_front


def row(method, time, error=None, case="", spread=0.0, more=None, ratio=None, **knobs):
    """A row of nine rounds, with the same error by every measure."""
    errors = None
    if error is not None:
        errors = Errors(error, error, error, "made up", more=more or {})
    low, high = time * (1 - spread), time * (1 + spread)
    rounds = (low, time, high) * 3
    return Row(case, method, knobs, time, low, high, 9, rounds, more or {}, errors, error, ratio)


def fronted(*rows):
    return with_front(rows)


class Fake:
    """An experiment of two candidates that says when it is asked to measure."""

    def __init__(self, needs_gl=False, stop_at=None):
        self.calls = []
        self.stop_at = stop_at
        self.experiment = Experiment(
            "fake", "Fake <&>", "Is it?", self.groups, lambda rows: f"{len(rows)} rows.",
            "the truth", needs_gl=needs_gl,
        )  # fmt: skip

    def groups(self, quick):
        yield [self.candidate("a", 1.0, 0.1), self.candidate("b", 2.0, 0.01)]

    def candidate(self, method, time, error):
        def once():
            self.call(f"{method} time")
            return Batch([time, 1.5 * time, 0.5 * time])

        def errors():
            self.call(f"{method} error")
            return Errors(error, 2 * error, error, "the truth", uncertainty={"rmse": error / 10})

        return Candidate(method, {"size": 3}, lambda stack: once, errors)

    def call(self, what):
        if len(self.calls) == self.stop_at:
            self.stop_at = None
            raise KeyboardInterrupt
        self.calls.append(what)
