"""An image file as texels: what m_d is at every point of a surface."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError
from playground.files import Stamp, read_bytes, stamp, texture_file
from playground.scene.mesh import Mesh
from playground.scene.scene import Object
from playground.shading.display import srgb_decode


def load_texture(path: str, encoding: str = "linear") -> NDArray[np.float32]:
    """The texels of an image file, linear RGB in [0, 1], float32 (H, W, 3), row 0 at v = 0.

    A bare name that is no file here is looked up among the project's textures.
    ``encoding`` says whether the stored numbers carry the sRGB curve.

    Raises
    ------
    PlaygroundError
        The file is missing, damaged, or no image.
    """
    file = texture_file(path, Path())
    return _texels(file, encoding, stamp(file))


def check_texcoords(item: Object, mesh: Mesh) -> None:
    """Raise an error where an object has a texture and its mesh cannot say where it goes."""
    if item.material.texture and mesh.texcoords is None:
        raise PlaygroundError(
            f"the mesh '{mesh.name or item.mesh}' has no texture coordinates",
            got=f"material.texture = {item.material.texture}",
            allowed="a texture on a mesh that has them",
            fix="Remove the texture, or export the model with texture coordinates (UV).",
        )


@lru_cache(maxsize=16)
def _texels(file: Path, encoding: str, state: Stamp) -> NDArray[np.float32]:
    """The texels of a file; ``state`` tells one that has changed from what it was."""
    from io import BytesIO

    from PIL import Image, UnidentifiedImageError

    data = read_bytes(file)
    try:
        with Image.open(BytesIO(data)) as picture:
            pixels = np.asarray(picture.convert("RGB"), dtype=np.float64) / 255.0
    except UnidentifiedImageError:
        raise PlaygroundError(
            f"{file} is no image", allowed="PNG, JPEG and other common formats"
        ) from None
    except (OSError, SyntaxError, ValueError, Image.DecompressionBombError) as error:
        raise PlaygroundError(
            f"the image {file} is damaged", got=str(error), fix="Export it again."
        ) from None
    if encoding == "srgb":
        pixels = srgb_decode(pixels)
    texels = np.ascontiguousarray(pixels[::-1].astype(np.float32))
    texels.setflags(write=False)
    return texels
