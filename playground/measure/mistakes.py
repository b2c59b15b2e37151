"""Which classic mistake a picture looks as if it were made with.

A setup is drawn in the ways in which people often get it wrong: with each mistake of the bug zoo,
in the other shading modes, with the highlight, its gate or the sRGB curve the other way, without
each term and light; upside down, mirrored, in swapped colours. The way that comes nearest to the
picture is probably how it was made.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from playground.measure import metrics
from playground.percent import percent
from playground.render.image import Image
from playground.render.renderer import Renderer, open_renderer
from playground.scene.settings import TERMS, Shading
from playground.scene.setup import Setup

Codes = NDArray[np.uint8]
ONE_CODE = 1  # of 255: both pictures were rounded to whole ones
EXPLAINED = 0.25  # of the difference: a way that leaves more explains nothing
ORDERS: dict[str, tuple[str, Callable[[Codes], Codes]]] = {
    "upside-down": ("Upside down", lambda codes: codes[::-1]),
    "mirrored": ("Mirrored, left and right", lambda codes: codes[:, ::-1]),
    "red-blue": ("Red and blue swapped", lambda codes: codes[..., ::-1]),
}


@dataclass(frozen=True)
class Way:
    """A way to get a setup wrong; ``title`` names it for people, ``breaks`` says what it does."""

    name: str
    title: str
    breaks: str
    setup: Setup


@dataclass(frozen=True)
class Likeness:
    """How far a picture is from one way: the RMSE of what is shown, in [0, 1]."""

    name: str
    title: str
    breaks: str
    rmse: float


@dataclass(frozen=True)
class Likely:
    """The result of `likely_mistakes`.

    ``right`` is the picture's RMSE against the setup as it is, ``off`` the share of its pixels that
    differ from it by more than one code of 255. ``nearest`` are the ways that come nearer, best
    first; ``zoo`` says whether the mistakes of the bug zoo were among those tried.
    """

    right: float
    off: float
    nearest: tuple[Likeness, ...] = ()
    zoo: bool = True

    @property
    def explained(self) -> bool:
        """Whether the nearest way leaves less than a quarter of the difference."""
        return bool(self.nearest) and self.nearest[0].rmse < EXPLAINED * self.right

    def to_dict(self) -> dict[str, Any]:
        """As JSON has it."""
        return asdict(self) | {"explained": self.explained}

    def __str__(self) -> str:
        if self.off == 0.0:
            return "the picture is right: no pixel is off by more than one code of 255"
        differs = f"{percent(self.off)} of the pixels differ, RMSE {self.right:.2g} as shown"
        without = (
            "" if self.zoo else "; those of the bug zoo were not tried, they need --renderer gl"
        )
        if not self.explained:
            return f"no classic mistake explains the difference ({differs}){without}"
        best, *others = self.nearest
        lines = [
            f"most like: {best.title} (RMSE {best.rmse:.2g}, to the right one {self.right:.2g})"
        ]
        lines += [f"  {best.breaks}"] if best.breaks else []
        close = [way for way in others if way.rmse < EXPLAINED * self.right][:2]
        return "\n".join([*lines, *(f"next: {way.title} (RMSE {way.rmse:.2g})" for way in close)])


def likely_mistakes(
    picture: Image,
    setup: Setup,
    renderer: str = "auto",
    progress: Callable[[float], None] = lambda share: None,
) -> Likely:
    """Which mistakes would make ``picture`` of ``setup``, nearest first.

    The bug zoo edits shaders: without a GL driver its mistakes are left out. ``progress`` is
    called with the share that is done.
    """
    theirs = picture.codes()
    with open_renderer(picture.size, renderer) as opened:
        right = _drawn(opened, setup)
        least = _rmse(theirs, right)
        apart = np.abs(np.subtract(theirs, right, dtype=np.int16)).max(axis=-1)
        off = float(np.mean(apart > ONE_CODE))
        if off == 0.0:
            return Likely(least, off)
        zoo = opened.name == "gl"
        found = [
            Likeness(name, title, "", _rmse(theirs, order(right)))
            for name, (title, order) in ORDERS.items()
        ]
        every = list(ways(setup, zoo))
        for number, way in enumerate(every, 1):
            drawn = _drawn(opened, way.setup)
            found.append(Likeness(way.name, way.title, way.breaks, _rmse(theirs, drawn)))
            progress(number / len(every))
    nearer = sorted((one for one in found if one.rmse < least), key=lambda one: one.rmse)
    return Likely(least, off, tuple(nearer), zoo)


def ways(setup: Setup, zoo: bool) -> Iterator[Way]:
    """The ways to get ``setup`` wrong, with those of the bug zoo if its shaders can run."""
    if zoo:
        from playground.render.gl.bugs import zoo as bugs

        for bug in bugs().values():
            yield Way(bug.name, bug.title, bug.breaks, setup.with_(bugs=(bug.name,)))
    now = setup.settings
    for shading in Shading:
        if shading != now.shading:
            yield Way(shading, f"Shaded {shading}", "", setup.with_(shading=shading))
    blinn = now.highlight == "blinn"
    base = "r·v (Phong) instead of n·h (Blinn)" if blinn else "n·h (Blinn) instead of r·v (Phong)"
    yield Way("highlight", base, "", setup.with_(highlight="phong" if blinn else "blinn"))
    gated = "forgotten" if now.gate else "added: none where n·l <= 0"
    yield Way("gate", f"The highlight's gate {gated}", "", setup.with_(gate=not now.gate))
    if now.curve == "srgb":
        yield Way("no-curve", "sRGB curve forgotten", "", setup.with_(curve="none"))
    else:
        yield Way("curve", "sRGB curve applied, unasked", "", setup.with_(curve="srgb"))
    yield from _parts_missing(setup)


def _parts_missing(setup: Setup) -> Iterator[Way]:
    terms = setup.settings.terms
    for term in TERMS:
        if term in terms:
            left = tuple(t for t in terms if t != term)
            yield Way(f"no-{term}", f"The {term} term is missing", "", setup.with_(terms=left))
    lights = setup.scene.lights
    for k in range(len(lights)):
        title = f"Light {k} ({lights[k].kind}) is missing"
        yield Way(f"no-light-{k}", title, "", setup.with_(lights=lights[:k] + lights[k + 1 :]))


def _drawn(opened: Renderer, setup: Setup) -> Codes:
    """The 8-bit codes, (H, W, 3), as a screen has them: display mistakes count."""
    width, height = opened.size
    out = opened.render(setup, np.empty((height, width, 4), dtype=np.uint8))
    assert isinstance(out, np.ndarray)
    return out[..., :3]


def _rmse(a: Codes, b: Codes) -> float:
    return metrics.rmse(a, b) / 255.0
