"""Every formula exists twice, under one name, with one list of arguments."""

import inspect
from importlib import import_module

import pytest

from playground import locate
from playground.render.gl.probe import signatures

STEMS = sorted(path.stem for path in locate.shader("lib").glob("*.glsl"))

# Functions with no twin, each with its reason.
NUMPY_ALONE = {
    "vector": {
        "cross": "a GLSL built-in",
        "dot": "a GLSL built-in",
        "normal_matrix": "needed once per object, computed on the CPU",
        "orientation": "needed once per object, computed on the CPU",
    },
    "phong": {
        "ambient_term": "the same at every point: computed once per surface, on the CPU",
        "emissive_term": "the same at every point",
        "weighted_sum": "the weights are folded into the products, once per surface, on the CPU",
    },
    "polygon": {
        "seen_edges": "GLSL goes from edge to edge",
        "cut_edges": "cut_edge for all edges at once",
        "extent": "a part of sighted",
        "area_samples": "GLSL goes from point to point",
        "chosen_vectors": "GLSL has no masks",
    },
    "optics": {
        "mirror_series": "what a recursion leaves out is told before it starts, on the CPU",
        "bounces_until": "a count of up to millions, which float32 cannot hold",
    },
    "light": {"cone": "needed once per light, computed on the CPU"},
    "flat_polygon": {
        "heights": "height_over, all corners at once",
        "clip_front": "cut_front, all edges at once",
        "quad_points": "GLSL goes from point to point",
    },
    "display": {
        "display_colour": "present.glsl strings the same steps together, specialised",
        "code8": "the 8-bit target does it",
    },
}
GLSL_ALONE = {
    "ray": {"next_float": "NumPy has nextafter"},
    "vector": {"unit_moderate": "float64 needs no second form"},
    "arc": {
        "angle_of": "NumPy has arctan2",
        "one_less_exp": "NumPy has expm1",
        "lobe_slope": "a part of lobe_arc",
        "lobe_gauss": "a part of lobe_arc",
        "arc_point": "a part of lobe_arc",
    },
    "polygon": {
        "sighted": "NumPy takes all corners at once",
        "cut_edge": "cut_edges, one edge at a time",
    },
    "form_factor": {
        "size_of": "NumPy has frexp",
        "cosines_between": "a part of point_to_point and point_to_disc",
    },
    "flat_polygon": {
        "height_over": "heights, one corner at a time",
        "cut_front": "clip_front, one edge at a time",
    },
    "edge_log": {
        "log_squared": "NumPy has log",
        "mean_log_risen": "what float32 needs for nearly flat neighbours, float64 does not",
        "parallel_part": "a part of parallel_logs",
        "parallel_gain": "a part of parallel_logs_risen",
        "parallel_logs_risen": "what float32 needs for nearly flat neighbours",
    },
    "edge_pair": {
        "graded_logs": "a part of edge_logs",
        "edge_logs_over": "what float32 needs for nearly flat neighbours",
    },
    "polygon_pair": {
        "seen_from_points": "a part of exchange_area",
        "beside": "a part of exchange_area that only float32 needs",
        "seen_along_edges": "a part of exchange_area",
        "perimeter": "a part of exchange_area that only float32 needs",
    },
    "area_light": {
        "small_lobe": "a part of the lobe's integral",
        "lobe_edge": "a part of the lobe's integral",
        "lobe_misses": "a shortcut; NumPy computes the zero",
    },
    "power": {
        "log2_near_one": "NumPy has log1p",
        "log_one_more": "NumPy has log1p",
        "power_below_one_whole": "a faster way to power_below_one, tested against that",
    },
}


def _module(stem):
    return import_module(f"playground.shading.{stem}")


def _functions(stem):
    module = _module(stem)
    return {
        name: f
        for name, f in inspect.getmembers(module, inspect.isfunction)
        if f.__module__ == module.__name__ and not name.startswith("_")
    }


def test_every_module_of_formulas_has_a_twin_file():
    import playground.shading

    assert sorted(playground.shading.__all__) == STEMS


@pytest.mark.parametrize("stem", STEMS)
def test_the_same_functions_in_both_languages(stem):
    numpy_names = set(_functions(stem)) - set(NUMPY_ALONE.get(stem, {}))
    glsl_names = set(signatures(stem)) - set(GLSL_ALONE.get(stem, {}))
    assert numpy_names == glsl_names


@pytest.mark.parametrize("stem", STEMS)
def test_the_same_arguments_in_the_same_order(stem):
    glsl = signatures(stem)
    for name, function in _functions(stem).items():
        if name in glsl:
            theirs = [label for qualifier, _, label in glsl[name].parameters if qualifier != "out"]
            assert list(inspect.signature(function).parameters) == theirs, name


@pytest.mark.parametrize("stem", STEMS)
def test_each_names_the_other(stem):
    glsl = locate.shader(f"lib/{stem}.glsl").read_text(encoding="utf-8")
    assert f"Twin: playground/shading/{stem}.py" in glsl
    assert f"Twin: shaders/lib/{stem}.glsl" in _module(stem).__doc__
