"""`radiosity`: the diffuse light of a setup, solved step by step as far as one wants.

Everything is computed when it is first asked for: patches, then form factors row by row as the
solver wants them. Light is in the unit of colours, which is radiance (radiosity over π).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from playground.errors import unknown_name
from playground.render.checks import check_setup
from playground.render.radiosity.depends import FACTORS
from playground.render.radiosity.direct import direct_light
from playground.render.radiosity.drawn import DrawnPatches, drawn_patches
from playground.render.radiosity.factor.form_factors import OpenRows, open_rows
from playground.render.radiosity.factor.matrix import BATCH, FormFactors
from playground.render.radiosity.not_modelled import not_modelled
from playground.render.radiosity.patch.divide import divide
from playground.render.radiosity.patch.patches import Patches
from playground.render.radiosity.report import Report, brief, report_on
from playground.render.radiosity.solver.exchange import Exchange
from playground.render.radiosity.solver.solve import SOLVERS
from playground.render.radiosity.solver.system import Step, System
from playground.render.stored import StoredLight
from playground.scene.settings import LIGHT_SHOWN
from playground.scene.setup import Setup
from playground.shading.floats import Array

if TYPE_CHECKING:
    import moderngl

    from playground.render.lightmap.lightmap import Lightmap

RENDERERS = ("auto", "gl", "numpy")
SHOOTING = ("progressive", "southwell", "overshooting")  # they use rows as columns
BLOTCHES = (
    "Small patches that are shot at through a hemicube catch a pixel of it too many or none, which "
    "shows as blotches: the solver 'gauss-seidel', or the form factors 'closed-form', make none."
)


def radiosity(
    setup: Setup, renderer: str = "auto", context: moderngl.Context | None = None
) -> Radiosity:
    """The radiosity of ``setup``, to be solved as its settings say.

    Parameters
    ----------
    setup : Setup
    renderer : {"auto", "gl", "numpy"}
        Where form factors are computed; ``"auto"`` takes the GPU where that is faster.
    context : moderngl.Context, optional
        A window's, instead of one of our own.

    Raises
    ------
    PlaygroundError
        What is given is no setup, or no such renderer. That there are no patches, or no light, is
        told when they are asked for.
    """
    check_setup(setup)
    if renderer not in RENDERERS:
        raise unknown_name("renderer", renderer, RENDERERS)
    return Radiosity(setup, renderer, context)


class Radiosity:
    """Patches, form factors and light of one setup.

    ``step`` is the last step made, None before the first; ``round`` counts the refinements of
    the patches so far, ``done`` says that nothing is left to do. ``not_modelled`` names what
    the scene has and radiosity leaves out.
    """

    def __init__(
        self,
        setup: Setup,
        renderer: str = "auto",
        context: moderngl.Context | None = None,
        earlier: Radiosity | None = None,
    ) -> None:
        """``earlier``, a solution of a similar setup, hands on form factors that still hold."""
        self.setup = setup
        self.step: Step | None = None
        self.round = 0
        self.done = False
        self.not_modelled = not_modelled(setup)
        while earlier is not None and "form_factors" not in earlier.__dict__:
            earlier = earlier._earlier
        self._earlier: Radiosity | None = earlier
        self._renderer, self._context = renderer, context
        self._rows: OpenRows | None = None
        self._drawn: dict[bool, DrawnPatches] = {}

    @cached_property
    def patches(self) -> Patches:
        """The patches; after the refinements so far."""
        return divide(self.setup)

    @cached_property
    def form_factors(self) -> FormFactors:
        """The form factors F_ij; a row is computed when somebody asks for it."""
        earlier, self._earlier = self._earlier, None
        if earlier is not None:
            if self.round == 0 and _same_factors(earlier, self):
                self._rows, earlier._rows = earlier._rows, None
                return earlier.form_factors
            earlier.close()
        settings = self.setup.settings
        self._rows = open_rows(self.patches, settings, self._renderer, self._context)
        return FormFactors(self._rows, self.patches, settings.normalise)

    @cached_property
    def lamps(self) -> Array:
        """The light D that arrives straight from directional, point and spot lights, (N, 3)."""
        return direct_light(self.setup, self.patches)

    @cached_property
    def system(self) -> System:
        """The equation C = E + ρ (D + F C) that is solved."""
        return System(
            form_factors=self.form_factors,
            area=self.patches.area,
            reflectance=self.patches.reflectance,
            emission=self.patches.emission,
            direct=self.lamps,
        )

    def steps(self) -> Iterator[Step]:
        """Solve, step by step. May be dropped at any time: a new call continues from there."""
        return (step for step in self._work() if step is not None)

    def solving(self) -> Iterator[float]:
        """The same; yields `progress` instead, also while form factors are computed."""
        return (self.progress for _ in self._work())

    def _work(self) -> Iterator[Step | None]:
        settings = self.setup.settings
        while not self.done:
            if settings.solver not in SHOOTING:
                yield from self._all_rows()
            solver = SOLVERS[settings.solver]
            for step in solver(self.system, settings.convergence, self.step):
                self.step = step
                yield step
            if self.round >= settings.refinement or not self._refine():
                self.done = True

    def _all_rows(self) -> Iterator[None]:
        """Compute the rows that are missing, some at a time, if they can all be kept."""
        factors = self.form_factors
        if len(factors) ** 2 * np.dtype(np.float32).itemsize > factors.most_bytes:
            return  # rows that are not kept would be computed twice
        missing = np.flatnonzero(np.isnan(factors.raw_sums()))
        for first in range(0, len(missing), BATCH):
            factors.row_sums(missing[first : first + BATCH])
            yield None

    def solve(self) -> Radiosity:
        """Make all the steps that are left; returns the radiosity itself."""
        for _ in self.steps():
            pass
        return self

    @property
    def progress(self) -> float:
        """The share of the work done, in [0, 1], as far as it can be told."""
        if self.done:
            return 1.0
        share = 0.0
        if self.step is not None and self.step.residual > 0.0:
            reached = np.log(min(self.step.residual, 1.0)) / np.log(self.setup.settings.convergence)
            share = float(np.clip(reached, 0.0, 1.0))
        if self.setup.settings.solver not in SHOOTING:  # nearly all of the time goes into rows
            share = 0.9 * self.form_factors.computed / len(self.form_factors) + 0.1 * share
        return (self.round + share) / (self.setup.settings.refinement + 1)

    @property
    def light(self) -> Array:
        """The light C that leaves each patch, (N, 3), as far as it is solved.

        If no step has been made, all of them are.
        """
        return self.last.light

    @property
    def arriving(self) -> Array:
        """The light H = D + Σ F_ij C_j that arrives at each patch, (N, 3)."""
        step, rho = self.last, self.patches.reflectance
        estimate = step.light - step.exact  # of a solver that guesses what will still arrive
        return np.asarray(step.arriving + estimate / np.where(rho > 0.0, rho, 1.0))

    @cached_property
    def direct(self) -> Array:
        """The part of `arriving` that comes straight from what sends out light, (N, 3)."""
        emission = self.patches.emission
        senders = np.flatnonzero(emission.any(axis=1))
        if self.setup.settings.solver in SHOOTING:
            sent = self.form_factors.send(senders, emission[senders])
        elif self.setup.settings.solver == "conjugate-gradients":
            sent = Exchange(self.form_factors)(emission) / self.patches.area[:, None]
        else:
            sent = self.form_factors.gather(emission)
        return np.asarray(self.system.direct + sent)

    @property
    def indirect(self) -> Array:
        """The part of `arriving` that has been reflected at least once, (N, 3)."""
        return self.arriving - self.direct

    @property
    def warnings(self) -> tuple[str, ...]:
        """What the scene has that is not modelled, and what was done to its meshes."""
        return (*self.not_modelled, *self.patches.warnings)

    def report(self) -> Report:
        """Row sums, reciprocity, closure, correction, energy, leaks: everything to be checked."""
        return report_on(self)

    def brief(self) -> str:
        """The most important of the report, in a line."""
        return brief(self.last, self.form_factors.report())

    def drawn(self, flat: bool = False) -> DrawnPatches:
        """The patches as meshes: smooth, or with corners of their own."""
        if flat not in self._drawn:
            objects = len(self.setup.scene.objects)
            self._drawn[flat] = drawn_patches(self.patches, objects, flat)
        return self._drawn[flat]

    def stored(self, flat: bool = False, shown: str = "all") -> tuple[StoredLight | None, ...]:
        """The light as it is drawn, per object; ``shown`` is all, direct or indirect."""
        if shown not in LIGHT_SHOWN:
            raise unknown_name("light_shown", shown, LIGHT_SHOWN)
        direct = None if shown == "all" else self.direct
        return self.drawn(flat).stored(self.arriving, direct, shown)

    def bake(self, size: int = 256) -> Lightmap:
        """The light as a texture of ``size`` × ``size`` texels; solved first, if it is not."""
        from playground.render.lightmap.bake import bake

        return bake(self, size)

    def close(self) -> None:
        """Free what the GPU holds; what has been computed stays."""
        if self._rows is not None:
            self._rows.close()
            self._rows = None

    @property
    def last(self) -> Step:
        """The last step; if none has been made, all of them are."""
        if self.step is None:
            self.solve()
        assert self.step is not None
        return self.step

    def _refine(self) -> bool:
        """Divide patches where the light changes; False if that divides none."""
        from playground.render.radiosity.patch.refine import refine

        finer = refine(self.patches, self.light)
        if finer is self.patches:
            return False
        self.close()
        for name in ("patches", "form_factors", "lamps", "system", "direct"):
            self.__dict__.pop(name, None)
        self._drawn.clear()
        settings = self.setup.settings
        if settings.form_factors == "hemicube" and settings.solver in SHOOTING and self.round == 0:
            finer = replace(finer, warnings=(*finer.warnings, BLOTCHES))
        self.patches, self.step = finer, None
        self.round += 1
        return True


def _same_factors(one: Radiosity, other: Radiosity) -> bool:
    """Whether the form factors of one setup are those of the other."""
    if "form_factors" not in one.__dict__ or one.round != 0:
        return False
    knobs = [[getattr(x.setup.settings, name) for name in FACTORS] for x in (one, other)]
    a, b = one.patches, other.patches
    return knobs[0] == knobs[1] and all(
        np.array_equal(getattr(a, name), getattr(b, name))
        for name in ("origin", "points", "corners", "owner", "parent")
    )
