"""The Cornell box by patches against the same box by chance: region by region, within error bars.

The path-traced mean is off by its standard error; a solution by patches is off because their
light is even. Both are known: the first is measured by the path tracer itself, the second follows
from two solutions, since the mean over a region converges as the area of patches, or nearly so.
"""

from functools import lru_cache

import numpy as np
import pytest

import playground as pg
from playground.render.trace.hits import closest
from playground.render.trace.path import PathTracing
from playground.render.trace.traced_scene import prepare

SIZE, SAMPLES = (40, 30), 96
COARSE, FINE = 600, 2400
# Patches of half the width: an error that falls as width^p shrinks by 2^p, so that of the finer
# solution is their difference over 2^p − 1. p is 2 where light is smooth, 1 for what a shadow's
# edge adds; between 600, 2,400 and 6,000 patches the regions fall with p = 1.6 to 2. Taken as 1.5.
ORDER = 1.5
SIGMAS = 4.0  # a chance of 6e-5 for each of the 21 means that are compared
BLOCK_TOPS = {"short block": 165.0, "tall block": 330.0}  # mm: their sides are what is seen well
REGIONS = ("floor", "back wall", "ceiling", "left wall", "right wall", "short block", "tall block")


@lru_cache(maxsize=1)
def box():
    return pg.load("cornell-box").with_(terms=("diffuse", "emissive"))


@lru_cache(maxsize=1)
def regions():
    """Pixels (P,) that show one region only, by name: told by nine rays through each."""
    scene = prepare(box(), SIZE)
    names = ["floor", "ceiling", "left wall", "right wall", "short block", "tall block"]
    solids = [names[s.object] if s.object is not None else "lamp" for s in scene.solids]
    pixel = np.arange(SIZE[0] * SIZE[1])
    seen = []
    for x in (0.001, 0.5, 0.999):
        for y in (0.001, 0.5, 0.999):
            rays = scene.rays_through(pixel % SIZE[0] + x, pixel // SIZE[0] + y)
            hits = closest(scene.solids, *rays)
            height = (rays[0] + rays[1] * np.where(hits.solid >= 0, hits.t, 0.0)[:, None])[:, 1]
            height = height / scene.view.scale + scene.view.eye[1]
            found = np.array([*solids, "nothing"])[hits.solid]
            found[(found == "floor") & (height > 0.1)] = "back wall"  # one mesh, with the floor
            for block, top in BLOCK_TOPS.items():
                found[(found == block) & (height > top - 0.1)] = "top"
            seen.append(found)
    alike = np.all(np.array(seen) == seen[0], axis=0)
    return {name: np.flatnonzero(alike & (seen[0] == name)) for name in REGIONS}


@lru_cache(maxsize=1)
def by_chance():
    """The mean of each region (3,), and its standard error."""
    traced = PathTracing(box(), SIZE)
    for _ in traced.steps(SAMPLES):
        pass
    mean = traced.image().pixels.reshape(-1, 3).astype(np.float64)
    error = traced.standard_error().reshape(-1, 3)
    return {
        name: (mean[at].mean(axis=0), np.sqrt((error[at] ** 2).sum(axis=0)) / len(at))
        for name, at in regions().items()
    }


@lru_cache(maxsize=4)
def by_patches(patches, method):
    """The mean of each region, (3,)."""
    setup = box().with_(patches=patches, form_factors=method)
    pixels = pg.render(setup, SIZE, method="radiosity").pixels.reshape(-1, 3).astype(np.float64)
    return {name: pixels[at].mean(axis=0) for name, at in regions().items()}


@pytest.mark.gl
@pytest.mark.parametrize("method", ["closed-form", "hemicube"])
def test_every_region_agrees_within_its_error_bars(gl, method):
    for name, (want, error) in by_chance().items():
        coarse, fine = (by_patches(n, method)[name] for n in (COARSE, FINE))
        division = np.abs(fine - coarse) / (2.0**ORDER - 1.0)
        bound = division + SIGMAS * error
        assert (np.abs(fine - want) <= bound).all(), (name, fine, want, division, error)


@pytest.mark.gl
def test_the_error_bars_say_something(gl):
    """Each is a small part of the light, also where it is darkest: on the block in the shade."""
    for name, (want, error) in by_chance().items():
        assert len(regions()[name]) >= 20, name
        coarse, fine = (by_patches(n, "closed-form")[name] for n in (COARSE, FINE))
        bound = np.abs(fine - coarse) / (2.0**ORDER - 1.0) + SIGMAS * error
        share = bound[:2] / want[:2]  # of blue there is hardly any
        assert (share < (0.3 if name == "short block" else 0.12)).all(), (name, share)


@pytest.mark.gl
def test_half_the_width_of_patches_brings_every_wall_nearer(gl):
    for name in ("floor", "back wall"):  # where error bars are smaller than what patches miss
        want, _ = by_chance()[name]
        coarse, fine = (np.abs(by_patches(n, "closed-form")[name] - want) for n in (COARSE, FINE))
        assert (fine < coarse).all(), name
