"""A lighting playground: the lecture "Lighting", computed, shown and checked.

    import playground as pg
    image = pg.render(pg.load("teapot"))
    image.save("teapot.png")

Names are loaded when they are first used: importing the package costs nothing.
"""

from __future__ import annotations

from importlib import import_module

TYPE_CHECKING = False  # typing.TYPE_CHECKING without the time that importing typing takes
if TYPE_CHECKING:
    from typing import Any

__version__ = "0.1.0"

_HOMES = {
    "load": "playground.scene.library",
    "library": "playground.scene.library",
    "save": "playground.scene.setup_file",
    "Setup": "playground.scene.setup",
    "Scene": "playground.scene.scene",
    "Object": "playground.scene.scene",
    "Mesh": "playground.scene.mesh",
    "Material": "playground.scene.material",
    "preset": "playground.scene.presets",
    "Transform": "playground.scene.transform",
    "Camera": "playground.scene.camera",
    "Settings": "playground.scene.settings",
    "Shading": "playground.scene.settings",
    "DirectionalLight": "playground.scene.light",
    "PointLight": "playground.scene.light",
    "SpotLight": "playground.scene.light",
    "RectangleLight": "playground.scene.light",
    "PolygonLight": "playground.scene.light",
    "Image": "playground.render.image",
    "open_renderer": "playground.render.renderer",
    "radiosity": "playground.render.radiosity.result",
    "PathTracing": "playground.render.trace.path",
    "compare": "playground.measure.compare",
    "PlaygroundError": "playground.errors",
}

_PACKAGES = ("explain", "render", "shading")  # the first two can be called

__all__ = sorted([*_HOMES, *_PACKAGES])


def __getattr__(name: str) -> Any:
    if name in _PACKAGES:
        return import_module(f"playground.{name}")
    if name not in _HOMES:
        raise AttributeError(f"module 'playground' has no attribute {name!r}")
    value = getattr(import_module(_HOMES[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
