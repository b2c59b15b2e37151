"""What a screen shows of linear colours: the display's steps, marks over them, and the way back."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from playground.render.precision import smallest_normal
from playground.scene.settings import Settings
from playground.shading.display import display_colour, srgb_decode
from playground.shading.floats import Array
from playground.shading.marks import KINDS, marked


def wanted_marks(settings: Settings) -> int:
    """The marks of the settings as a number: bit k for kind k of `KINDS`."""
    return sum(1 << k for k, kind in enumerate(KINDS) if kind in settings.marks)


def shown_colour(colour: ArrayLike, settings: Settings) -> Array:
    """In [0, 1], shape (..., 3), for linear ``colour``: exposed, clamped, with curve and marks."""
    s = settings
    shown = display_colour(colour, s.exposure, s.clamp, s.curve)
    if not s.marks:
        return shown
    return marked(shown, colour, s.exposure, smallest_normal(s), wanted_marks(s))


def light_shown(shown: ArrayLike, settings: Settings) -> Array:
    """The linear light (..., 3) that is shown as ``shown``, in [0, 1].

    What was cut stays cut, a mark stays a colour, and an exposure of 0 leaves nothing to undo.
    """
    shown = np.asarray(shown, dtype=np.float64)
    light = srgb_decode(shown) if settings.curve == "srgb" else shown
    return light / (settings.exposure or 1.0)
