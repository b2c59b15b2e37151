"""The sphere that several experiments draw: finer and finer, beside the exact one."""

from __future__ import annotations

from functools import lru_cache

from playground.measure.analytic import Exact, exact_picture
from playground.scene.camera import Camera
from playground.scene.light import PointLight
from playground.scene.material import Material
from playground.scene.mesh import Mesh
from playground.scene.scene import Object, Scene
from playground.scene.setup import Setup
from playground.scene.shapes_curved import uv_sphere

REFERENCE = "the sphere itself, shaded at every pixel in float64"
SIZE, QUICK_SIZE = (320, 240), (160, 120)
SHININESS = 32.0


@lru_cache(maxsize=16)
def sphere_mesh(tessellation: int) -> Mesh:
    """`uv_sphere`, also beyond the range that a setup offers."""
    return uv_sphere(tessellation)


@lru_cache(maxsize=64)
def sphere(tessellation: int, shininess: float = SHININESS) -> Setup:
    """One sphere under one point light."""
    material = Material(
        diffuse=(0.75, 0.25, 0.2),
        specular=(0.6, 0.6, 0.6),
        ambient=(0.75, 0.25, 0.2),
        shininess=shininess,
    )
    ball = Object("sphere", material=material, arrays=sphere_mesh(tessellation))
    light = PointLight(position=(3.0, 4.0, 5.0))
    scene = Scene(objects=(ball,), lights=(light,))
    return Setup(scene, Camera(eye=(0.0, 0.6, 3.4)), name="sphere")


@lru_cache(maxsize=8)
def exact_sphere(size: tuple[int, int], shininess: float = SHININESS) -> Exact:
    """What every one of them approximates.

    The finest mesh fits the depth range and the scale of the view to the same bounds.
    """
    return exact_picture(sphere(64, shininess), size)
