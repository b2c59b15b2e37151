"""Pictures of a lesson: laid out side by side, and held against what their caption says."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.explain.panels import Panel, lay_out
from playground.lesson.words import Check
from playground.render.image import Image

LETTERS = 46  # pixels of a row for one of its letters: 9 pixels in a column of the window 410 wide
NOTHING = 0.5  # the grey of an empty picture


def assert_shows(pictures: Sequence[Image], caption: str, shows: Check) -> None:
    """See that ``shows`` is content with the pictures, and not with empty ones.

    Raises
    ------
    PlaygroundError
        The first says that the caption is wrong, the second that the check is.
    """
    for picture in pictures:
        if not isinstance(picture, Image):
            raise PlaygroundError("a figure is made of images", got=type(picture).__name__)
    if not shows(*pictures):
        raise PlaygroundError("the figure does not show what its caption says", got=caption)
    if accepts(shows, [_empty(picture) for picture in pictures]):
        raise PlaygroundError(
            "what the figure shows is not checked: shows= accepts empty pictures", got=caption
        )


def accepts(shows: Check, empty: Sequence[object]) -> bool:
    """Whether the check is content with nothing; a check that fails on it is not."""
    try:
        with np.errstate(all="ignore"):
            return bool(shows(*empty))
    except Exception:  # it may divide by a contrast that an empty picture has not
        return False


def side_by_side(pictures: Sequence[Image], names: Sequence[str]) -> NDArray[np.uint8]:
    """The 8-bit codes (H, W, 3) of one picture, or of a row with names under the pictures.

    Raises
    ------
    PlaygroundError
        Pictures of different sizes, or not as many names as pictures.
    """
    if len(pictures) == 1 and not names:
        return pictures[0].codes()
    if len(names) != len(pictures):
        raise PlaygroundError(
            "each picture of a row has a name", got=f"{len(names)} names, {len(pictures)} pictures"
        )
    if len({picture.size for picture in pictures}) > 1:
        raise PlaygroundError("pictures of a row have one size")
    row = [Panel(picture.codes(), name) for picture, name in zip(pictures, names, strict=True)]
    wide = sum(picture.size[0] for picture in pictures)
    return lay_out([row], letters=max(13, round(wide / LETTERS)))


def _empty(picture: Image) -> Image:
    return replace(picture, pixels=np.full_like(picture.pixels, NOTHING), coverage=None)
