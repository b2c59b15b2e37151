"""The books of light, on numbers that can be followed by hand."""

import numpy as np
import pytest
from enclosures import grey, system_of

from playground.render.radiosity.solver.ledger import Ledger
from playground.render.radiosity.solver.solve import SOLVERS


def books(*parts):
    return Ledger(*(np.full(3, float(part)) for part in parts))


def test_imbalance_is_what_is_missing():
    assert books(10, 6, 3, 1).imbalance == 0.0
    assert books(10, 6, 3, 0.5).imbalance == pytest.approx(0.05)
    assert books(0, 0, 0, 0).imbalance == 0.0
    assert books(1, 0, -9, 10).imbalance == 0.0  # a patch has sent too much
    lopsided = Ledger(*np.array([[10, 1, 1], [6, 1, 1], [4, 0, 0], [0, 0, 1]], dtype=float))
    assert lopsided.imbalance == pytest.approx(1.0)  # of the worst channel


def facing_plates():
    """Areas of 2, F = 0.5 both ways, ρ = 0.5; one emits 1, on the other 0.25 falls from a lamp."""
    emission, direct = grey(2, 0.0), grey(2, 0.0)
    emission[0], direct[1] = 1.0, 0.25
    matrix = [[0.0, 0.5], [0.5, 0.0]]
    return system_of(np.array(matrix), np.full(2, 2.0), grey(2, 0.5), emission, direct)


def columns(step):
    ledger = step.ledger
    parts = (ledger.emitted, ledger.absorbed, ledger.unshot, ledger.escaped)
    assert all(np.all(part == part[0]) for part in parts)
    return [float(part[0]) for part in parts]


def test_shots_by_hand():
    steps = SOLVERS["progressive"](facing_plates(), 1e-3, shots_per_step=1)
    # Emitted 2·1 and 2·0.25 from the lamp, half of which the second plate has absorbed.
    assert columns(next(steps)) == [2.5, 0.25, 2.25, 0.0]
    # The first plate sends 2·1: half escapes, half arrives, half of that is absorbed.
    step = next(steps)
    assert step.patch == 0 and columns(step) == [2.5, 0.75, 0.75, 1.0]
    assert step.arriving[:, 0].tolist() == [0.0, 0.75]
    assert step.exact[:, 0].tolist() == [1.0, 0.375]
    # The second has 0.125 of the lamp's light and 0.25 of the plate's, times 2.
    step = next(steps)
    assert step.patch == 1 and columns(step) == [2.5, 0.9375, 0.1875, 1.375]


def test_bounces_by_hand():
    steps = SOLVERS["jacobi"](facing_plates(), 1e-3)
    assert columns(next(steps)) == [2.5, 0.25, 2.25, 0.0]
    # Both send at once, 2·1 and 2·0.125; half of it escapes.
    step = next(steps)
    assert step.patch is None and columns(step) == [2.5, 0.8125, 0.5625, 1.125]


def test_too_much_is_unshot_below_zero():
    system = facing_plates()
    steps = SOLVERS["overshooting"](system, 1e-3, shots_per_step=1)
    next(steps)
    step = next(steps)
    # The mean 0.5625 that waits would arrive as 0.5625 / (1 − 0.5): the plate sends ρ of it more.
    assert step.patch == 0
    assert columns(step) == pytest.approx([2.5, 0.25 + 0.25 * 3.125, -0.09375, 1.5625])
    assert step.ledger.imbalance < 1e-15
