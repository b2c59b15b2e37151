"""What the user points at in the explanation of a pixel."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Clue:
    """``lit`` is the symbol under the mouse, in the panel or in the picture.

    ``corner`` is the vertex and ``light`` the light whose vectors are shown, None for the
    vertex with the most weight and the light that adds most. ``seen`` is the layout, and
    the size of the picture, in which the pixel was explained last.
    """

    picture: int = 0  # number of the picture in the layout
    light: int | None = None
    corner: int | None = None
    term: str = "diffuse"
    seen: tuple[str, tuple[int, int]] | None = None
    lit: str = ""  # "n", "l", "v", "r", "h", "ρ" or nothing
