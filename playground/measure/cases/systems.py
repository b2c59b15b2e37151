"""Every kind of case by its name: who solves it, or why nobody does."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from playground.measure.cases import (
    display,
    form_factor,
    hemicube,
    light,
    lightmap,
    place,
    radiosity,
    raster,
    rays,
    shading,
)

Solve = Callable[[dict[str, Any], Any], dict[str, Any]]


@dataclass(frozen=True)
class System:
    """A kind of case: its solver, or why it has none; whether it never runs on the GPU."""

    solve: Solve | None = None
    missing: str = ""
    cpu: bool = False


def _waiting(reason: str, *names: str) -> dict[str, System]:
    return {name: System(missing=reason) for name in names}


SYSTEMS: dict[str, System] = {
    "phong_pow": System(shading.phong_pow),
    "phong_lobe": System(shading.phong_lobe),
    "reflect": System(shading.reflect),
    "phong_shade": System(shading.phong_shade),
    "pervertex_vs_fragment": System(shading.pervertex_vs_fragment),
    "normal_interp": System(place.normal_interp),
    "normal_matrix": System(place.normal_matrix_case),
    "camera_relative": System(place.camera_relative),
    "attenuation": System(light.attenuation),
    "spot_cone": System(light.spot_cone),
    "polygon_form_factor": System(light.polygon_form_factor),
    "phong_lobe_polygon": System(light.phong_lobe_polygon),
    "raster_coverage": System(raster.raster_coverage, cpu=True),
    "perspective_interp": System(raster.perspective_interp, cpu=True),
    "near_clip": System(raster.near_clip, cpu=True),
    "hemicube_pixel": System(hemicube.hemicube_pixel),
    "hemicube_sum": System(hemicube.hemicube_sum),
    "srgb": System(display.srgb),
    "lightmap_bilinear": System(lightmap.lightmap_bilinear),
    "lightmap_dilate": System(lightmap.lightmap_dilate),
    "lightmap_bleed": System(lightmap.lightmap_bleed),
    "ray_sphere": System(rays.ray_sphere),
    "ray_triangle": System(rays.ray_triangle),
    "watertight_fan": System(rays.watertight_fan),
    "ray_box": System(rays.ray_box),
    "ray_offset": System(rays.ray_offset),
    "refract": System(rays.refract),
    "fresnel_table": System(rays.fresnel_table),
    "slab": System(rays.slab),
    "glass_ball": System(rays.glass_ball),
    "nested_dielectrics": System(rays.nested_dielectrics),
    "mirror_recursion": System(rays.mirror_recursion, cpu=True),
    "depth_reversed_z": System(
        missing="depth runs from -w to w as OpenGL has it, where reversing gains no digit"
    ),
    **_waiting("a torus is a mesh here: no ray meets its equation", "ray_torus"),
    "form_factor_kernel": System(form_factor.kernel),
    "form_factor_discs": System(form_factor.discs),
    "form_factor_element_disc": System(form_factor.element_disc),
    "form_factor_element_sphere": System(form_factor.element_sphere),
    "form_factor_sphere_rect": System(form_factor.sphere_rectangle),
    "form_factor_inside_sphere": System(form_factor.inside_sphere),
    "form_factor_concentric": System(form_factor.concentric),
    "form_factor_strips": System(form_factor.strips),
    "form_factor_box": System(form_factor.box),
    "form_factor_pair": System(form_factor.pair),
    "radiosity_furnace": System(radiosity.furnace),
    "radiosity_solve": System(radiosity.solve, cpu=True),
    "radiosity_enclosure": System(radiosity.enclosure),
}
