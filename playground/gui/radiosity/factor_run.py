"""What the panel of form factors shows, computed beside the window, and its texture."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import replace

import moderngl
import numpy as np

from playground.explain.patch_pair import PatchPair, pair_steps
from playground.gui.radiosity.factor_told import FactorTold, HemicubeTold
from playground.gui.radiosity.factor_view import OTHER, UNDER, FactorView
from playground.gui.radiosity.hemicube_image import enlarged, image, material_colours, own_colours
from playground.gui.radiosity.radiosity_run import RadiosityRun
from playground.gui.state import State
from playground.gui.work.latest import Latest
from playground.render.checks import check_setup
from playground.render.radiosity.factor.hemicube import Hemicubes
from playground.render.radiosity.patch.divide import divide
from playground.render.radiosity.patch.patches import Patches
from playground.scene.settings import Settings
from playground.scene.setup import Setup
from playground.shading.display import display_colour
from playground.shading.floats import Array


class FactorRun:
    """Patches, the chosen pair and the hemicube of i: each on a thread of its own.

    ``now`` is what was told last.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._patches: Latest[Patches] = Latest()
        self._pair: Latest[PatchPair] = Latest()
        self._hemicube: Latest[HemicubeTold] = Latest()
        self._texture: moderngl.Texture | None = None
        self._drawn: object = None
        self._light: Array | None = None
        self.now = FactorTold()

    def advance(self, state: State, radiosity: RadiosityRun) -> State:
        """The state with the patches that are there; none are before they can be chosen."""
        view, setup = state.factors, state.setup
        if not view.picking and view.one is None:
            self._rest()
            return state
        asked = (setup.scene, setup.settings.patches)
        patches = self._patches.ask(asked, lambda: _divided(setup))
        view = view.forgotten() if self._patches.error else view.on(patches)
        pair, hemicube = self._chosen(view, setup.settings)
        works = (self._patches, self._pair, self._hemicube)
        light = _light(view.of, radiosity)
        self.now = FactorTold(
            patches=patches,
            pair=pair,
            hemicube=hemicube,
            picture=self._picture(view, hemicube, light, setup.settings),
            solved=light is not None,
            error=next((work.error for work in works if work.error), ""),
            working=any(work.working for work in works),
        )
        return state if view == state.factors else replace(state, factors=view)

    def close(self) -> None:
        """Free the GPU memory, and stop the threads."""
        for work in (self._patches, self._pair, self._hemicube):
            work.close()
        if self._texture is not None:
            self._texture.release()
            self._texture = None

    def _rest(self) -> None:
        for work in (self._patches, self._pair, self._hemicube):
            work.rest()
        self.now = FactorTold()

    def _chosen(
        self, view: FactorView, settings: Settings
    ) -> tuple[PatchPair | None, HemicubeTold | None]:
        """The pair and the hemicube; None while they are not those of the chosen patches."""
        patches, one, other = view.of, view.one, view.other
        if patches is None or one is None:
            self._pair.rest()
            self._hemicube.rest()
            return None, None
        cube = self._hemicube.ask(
            (patches, one, view.resolution),
            lambda: _looked(patches, one, view.resolution),
        )
        cube = cube if cube is not None and cube.patch == one else None
        if other is None:
            self._pair.rest()
            return None, cube
        asked = (patches, one, other, settings.occlusion, settings.hemicube)
        pair = self._pair.ask(asked, lambda: _steps(patches, one, other, settings))
        fits = pair is not None and pair.patches is patches and pair.numbers == (one, other)
        return pair if fits else None, cube

    def _picture(
        self,
        view: FactorView,
        hemicube: HemicubeTold | None,
        light: Array | None,
        settings: Settings,
    ) -> int:
        """The texture of the hemicube, painted again when something of it has changed."""
        if hemicube is None or view.of is None:
            return 0
        shown = light if view.colouring == "light" else None
        wanted = (hemicube, view.colouring, view.other, view.pointed, settings)
        if self._texture is None or wanted != self._drawn or shown is not self._light:
            marks = tuple(
                (patch, colour)
                for patch, colour in ((view.other, OTHER), (view.pointed, UNDER))
                if patch is not None
            )
            flat = image(hemicube.items, _colours(view, view.of, shown, settings), marks)
            codes = enlarged(flat)
            size = (codes.shape[1], codes.shape[0])
            if self._texture is None or self._texture.size != size:
                if self._texture is not None:
                    self._texture.release()
                self._texture = self._context.texture(size, 4)
                self._texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
            self._texture.write(codes.tobytes())
            self._drawn, self._light = wanted, shown
        return int(self._texture.glo)


def _light(patches: Patches | None, radiosity: RadiosityRun) -> Array | None:
    """The light of these patches, (N, 3) linear, where radiosity is solved for the same."""
    step, known = radiosity.step, radiosity.patches
    if step is None or known is None or patches is None:
        return None
    return step.light if np.array_equal(known.corners, patches.corners) else None


def _colours(
    view: FactorView, patches: Patches, light: Array | None, settings: Settings
) -> Array | None:
    """The colours of the patches as codes in [0, 1], (N, 3); None for delta form factors."""
    if view.colouring == "delta":
        return None
    if view.colouring == "patch":
        return own_colours(len(patches))
    if light is None:
        return display_colour(material_colours(patches), 1.0, True, "srgb")
    return display_colour(light, settings.exposure, settings.clamp, settings.curve)


def _divided(setup: Setup) -> Generator[Patches, None, None]:
    check_setup(setup)
    yield divide(setup)


def _looked(patches: Patches, patch: int, resolution: int) -> Generator[HemicubeTold, None, None]:
    yield HemicubeTold(patch, Hemicubes(patches, True, resolution).item_buffer(patch))


def _steps(
    patches: Patches, i: int, j: int, settings: Settings
) -> Generator[PatchPair, None, None]:
    yield from pair_steps(patches, i, j, settings)
