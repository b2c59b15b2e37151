"""How the scene is shaded and shown: the switches of the lecture."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from playground.scene.knob import Declared, choice, integer, names, number, switch


class Shading(StrEnum):
    """Where the Phong model is evaluated."""

    FLAT = "flat"
    PER_VERTEX = "per-vertex"
    PER_FRAGMENT = "per-fragment"


BUGS = (  # the names of shaders/bugs.toml; a test holds the two together
    "normal-not-renormalised",
    "wrong-normal-matrix",
    "missing-max",
    "light-in-wrong-space",
    "light-vector-not-normalised",
    "srgb-twice",
)
TERMS = ("diffuse", "specular", "ambient", "emissive")


@dataclass(frozen=True)
class Settings(Declared):
    """Everything about a picture that is neither the scene nor the camera."""

    label = "settings"

    shading: str = choice(
        Shading.PER_FRAGMENT.value,
        tuple(mode.value for mode in Shading),
        help="evaluate the model once per triangle, per vertex or per fragment",
    )
    terms: tuple[str, ...] = names(TERMS, TERMS, help="which of the four terms are summed")
    diffuse_weight: float = number(1.0, 0.0, 1e3, help="multiplies the diffuse term")
    specular_weight: float = number(1.0, 0.0, 1e3, help="multiplies the specular term")
    ambient_weight: float = number(1.0, 0.0, 1e3, help="multiplies the ambient term")
    emissive_weight: float = number(1.0, 0.0, 1e3, help="multiplies the emissive term")
    highlight: str = choice(
        "phong", ("phong", "blinn"), help="specular base: r·v (Phong 1975) or n·h (Blinn 1977)"
    )
    gate: bool = switch(False, help="no highlight where n·l <= 0; the lecture has no such gate")
    exposure: float = number(1.0, 0.0, 1e6, scale="log", help="display: multiplies every colour")
    clamp: bool = switch(True, help="display: cut at 0 and 1; without it 8-bit codes wrap around")
    curve: str = choice("none", ("none", "srgb"), help="display: transfer curve after clamping")
    samples: int = integer(1, 1, 16, help="anti-aliasing samples per pixel")

    bugs: tuple[str, ...] = names((), BUGS, help="classic mistakes to make, on the GPU only")

    @property
    def weights(self) -> dict[str, float]:
        """The weight of each of the four terms; 0 for a term that is switched off."""
        return {
            term: getattr(self, f"{term}_weight") if term in self.terms else 0.0 for term in TERMS
        }
