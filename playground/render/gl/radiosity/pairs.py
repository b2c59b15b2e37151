"""What pairs of patches exchange, on the GPU: a pixel per pair of shaders/radiosity/pairs.frag.

float32, in units in which the scene is about 1 large. What
`playground.render.radiosity.factor.pairs` says about far pairs, and which share of near ones is
visible; the closed form of near ones needs float64 and is computed there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from playground.render.gl.context import rest
from playground.render.gl.program import Program
from playground.render.gl.source import assemble
from playground.render.gl.trace.bvh_texels import bvh_texels
from playground.render.radiosity.factor.pairs import INSET, LOOKS, multipliers
from playground.render.radiosity.factor.visibility import LIFT, bend_of, between, size_of, tree_of
from playground.render.radiosity.patch.patches import Patches

if TYPE_CHECKING:
    import moderngl

Ints = NDArray[np.intp]
Singles = NDArray[np.float32]

WIDTH = 1024  # texels to a row of what is read by number, and pixels to one of the picture
HEIGHT = 256  # of the picture
TEXELS = 5  # per patch
UNIT = float(np.finfo(np.float32).eps)


class GpuPairs:
    """A scene's patches and what may stand between them, uploaded; call it with rows and columns.

    Parameters
    ----------
    occlusion : bool
        Whether patches hide one another.
    points, rays : int
        As in `playground.render.radiosity.factor.pairs`.
    look : bool
        As in `pairs.visible`.
    """

    def __init__(
        self,
        context: moderngl.Context,
        patches: Patches,
        occlusion: bool = True,
        points: int = 3,
        rays: int = 5,
        look: bool = True,
    ) -> None:
        self._context = context
        _, exponent = np.frexp(size_of(patches))
        self._scale = float(np.ldexp(1.0, -int(exponent)))  # the largest coordinate: 1/2 to 1
        triangles = between(patches).tree.corners * self._scale
        rays = rays if occlusion and len(triangles) else 0
        lift = LIFT * UNIT + 2.0 * bend_of(patches) * self._scale
        symbols: dict[str, object] = {"POINTS": points, "RAYS": rays, "LIFT": f"{lift:.9e}"}
        symbols["RAY_U"], symbols["RAY_V"] = multipliers(rays)
        symbols["LOOKS"], symbols["INSET"] = LOOKS**2 if look else 0, INSET
        nodes, weights = np.polynomial.legendre.leggauss(points)
        symbols["GAUSS_NODES"] = _literal((1.0 + nodes) / 2.0)
        symbols["GAUSS_WEIGHTS"] = _literal(weights / 2.0)
        held = {"pair_patches": self._texture(self._patches(patches))}
        if rays:
            tree = tree_of(triangles.astype(np.float32))
            texels = bvh_texels([tree])
            symbols |= texels.defines
            held["bvh_nodes"] = self._texture(texels.nodes)
            held["bvh_corners"] = self._texture(texels.corners)
        self._held = held
        sources = assemble("trace/screen.vert"), assemble("radiosity/pairs.frag", symbols)
        self._program = Program(context, sources)
        self._array = context.vertex_array(self._program.gl, [])
        rows = _by_number(np.zeros((len(patches), 1), dtype=np.int32))
        self._numbers = {name: self._texture(rows) for name in ("pair_rows", "pair_columns")}
        for unit, name in enumerate(self._textures()):
            self._set(name, unit)
        if rays:
            (root,) = texels.trees
            self._program.write({"bvh_low": root.low, "bvh_cell": root.cell})
            self._set("bvh_root", root.root)
        self._target = context.framebuffer([context.texture((WIDTH, HEIGHT), 2, dtype="f4")])

    def __call__(self, rows: Ints, columns: Ints) -> tuple[Singles, Singles]:
        """A_i F_ij as if all pairs were far, and the visible shares; (len(rows), len(columns))."""
        found = np.empty((len(rows), len(columns), 2), dtype=np.float32)
        for name, numbers in (("pair_rows", rows), ("pair_columns", columns)):
            texture = self._numbers[name]
            height = -(-len(numbers) // WIDTH)
            padded = np.zeros(height * WIDTH, dtype=np.int32)
            padded[: len(numbers)] = numbers
            texture.write(padded.tobytes(), viewport=(0, 0, WIDTH, height))
        for unit, texture in enumerate(self._textures().values()):
            texture.use(unit)
        self._context.enable_only(self._context.NOTHING)  # whatever was drawn before
        self._target.use()
        for row in range(0, len(rows), HEIGHT):
            for column in range(0, len(columns), WIDTH):
                part = found[row : row + HEIGHT, column : column + WIDTH]
                view = (0, 0, part.shape[1], part.shape[0])
                self._set("pair_corner", (column, row))
                self._target.viewport = view
                self._array.render(vertices=3)
                data = self._target.read(viewport=view, components=2, dtype="f4")
                part[...] = np.frombuffer(data, np.float32).reshape(part.shape)
        rest(self._context)
        return found[..., 0] / np.float32(self._scale**2), found[..., 1]

    def release(self) -> None:
        """Free the GPU memory."""
        rest(self._context)
        textures = self._textures().values()
        for held in (*self._target.color_attachments, self._target, *textures, self._array):
            held.release()
        self._program.release()

    def _textures(self) -> dict[str, moderngl.Texture]:
        return {**self._held, **self._numbers}

    def _set(self, name: str, value: Any) -> None:
        if name in self._program.gl:
            member: Any = self._program.gl[name]
            member.value = value

    def _patches(self, patches: Patches) -> NDArray[Any]:
        texels = np.zeros((len(patches), TEXELS, 4), dtype=np.float32)
        texels[:, :4, :3] = patches.turned * self._scale
        texels[:, 4, :3] = patches.normal
        texels[:, 4, 3] = patches.rank
        return _by_number(texels.reshape(-1, 4))

    def _texture(self, texels: NDArray[Any]) -> moderngl.Texture:
        height, width, components = texels.shape
        kind = {"f": "f4", "i": "i4", "u": "u4"}[texels.dtype.kind]
        data = np.ascontiguousarray(texels).tobytes()
        texture = self._context.texture((width, height), components, data, dtype=kind)
        texture.filter = (self._context.NEAREST, self._context.NEAREST)
        return texture


def _by_number(texels: NDArray[Any]) -> NDArray[Any]:
    """Texels (n, c) in rows of `WIDTH`, (H, WIDTH, c)."""
    rows = np.zeros((max(-(-len(texels) // WIDTH), 1) * WIDTH, texels.shape[1]), texels.dtype)
    rows[: len(texels)] = texels
    return rows.reshape(-1, WIDTH, texels.shape[1])


def _literal(values: NDArray[np.float64]) -> str:
    return f"float[{len(values)}]({', '.join(f'{x:.9e}' for x in values)})"
