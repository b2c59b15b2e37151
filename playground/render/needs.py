"""What a setup needs, derived from it and from nothing else.

A feature that a scene does not use is not compiled, not uploaded, not computed. The
same answer specialises the shader programs, is printed by ``playground explain`` and
shown in the window.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, fields

from playground.render.precision import on_gpu
from playground.render.shown import wanted_marks
from playground.render.surface import Surface
from playground.render.view import View
from playground.scene.settings import Settings


@dataclass(frozen=True)
class Needs:
    """The features that drawing one object takes; equal needs share a program."""

    shading: str
    directional_lights: int = 0
    point_lights: int = 0
    spot_lights: int = 0
    area_lights: int = 0
    area_corners: int = 0
    diffuse: bool = False
    specular: bool = False
    blinn: bool = False
    gate: bool = False
    attenuation: bool = False
    texture: bool = False
    stored: bool = False
    lightmap: bool = False
    two_sided: bool = False
    stretched: bool = False
    display: bool = False
    exposure: bool = False
    curve: bool = False
    wrap: bool = False
    marks: int = 0  # bit k for kind k of playground.shading.marks
    bugs: tuple[str, ...] = ()
    precision: str = "native"

    @property
    def defines(self) -> dict[str, int]:
        """The features as preprocessor symbols: ``POINT_LIGHTS 1``, ``SPECULAR 0``, ..."""
        others = ("shading", "bugs", "precision")
        names = [f.name for f in fields(self) if f.name not in others]
        return {name.upper(): int(getattr(self, name)) for name in names}

    def describe(self) -> str:
        """The features in use, in one line of words."""
        words = [self.shading]
        for name in self.defines:
            name = name.lower()
            value = getattr(self, name)
            if value is True:
                words.append(name.replace("_", " "))
            elif value and name == "marks":
                words.append("marks")
            elif value:
                words.append(f"{value} {name.replace('_', ' ')}"[: None if value > 1 else -1])
        words += [f"bug: {bug}" for bug in self.bugs]
        if self.precision != "native":
            words.append(self.precision)
        return ", ".join(words)


def needs(surface: Surface, view: View, settings: Settings, display: bool = False) -> Needs:
    """What drawing ``surface`` needs; ``display`` says that the target holds 8-bit codes."""
    lights = surface.lights
    diffuse = any(light.diffuse.any() for light in lights)
    specular = any(light.specular.any() for light in lights)
    lit = diffuse or specular
    count = Counter(light.kind for light in lights if lit)
    stored = surface.stored
    unlit = stored is None or surface.reflectance is None or not surface.reflectance.any()
    corners = [len(light.corners) for light in lights if light.corners is not None]
    return Needs(
        shading=settings.shading,
        directional_lights=count["directional"],
        point_lights=count["point"],
        spot_lights=count["spot"],
        area_lights=count["area"],
        area_corners=max(corners) if count["area"] else 0,
        diffuse=diffuse,
        specular=specular,
        blinn=specular and settings.highlight == "blinn",
        gate=specular and settings.gate,
        attenuation=lit and any(light.attenuates for light in lights),
        texture=(diffuse or not unlit) and surface.texels is not None,
        stored=stored is not None,
        lightmap=stored is not None and stored.texels is not None,
        two_sided=(lit or stored is not None) and view.two_sided(surface),
        stretched=lit and surface.stretched,
        display=display,
        exposure=display and settings.exposure != 1.0,
        curve=display and settings.curve == "srgb",
        wrap=display and not settings.clamp,
        marks=wanted_marks(settings) if display else 0,
        bugs=settings.bugs,
        precision=on_gpu(settings),
    )
