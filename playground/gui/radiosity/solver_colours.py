"""A colour for each solver and each entry of the books, told apart by colour-blind eyes too."""

from __future__ import annotations

from playground.scene.settings import SOLVERS

Rgb = tuple[float, float, float]
# Okabe & Ito, Color Universal Design, 2008: lighter on dark paper, darker on light paper.
DARK: tuple[Rgb, ...] = (
    (0.62, 0.62, 0.62),
    (0.34, 0.71, 0.91),
    (0.95, 0.60, 0.10),
    (0.94, 0.89, 0.26),
    (0.80, 0.60, 0.70),
    (0.00, 0.75, 0.55),
    (0.95, 0.45, 0.25),
)
LIGHT: tuple[Rgb, ...] = (
    (0.50, 0.50, 0.50),
    (0.00, 0.45, 0.70),
    (0.80, 0.50, 0.00),
    (0.60, 0.55, 0.00),
    (0.66, 0.30, 0.52),
    (0.00, 0.50, 0.38),
    (0.80, 0.25, 0.05),
)
COLOURS = {
    "dark": dict(zip(SOLVERS, DARK, strict=True)),
    "light": dict(zip(SOLVERS, LIGHT, strict=True)),
}
BOOKS: dict[str, dict[str, Rgb]] = {
    "dark": {
        "absorbed": (0.34, 0.55, 0.75),
        "escaped": (0.55, 0.55, 0.55),
        "unshot": (0.95, 0.75, 0.20),
    },
    "light": {
        "absorbed": (0.25, 0.50, 0.75),
        "escaped": (0.60, 0.60, 0.60),
        "unshot": (0.90, 0.62, 0.00),
    },
}
