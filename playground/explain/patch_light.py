"""The light of one patch: its radiosity equation with numbers, who sends it, where it goes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from playground.render.radiosity.result import Radiosity
from playground.shading.floats import Array

MOST = 10  # senders that are told


@dataclass(frozen=True, eq=False)
class Sender:
    """A patch that sends light: ``sent`` (3,) is F C, ``share`` its part of all that is sent.

    ``owner`` is the number of its object; numbers beyond those of the objects are lights.
    """

    patch: int
    factor: float
    light: Array
    sent: Array
    share: float
    owner: int


@dataclass(frozen=True, eq=False)
class PatchLight:
    """C = E + ρ ⊗ (D + Σ F C) of one patch; colours (3,), linear.

    ``lamps`` is D, what arrives straight from lamps that are no patches, ``gathered`` Σ F C from
    all other patches. ``balanced`` is the right side of the equation, ``light`` the C that
    the solver has, ``residual`` their difference in the worst channel: what stopping at the
    ``convergence`` leaves. ``direct`` and ``indirect`` are the solver's two parts of the light that
    arrives. ``sending`` patches send something; ``senders`` are the first of them.
    """

    patch: int
    count: int
    area: float
    reflectance: Array
    emission: Array
    lamps: Array
    gathered: Array
    direct: Array
    indirect: Array
    light: Array
    row_sum: float
    senders: tuple[Sender, ...]
    sending: int

    @property
    def balanced(self) -> Array:
        """E + ρ ⊗ (D + Σ F C), (3,)."""
        return np.asarray(self.emission + self.reflectance * (self.lamps + self.gathered))

    @property
    def residual(self) -> float:
        """How far the solver's light is from what the equation says."""
        return float(np.abs(self.light - self.balanced).max())

    @property
    def ledger(self) -> dict[str, Array]:
        """Its energy in area times colour, (3,) each: arrives = absorbed + reflected."""
        arrives = self.area * (self.lamps + self.gathered)
        reflected = self.reflectance * arrives
        return {
            "arrives": arrives,
            "absorbed": arrives - reflected,
            "reflected": reflected,
            "emitted": self.area * self.emission,
            "leaves": reflected + self.area * self.emission,
        }


def explain_patch(result: Radiosity, patch: int) -> PatchLight:
    """Where the light of ``patch`` comes from in a solution; solves, if nobody has."""
    patches, light = result.patches, result.light
    row = result.form_factors.rows([patch])[0]
    sent = row[:, None] * light
    gathered = sent.sum(axis=0)
    strength, all_of_it = sent.sum(axis=1), float(gathered.sum())
    first = np.argsort(-strength, kind="stable")[:MOST]
    return PatchLight(
        patch=patch,
        count=len(patches),
        area=float(patches.area[patch]),
        reflectance=patches.reflectance[patch],
        emission=patches.emission[patch],
        lamps=np.asarray(result.system.direct)[patch],
        gathered=gathered,
        direct=result.direct[patch],
        indirect=result.indirect[patch],
        light=light[patch],
        row_sum=float(row.sum()),
        senders=tuple(
            Sender(
                int(j),
                float(row[j]),
                light[j],
                sent[j],
                float(strength[j]) / all_of_it,
                int(patches.owner[j]),
            )
            for j in first
            if strength[j] > 0.0
        ),
        sending=int(np.count_nonzero(strength > 0.0)),
    )
