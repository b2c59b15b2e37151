"""Why a pixel of a radiosity or lightmap picture has its colour: what arrives, and what is left.

Computed by the float64 renderer of stored light, from the light that it draws.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from playground.explain.patch_light import PatchLight, explain_patch
from playground.explain.patch_words import light_dict, light_text
from playground.explain.pixel import check_pixel
from playground.explain.sight import sight
from playground.explain.words import ending, plain, triple
from playground.render.checks import check_setup, check_size
from playground.render.numpy_renderer import colours_before, pixel_colours
from playground.render.radiosity.light_source import RadiosityLight
from playground.render.raster.rasterize import Frame
from playground.render.renderer import light_of
from playground.render.stored import shown_background, shown_weights, stored_surfaces
from playground.render.stored_renderer import LightSource
from playground.render.surface import Surface
from playground.render.view import view_of
from playground.scene.setup import Setup
from playground.shading.display import code8, display_colour
from playground.shading.floats import Array
from playground.shading.texture import bilinear

# Of all light, or direct light alone, and of indirect light
EMITTED = ("what it emits, s_d", "what it emits is direct light: black")
BEHIND = ("the background", "the background is direct light: black")


def _black() -> Array:
    return np.zeros(3)


@dataclass(frozen=True, eq=False)
class StoredPixel:
    """What a pixel shows of stored light; colours are (3,) and linear.

    ``direct`` and ``indirect`` are the parts of the light H that arrives, ``arriving`` what is
    shown of it, ``material_diffuse`` is m_d with its
    texture; ``diffuse``, ``specular`` and ``emissive`` are the terms, weighted, that make up
    ``colour``. ``patch`` is the patch it sees, of radiosity, and
    ``patch_light`` the light of that patch; ``back`` says that it sees the back
    of a surface, where nothing arrives.
    """

    setup: Setup
    pixel: tuple[int, int]
    size: tuple[int, int]
    method: str
    colour: Array
    shown: Array
    codes: NDArray[np.uint8]
    object: int | None = None
    light: int | None = None
    patch: int | None = None
    back: bool = False
    direct: Array = field(default_factory=_black)
    indirect: Array = field(default_factory=_black)
    arriving: Array = field(default_factory=_black)
    material_diffuse: Array = field(default_factory=_black)
    diffuse: Array = field(default_factory=_black)
    specular: Array = field(default_factory=_black)
    emissive: Array = field(default_factory=_black)
    note: str = ""
    patch_light: PatchLight | None = None

    def text(self) -> str:
        """The explanation for a terminal."""
        x, y = self.pixel
        lines = [f"{self.setup.name}, pixel ({x}, {y}) of {self.size[0]} x {self.size[1]}"]
        lines[0] += f", {self.method}"
        if self.light is not None:
            lines.append(f"sees light {self.light} itself: {EMITTED[self._indirect]}")
        elif self.object is None:
            lines.append(f"no surface here: {BEHIND[self._indirect]}")
        elif self.back:
            lines.append(f"sees the back of object {self.object}, where nothing arrives: black")
        else:
            lines += self._terms()
        return "\n".join([*lines, *ending(self)])

    @property
    def _indirect(self) -> bool:
        return self.setup.settings.light_shown == "indirect"

    def _terms(self) -> list[str]:
        patch = f"patch {self.patch} of " if self.patch is not None else ""
        shown, w = self.setup.settings.light_shown, self.setup.settings.weights["diffuse"]
        shown = "both" if shown == "all" else f"{shown} light only"
        weight = f"{w:g} · " if w != 1.0 else ""
        return [
            f"sees {patch}object {self.object}",
            self.note,
            f"  direct    {triple(self.direct)}   straight from what sends out light",
            f"  indirect  {triple(self.indirect)}   reflected before",
            f"  H         {triple(self.arriving)}   arriving: {shown}",
            f"  diffuse   {weight}m_d ⊗ H = {weight}{triple(self.material_diffuse)} ⊗ "
            f"{triple(self.arriving)} = {triple(self.diffuse)}",
            f"  specular  {triple(self.specular)}   of the local model, without shadows",
            f"  emissive  {triple(self.emissive)}",
            *(light_text(self.patch_light) if self.patch_light is not None else ()),
        ]

    def latex(self) -> str:
        """The equation with this pixel's numbers, as LaTeX."""
        if self.back or self.object is None:
            return rf"c = {_column(self.colour)}"
        return (
            r"c = m_d \otimes H + c_s + m_e = "
            rf"{_column(self.material_diffuse)} \otimes {_column(self.arriving)} + "
            rf"{_column(self.specular)} + {_column(self.emissive)} = "
            rf"{_column(self.colour)}"
        )

    def to_dict(self) -> dict[str, Any]:
        """The explanation as plain values under the names of the vocabulary."""
        names = ("object", "light", "patch", "back", "direct", "indirect", "arriving")
        terms = ("material_diffuse", "diffuse", "specular", "emissive", "colour", "shown")
        return {
            "setup": self.setup.name,
            "pixel": list(self.pixel),
            "size": list(self.size),
            "method": self.method,
            **{name: plain(getattr(self, name)) for name in (*names, *terms)},
            "code": [int(code) for code in self.codes],
            "patch_light": light_dict(self.patch_light) if self.patch_light is not None else None,
        }

    def __str__(self) -> str:
        return self.text()


def explain_stored(
    setup: Setup,
    pixel: tuple[int, int],
    size: tuple[int, int],
    method: str,
    light: LightSource | None = None,
) -> StoredPixel:
    """Why ``pixel`` = (x, y) of a picture by radiosity or lightmap has its colour.

    ``light`` is that of a picture that is being shown; without it, it is computed.

    Raises
    ------
    PlaygroundError
        The pixel is outside the picture, or there is no lightmap.
    """
    check_setup(setup)
    x, y = check_pixel(pixel, *check_size(size))
    own = light is None
    light = light_of(method) if light is None else light
    for _ in light.prepare(setup):
        pass
    weights = shown_weights(setup.settings)
    everything = stored_surfaces(setup.scene, weights, light.stored(setup))
    view = view_of(setup.camera, everything, size)
    frame = sight(everything, view, setup.camera, size)
    number = int(frame.object[y, x])
    seen: dict[str, Any] = {}
    colour = np.array(shown_background(setup))
    if number >= 0:
        colour, specular = (
            pixel_colours(
                surface,
                view,
                setup.settings,
                frame,
                (np.array([y]), np.array([x])),
                colours_before(surface, view, setup.settings),
            )[0]
            for surface in (everything[number], _dark(everything[number]))
        )
        seen = _seen(setup, everything, frame, (x, y), light)
        if "diffuse" in seen:
            seen["specular"] = specular
    if own:
        light.close()
    s = setup.settings
    shown = display_colour(colour, s.exposure, s.clamp, s.curve)
    return StoredPixel(setup, (x, y), size, method, colour, shown, code8(shown), **seen)


def _seen(
    setup: Setup,
    everything: tuple[Surface, ...],
    frame: Frame,
    pixel: tuple[int, int],
    light: LightSource,
) -> dict[str, Any]:
    """What a pixel sees that sees some surface, by the names of `StoredPixel`."""
    x, y = pixel
    number, triangle, weights = int(frame.object[y, x]), frame.triangle[y, x], frame.weights[y, x]
    surface = everything[number]
    if surface.stored is None or surface.reflectance is None:
        return {"light": surface.emitter}
    if bool(frame.front[y, x]) == surface.mirrored:
        return {"object": number, "back": True}
    mesh = surface.mesh

    def here(values: NDArray[Any]) -> Array:
        return np.asarray(weights @ values[mesh.faces[triangle]])

    arriving = {}
    for shown in ("direct", "indirect", setup.settings.light_shown):
        stored = light.stored(setup.with_(light_shown=shown))[number]
        arriving[shown] = stored.at(here) if stored is not None else np.zeros(3)
    texel = np.ones(3)
    if surface.texels is not None and mesh.texcoords is not None:
        texel = bilinear(surface.texels, here(mesh.texcoords))
    diffuse = surface.reflectance * texel * arriving[setup.settings.light_shown]
    return {
        "object": number,
        **_patch(light, number, triangle),
        "direct": arriving["direct"],
        "indirect": arriving["indirect"],
        "arriving": arriving[setup.settings.light_shown],
        "material_diffuse": np.array(setup.scene.objects[number].material.diffuse) * texel,
        "diffuse": diffuse,
        "emissive": surface.constant_terms,
        "note": light.note(),
    }


def _dark(surface: Surface) -> Surface:
    """The surface with its highlights alone."""
    return replace(surface, reflectance=np.zeros(3), constant_terms=np.zeros(3))


def _patch(light: LightSource, number: int, triangle: int) -> dict[str, Any]:
    """Which patch a triangle of an object is a part of, of radiosity, and its light."""
    if not isinstance(light, RadiosityLight) or light.result is None:
        return {}
    drawn = light.result.drawn(flat=True)
    mesh = drawn.meshes[number]
    if mesh is None:
        return {}
    patch = int(drawn.vertices[number][mesh.faces[triangle, 0]])
    return {"patch": patch, "patch_light": explain_patch(light.result, patch)}


def _column(values: Any) -> str:
    return r"\begin{pmatrix}" + r" \\ ".join(f"{v:.4f}" for v in values) + r"\end{pmatrix}"
