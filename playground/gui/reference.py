"""The float64 picture of the NumPy renderer, drawn in the background.

The window never waits for it: until a new picture is ready, the last one stands.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from threading import Event, Thread
from time import perf_counter

import moderngl
import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.render.numpy_renderer import (
    colours_before,
    pixel_colours,
    sample_offsets,
    visibility,
)
from playground.render.surface import surfaces
from playground.render.view import view_of
from playground.scene.setup import Setup
from playground.shading.display import code8, display_colour

Codes = NDArray[np.uint8]
BLOCK = 2**14  # pixels between two looks at whether the picture is still wanted
CALM = 0.15  # seconds that a setup must stand still: nobody reads a picture while it moves


class _SupersededError(Exception):
    """Another picture is wanted by now."""


def reference_codes(setup: Setup, size: tuple[int, int], stop: Event) -> Codes:
    """The 8-bit codes (H, W, 4) of the reference picture.

    As `NumpyRenderer.render`, in pieces, so that it can be given up when ``stop`` is set.
    """
    everything = surfaces(setup.scene, setup.settings.weights)
    view = view_of(setup.camera, everything, size)
    offsets = sample_offsets(setup.settings.samples)
    colour = np.zeros((size[1], size[0], 3))
    for offset in offsets:
        frame = visibility(everything, view, size, offset)
        sample = np.empty_like(colour)
        sample[...] = setup.scene.background
        for number, surface in enumerate(everything):
            rows, columns = np.nonzero(frame.object == number)
            before = colours_before(surface, view, setup.settings)
            for start in range(0, len(rows), BLOCK):
                if stop.is_set():
                    raise _SupersededError
                at = rows[start : start + BLOCK], columns[start : start + BLOCK]
                sample[at] = pixel_colours(surface, view, setup.settings, frame, at, before)
        if stop.is_set():
            raise _SupersededError
        colour += sample / len(offsets)
    s = setup.settings
    linear = colour.astype(np.float32)
    codes = np.full((size[1], size[0], 4), 255, dtype=np.uint8)
    codes[..., :3] = code8(display_colour(linear, s.exposure, s.clamp, s.curve))
    return codes


@dataclass(eq=False)
class _Job:
    """One picture under way."""

    setup: Setup
    size: tuple[int, int]
    stop: Event = field(default_factory=Event)
    codes: Codes | None = None
    error: str = ""
    done: bool = False

    def run(self) -> None:
        """Draw; for a thread of its own."""
        try:
            self.codes = reference_codes(self.setup, self.size, self.stop)
        except _SupersededError:
            pass
        except Exception as error:  # a thread has nobody else to tell
            self.error = str(error) or repr(error)
        self.done = True


class ReferencePicture:
    """The reference picture of one place in the view, as a texture and as codes."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._texture: moderngl.Texture | None = None
        self._wanted: tuple[Setup, tuple[int, int]] | None = None
        self._since = 0.0
        self._job: _Job | None = None
        self._shown: tuple[Setup, tuple[int, int]] | None = None
        self.codes: Codes | None = None

    def texture(self, setup: Setup, size: tuple[int, int]) -> moderngl.Texture:
        """The texture of the last picture that is ready; grey where there is none yet.

        Raises
        ------
        PlaygroundError
            This setup cannot be drawn by the reference.
        """
        wanted = (setup, size)
        if self._wanted != wanted:
            self._wanted, self._since = wanted, perf_counter()
            if self._job is not None:
                self._job.stop.set()
        self._collect()
        calm = perf_counter() - self._since >= CALM or self._shown is None
        if self._job is None and self._shown != wanted and calm:
            self._job = _Job(setup, size)
            Thread(target=self._job.run, daemon=True, name="reference").start()
        if self._texture is None:
            self._texture = self._context.texture((1, 1), 4, bytes((90, 90, 90, 255)))
        return self._texture

    @property
    def computing(self) -> bool:
        """Whether the picture that is wanted is not there yet."""
        return self._wanted is not None and self._shown != self._wanted

    @property
    def stamp(self) -> object:
        """Changes when the picture does."""
        return self._shown

    def rest(self) -> None:
        """Nobody looks at it: give up what is under way."""
        if self._job is not None:
            self._job.stop.set()
        self._job, self._wanted = None, self._shown

    def _collect(self) -> None:
        """Take over the picture of a thread that has finished."""
        job = self._job
        if job is None or not job.done:
            return
        self._job = None
        if job.error:
            self._shown = (job.setup, job.size)  # not again until something changes
            raise PlaygroundError(f"the reference picture failed: {job.error}")
        if job.codes is not None and self._wanted == (job.setup, job.size):
            self._shown, self.codes = (job.setup, job.size), job.codes
            if self._texture is None or self._texture.size != job.size:
                self.release()
                self._texture = self._context.texture(job.size, 4, job.codes.tobytes())
            else:
                self._texture.write(job.codes.tobytes())

    def release(self) -> None:
        """Free the GPU memory."""
        if self._texture is not None:
            self._texture.release()
            self._texture = None
