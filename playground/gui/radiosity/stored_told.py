"""What the panel says of a pixel of stored light: every text, colour and number, made once."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from playground.explain.patch_light import PatchLight, Sender
from playground.explain.stored_pixel import StoredPixel
from playground.gui.pixel.equation import Parts, triple
from playground.gui.pixel.telling import KEPT, Line, line
from playground.percent import percent

SHOWN = {"all": "", "direct": "   direct alone", "indirect": "   indirect alone"}
FAR = 6  # senders that are told


@dataclass(frozen=True)
class StoredTold:
    """What arrives at a pixel, what its surface makes of it, and its patch, of radiosity.

    ``filter`` are m_d and H.
    """

    seen: str
    arriving: tuple[Line, ...]
    diffuse: Line
    equation: tuple[Parts, Parts]
    others: tuple[Line, ...]
    filter: tuple[list[float], list[float]]
    patch: PatchTold | None


@dataclass(frozen=True)
class PatchTold:
    """The radiosity equation of a patch: in symbols, in numbers, and who sends light to it."""

    title: str
    symbols: Parts
    lines: tuple[Line, ...]
    balance: str
    senders: tuple[Line, ...]
    energy: str


@lru_cache(maxsize=KEPT)
def stored_told(why: StoredPixel) -> StoredTold:
    """What is said of a pixel that sees the front of a surface with stored light."""
    settings = why.setup.settings
    weight = settings.weights["diffuse"]
    factor = (f"{weight:g} ·",) if weight != 1.0 else ()
    numbers = ("=", *factor, f"{triple(why.material_diffuse)} ⊗", triple(why.arriving))
    light = why.patch_light
    return StoredTold(
        seen=_seen(why),
        arriving=(
            line(why, why.direct, f"direct  {triple(why.direct)}"),
            line(why, why.indirect, f"indirect  {triple(why.indirect)}"),
            line(why, why.arriving, f"H  {triple(why.arriving)}{SHOWN[settings.light_shown]}"),
        ),
        diffuse=line(why, why.diffuse, f"diffuse  {triple(why.diffuse)}"),
        equation=(("m_d ⊗ H",), numbers if weight else ("switched off",)),
        others=(
            line(why, why.specular, f"specular  {triple(why.specular)}"),
            line(why, why.emissive, f"emissive  {triple(why.emissive)}"),
        ),
        filter=(why.material_diffuse.tolist(), why.arriving.tolist()),
        patch=_patch(why, light) if light is not None else None,
    )


def _seen(why: StoredPixel) -> str:
    """What is seen: which object, and which patch of it."""
    assert why.object is not None
    mesh = why.setup.scene.objects[why.object].mesh.rsplit("/", 1)[-1]
    patch = f"patch {why.patch} of " if why.patch is not None else ""
    return f"sees {patch}object {why.object}, {mesh}"


def _patch(why: StoredPixel, light: PatchLight) -> PatchTold:
    """The equation of the patch, term by term."""
    terms = (
        ("C", light.light, "leaves it"),
        ("E", light.emission, "emitted"),
        ("ρ", light.reflectance, "reflectance"),
        ("D", light.lamps, "straight from lamps"),
        ("Σ F C", light.gathered, f"from {light.sending} patches"),
    )
    return PatchTold(
        title=f"patch {light.patch} of {light.count}",
        symbols=("C = E + ρ ⊗ (D + Σ F C)",),
        lines=tuple(line(why, of, f"{name}  {triple(of)}   {words}") for name, of, words in terms),
        balance=_balance(light),
        senders=tuple(
            line(
                why,
                s.sent,
                f"{percent(s.share, '.1f')}  patch {s.patch} of {_owner(why, s)}, F {s.factor:.3g}",
            )
            for s in light.senders[:FAR]
        ),
        energy=_energy(light),
    )


def _owner(why: StoredPixel, sender: Sender) -> str:
    """What the patch of a sender is a part of."""
    known = sender.owner < len(why.setup.scene.objects)
    return f"object {sender.owner}" if known else "a light"


def _balance(light: PatchLight) -> str:
    """How far the solver's light is from the right side of its equation."""
    return f"the right side is {triple(light.balanced)}: off by {light.residual:.1e}"


def _energy(light: PatchLight) -> str:
    """What becomes of the light that arrives."""
    book = {name: float(np.sum(value)) for name, value in light.ledger.items()}
    arrives = book["arrives"]
    if not arrives:
        return "no light arrives"
    absorbed, reflected = (
        percent(book[part] / arrives, ".0f") for part in ("absorbed", "reflected")
    )
    return f"of what arrives, {absorbed} is absorbed and {reflected} reflected"
