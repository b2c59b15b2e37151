"""The one picture that ours, the floor and the peers all draw, and the camera's path around it.

A geodesic sphere of 20 f² triangles under one point light at (3, 4, 5), 1280 x 720.
"""

from __future__ import annotations

from math import cos, sin

from playground.scene.camera import Camera
from playground.scene.light import PointLight
from playground.scene.material import Material
from playground.scene.scene import Object, Scene
from playground.scene.setup import Setup

SIZE = (1280, 720)
TESSELLATION = {"1k": 7, "100k": 71, "1M": 224}  # 980, 100 820 and 1 003 520 triangles
LIGHT = (3.0, 4.0, 5.0)
BACKGROUND = (0.1, 0.1, 0.12)
AMBIENT, DIFFUSE, SPECULAR = (0.05, 0.05, 0.05), (0.7, 0.3, 0.2), (0.5, 0.5, 0.5)
SHININESS = 32.0
FOV, NEAR, FAR = 45.0, 0.1, 20.0


def eye(step: int) -> tuple[float, float, float]:
    """Where the camera stands at a step of its orbit."""
    angle = 0.05 * step
    return 3.0 * sin(angle), 0.6, 3.0 * cos(angle)


def frames_setup(triangles: str, shading: str = "per-fragment", samples: int = 1) -> Setup:
    """The setup for a named number of triangles."""
    material = Material(
        diffuse=DIFFUSE, specular=SPECULAR, ambient=(0.5, 0.5, 0.5), shininess=SHININESS
    )
    ball = Object("icosphere", tessellation=TESSELLATION[triangles], material=material)
    light = PointLight(position=LIGHT, ambient=(0.1, 0.1, 0.1))
    scene = Scene(background=BACKGROUND, objects=(ball,), lights=(light,))
    camera = Camera(eye=eye(0), fov=FOV, near=NEAR, far=FAR)
    setup = Setup(scene, camera, name=f"{triangles} triangles")
    return setup.with_(shading=shading, samples=samples)
