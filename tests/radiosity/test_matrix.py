"""Form factors row by row: when they are computed, what is corrected, what is reported."""

import numpy as np
import pytest
from enclosures import (
    Areas,
    disc_box,
    eliminated,
    grey,
    known,
    random_closed,
    some_light,
    system_of,
)
from plates import WALLS, block, cube, facing_plates, patches_of, rectangle, room

from playground.errors import PlaygroundError
from playground.render.radiosity.factor.closure import is_closed
from playground.render.radiosity.factor.matrix import FormFactors
from playground.render.radiosity.solver.exchange import Exchange
from playground.render.radiosity.solver.solve import SOLVERS, System, solution

U = 2.0**-53


class Counted:
    """Rows of a known matrix; remembers which were asked for."""

    def __init__(self, matrix):
        self.matrix, self.asked = matrix, []

    def __call__(self, chosen):
        self.asked.append(chosen.tolist())
        return self.matrix[chosen]


def test_a_row_is_computed_when_it_is_asked_for_and_then_kept(rng):
    matrix, area = random_closed(rng, 20)
    rows = Counted(matrix)
    factors = FormFactors(rows, Areas(area), closed=True, dtype=np.float64)
    assert factors.computed == 0 and rows.asked == []
    assert factors.rows([7, 3]) == pytest.approx(matrix[[7, 3]], rel=1e-13)
    assert factors.rows([3, 9, 7, 9]) == pytest.approx(matrix[[3, 9, 7, 9]], rel=1e-13)
    factors.send(np.array([7, 9]), np.ones((2, 3)))
    assert rows.asked == [[7, 3], [9]] and factors.computed == 3
    assert factors.gather(np.ones((20, 1))) == pytest.approx(1.0, rel=1e-13)
    assert factors.computed == 20 and sorted(i for each in rows.asked for i in each) == list(
        range(20)
    )


@pytest.mark.parametrize("kept", [0, 1, 5, 150])
def test_what_finds_no_room_is_computed_again(rng, kept):
    """All products are right whatever the memory; more rows than a batch."""
    matrix, area = random_closed(rng, 150)
    rows, light = Counted(matrix), rng.random((150, 2))
    factors = FormFactors(
        rows, Areas(area), closed=True, dtype=np.float64, most_bytes=kept * 150 * 8
    )
    some = rng.permutation(150)[:90]
    assert factors.rows(some) == pytest.approx(matrix[some], rel=1e-12)
    assert factors.gather(light) == pytest.approx(matrix @ light, rel=1e-12)
    power = area[some, None] * light[some]
    sent = matrix[some].T @ power / area[:, None]
    assert factors.send(some, light[some]) == pytest.approx(sent, rel=1e-12)
    exchange = area[:, None] * matrix
    assert factors.exchange(light) == pytest.approx(exchange @ light, rel=1e-12)
    assert factors.column_sums() == pytest.approx(np.ones(150), rel=1e-12)
    assert factors.computed == 150
    assert factors.calls == 150 if kept == 150 else factors.calls > 450


@pytest.mark.parametrize("name", [name for name in SOLVERS if name != "direct"])
def test_solvers_do_with_little_memory(rng, name):
    matrix, area = random_closed(rng, 80)
    light = some_light(rng, 80)
    small = FormFactors(
        Counted(matrix), Areas(area), closed=True, dtype=np.float64, most_bytes=9 * 80 * 8
    )
    step = solution(System(small, area, *light), name, 1e-8)
    assert step.exact == pytest.approx(eliminated(matrix, *light), rel=1e-6)


def test_elimination_says_how_many_patches_it_could_take(rng):
    matrix, area = random_closed(rng, 80)
    small = FormFactors(Counted(matrix), Areas(area), closed=True, most_bytes=2**16)
    with pytest.raises(PlaygroundError, match=r"80 patches are too many.*at most 52 patches"):
        solution(System(small, area, *some_light(rng, 80)), "direct")
    assert small.computed == 0  # said before the work
    with pytest.raises(PlaygroundError, match="at most 90 patches"):
        FormFactors(Counted(matrix), Areas(np.ones(91)), most_bytes=2**16).matrix()


def test_float32_rows_still_sum_to_one(rng):
    """The divisor is float64: a furnace of 1 − 2^-20 keeps its digits."""
    matrix, area = disc_box(4)
    factors = FormFactors(Counted(1.01 * matrix), Areas(area), closed=True, dtype=np.float32)
    rows = factors.rows(np.arange(96))
    assert rows == pytest.approx(matrix, rel=2e-7)  # rounding of the entry and of what it sums to
    assert np.abs(rows.sum(axis=1) - 1.0).max() < 100 * U
    rho = 1.0 - 2.0**-20
    system = System(factors, area, grey(96, rho), grey(96, 1.0))
    assert solution(system, "conjugate-gradients", 1e-8).light == pytest.approx(2.0**20, rel=1e-7)


@pytest.mark.parametrize("rho", [0.5, 0.9, 0.99])
@pytest.mark.parametrize("off", [0.01, -0.01, 0.001])
def test_what_a_wrong_row_sum_does_to_a_furnace(rho, off):
    """C is too bright by (1 − ρ) / (1 − ρ (1 + δ)) − 1: 9.9 % for 1 % at ρ = 0.9."""
    matrix, area = disc_box(3)
    light = (grey(54, rho), grey(54, 1.0))
    law = (1.0 - rho) / (1.0 - rho * (1.0 + off))
    if (rho, off) == (0.9, 0.01):
        assert round(100 * (law - 1.0), 1) == 9.9
    rows, keys = Counted((1 + off) * matrix), {"closed": True, "dtype": np.float64}
    for name in ("direct", "conjugate-gradients", "jacobi", "overshooting"):
        wrong = System(FormFactors(rows, Areas(area), False, **keys), area, *light)
        if rho * (1.0 + off) < 0.999 or name in ("direct", "conjugate-gradients"):
            bright = solution(wrong, name, 1e-10).exact * (1.0 - rho)
            assert bright == pytest.approx(law * np.ones((54, 3)), rel=1e-9)
        right = System(FormFactors(rows, Areas(area), True, **keys), area, *light)
        bright = solution(right, name, 1e-10).exact * (1.0 - rho)
        assert bright == pytest.approx(np.ones((54, 3)), rel=1e-9)


def test_rows_are_corrected_in_closed_scenes_only_and_only_if_wanted(rng):
    matrix, area = random_closed(rng, 10)
    for normalise, closed, sums in ((True, True, 1.0), (True, False, 0.9), (False, True, 0.9)):
        factors = FormFactors(Counted(0.9 * matrix), Areas(area), normalise, closed=closed)
        assert factors.row_sums(np.arange(10)) == pytest.approx(sums, rel=1e-6)
        assert ("divided by its sum" in factors.correction) == (sums == 1.0)
        assert factors.report().correction == factors.correction


def test_a_covered_patch_is_not_stretched(rng):
    matrix, area = random_closed(rng, 10)
    matrix[4], matrix[5] = 0.0, 0.2 * matrix[5]
    factors = FormFactors(Counted(matrix), Areas(area), closed=True)
    assert factors.row_sums([3, 4, 5]) == pytest.approx([1.0, 0.0, 0.2], rel=1e-6)


def test_the_report_names_rows_that_are_stretched(rng):
    matrix, area = random_closed(rng, 10)
    matrix[2] *= 0.8
    matrix[4] *= 0.6
    matrix[5] *= 0.2
    factors = FormFactors(Counted(matrix), Areas(area), closed=True)
    assert factors.report().stretched == 0, "no row is known yet"
    factors.row_sums(np.arange(10))
    report = factors.report()
    assert (report.stretched, report.left_short) == (2, 1)
    assert report.stretched_most == pytest.approx(1.0 / 0.6, rel=1e-6)  # a row in float32
    assert "2 rows sum to less than 0.95 and are stretched, by at most 1.67" in str(report)
    assert "1 rows are mostly covered" in str(report)
    for others in ({"closed": False}, {"closed": True, "normalise": False}):
        factors = FormFactors(Counted(matrix), Areas(area), **others)
        factors.row_sums(np.arange(10))
        assert "stretched" not in str(factors.report())


def test_the_report(rng):
    matrix, area = random_closed(rng, 30)
    matrix[3] *= 1.1
    factors = FormFactors(Counted(matrix), Areas(area), closed=True, dtype=np.float64)
    report = factors.report()
    assert report.computed == 0 and "0 of 30 rows" in str(report)
    factors.rows([3, 8, 9])
    report = factors.report()
    assert (report.computed, report.patches, report.paired, report.closed) == (3, 30, 3, True)
    sums = np.array([1.1, 1.0, 1.0])
    got = [report.lowest, report.highest, report.mean]
    assert got == pytest.approx([sums.min(), sums.max(), sums.mean()], rel=1e-12)
    sent = area[[3, 8, 9], None] * matrix[[3, 8, 9]][:, [3, 8, 9]]
    assert report.reciprocity == pytest.approx(np.abs(sent - sent.T).max() / sent.max(), rel=1e-12)
    share = np.abs(sent - sent.T).sum() / sent.sum()
    assert report.reciprocity_share == pytest.approx(share, rel=1e-12)
    assert "row sums 1.000000 to 1.100000" in str(report)


def test_a_form_factor_that_is_no_number_is_refused(rng):
    matrix, area = random_closed(rng, 6)
    matrix[4, 2] = np.nan
    with pytest.raises(PlaygroundError, match="not a number; got in the row of patch 4"):
        FormFactors(Counted(matrix), Areas(area), closed=True).rows([3, 4, 5])


def without_reciprocity(rng, size=40):
    matrix, area = random_closed(rng, size)
    matrix *= 1.0 + 0.2 * rng.random((size, size))
    return FormFactors(Counted(matrix), Areas(area), closed=True, dtype=np.float64), area


def test_exchange_is_symmetric_and_balanced(rng):
    factors, area = without_reciprocity(rng)
    exchange = Exchange(factors)
    whole = exchange(np.eye(40))
    assert whole == pytest.approx(whole.T, rel=1e-13)
    assert whole.sum(axis=1) == pytest.approx(area, rel=1e-9)
    assert exchange.sums == pytest.approx(np.ones((40, 1)), rel=1e-9)


def test_exchange_changes_nothing_where_reciprocity_holds(rng):
    matrix, area = random_closed(rng, 20)
    for keys in ({}, {"normalise": True}):
        whole = Exchange(known(matrix, area, **keys))(np.eye(20))
        assert whole == pytest.approx(area[:, None] * matrix, rel=1e-11, abs=1e-16)


@pytest.mark.parametrize("name", ["jacobi", "gauss-seidel", "conjugate-gradients", "direct"])
def test_a_furnace_is_exact_without_reciprocity(rng, name):
    factors, area = without_reciprocity(rng)
    step = solution(System(factors, area, grey(40, 0.9), grey(40, 1.0)), name, 1e-9)
    assert step.exact == pytest.approx(grey(40, 10.0), rel=1e-8)


@pytest.mark.parametrize("name", ["progressive", "southwell", "overshooting"])
def test_shooting_keeps_all_light_without_reciprocity(rng, name):
    factors, area = without_reciprocity(rng)
    step = solution(System(factors, area, grey(40, 0.9), grey(40, 1.0)), name, 1e-9)
    assert np.abs(step.ledger.escaped).max() < 1e-12 * area.sum()
    assert step.ledger.imbalance < 1e-12
    mean = (area[:, None] * step.exact).sum(axis=0) / area.sum()
    assert mean == pytest.approx(10.0 * np.ones(3), rel=1e-7)  # ΣA C (1 − ρ) = ΣA E


def test_which_scenes_are_closed():
    assert is_closed(cube(3)) and is_closed(room(4, 2))
    assert not is_closed(facing_plates(3, 0.2))
    for missing in range(6):
        walls = [wall for number, wall in enumerate(WALLS) if number != missing]
        assert not is_closed(patches_of(walls, [(3, 3)] * 5))
    inside_out = [wall[::-1] for wall in WALLS]
    assert not is_closed(patches_of(inside_out, [(2, 2)] * 6))


def test_a_patch_beneath_a_box_does_not_open_a_room():
    standing = [face - [0.0, 0.1, 0.0] for face in block(0.0, 0.0, 0.8, 0.4, 0.2)]
    assert is_closed(patches_of([*WALLS, *standing], [(8, 8)] * 6 + [(1, 1)] * 6))


def test_a_small_window_opens_a_room():
    """A twentieth of a wall."""
    for width in (0.2, 1.9):
        top = [rectangle((-1, -1, 1), (0, 2, 0), (2 - width, 0, 0))]
        assert not is_closed(patches_of([*WALLS[:5], *top], [(4, 4)] * 6))


def test_many_small_patches_do_not_hide_what_a_few_large_ones_lose():
    """The back of a lamp below the ceiling takes light, however finely a small block is cut."""
    lamp = [rectangle((-0.3, 0.9, -0.3), (0.6, 0, 0), (0, 0, 0.6))]
    small = block(0.0, 0.0, 0.2, 0.1, 0.0)
    for m in (1, 40):
        patches = patches_of([*WALLS, *small, *lamp], [(8, 8)] * 6 + [(m, m)] * 6 + [(1, 1)])
        assert not is_closed(patches), m


def test_it_is_asked_only_when_it_matters(monkeypatch):
    def never(patches):
        raise AssertionError

    monkeypatch.setattr("playground.render.radiosity.factor.matrix.is_closed", never)
    patches = cube(1)
    matrix = np.full((6, 6), 0.2) - 0.2 * np.eye(6)
    FormFactors(Counted(matrix), patches, normalise=False).rows([1, 2])
    with pytest.raises(AssertionError):
        FormFactors(Counted(matrix), patches).rows([1, 2])


@pytest.mark.parametrize("chosen", [[6], [0, -1], [0.5]])
def test_patches_that_are_none_have_no_rows(chosen):
    factors = FormFactors(Counted(np.eye(6)), cube(1), closed=True)
    for ask in (factors.rows, factors.row_sums):
        with pytest.raises(PlaygroundError, match=r"no such patch.*from 0 to 5"):
            ask(chosen)


def test_a_system_takes_the_matrix_as_it_is(rng):
    matrix, area = random_closed(rng, 8)
    light = some_light(rng, 8)
    step = solution(system_of(0.97 * matrix, area, *light), "direct")
    assert step.exact == pytest.approx(eliminated(0.97 * matrix, *light), rel=1e-13)
