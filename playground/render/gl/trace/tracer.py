"""The ray tracer on the GPU: scene → layout → program → one triangle per sample → read."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.render.checks import check_out, check_setup
from playground.render.gl import context as gl_context
from playground.render.gl.program import Program
from playground.render.gl.source import assemble
from playground.render.gl.trace.features import Symbols, display_symbols, symbols_of, unrolled
from playground.render.gl.trace.program import TraceProgram
from playground.render.gl.trace.standing import Placed, Standing
from playground.render.gl.trace.sums import Sums
from playground.render.gl.trace.textures import Textures
from playground.render.gl.trace.uniforms import camera_values
from playground.render.image import Image, LeftOut
from playground.render.numpy_renderer import sample_offsets
from playground.render.trace.warn import warnings_of
from playground.scene.setup import Setup

if TYPE_CHECKING:
    import moderngl

Key = tuple[tuple[str, object], ...]
KEPT = 16  # programs of earlier scenes


class GLTracer:
    """Traces pictures of ``size``, which may be set anew, on the GPU.

    ``left_out`` and ``warnings`` tell of the last one.
    While something moves, the numbers of the scene are uniforms. A scene that has stood still for
    a few frames, with the camera free to move, gets a program in which they are constants.
    """

    name = "gl"

    def __init__(self, size: tuple[int, int], context: moderngl.Context | None = None) -> None:
        self.size = size
        self._context = context or gl_context.headless()
        self.bakes = True  # whether a scene that stays gets a program of its own
        self._standing = Standing()
        self._programs: dict[Key, TraceProgram] = {}
        self._baked: tuple[Placed | None, Key, TraceProgram | None] = (None, (), None)
        self._asked: tuple[Placed, bool, bool, bool, Symbols] | None = None
        self._shows: dict[Key, Program] = {}
        self._textures = Textures(self._context)
        self._sums: dict[str, Sums] = {}
        self._traced: tuple[Placed, Sums] | None = None
        self._unasked: tuple[Setup, bool] | None = None

    @property
    def left_out(self) -> LeftOut | None:
        """What the cut-offs left out of the last picture; None before the first.

        A picture that went into an array is traced once more for it.
        """
        if self._traced is None:
            return None
        sums = self._traced[1]
        if self._unasked is not None:
            setup, codes = self._unasked
            self._sample(setup, sums, (0.5, 0.5), codes, 1)
        return LeftOut(sums.read_lost())

    @property
    def warnings(self) -> tuple[str, ...]:
        """What the last picture shows that its author may not expect."""
        return warnings_of(self._traced[0].scene, "float32") if self._traced else ()

    def render(self, setup: Setup, out: NDArray[Any] | None = None) -> Image | NDArray[Any]:
        """Trace ``setup``; see `playground.render.renderer.Renderer.render`."""
        check_setup(setup)
        if setup.settings.bugs:
            raise PlaygroundError(
                "the ray tracer makes no mistakes",
                got=f"bugs = {', '.join(setup.settings.bugs)}",
                fix="Use --method raster, or --set bugs= for none.",
            )
        if out is None:
            pixels = np.empty((self.size[1], self.size[0], 4), dtype=np.float32)
            self._trace_and_read(setup, pixels, lost=True)
            colour = np.ascontiguousarray(pixels[..., :3])
            return Image(
                colour,
                pixels[..., 3].copy(),
                setup,
                self.name,
                left_out=self.left_out,
                warnings=self.warnings,
            )
        check_out(out, self.size)
        if out.shape[2] == 4 and out.flags.c_contiguous:
            self._trace_and_read(setup, out)
        else:
            whole = np.empty((self.size[1], self.size[0], 4), dtype=out.dtype)
            self._trace_and_read(setup, whole)
            out[...] = whole[..., : out.shape[2]]
        return out

    def samples(self, setup: Setup) -> int:
        """As many samples per pixel as ``setup`` asks for."""
        return setup.settings.samples

    def _trace_and_read(self, setup: Setup, out: NDArray[Any], lost: bool = False) -> None:
        codes = out.dtype == np.uint8
        if setup.settings.samples == 1:
            sums = self._sums_of("f1" if codes else "f4")
            self._sample(setup, sums, (0.5, 0.5), codes, 1, lost=lost)
            sums.read(out)
            return
        for _ in self.steps(setup):
            pass
        sums = self._sums["f4"]
        if codes:
            sums = self._sums_of("f1")
            sums.begin()
            self.show(setup, 1.0)
        sums.read(out)

    def steps(self, setup: Setup, bands: int = 1) -> Iterator[float]:
        """Add sample after sample of every pixel; yields the share that is done.

        A step is one sample of the pixels of one of that many ``bands`` of rows. What there is
        after a whole sample can be shown by `show`.
        """
        offsets = sample_offsets(setup.settings.samples)
        sums = self._sums_of("f4")
        edges = [round(i * self.size[1] / bands) for i in range(bands + 1)]
        for i, offset in enumerate(offsets):
            for k, rows in enumerate(pairwise(edges)):
                sums.rows = None if bands == 1 else rows
                self._sample(setup, sums, offset, False, len(offsets), i == 0, again=k > 0)
                yield (i + (k + 1) / bands) / len(offsets)

    def show(self, setup: Setup, done: float) -> None:
        """Draw the share ``done`` of the samples into the framebuffer that is bound."""
        symbols = display_symbols(setup.settings, True)
        key = tuple(symbols.items())
        if key not in self._shows:
            stages = assemble("trace/screen.vert"), assemble("trace/present.frag", symbols)
            self._shows[key] = Program(self._context, stages)
        program = self._shows[key]
        self._context.disable(self._everything())
        self._sums["f4"].colour.use(0)
        program.write({"whole": 1.0 / done, "exposure": setup.settings.exposure})
        array = self._context.vertex_array(program.gl, [])
        array.render(vertices=3)
        array.release()

    def _sample(
        self,
        setup: Setup,
        sums: Sums,
        offset: tuple[float, float],
        display: bool,
        samples: int,
        first: bool = True,
        again: bool = False,
        lost: bool = True,
    ) -> None:
        """Trace one sample of every pixel; of several, add it to the earlier ones.

        ``again`` says that it goes on with the sample of which it traced other rows, ``lost``
        that the weights of rays that are not shot are kept.
        """
        import moderngl

        placed = self._standing.placed if again else None
        placed = placed or self._standing.place(setup, self.size)
        self._textures.check(placed)
        view = self._standing.view(setup.camera, self.size)
        symbols = self._symbols(placed, display, samples > 1, lost)
        program = self._program(placed, symbols)
        program.write(camera_values(view, placed.view, setup.camera, self.size, offset))
        program.write({"sample_share": 1.0 / samples})
        program.write({"around_eye": np.array([placed.media_around(setup)], dtype=np.uint32)})
        self._textures.bind(placed, program)
        sums.keep_lost((1 if symbols["GREY"] else 4) if lost else 0)
        if first:
            sums.begin()
        else:
            sums.use()
        self._context.disable(self._everything())
        if samples > 1:
            self._context.enable(moderngl.BLEND)
            self._context.blend_func = moderngl.ONE, moderngl.ONE
        program.draw()
        self._context.disable(self._everything())
        self._traced, self._unasked = (placed, sums), None if lost else (setup, display)

    def _everything(self) -> int:
        import moderngl

        return moderngl.BLEND | moderngl.DEPTH_TEST | moderngl.CULL_FACE

    def _symbols(self, placed: Placed, display: bool, accumulate: bool, lost: bool) -> Symbols:
        """What the program for a scene is made of; a scene that stays is asked once."""
        asked = placed, display, accumulate, lost
        if self._asked is None or self._asked[:4] != asked:
            self._asked = *asked, symbols_of(placed.scene, placed.layout, placed.trees, *asked[1:])
        return self._asked[4]

    def _program(self, placed: Placed, symbols: Symbols) -> TraceProgram:
        """The program for a scene, its numbers uploaded or, once they stay, built in."""
        key = tuple(symbols.items())
        known = self._baked[0] is placed and self._baked[1] == key
        if self._standing.steady and unrolled(placed.layout) and (self.bakes or known):
            if not known:
                self._drop_baked()
                program = TraceProgram(self._context, symbols, placed.values)
                program.write(placed.values)  # those that cannot be constants
                self._baked = placed, key, program
            assert self._baked[2] is not None
            return self._baked[2]
        if key not in self._programs:
            for old in list(self._programs)[:-KEPT]:
                self._programs.pop(old).release()
            self._programs[key] = TraceProgram(self._context, symbols)
        self._programs[key].write(placed.values)
        return self._programs[key]

    def _sums_of(self, dtype: str) -> Sums:
        known = self._sums.get(dtype)
        if known is not None and known.size != self.size:
            self._sums.pop(dtype).release()
        if dtype not in self._sums:
            self._sums[dtype] = Sums(self._context, self.size, dtype)
        return self._sums[dtype]

    def _drop_baked(self) -> None:
        if self._baked[2] is not None:
            self._baked[2].release()
        self._baked = (None, (), None)

    def close(self) -> None:
        """Free the GPU memory."""
        self._drop_baked()
        for program in self._programs.values():
            program.release()
        for shown in self._shows.values():
            shown.release()
        for sums in self._sums.values():
            sums.release()
        self._textures.release()
        self._programs, self._shows, self._sums, self._traced = {}, {}, {}, None

    def __enter__(self) -> GLTracer:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()
