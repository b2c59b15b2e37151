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
PRECISIONS = ("native", "float16", "float32", "float64")
FORM_FACTORS = ("hemicube", "closed-form", "hemisphere", "point-to-polygon", "point-to-point")
SOLVERS = (
    "jacobi",
    "gauss-seidel",
    "progressive",
    "southwell",
    "overshooting",
    "conjugate-gradients",
    "direct",
)
LIGHT_SHOWN = ("all", "direct", "indirect")
MARKS = ("nan", "infinite", "negative", "denormal", "clamped")  # KINDS of shading/marks.py


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
    precision: str = choice(
        "native",
        PRECISIONS,
        help="arithmetic of the shading; native is float32 on the GPU, float64 in NumPy",
    )
    marks: tuple[str, ...] = names(
        (), MARKS, help="display: false colours for numbers that a picture would hide"
    )
    depth: int = integer(5, 0, 100, help="ray tracing: bounces followed; 0 for primary rays only")
    threshold: float = number(
        0.004,
        0.0,
        1.0,
        scale="log",
        help="ray tracing: a ray that weighs less in every channel is not shot",
    )
    light_samples: int = integer(
        16, 1, 1024, help="ray tracing: shadow rays to each area light; more are smoother"
    )
    fresnel: str = choice(
        "exact", ("exact", "schlick"), help="ray tracing: what glass reflects, or Schlick's guess"
    )
    surfaces: str = choice(
        "analytic",
        ("analytic", "triangles"),
        help="ray tracing: spheres, boxes, ... themselves, or the triangles of their meshes",
    )
    clear_shadows: bool = switch(
        True, help="ray tracing: glass lets light through to what lies behind, unbent"
    )

    patches: int = integer(600, 1, 100_000, help="radiosity: about how many patches")
    refinement: int = integer(
        0, 0, 6, help="radiosity: rounds in which patches are divided where the light changes"
    )
    form_factors: str = choice("closed-form", FORM_FACTORS, help="radiosity: how F_ij is computed")
    hemicube: int = integer(64, 8, 1024, help="radiosity: pixels along an edge of the hemicube")
    occlusion: bool = switch(True, help="radiosity: patches hide one another")
    normalise: bool = switch(
        True, help="radiosity: the form factors of a patch in a closed scene are made to sum to 1"
    )
    solver: str = choice("progressive", SOLVERS, help="radiosity: how the system is solved")
    convergence: float = number(
        1e-4, 1e-12, 0.5, scale="log", help="radiosity: share of the light left when it stops"
    )
    light_shown: str = choice(
        "all", LIGHT_SHOWN, help="radiosity, lightmap: straight from lamps or not"
    )

    bugs: tuple[str, ...] = names((), BUGS, help="classic mistakes to make, on the GPU only")

    @property
    def weights(self) -> dict[str, float]:
        """The weight of each of the four terms; 0 for a term that is switched off."""
        return {
            term: getattr(self, f"{term}_weight") if term in self.terms else 0.0 for term in TERMS
        }
