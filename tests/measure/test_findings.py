"""The sentence of an experiment follows from its rows: other rows, another sentence."""

from dataclasses import replace

import pytest
from synthetic import row

from playground.measure.experiments import EXPERIMENTS, find
from playground.measure.experiments.first_image import BASE, FLOOR, IMPORT, OURS


def finding(name, *rows):
    return find(name).finding(list(rows))


@pytest.mark.parametrize("name", EXPERIMENTS)
def test_no_rows_no_claim(name):
    assert finding(name) == "Nothing has been compared yet."


def test_shading_rate():
    coarse = row("per-fragment", 1.0, 0.02, tessellation=8)
    fine = row("per-fragment", 2.0, 0.005, tessellation=16)
    vertex = row("per-vertex", 6.0, 0.008, tessellation=64)
    flat = row("flat", 5.0, 0.3, tessellation=64)
    told = finding("shading-rate", coarse, fine, vertex, flat)
    assert told.startswith(
        "An error of 1 % is reached first by per-fragment, tessellation 16 (2 ms); "
        "by per-vertex, tessellation 64 in 3 times that; not by flat"
    )
    assert "-2.0 (per-fragment)" in told
    swapped = finding("shading-rate", coarse, fine, row("per-vertex", 1.0, 0.008, tessellation=64))
    assert swapped.startswith("An error of 1 % is reached first by per-vertex")
    assert "by per-fragment, tessellation 16 in 2 times that" in swapped
    assert finding("shading-rate", flat).startswith("No shading reaches an error of 1 %")


def test_popping():
    def jumps(method, error, off, tessellation):
        return row(method, 1.0, error, more={"peak off by": off}, tessellation=tessellation)

    told = finding("popping", jumps("per-vertex", 0.2, 0.5, 8), jumps("per-vertex", 0.01, 0.02, 64))
    assert "per-vertex 20 % at most (at tessellation 8), 1 % at tessellation 64" in told
    assert told.endswith("lost somewhere on the way by per-vertex, tessellation 8.")
    calm = finding("popping", jumps("per-vertex", 0.001, 0.01, 8))
    assert "per-vertex 0.1 % at most" in calm and "lost" not in calm


def test_normal_interpolation():
    def pair(price, loss):
        return (
            row("renormalised", 1.0 + price, 0.01, tessellation=8),
            row("not renormalised", 1.0, 0.01 * loss, tessellation=8),
        )

    dear = finding("normal-interpolation", *pair(0.2, 3.0))
    assert "3 times at tessellation 8" in dear and "+20 %" in dear
    assert "not told apart" not in dear
    free = finding("normal-interpolation", *pair(0.0, 0.5))
    assert "0.5 times at tessellation 8" in free and "not told apart from nothing" in free
    few = (replace(each, rounds=each.rounds[:3]) for each in pair(0.2, 3.0))
    assert "not told apart from nothing" in finding("normal-interpolation", *few)


def test_anti_aliasing():
    told = finding(
        "anti-aliasing", row("GL", 1.0, 0.04, samples=1), row("GL", 3.0, 0.01, samples=4)
    )
    assert told == (
        "GL: 4 samples take 3 times the time of 1 and change the error from 4 % to 1 %, "
        "as samples to the power -1.00."
    )
    worse = finding(
        "anti-aliasing", row("NumPy", 1.0, 0.01, samples=1), row("NumPy", 3.0, 0.02, samples=4)
    )
    assert "NumPy" in worse and "from 1 % to 2 %" in worse and "power 0.50" in worse


def test_renderer():
    told = finding("renderer", row("GL", 2.0, 0.02, "a"), row("NumPy", 20.0, 0.01, "a"))
    assert told == "A: NumPy takes 10 times the time of GL (error 1 %, GL 2 %)."
    assert "0.5 times" in finding("renderer", row("GL", 2.0, case="a"), row("NumPy", 1.0, case="a"))


def test_specular_power():
    power = row("pow", 4.0, 0.0, "GLSL, shininess 20")
    bad = row("Schlick", 2.0, 0.2, "GLSL, shininess 20")
    assert finding("specular-power", power, bad) == (
        "GLSL, pow beside the fastest within 1 %, at shininess 20: it is the fastest; "
        "Schlick's form is off by up to 20 %."
    )
    good = row("Schlick", 2.0, 0.001, "GLSL, shininess 20")
    told = finding("specular-power", power, good)
    assert "20: 2 times as long as Schlick" in told and "off by up to 0.1 %" in told


@pytest.mark.parametrize("name", ["area-light", "area-light-gl"])
def test_area_light(name):
    closed = row("closed form", 10.0, 1e-15, "c")
    few = row("uniform samples", 1.0, 0.4, "c", samples=1)
    many = row("uniform samples", 9.0, 0.2, "c", samples=4)
    told = finding(name, closed, few, many)
    assert "in its time fit 4 uniform samples, off by 20 %" in told and "power -0.50" in told
    dear = finding(name, row("closed form", 0.5, 1e-15, "c"), few, many)
    assert "1 uniform samples take 2 times its time" in dear


def test_precision():
    rows = [
        row("GL float32", 1.0, 1e-6, "sh 5"),
        row("GL float16", 3.0, 1e-3, "sh 5"),
        row("GL float32", 1.0, 1e-6, "sh 1000"),
        row("GL float16", 3.0, 0.5, "sh 1000"),
    ]
    told = finding("precision", *rows)
    assert "Sh 5: every precision stays within one step of 8 bits" in told
    assert "sh 1000: GL float16 50 % off at worst, GL float16 takes 3 times" in told


def test_cost():
    full, plain = "a scene with everything", "a plain scene"
    program = {"same program": 1.0}
    other = {"same program": 0.0}
    rows = [
        row("everything", 4.0, 0.0, full),
        row("no texture", 3.0, 0.1, full),
        row("no gate", 4.0, 0.1, full),
        row("plain", 1.0, 0.0, plain, more=program),
        row("gate", 1.0, 0.0, plain, more=program),
        row("black light", 1.5, 0.0, plain, more=other),
    ]
    told = finding("cost", *rows)
    assert "everything most by -25 % (no texture); lost in the noise: no gate" in told
    assert "1 of 2 idle things run the very program of a plain scene" in told
    assert "1 of these in a time not told apart" in told
    assert "0 of the others in a time not told apart from its own (but black light (+50 %))" in told
    even = finding("cost", *rows[:1], rows[2])
    assert "no feature of a scene with everything has a price" in even.lower()
    few = finding("cost", *(replace(each, rounds=each.rounds[:3]) for each in rows))
    assert few == (
        "3 rounds are too few to tell any price from the noise; "
        "1 of 2 idle things run the very program of a plain scene."
    )


def test_frames():
    rows = [row("per-fragment", 1.0, 0.0, "1k", ratio=0.8), row("VTK", 3.0, case="1k", ratio=2.0)]
    assert finding("frames", *rows) == (
        "1k: ours takes 0.8 times the time of the floor, VTK 2 times."
    )
    assert "1.5 times" in finding("frames", row("per-fragment", 1.0, 0.0, "1k", ratio=1.5))


def test_first_image():
    def process(command, seconds):
        return row("cold process", seconds, more={"megabytes": 100.0}, command=command)

    told = finding(
        "first-image", process(OURS, 0.3), process(FLOOR, 0.2), process(BASE, 0.1),
        process(IMPORT, 0.15),
    )  # fmt: skip
    assert told.startswith("The first picture takes 0.3 s and 100 MB; the floor 0.2 s and 100 MB")
    assert "importing the package after NumPy takes +50 ms" in told
