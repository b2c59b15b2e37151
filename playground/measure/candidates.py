"""What could be dropped from a setup: one function per kind of candidate.

A new kind is a function ``setup -> candidates`` and a row in `KINDS`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from playground.render.texels import load_texture
from playground.scene.light import AreaLight, PointLight
from playground.scene.scene import Object
from playground.scene.settings import Shading
from playground.scene.setup import Setup
from playground.scene.shapes import SHAPES

Change = Callable[[Setup], Setup]
LEVELS = 3  # how often a tessellation is halved: beyond an eighth little is left of a shape
CHEAPER = {  # the modes that evaluate the model less often
    Shading.PER_FRAGMENT: (Shading.PER_VERTEX, Shading.FLAT),
    Shading.PER_VERTEX: (Shading.FLAT,),
    Shading.FLAT: (),
}


@dataclass(frozen=True)
class Candidate:
    """Something that a picture may do without.

    Parameters
    ----------
    kind : which row of `KINDS` it comes from
    part : what it concerns; two candidates of one part exclude each other
    name : what is dropped, in words; no two candidates of a setup have the same
    change : the setup without it, from a setup with it
    """

    kind: str
    part: str
    name: str
    change: Change = field(compare=False, repr=False)


def candidates_of(setup: Setup, method: str = "raster") -> tuple[Candidate, ...]:
    """Everything that could be dropped from ``setup``, in the order of `KINDS`.

    Only what makes a difference to pictures by this ``method``.
    """
    alone = {kind for kinds in ONLY.values() for kind in kinds} - set(ONLY[method])
    unseen = _met_by_formula(setup) if method == "ray-tracing" else set()
    every = (c for kind in KINDS if kind not in alone for c in KINDS[kind](setup))
    return tuple(candidate for candidate in every if candidate.part not in unseen)


def without(setup: Setup, dropped: Iterable[Candidate]) -> Setup:
    """``setup`` without all of ``dropped``, candidates of this setup.

    They leave from the last to the first, so that the number of a light still holds when
    its turn comes.
    """
    left = set(dropped)
    every = [candidate for kind in KINDS.values() for candidate in kind(setup)]
    for candidate in reversed(every):
        if candidate in left:
            setup = candidate.change(setup)
    return setup


def lights(setup: Setup) -> Iterator[Candidate]:
    """Each light, with all its terms."""
    for i, light in enumerate(setup.scene.lights):

        def change(setup: Setup, i: int = i) -> Setup:
            kept = setup.scene.lights
            return setup.with_(lights=kept[:i] + kept[i + 1 :])

        yield Candidate("light", f"light {i}", f"light {i} ({light.kind})", change)


def fading(setup: Setup) -> Iterator[Candidate]:
    """The attenuation of each light that fades with distance."""
    for i, light in enumerate(setup.scene.lights):
        if isinstance(light, PointLight) and light.attenuate:
            part = f"light {i} fading"

            def change(setup: Setup, i: int = i) -> Setup:
                every = setup.scene.lights
                fading = every[i]
                assert isinstance(fading, PointLight)
                steady = replace(fading, attenuate=False)
                return setup.with_(lights=(*every[:i], steady, *every[i + 1 :]))

            yield Candidate("fading", part, f"fading of light {i} ({light.kind})", change)


def terms(setup: Setup) -> Iterator[Candidate]:
    """Each of the four terms that is summed."""
    for term, weight in setup.settings.weights.items():
        if weight != 0.0:

            def change(setup: Setup, term: str = term) -> Setup:
                return setup.with_(terms=tuple(t for t in setup.settings.terms if t != term))

            yield Candidate("term", f"{term} term", f"{term} term", change)


def textures(setup: Setup) -> Iterator[Candidate]:
    """Each texture; its mean colour takes its place, so that what counts is its detail."""
    for i, item in enumerate(setup.scene.objects):
        if item.material.texture:
            name = f"texture of {_label(i, item)}"

            def change(setup: Setup, i: int = i) -> Setup:
                return _with_object(setup, i, _averaged(setup.scene.objects[i]))

            yield Candidate("texture", name, name, change)


def tessellations(setup: Setup) -> Iterator[Candidate]:
    """Each generated mesh at half, a quarter and an eighth of its tessellation."""
    for i, item in enumerate(setup.scene.objects):
        if item.arrays is not None or item.mesh not in SHAPES:
            continue
        shape = SHAPES[item.mesh]
        now = item.tessellation or shape.default_tessellation
        for halvings in range(1, LEVELS + 1):
            level = now >> halvings
            if level < shape.min:
                break

            def change(setup: Setup, i: int = i, level: int = level) -> Setup:
                coarse = replace(setup.scene.objects[i], tessellation=level)
                return _with_object(setup, i, coarse)

            part = _tessellation(i, item)
            yield Candidate("tessellation", part, f"{part}: {now} → {level}", change)


def shadings(setup: Setup) -> Iterator[Candidate]:
    """The modes that evaluate the model less often."""
    for mode in CHEAPER[Shading(setup.settings.shading)]:

        def change(setup: Setup, mode: str = mode.value) -> Setup:
            return setup.with_(shading=mode)

        name = f"shading: {setup.settings.shading} → {mode.value}"
        yield Candidate("shading", "shading", name, change)


def samples(setup: Setup) -> Iterator[Candidate]:
    """Half as many samples per pixel, and so on down to one."""
    now = setup.settings.samples
    count = now // 2
    while count >= 1:

        def change(setup: Setup, count: int = count) -> Setup:
            return setup.with_(samples=count)

        yield Candidate("samples", "samples", f"samples per pixel: {now} → {count}", change)
        count //= 2


def bounces(setup: Setup) -> Iterator[Candidate]:
    """Each bounce less, down to none, where anything mirrors or lets light through."""
    materials = [item.material for item in setup.scene.objects]
    now = setup.settings.depth
    if any(any(m.reflectance) or any(m.transmittance) for m in materials):
        for depth in range(now - 1, -1, -1):

            def change(setup: Setup, depth: int = depth) -> Setup:
                return setup.with_(depth=depth)

            yield Candidate("bounce", "bounces", f"bounces: {now} → {depth}", change)


def light_samples(setup: Setup) -> Iterator[Candidate]:
    """Half as many shadow rays to each area light, and so on down to one."""
    now = setup.settings.light_samples
    count = now // 2 if any(isinstance(x, AreaLight) for x in setup.scene.lights) else 0
    while count >= 1:

        def change(setup: Setup, count: int = count) -> Setup:
            return setup.with_(light_samples=count)

        name = f"shadow rays to each area light: {now} → {count}"
        yield Candidate("shadow rays", "shadow rays", name, change)
        count //= 2


# Lights come first, to leave last: what goes before them still finds them by their numbers.
KINDS: dict[str, Callable[[Setup], Iterator[Candidate]]] = {
    "light": lights,
    "fading": fading,
    "term": terms,
    "texture": textures,
    "tessellation": tessellations,
    "shading": shadings,
    "bounce": bounces,
    "shadow rays": light_samples,
    "samples": samples,
}
ONLY = {  # kinds that are for one method only
    "raster": ("shading",),
    "ray-tracing": ("bounce", "shadow rays"),
}


def _with_object(setup: Setup, i: int, item: Object) -> Setup:
    every = setup.scene.objects
    return setup.with_(objects=(*every[:i], item, *every[i + 1 :]))


def _averaged(item: Object) -> Object:
    """The object with the mean of its texels, which multiply m_d, in place of the texture."""
    material = item.material
    texels = load_texture(material.texture, material.texture_encoding)
    mean = texels.mean(axis=(0, 1), dtype=np.float64)
    red, green, blue = (float(m * t) for m, t in zip(material.diffuse, mean, strict=True))
    diffuse = (red, green, blue)
    return replace(item, material=replace(material, diffuse=diffuse, texture=""))


def _met_by_formula(setup: Setup) -> set[str]:
    """The tessellations that no ray sees: of shapes that rays meet without triangles."""
    from playground.render.trace.traced_scene import prepare

    objects = setup.scene.objects
    exact = (s.object for s in prepare(setup, (1, 1)).solids if s.kind != "mesh")
    return {_tessellation(i, objects[i]) for i in exact if i is not None}


def _tessellation(i: int, item: Object) -> str:
    return f"tessellation of {_label(i, item)}"


def _label(i: int, item: Object) -> str:
    return f"object {i} ({Path(item.mesh).stem if item.arrays is None else 'mesh'})"
