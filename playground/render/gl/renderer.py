"""The rasteriser on the GPU: needs → program → uniforms → draw → read."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.render.checks import check_out, check_setup
from playground.render.gl import context as gl_context
from playground.render.gl.clusters import frustum_planes, visible_runs
from playground.render.gl.edited import Edited
from playground.render.gl.mesh_buffers import MeshBuffers
from playground.render.gl.program import SAMPLERS, Program, check_lights, check_precision
from playground.render.gl.target import Target
from playground.render.gl.uniforms import surface_uniforms, view_uniforms
from playground.render.image import Image
from playground.render.needs import Needs, needs
from playground.render.shown import shown_colour
from playground.render.surface import Surface, surfaces
from playground.render.view import View, view_of
from playground.scene.scene import Scene
from playground.scene.settings import Settings
from playground.scene.setup import Setup

if TYPE_CHECKING:
    import moderngl

KEPT = 8  # meshes and textures of earlier scenes that wait to be drawn again
STEADY = 8  # frames with the same scene and settings before their values become constants


class GLRenderer:
    """Draws setups of one size; keeps programs, meshes and targets between them.

    While sliders move, frames share one program and only uniforms change. A scene that
    has stood still for `STEADY` frames, with the camera free to move, gets programs in
    which its colours are constants.
    """

    name = "gl"

    def __init__(self, size: tuple[int, int], context: moderngl.Context | None = None) -> None:
        self.size = size
        self._context = context or gl_context.headless()
        self._edited = Edited()
        self._programs: dict[Needs, Program] = {}
        self._baked: dict[tuple[Needs, int], Program] = {}
        self._meshes: dict[tuple[int, int, bool, bool], tuple[object, MeshBuffers]] = {}
        self._textures: dict[int, tuple[object, moderngl.Texture]] = {}
        self._targets: dict[tuple[str, int], Target] = {}
        self._drawn: tuple[Scene | None, Settings | None] = (None, None)
        self._surfaces: tuple[Surface, ...] = ()
        self._wanted: dict[tuple[int, bool, bool], Needs] = {}  # all that the camera can change
        self._frames = 0

    @property
    def overrides(self) -> Mapping[str, str]:
        """Texts that take the place of shader files.

        While they do not compile, the last good ones run and `shader_error` says why.
        """
        return self._edited.texts

    @overrides.setter
    def overrides(self, texts: Mapping[str, str]) -> None:
        if self._edited.change(texts):
            self._release_programs()

    def refuse_overrides(self, error: str) -> None:
        """Go back to the last good shaders, because drawing with the newest has failed."""
        self._edited.refuse(error)
        self._release_programs()

    @property
    def shader_error(self) -> str:
        """Why the overrides are not what is drawn with, with file and line; empty if they are."""
        return self._edited.error

    def render(self, setup: Setup, out: NDArray[Any] | None = None) -> Image | NDArray[Any]:
        """Draw ``setup``; see `playground.render.renderer.Renderer.render`."""
        check_setup(setup)
        if out is None:
            pixels = np.empty((self.size[1], self.size[0], 4), dtype=np.float32)
            self._draw_and_read(setup, pixels)
            colour = np.ascontiguousarray(pixels[..., :3])
            image = Image(colour, pixels[..., 3].copy(), setup, self.name)
            samples = self.samples(setup)
            if samples != setup.settings.samples:
                image.notes["samples"] = f"this driver draws {samples} samples per pixel"
            return image
        check_out(out, self.size)
        if out.shape[2] == 4 and out.flags.c_contiguous:
            self._draw_and_read(setup, out)
        else:
            whole = np.empty((self.size[1], self.size[0], 4), dtype=out.dtype)
            self._draw_and_read(setup, whole)
            out[...] = whole[..., : out.shape[2]]
        return out

    def samples(self, setup: Setup) -> int:
        """How many samples per pixel the driver draws for ``setup``: no more than it can."""
        return min(setup.settings.samples, max(int(self._context.max_samples), 1))

    def _draw_and_read(self, setup: Setup, out: NDArray[Any]) -> None:
        target = self._target("f1" if out.dtype == np.uint8 else "f4", setup.settings.samples)
        self.draw(setup, target)
        target.read(out)

    def draw(self, setup: Setup, target: Target) -> None:
        """Draw ``setup`` into ``target`` and leave it on the GPU."""
        self._notice(setup)
        view = view_of(setup.camera, self._surfaces, self.size)
        background = self._background_of(setup)
        if target.dtype == "f1":
            red, green, blue = shown_colour(background, setup.settings)
            background = float(red), float(green), float(blue)
        target.begin(background)
        for number, surface in enumerate(self._surfaces):
            two_sided = view.two_sided(surface)
            key = (number, two_sided, target.dtype == "f1")
            if key not in self._wanted:
                self._wanted[key] = needs(surface, view, setup.settings, target.dtype == "f1")
            wanted = self._wanted[key]
            program = self._program(wanted, number, surface, setup.settings)
            self._draw_surface(surface, view, wanted, program, two_sided)

    def _surfaces_of(self, setup: Setup) -> tuple[Surface, ...]:
        """What is drawn of ``setup``: asked anew when the scene or the settings have changed."""
        return surfaces(setup.scene, setup.settings.weights)

    def _background_of(self, setup: Setup) -> tuple[float, float, float]:
        return setup.scene.background

    def _notice(self, setup: Setup) -> None:
        """Prepare the surfaces anew unless only the camera has moved."""
        scene, settings = setup.scene, setup.settings
        if self._drawn[0] is scene and self._drawn[1] is settings:
            self._frames += 1
            return
        self._surfaces = self._surfaces_of(setup)
        self._drawn, self._frames = (scene, settings), 0
        for program in self._baked.values():
            program.release()
        self._baked.clear()
        self._wanted.clear()
        self._forget()

    def _forget(self) -> None:
        """Free meshes and textures of earlier scenes beyond `KEPT` of each."""
        meshes = {(id(surface.mesh), id(surface.stored)) for surface in self._surfaces}
        for key in [key for key in self._meshes if key[:2] not in meshes][:-KEPT]:
            buffers = self._meshes.pop(key)[1]
            for program in self._programs.values():
                program.forget(buffers)
            buffers.release()
        texels = {id(surface.texels) for surface in self._surfaces}
        texels |= {id(surface.stored.texels) for surface in self._surfaces if surface.stored}
        for number in [number for number in self._textures if number not in texels][:-KEPT]:
            self._textures.pop(number)[1].release()

    def _draw_surface(
        self, surface: Surface, view: View, wanted: Needs, program: Program, two_sided: bool
    ) -> None:
        import moderngl

        values = view_uniforms(surface, view, wanted.precision)
        program.write(values)
        if wanted.texture and surface.texels is not None:
            self._texture(surface.texels).use(0)
        if surface.stored is not None and surface.stored.texels is not None:
            self._texture(surface.stored.texels).use(SAMPLERS["lightmap_texels"])

        # The picture is drawn upside down, which turns every winding around.
        cull = not two_sided
        self._context.front_face = "ccw" if surface.mirrored else "cw"
        self._context.enable_only(moderngl.DEPTH_TEST | (moderngl.CULL_FACE if cull else 0))
        buffers = self._mesh(surface, wanted)
        array = program.array(buffers)
        if buffers.clusters is None or surface.stretched:
            array.render()
            return
        planes = frustum_planes(values["clip_from_object"])
        eye, pixel = view.eye_in(surface), view.pixel(self.size[1])
        for first, count in visible_runs(buffers.clusters, eye, planes, pixel, cull):
            array.render(vertices=3 * count, first=3 * first)

    def _program(self, wanted: Needs, number: int, surface: Surface, settings: Settings) -> Program:
        """The program for a surface, its colours uploaded or, once they stay, built in."""
        if self._frames < STEADY:
            if wanted not in self._programs:
                check_precision(self._context, wanted)
                check_lights(self._context, wanted)
                self._programs[wanted] = self._edited.program(self._context, wanted)
            self._programs[wanted].write(surface_uniforms(surface, settings))
            return self._programs[wanted]
        key = (wanted, number)
        if key not in self._baked:
            values = surface_uniforms(surface, settings)
            self._baked[key] = self._edited.program(self._context, wanted, values)
        return self._baked[key]

    def _mesh(self, surface: Surface, wanted: Needs) -> MeshBuffers:
        flat = wanted.shading == "flat"
        mesh, stored = surface.mesh, surface.stored
        key = (id(mesh), id(stored), flat, wanted.texture)
        if key not in self._meshes:
            columns = stored.columns if stored is not None else None
            buffers = MeshBuffers(self._context, mesh, flat, wanted.texture, columns)
            self._meshes[key] = ((mesh, stored), buffers)
        return self._meshes[key][1]

    def _texture(self, texels: NDArray[np.float32]) -> moderngl.Texture:
        if id(texels) not in self._textures:
            size = (texels.shape[1], texels.shape[0])
            largest = int(self._context.info["GL_MAX_TEXTURE_SIZE"])
            if max(size) > largest:
                raise PlaygroundError(
                    "a texture is too large for this driver",
                    got=f"{size[0]}x{size[1]}",
                    allowed=f"up to {largest} texels a side",
                    fix="Make the image smaller, or use --renderer numpy.",
                )
            texture = self._context.texture(size, 3, texels.tobytes(), dtype="f4")
            self._textures[id(texels)] = (texels, texture)
        return self._textures[id(texels)][1]

    def _target(self, dtype: str, samples: int) -> Target:
        key = (dtype, samples)
        if key not in self._targets:
            self._targets[key] = Target(self._context, self.size, dtype, samples)
        return self._targets[key]

    def close(self) -> None:
        """Free the GPU memory."""
        self._release_programs()
        for _, buffers in self._meshes.values():
            buffers.release()
        for _, texture in self._textures.values():
            texture.release()
        for target in self._targets.values():
            target.release()
        self._drawn = (None, None)
        self._meshes, self._textures, self._targets = {}, {}, {}

    def _release_programs(self) -> None:
        for program in (*self._baked.values(), *self._programs.values()):
            program.release()
        self._baked, self._programs = {}, {}

    def __enter__(self) -> GLRenderer:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()
