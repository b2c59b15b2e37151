"""Where the picture is taken from."""

from __future__ import annotations

from dataclasses import dataclass

from playground.errors import PlaygroundError
from playground.scene.knob import Declared, number, vector


@dataclass(frozen=True)
class Camera(Declared):
    """A pinhole camera: where it stands, what it looks at, how wide it sees.

    ``near`` and ``far`` are distances along the view direction; 0 means "as the
    scene needs it", which is nearly always right.
    """

    label = "camera"

    eye: tuple[float, float, float] = vector(2.0, 1.5, 3.0, help="where the viewer stands")
    target: tuple[float, float, float] = vector(0.0, 0.0, 0.0, help="the point looked at")
    up: tuple[float, float, float] = vector(0.0, 1.0, 0.0, help="which way is up in the picture")
    fov: float = number(
        40.0,
        0.01,
        170.0,
        unit="degrees",
        help="angle of view across the shorter side of the picture",
    )
    near: float = number(0.0, 0.0, help="nearest distance drawn; 0 fits it to the scene")
    far: float = number(0.0, 0.0, help="farthest distance drawn; 0 fits it to the scene")

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.eye == self.target:
            raise PlaygroundError(
                "camera.eye and camera.target are the same point",
                got=self.eye,
                fix="Move one of them: the view direction is from eye to target.",
            )
        if not any(self.up):
            raise PlaygroundError(
                "camera.up has no direction", got=self.up, allowed="any vector but (0, 0, 0)"
            )
        if self.near and self.far and self.near >= self.far:
            raise PlaygroundError(
                "camera.near must be below camera.far",
                got=f"{self.near:g} >= {self.far:g}",
                fix="Swap them, or set both to 0.",
            )
