"""All solvers against elimination, theory and each other."""

from itertools import islice, pairwise
from math import ceil, log

import numpy as np
import pytest
from enclosures import Areas, disc_box, eliminated, grey, random_closed, some_light, system_of

from playground.errors import PlaygroundError
from playground.render.radiosity.factor.matrix import FormFactors
from playground.render.radiosity.solver.solve import SOLVERS, System, solution
from playground.scene import settings

SHOOTING = ("progressive", "southwell", "overshooting")
ITERATIVE = [name for name in SOLVERS if name != "direct"]
STEPWISE = ("jacobi", "gauss-seidel", *SHOOTING)
U = 2.0**-53


@pytest.fixture(params=[1.0, 0.7, 0.05], ids=["closed", "open", "wide open"])
def room(request, rng):
    """A matrix, areas, reflectance, emission, direct light; also with patches that see nothing."""
    factors, area = random_closed(rng, 40)
    factors *= request.param
    if request.param < 1.0:
        factors[5], factors[:, 5] = 0.0, 0.0
    return factors, area, *some_light(rng, 40)


def error(area, light, truth):
    """Σ A |difference| / Σ A |light| of the worst channel."""
    a = area[:, None]
    return float(np.max((a * np.abs(truth - light)).sum(0) / (a * np.abs(light)).sum(0)))


def test_the_names_are_those_of_the_settings():
    assert tuple(SOLVERS) == settings.SOLVERS


@pytest.mark.parametrize("name", SOLVERS)
def test_every_step_is_as_near_as_it_says(room, name):
    factors, area, *light = room
    truth = eliminated(factors, *light)
    for step in SOLVERS[name](system_of(factors, area, *light), 1e-6):
        assert error(area, step.exact, truth) <= step.bound + 100 * U
    assert step.residual <= 1e-6
    assert step.bound < 1e-5  # 0.9 / (1 − 0.9) residuals, over a light that exceeds the first


@pytest.mark.parametrize("name", SOLVERS)
def test_it_balances_at_every_step(room, name):
    factors, area, *light = room
    for step in SOLVERS[name](system_of(factors, area, *light), 1e-5):
        # Each part sums N numbers, of a few roundings each; what escaped grows shot by shot.
        assert step.ledger.imbalance <= (4 * (len(area) + 8) + 2 * step.done) * U
    assert np.all(step.ledger.absorbed > 0.0)
    assert np.all(step.ledger.unshot < 1e-4 * step.ledger.emitted)


@pytest.mark.parametrize("name", SOLVERS)
def test_nothing_escapes_from_a_closed_room(rng, name):
    factors, area = random_closed(rng, 30)
    step = solution(system_of(factors, area, *some_light(rng, 30)), name, 1e-9)
    assert np.max(np.abs(step.ledger.escaped / step.ledger.emitted)) < 1e-12  # sums off by 1e-13
    assert step.ledger.absorbed == pytest.approx(step.ledger.emitted, rel=1e-8)


@pytest.mark.parametrize("name", SOLVERS)
@pytest.mark.parametrize("rho", [0.0, 0.5, 0.9, 0.99])
def test_the_furnace(rng, name, rho):
    factors, area = random_closed(rng, 30)
    system = system_of(factors, area, grey(30, rho), grey(30, 2.0))
    step = solution(system, name, 1e-10)
    # The share left of the light is the share missing of the light: both are powers of rho.
    assert step.exact == pytest.approx(grey(30, 2.0 / (1.0 - rho)), rel=1e-9)
    assert step.arriving == pytest.approx(grey(30, 2.0 / (1.0 - rho)), rel=1e-9)


@pytest.mark.parametrize("name", ["conjugate-gradients", "direct", "overshooting"])
def test_a_furnace_that_is_nearly_white(rng, name):
    rho = 1.0 - 2.0**-20
    factors, area = disc_box(3)
    step = solution(system_of(factors, area, grey(54, rho), grey(54, 1.0)), name, 1e-7)
    # Sums of rows are off by some 50 u, which counts 1 / (1 − rho) times.
    assert step.light == pytest.approx(grey(54, 2.0**20), rel=1e-7)


@pytest.mark.parametrize("name", STEPWISE)
def test_slow_solvers_say_so_instead(name):
    rho = 1.0 - 2.0**-20
    factors, area = disc_box(1)
    emission = grey(6, 0.0)
    emission[0] = 1.0
    system = system_of(factors, area, grey(6, rho), emission)
    if name == "overshooting":  # takes what is to come at once
        assert solution(system, name, 1e-6).residual <= 1e-6
        return
    with pytest.raises(PlaygroundError, match=r"more sweeps needed.*conjugate-gradients"):
        solution(system, name, 1e-6)


@pytest.mark.parametrize("name", SOLVERS)
def test_light_that_grows_is_refused(rng, name):
    factors, area = random_closed(rng, 20)
    emission = some_light(rng, 20)[1]
    with pytest.raises(PlaygroundError, match=r"grows without bound.*sum to up to 1.02.*normalise"):
        solution(system_of(1.02 * factors, area, grey(20, 0.99), emission), name)


@pytest.mark.parametrize("name", SOLVERS)
def test_light_that_is_never_absorbed_is_refused(name):
    factors, area = disc_box(1)
    with pytest.raises(PlaygroundError, match=r"never absorbed.*Lower the reflectance"):
        solution(system_of(factors, area, grey(6, 1.0), grey(6, 1.0)), name)


@pytest.mark.parametrize("name", SOLVERS)
def test_white_patches_are_solved_if_another_absorbs(name):
    reflectance, emission = grey(4, 1.0), grey(4, 0.0)
    reflectance[3], emission[0] = 0.0, 1.0
    step = solution(system_of(grey(4, 0.25)[:, [0] * 4], np.ones(4), reflectance, emission), name)
    # H = (1 + 3 H) / 4, so H = 1; a quarter is absorbed at each flight.
    assert step.exact == pytest.approx(np.outer([2.0, 1.0, 1.0, 0.0], np.ones(3)), abs=1e-3)


def first_left(rho, share):
    """The first k with rho^k <= share."""
    return ceil(log(share) / log(rho))


@pytest.mark.parametrize("rho", [0.5, 0.8, 0.95, 0.99])
def test_the_number_of_sweeps_is_that_of_theory(rng, rho):
    factors, area = disc_box(4)
    everywhere = system_of(factors, area, grey(96, rho), grey(96, 1.0))
    assert solution(everywhere, "jacobi", 1e-4).done == first_left(rho, 1e-4)

    # From one wall the even part of the light decides, after a few bounces.
    emission = grey(96, 0.0)
    emission[80:] = 1.0
    sweeps = {
        name: solution(system_of(factors, area, grey(96, rho), emission), name, 1e-4).done
        for name in SOLVERS
    }
    assert abs(sweeps["jacobi"] - first_left(rho, 1e-4)) <= 2
    assert 1 / 3 <= sweeps["gauss-seidel"] / sweeps["jacobi"] <= 0.6
    assert sweeps["conjugate-gradients"] <= 8
    # A patch that waits sends with one shot what came with many: about half the sweeps of Jacobi.
    assert 1 / 3 <= sweeps["progressive"] / 96 / sweeps["jacobi"] <= 0.75
    assert sweeps["overshooting"] < 0.6 * sweeps["progressive"]


def test_each_sweep_is_a_bounce(rng):
    factors, area = random_closed(rng, 25)
    reflectance, emission, direct = some_light(rng, 25)
    first = emission + reflectance * direct
    bounce, light = first, first.copy()
    for step in islice(
        SOLVERS["jacobi"](system_of(factors, area, reflectance, emission, direct), 1e-9), 12
    ):
        assert step.exact == pytest.approx(light, rel=1e-13)
        bounce = reflectance * (factors @ bounce)
        light = light + bounce


@pytest.mark.parametrize("block", [1, 7, 64])
def test_gauss_seidel_is_the_textbook_one(rng, monkeypatch, block):
    """Updates in blocks give what updates one by one give, with F_ii != 0 too."""
    monkeypatch.setattr("playground.render.radiosity.solver.gathering.TOGETHER", block)
    factors, area = random_closed(rng, 20)
    factors = 0.8 * factors + 0.2 * np.eye(20)
    reflectance, emission, direct = some_light(rng, 20)
    light = emission + reflectance * direct
    steps = SOLVERS["gauss-seidel"](system_of(factors, area, reflectance, emission, direct), 1e-9)
    next(steps)
    for step in islice(steps, 4):
        for i in range(20):
            others = factors[i] @ light - factors[i, i] * light[i]
            received = emission[i] + reflectance[i] * (direct[i] + others)
            light[i] = received / (1.0 - reflectance[i] * factors[i, i])
        light = emission + reflectance * (direct + factors @ light)  # and what is seen of it
        assert step.exact == pytest.approx(light, rel=1e-12)


@pytest.mark.parametrize("name", SOLVERS)
def test_going_on_is_not_having_stopped(room, name):
    factors, area, *light = room
    steps = list(SOLVERS[name](system_of(factors, area, *light), 1e-6))
    for stop in {0, len(steps) // 3, len(steps) // 2, len(steps) - 1}:
        system = system_of(factors, area, *light)
        rest = list(SOLVERS[name](system, 1e-6, steps[stop]))
        assert [step.done for step in rest] == [step.done for step in steps[stop + 1 :]]
        for one, other in zip(rest, steps[stop + 1 :], strict=True):
            assert np.array_equal(one.light, other.light)
            assert np.array_equal(one.ledger.escaped, other.ledger.escaped)


@pytest.mark.parametrize("name", SOLVERS)
@pytest.mark.parametrize("before", ITERATIVE)
def test_a_solver_takes_over_from_another(room, name, before):
    factors, area, *light = room
    truth = eliminated(factors, *light)
    begun = solution(system_of(factors, area, *light), before, 1e-2)
    step = solution(system_of(factors, area, *light), name, 1e-7, begun)
    assert error(area, step.exact, truth) <= step.bound + 100 * U
    assert step.residual <= 1e-7 and step.ledger.imbalance < 1e-12


@pytest.mark.parametrize("name", SOLVERS)
def test_a_channel_without_light_costs_nothing(rng, name):
    factors, area = random_closed(rng, 20)
    reflectance, emission, direct = some_light(rng, 20)
    emission[:, 1], direct[:, 1] = 0.0, 0.0
    system = system_of(factors, area, reflectance, emission, direct)
    assert system.working.rho.shape == (20, 2)
    step = solution(system, name, 1e-8)
    assert not step.light[:, 1].any() and not step.arriving[:, 1].any()
    lit = step.exact[:, [0, 2]]
    truth = eliminated(factors, reflectance, emission, direct)[:, [0, 2]]
    assert lit == pytest.approx(truth, rel=1e-5)


@pytest.mark.parametrize("name", SHOOTING)
def test_rows_of_patches_that_never_shoot_are_never_computed(rng, name):
    factors, area = random_closed(rng, 50)
    reflectance, emission, _ = some_light(rng, 50)
    reflectance[20:] = 0.0  # black, and no lamps: they have nothing to send
    asked = []

    def rows(chosen):
        asked.extend(chosen.tolist())
        return factors[chosen]

    form_factors = FormFactors(rows, Areas(area), closed=True, dtype=np.float64)
    step = solution(System(form_factors, area, reflectance, emission), name, 1e-10)
    assert sorted(asked) == list(range(20)) and form_factors.computed == 20
    assert step.exact == pytest.approx(eliminated(factors, reflectance, emission), rel=1e-8)
    assert np.all(step.arriving[20:] > 0.0)


def test_no_row_is_asked_for_before_the_first_step(rng):
    factors, area = random_closed(rng, 10)
    for name in SOLVERS:
        system = system_of(factors, area, *some_light(rng, 10))
        step = next(SOLVERS[name](system, 1e-4))
        assert (
            system.form_factors.computed == 0
            and step.done == 0
            and step.residual == pytest.approx(1.0)
        )


@pytest.mark.parametrize("name", SHOOTING)
def test_shots_one_by_one(rng, name):
    factors, area = random_closed(rng, 30)
    light = some_light(rng, 30)
    one = list(SOLVERS[name](system_of(factors, area, *light), 1e-4, shots_per_step=1))
    assert [step.done for step in one] == list(range(len(one)))
    assert one[0].patch is None and all(len(step.patches) == 1 for step in one[1:])
    for before, after in pairwise(one):
        left = np.abs(before.state[0].unshot).sum(axis=1)
        if name == "progressive":
            assert after.patch == np.argmax(left * area)
        elif name == "southwell":
            assert after.patch == np.argmax(left)
    many = solution(system_of(factors, area, *light), name, 1e-4)
    assert many.exact == pytest.approx(one[-1].exact, rel=1e-2)
    assert 0.5 < many.done / one[-1].done < 2.0


def test_the_ambient_estimate_comes_nearer_early(rng):
    factors, area = disc_box(4)
    reflectance, emission = grey(96, 0.8), grey(96, 0.0)
    emission[80:] = 1.0
    truth = eliminated(factors, reflectance, emission)
    steps = list(SOLVERS["progressive"](system_of(factors, area, reflectance, emission), 1e-6))
    for step in steps[: len(steps) // 2]:
        assert error(area, step.light, truth) < 0.5 * error(area, step.exact, truth)
    assert np.max(np.abs(steps[-1].light - steps[-1].exact)) < 1e-5
    plain = SOLVERS["progressive"](
        system_of(factors, area, reflectance, emission), 1e-6, ambient=False
    )
    assert all(np.array_equal(step.light, step.exact) for step in plain)


def test_overshooting_does_not_overdo_open_scenes(rng):
    """Also where nearly all light leaves, and patches that see nothing keep their own."""
    for stay in (0.9, 0.3, 0.0):
        factors, area = random_closed(rng, 12)
        factors *= stay
        factors[:4], factors[:, :4] = 0.0, 0.0
        reflectance, emission = grey(12, 0.99), grey(12, 1.0)
        system = system_of(factors, area, reflectance, emission)
        step = solution(system, "overshooting", 1e-9)
        assert step.exact == pytest.approx(eliminated(factors, reflectance, emission), rel=1e-6)
        assert step.done < 40 * 12


@pytest.mark.parametrize("name", SOLVERS)
@pytest.mark.parametrize("size", [1e-9, 1e9])
@pytest.mark.parametrize("strength", [1e-20, 1e20])
def test_neither_unit_matters(rng, name, size, strength):
    factors, area = random_closed(rng, 12)
    reflectance, emission, direct = some_light(rng, 12)
    plain = solution(system_of(factors, area, reflectance, emission, direct), name, 1e-8)
    scaled = system_of(factors, size * area, reflectance, strength * emission, strength * direct)
    other = solution(scaled, name, 1e-8)
    assert other.exact / strength == pytest.approx(plain.exact, rel=1e-7)


def test_bad_systems_are_refused(rng):
    factors, area = random_closed(rng, 5)
    good = {"reflectance": grey(5, 0.5), "emission": grey(5, 1.0), "direct": grey(5, 0.0)}
    spoiled = good["reflectance"].copy()
    spoiled[3, 1] = 1.5
    nan = good["emission"].copy()
    nan[2] = np.nan
    for changed, words in (
        ({"reflectance": spoiled}, r"reflectance of patch 3 .*got 1.5; allowed: 0 to 1"),
        ({"emission": nan}, r"emission of patch 2 .*got nan"),
        ({"direct": -good["emission"]}, r"direct of patch 0 .*got -1.0; allowed: finite"),
        ({"emission": grey(5, 0.0)}, r"no light enters the scene.*add a light"),
        ({"emission": grey(4, 1.0)}, r"the emission of 5 patches; got \(4, 3\)"),
    ):
        with pytest.raises(PlaygroundError, match=words):
            system_of(factors, area, **{**good, **changed})
    with pytest.raises(PlaygroundError, match=r"unknown solver.*'progresive'.*'progressive'"):
        solution(system_of(factors, area, **good), "progresive")
