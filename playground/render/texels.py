"""An image file as texels: what m_d is at every point of a surface."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from playground import locate
from playground.errors import PlaygroundError
from playground.files import read_bytes
from playground.shading.display import srgb_decode


@lru_cache(maxsize=16)
def load_texture(path: str, encoding: str = "linear") -> NDArray[np.float32]:
    """The texels of an image file, linear RGB in [0, 1], float32 (H, W, 3), row 0 at v = 0.

    A name without a folder that is no file is looked up among the project's textures.
    ``encoding`` says whether the stored numbers carry the sRGB curve.

    Raises
    ------
    PlaygroundError
        The file is missing, damaged, or no image.
    """
    from io import BytesIO

    from PIL import Image, UnidentifiedImageError

    file = Path(path)
    if not file.exists() and locate.asset(f"textures/{file.name}").is_file():
        file = locate.asset(f"textures/{file.name}")
    try:
        with Image.open(BytesIO(read_bytes(file))) as picture:
            pixels = np.asarray(picture.convert("RGB"), dtype=np.float64) / 255.0
    except UnidentifiedImageError:
        raise PlaygroundError(
            f"{file} is no image", allowed="PNG, JPEG and other common formats"
        ) from None
    except (OSError, SyntaxError, ValueError, Image.DecompressionBombError) as error:
        if isinstance(error, PlaygroundError):
            raise
        raise PlaygroundError(
            f"the image {file} is damaged", got=str(error), fix="Export it again."
        ) from None
    if encoding == "srgb":
        pixels = srgb_decode(pixels)
    texels = np.ascontiguousarray(pixels[::-1].astype(np.float32))
    texels.setflags(write=False)
    return texels
