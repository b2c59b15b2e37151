"""What the program for a traced scene is made of: the symbols its shader files ask for.

A feature that the scene does not use is not compiled. Solids, materials and lights are written
out one after the other, so that the driver sees constants instead of indices; where there are
many, as a loop.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from playground.render.gl.trace.layout import KINDS, Layout
from playground.render.gl.trace.trees import Trees
from playground.render.shown import wanted_marks
from playground.render.trace.solids import Solid
from playground.render.trace.traced_scene import TracedScene
from playground.scene.settings import Settings
from playground.shading.light import BRIGHTEST

Symbols = dict[str, object]
UNROLLED = 16  # more of a kind than this become a loop
LIGHTS = ("directional", "point", "spot", "area")


def symbols_of(
    scene: TracedScene,
    layout: Layout,
    trees: Trees | None,
    display: bool,
    accumulate: bool,
    lost: bool = True,
) -> Symbols:
    """The preprocessor symbols; equal ones make equal programs.

    ``lost`` says that the weights of rays that are not shot are asked for.
    """
    return {
        **(trees.texels.defines if trees is not None else {}),
        **_solids(scene, layout),
        **_materials(layout),
        **_lights(scene, layout),
        **_recursion(scene, layout),
        **display_symbols(scene.settings, display and not accumulate),
        "ACCUMULATE": int(accumulate),
        "LOST": int(lost),
        "CLIPPED": int(bool(scene.setup.camera.near or scene.setup.camera.far)),
    }


def unrolled(layout: Layout) -> bool:
    """Whether all indices are constants, so that numbers may become constants too."""
    counts = [*map(len, layout.kinds.values()), len(layout.looks), layout.media]
    return max(*counts, *map(len, layout.lights.values()), 0) <= UNROLLED


def _each(rows: Sequence[Sequence[int]]) -> str:
    """DO(...) for each row of arguments; the first of them counts."""
    if len(rows) <= UNROLLED:
        return " ".join(f"DO({', '.join(map(str, row))})" for row in rows)
    first, last = rows[0][0], rows[-1][0]
    columns = [", ".join(map(str, column)) for column in list(zip(*rows, strict=True))[1:]]
    others = "".join(f", (int[]({column})[i - {first}])" for column in columns)
    return f"for (int i = {first}; i <= {last}; ++i) {{ DO(i{others}) }}"


def _solids(scene: TracedScene, layout: Layout) -> Symbols:
    groups = {"BALLS": ("ball",), "FLATS": ("square", "disc")}
    groups |= {"SHAPES": ("oval", "box", "cylinder"), "MESHES": ("mesh",)}
    symbols: Symbols = {}
    clear = scene.settings.clear_shadows
    for group, kinds in groups.items():
        start = 0
        for kind in kinds:
            numbers = layout.kinds[kind]
            rows = [(start + i, n, layout.look[n]) for i, n in enumerate(numbers)]
            start += len(rows)
            blocking = [row for row in rows if row[1] in layout.blocking]
            glass = [row for row in blocking if clear and scene.solids[row[1]].transmissive]
            solid = [row for row in blocking if row not in glass]
            symbols[f"EACH_{kind.upper()}(DO)"] = _each(rows)
            symbols[f"BLOCKING_{kind.upper()}(DO)"] = _each(solid)
            symbols[f"CLEAR_{kind.upper()}(DO)"] = _each(glass)
        symbols[group] = start
    meshes = [scene.solids[n].surface for n in layout.kinds["mesh"]]
    symbols["STRETCHED"] = int(any(surface.stretched for surface in meshes))
    symbols["CLEAR_SHADOWS"] = int(any(symbols[f"CLEAR_{kind.upper()}(DO)"] for kind in KINDS))
    return symbols


def _materials(layout: Layout) -> Symbols:
    looks = layout.looks
    textures = [k for k, look in enumerate(looks) if look.texels is not None]
    return {
        "MATERIALS": len(looks),
        "EACH_OTHER_MATERIAL(DO)": _each([(k,) for k in range(1, len(looks))]),
        "TEXTURES": len(textures),
        "EACH_TEXTURED(DO)": " ".join(f"DO({k}, {j})" for j, k in enumerate(textures)),
    }


def _lights(scene: TracedScene, layout: Layout) -> Symbols:
    lamps = {s.surface.emitter: n for n, s in enumerate(scene.solids) if s.object is None}
    symbols: Symbols = {"BRIGHTEST": BRIGHTEST, "LIGHT_SAMPLES": scene.settings.light_samples}
    for kind in LIGHTS:
        found = layout.lights.get(kind, ())
        rows = [(i, lamps.get(n, -2)) if kind == "area" else (i,) for i, (n, _) in enumerate(found)]
        symbols[f"{kind.upper()}_LIGHTS"] = len(found)
        symbols[f"EACH_{kind.upper()}(DO)"] = _each(rows)
    everything = [light for found in layout.lights.values() for _, light in found]
    corners = [len(light.corners) for light in everything if light.corners is not None]
    surfaces = [s.surface for s in scene.solids]
    specular = any(light.specular.any() for surface in surfaces for light in surface.lights)
    symbols["AREA_CORNERS"] = max(corners, default=0)
    symbols["DIFFUSE"] = int(any(x.diffuse.any() for s in surfaces for x in s.lights))
    symbols["SPECULAR"] = int(specular)
    symbols["BLINN"] = int(specular and scene.settings.highlight == "blinn")
    symbols["GATE"] = int(specular and scene.settings.gate)
    symbols["ATTENUATION"] = int(any(light.attenuates for light in everything))
    return symbols


def _recursion(scene: TracedScene, layout: Layout) -> Symbols:
    glass = any(solid.transmissive for solid in scene.solids)
    mirrors = any(any(solid.material.reflectance) for solid in scene.solids)
    absorbing = layout.media > 0 and any(look.absorption.any() for look in layout.looks)
    media = ", ".join(str(look.medium) for look in layout.looks)
    return {
        "RECURSION": int(glass or mirrors),
        "TRANSMISSION": int(glass),
        "BRANCHING": int(glass and scene.settings.depth > 0),
        "DEPTH": scene.settings.depth,
        "SCHLICK": int(scene.settings.fresnel == "schlick"),
        "GREY": int(not absorbing and all(_grey(solid) for solid in scene.solids)),
        "ABSORPTION": int(absorbing),
        "MEDIA": layout.media,
        "NESTED": int(layout.nested),
        "EACH_MEDIUM(DO)": _each([(k,) for k in reversed(range(layout.media))]),
        "MEDIUM_OF_MATERIAL": f"int[]({media})",
    }


def _grey(solid: Solid) -> bool:
    shares = solid.material.reflectance, solid.material.transmittance
    return all(len(set(share)) == 1 for share in shares)


def display_symbols(settings: Settings, display: bool) -> Symbols:
    """What `present.glsl` asks for; all off unless the target holds 8-bit codes."""
    return {
        "DISPLAY": int(display),
        "EXPOSURE": int(display and settings.exposure != 1.0),
        "CURVE": int(display and settings.curve == "srgb"),
        "WRAP": int(display and not settings.clamp),
        "MARKS": wanted_marks(settings) if display else 0,
        "SMALLEST_NORMAL": f"{np.finfo(np.float32).tiny:.8e}",
    }
