"""The advisor: what it finds, what it proposes, and that the proposal keeps its budget.

Times come from `cost`, a function of the setup: no test depends on a clock.
"""

import json
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from playground.errors import PlaygroundError
from playground.measure import metrics
from playground.measure.advice import error_of
from playground.measure.advisor import advise, advising
from playground.measure.candidates import KINDS, ONLY, candidates_of, without
from playground.measure.paired import Stopwatch
from playground.render.renderer import render
from playground.scene.library import load
from playground.scene.light import DirectionalLight, PointLight
from playground.scene.scene import Object, Scene
from playground.scene.setup import Setup

SIZE = (64, 48)
BLACK = (0.0, 0.0, 0.0)
KEY = PointLight(position=(2, 3, 4))
DARK = PointLight(position=(1, 3, 4), diffuse=BLACK, specular=BLACK, ambient=BLACK)
# Seen from (0, 0, 3) no point of a ball around the origin has a normal that looks this way.
BEHIND = DirectionalLight(to_light=(0, 0, -1), specular=BLACK, ambient=BLACK)
FAINT = DirectionalLight(to_light=(0, 1, 1), diffuse=(0.02, 0.02, 0.02), specular=BLACK)
SPEED = {"flat": 0.1, "per-vertex": 0.3, "per-fragment": 1.0}


def ball(*lights, **changes):
    scene = Scene(background=BLACK, objects=(Object("sphere", tessellation=32),), lights=lights)
    return Setup(scene, name="ball").with_(eye=(0, 0, 3), target=BLACK, fov=45.0, **changes)


def cost(setup):
    """Milliseconds that grow with all that could be dropped."""
    triangles = sum(len(item.geometry().mesh.faces) for item in setup.scene.objects)
    faded = sum(getattr(light, "attenuate", False) for light in setup.scene.lights)
    textured = sum(bool(item.material.texture) for item in setup.scene.objects)
    s = setup.settings
    shading = SPEED[s.shading] * (len(setup.scene.lights) + 0.1 * faded) * (1 + len(s.terms))
    return 1.0 + s.samples * (shading + textured) + 1e-3 * triangles


def advice(setup, budget=0.01, metric="rmse", **more):
    return advise(setup, budget, metric, **{"size": SIZE, "renderer": "numpy", "cost": cost} | more)


def names(findings):
    return [finding.candidate.name for finding in findings]


def shown(setup):
    return render(setup, SIZE, "numpy").shown()


def test_what_cannot_be_seen_contributes_nothing_and_goes_first():
    found = advice(ball(KEY, DARK, BEHIND), 1e-4)
    by_name = {finding.candidate.name: finding for finding in found.findings}
    for name in ("light 1 (point)", "light 2 (directional)"):
        errors = by_name[name].errors
        assert (errors.rmse, errors.max, errors.flip, errors.off) == (0.0, 0.0, 0.0, 0.0)
    assert set(names(found.chosen)[:2]) == {"light 1 (point)", "light 2 (directional)"}
    assert found.proposed.scene.lights == (KEY,)
    assert by_name["light 0 (point)"].errors.rmse > 0.05
    assert by_name["light 0 (point)"].errors.off > 0.1


@pytest.mark.parametrize("budget", [1e-6, 1e-3, 0.01, 0.03])
def test_an_important_light_stays(budget):
    setup = ball(DARK, KEY, FAINT)
    without_key = shown(setup.with_(lights=(DARK, FAINT)))
    assert np.sqrt(np.mean((without_key - shown(setup)) ** 2)) > 0.03
    assert KEY in advice(setup, budget).proposed.scene.lights


@pytest.mark.parametrize("metric", ["rmse", "max", "flip"])
@pytest.mark.parametrize("budget", [0.003, 0.02, 0.08])
def test_the_picture_of_the_whole_proposal_keeps_the_budget(metric, budget):
    setup = ball(KEY, FAINT, BEHIND, samples=2)
    found = advice(setup, budget, metric)
    full, less = shown(setup), shown(found.proposed)
    error = {
        "rmse": np.sqrt(np.mean((full - less) ** 2)),
        "max": np.max(np.abs(full - less)),
        "flip": np.mean(metrics.flip_map(full, less)),
    }[metric]
    assert error <= budget
    # Sums of the same numbers in another order: a few steps of float64 apart
    assert found.errors.of(metric) == pytest.approx(error, rel=1e-12, abs=1e-15)
    assert found.chosen
    assert found.saving.saved == pytest.approx(cost(setup) - cost(found.proposed))


def test_errors_do_not_add():
    """Two lights, each of which alone lights the ball beyond white: one can go, both cannot."""
    bright = replace(KEY, diffuse=(9, 9, 9), specular=BLACK)
    setup = ball(bright, bright, terms=("diffuse",)).with_(shading="flat", tessellation=3)
    found = advice(setup, 0.08)
    alone = [f.errors.rmse for f in found.findings if f.candidate.kind == "light"]
    assert max(alone) <= 0.08
    assert len(found.proposed.scene.lights) == 1
    neither = error_of("rmse", render(setup, SIZE, "numpy"), render(ball(), SIZE, "numpy"))
    assert neither > 2 * sum(alone)


@pytest.mark.parametrize("name", ["coloured-lights", "textured", "teapot"])
def test_a_larger_budget_never_keeps_more(name):
    kept = [cost(advice(load(name), b).proposed) for b in (1e-4, 1e-3, 0.01, 0.05, 0.2, 1.0)]
    assert all(larger <= smaller for smaller, larger in pairwise(kept))
    assert kept[-1] < kept[0]


def test_a_coarser_ball_has_another_silhouette():
    found = advice(ball(KEY), 1e-9)
    levels = [f for f in found.findings if f.candidate.kind == "tessellation"]
    assert [f.candidate.name[-7:] for f in levels] == ["32 → 16", " 32 → 8", " 32 → 4"]
    full = render(ball(KEY), SIZE, "numpy").coverage > 0
    lost = []
    for finding in levels:
        coarse = finding.candidate.change(ball(KEY))
        lost.append(np.sum(full != (render(coarse, SIZE, "numpy").coverage > 0)))
    errors = [f.errors.rmse for f in levels]
    assert 0 < lost[0] < lost[1] < lost[2]
    assert 0.0 < errors[0] < errors[1] < errors[2]
    assert not any(f in found.chosen for f in levels)


def test_of_levels_that_exclude_each_other_one_is_proposed():
    found = advice(ball(KEY, samples=4), 0.5)
    parts = [finding.candidate.part for finding in found.chosen]
    assert len(parts) == len(set(parts))
    assert found.proposed.settings.samples == 1


def test_every_kind_changes_what_its_name_says():
    fading = replace(KEY, attenuate=True)
    setup = load("textured").with_(lights=(fading, DARK), samples=4)
    every = candidates_of(setup)
    assert {candidate.kind for candidate in every} == set(KINDS) - set(ONLY["ray-tracing"])
    assert len({candidate.name for candidate in every}) == len(every)
    for candidate in every:
        assert candidate.change(setup) != setup
        assert cost(candidate.change(setup)) < cost(setup)


def test_all_lights_leave_by_their_numbers():
    setup = ball(KEY, DARK, BEHIND, FAINT)
    lights = [c for c in candidates_of(setup) if c.kind == "light"]
    assert without(setup, lights).scene.lights == ()
    assert without(setup, [lights[0], lights[2]]).scene.lights == (DARK, FAINT)
    fading = ball(DARK, replace(KEY, attenuate=True))
    chosen = [
        c
        for c in candidates_of(fading)
        if c.name in ("light 0 (point)", "fading of light 1 (point)")
    ]
    assert without(fading, chosen).scene.lights == (KEY,)


def test_a_texture_gives_way_to_its_mean():
    setup = load("textured")
    texture = next(c for c in candidates_of(setup) if c.kind == "texture")
    material = texture.change(setup).scene.objects[0].material
    assert material.texture == ""
    assert 0.0 < min(material.diffuse) <= max(material.diffuse) < 1.0
    assert material == replace(
        setup.scene.objects[0].material, texture="", diffuse=material.diffuse
    )


def test_nothing_to_drop():
    setup = Setup(Scene(objects=(), lights=()), name="empty").with_(terms=(), shading="flat")
    found = advice(setup)
    assert found.findings == found.chosen == ()
    assert found.proposed is setup
    assert found.sentence() == "empty has nothing that could be dropped."
    assert found.table() == ""


def test_what_saves_no_time_is_not_proposed():
    found = advice(ball(KEY, DARK), 1.0, cost=lambda setup: 5.0)
    assert found.findings and not found.chosen
    assert found.saving is None and found.proposed is found.setup
    assert "without effect on the picture: light 1 (point)" in found.sentence()


def test_the_sentence_is_what_was_measured():
    setup = ball(KEY, DARK)
    found = advice(setup, 1e-9)
    full, less = cost(setup), cost(found.proposed)
    share = 100 * (full - less) / full
    assert f"saves {full - less:.3g} of {full:.3g} ms a picture, {share:.0f} %" in found.sentence()
    document = json.loads(json.dumps(found.to_dict()))
    assert document["proposal"]["drop"] == names(found.chosen)
    assert document["sentence"] == found.sentence()
    proposed = [row["name"] for row in document["findings"] if row["proposed"]]
    assert set(proposed) == set(names(found.chosen))
    for finding in found.findings:
        line = next(row for row in found.table().splitlines() if finding.candidate.name in row)
        assert line.startswith("*") == (finding in found.chosen)


def test_flip_can_be_left_out_unless_it_is_the_metric():
    setup = ball(KEY)
    assert all(f.errors.flip is None for f in advice(setup, flip=False).findings)
    assert all(f.errors.flip >= 0.0 for f in advice(setup, metric="flip", flip=False).findings)


def test_progress_rises_and_shows_what_is_found():
    steps = advising(ball(KEY, DARK), 0.01, size=SIZE, renderer="numpy", cost=cost)
    told = list(steps)
    assert all(a.share <= b.share for a, b in pairwise(told))
    assert 0.0 <= told[0].share < 0.1 and 0.9 < told[-1].share <= 1.0
    assert all(a.findings == b.findings[: len(a.findings)] for a, b in pairwise(told))


def test_it_can_be_given_up(monkeypatch):
    closed = []
    monkeypatch.setattr(Stopwatch, "close", lambda self: closed.append(self))
    steps = advising(ball(KEY), 0.01, size=(8, 8), renderer="numpy")
    for _ in range(3):
        next(steps)
    steps.close()
    assert len(closed) == 1
    with pytest.raises(StopIteration):
        next(steps)


@pytest.mark.parametrize("budget", [0, -1, float("nan"), float("inf"), "much", None, True])
def test_a_budget_is_a_number_above_zero(budget):
    with pytest.raises(PlaygroundError, match="error budget is not valid"):
        advice(ball(KEY), budget)


def test_a_metric_is_one_of_three():
    with pytest.raises(PlaygroundError, match="unknown metric"):
        advice(ball(KEY), 0.01, "ssim")


def test_what_saves_nothing_when_measured_again_is_not_proposed():
    setup, dark = ball(KEY, DARK), ball(KEY)

    def lucky():
        """Whoever is measured first without the dark light is faster; the proposal is not."""
        firsts = []

        def measured(drawn):
            if drawn.scene == dark.scene and not any(drawn is each for each in firsts):
                firsts.append(drawn)
            return 4.0 if firsts and drawn is firsts[0] else 5.0

        return measured

    found = advice(setup, 0.01, cost=lucky())
    assert names(found.refuted) == ["light 1 (point)"]
    assert found.chosen == () and found.proposed is setup and found.saving is None
    assert found.sentence() == (
        "Dropping light 1 (point) saves no time when measured again: nothing is proposed."
    )
    assert found.to_dict()["proposal"]["drop"] == []


@pytest.mark.gl
def test_the_gpu_finds_what_numpy_finds(gl_context):
    setup = ball(KEY, DARK, BEHIND)
    drawn = advice(setup, 0.02, renderer="gl", context=gl_context)
    exact = advice(setup, 0.02)
    assert names(drawn.chosen) == names(exact.chosen)
    for mine, theirs in zip(drawn.findings, exact.findings, strict=True):
        # One pixel of the silhouette on the other side changes the RMSE by this at most
        assert abs(mine.errors.rmse - theirs.errors.rmse) <= 1.0 / np.sqrt(SIZE[0] * SIZE[1])
