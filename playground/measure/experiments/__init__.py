"""The experiments of ``playground measure``, by name; each is a file of this folder.

A new one: a file with an `Experiment` called ``EXPERIMENT``, and its name here.
"""

from __future__ import annotations

from importlib import import_module

from playground.errors import unknown_name
from playground.measure.record import Experiment

EXPERIMENTS = (
    "shading-rate",
    "popping",
    "precision",
    "specular-power",
    "area-light",
    "area-light-gl",
    "normal-interpolation",
    "anti-aliasing",
    "renderer",
    "cost",
    "frames",
    "first-image",
    "depth",
    "shadow-samples",
    "bvh",
    "rays",
    "trace-precision",
    "offset",
    "form-factors",
    "hemicube",
    "solvers",
    "subdivision",
    "lightmap",
    "radiosity-precision",
    "radiosity",
)


def find(name: str) -> Experiment:
    """The experiment of this name.

    Raises
    ------
    PlaygroundError
        There is none; the message lists those there are.
    """
    if name not in EXPERIMENTS:
        raise unknown_name("experiment", name, EXPERIMENTS)
    module = import_module(f"{__name__}.{name.replace('-', '_')}")
    experiment: Experiment = module.EXPERIMENT
    return experiment
