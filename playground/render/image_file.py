"""Pictures as files: PNG with the setup inside, EXR and NPY with linear floats."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError, unknown_name
from playground.files import read_bytes, write_whole
from playground.scene.setup_picture import SETUP_KEY, setup_inside, setup_text

if TYPE_CHECKING:
    from playground.render.image import Image
    from playground.scene.setup import Setup

SUFFIXES = (".png", ".exr", ".npy")


def check_suffix(path: Path) -> str:
    """The suffix of a picture file, in lower case, or an error that lists the known ones."""
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        raise unknown_name("picture format", path.suffix or str(path), SUFFIXES)
    return suffix


def save_image(image: Image, path: Path) -> None:
    """Write ``image`` as the suffix of ``path`` says."""
    suffix = check_suffix(path)
    if suffix == ".png":
        data = png_bytes(image.codes(), image.setup)
    elif suffix == ".npy":
        buffer = BytesIO()
        np.save(buffer, image.pixels)
        data = buffer.getvalue()
    else:
        data = _exr_bytes(image.pixels)
    write_whole(path, data)


def png_bytes(codes: NDArray[np.uint8], setup: Setup | None = None, title: str = "") -> bytes:
    """A PNG file of 8-bit codes (H, W, 3) that carries ``setup`` as JSON text."""
    from PIL import Image as PillowImage
    from PIL.PngImagePlugin import PngInfo

    info = PngInfo()
    if setup is not None:
        text = setup_text(setup)
        if text is not None:
            info.add_itxt(SETUP_KEY, text)
    if title:
        info.add_itxt("Title", title)
    buffer = BytesIO()
    PillowImage.fromarray(codes).save(buffer, "PNG", pnginfo=info, compress_level=1)
    return buffer.getvalue()


def read_image(path: Path) -> Image:
    """The picture in a file: PNG codes count as linear values, without undoing any curve.

    Raises
    ------
    PlaygroundError
        The file is missing, damaged, or of another kind.
    """
    from playground.render.image import Image

    suffix = check_suffix(path)
    data = read_bytes(path)
    try:
        if suffix == ".npy":
            pixels = np.load(BytesIO(data), allow_pickle=False)
        elif suffix == ".exr":
            pixels = _read_exr(path)
        else:
            pixels = _read_png(data)
    except Exception as error:  # each library has its own way to complain
        raise _damaged(path, str(error)) from None
    if pixels.ndim != 3 or pixels.shape[2] not in (3, 4) or 0 in pixels.shape:
        raise PlaygroundError(f"{path} holds no picture", got=pixels.shape, allowed="(H, W, 3)")
    pixels = np.ascontiguousarray(pixels[..., :3], dtype=np.float32)
    return Image(pixels, setup=setup_inside(data) if suffix == ".png" else None, renderer="file")


def _read_png(data: bytes) -> NDArray[np.float64]:
    from PIL import Image as PillowImage

    with PillowImage.open(BytesIO(data), formats=["PNG"]) as picture:
        return np.asarray(picture.convert("RGB"), dtype=np.float64) / 255.0


def _read_exr(path: Path) -> NDArray[np.float32]:
    import OpenEXR

    with OpenEXR.File(str(path)) as file:
        return np.asarray(file.channels()["RGB"].pixels, dtype=np.float32)


def _exr_bytes(pixels: NDArray[np.float32]) -> bytes:
    import os
    import tempfile

    import OpenEXR

    # The library writes to a path only.
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "picture.exr")
        header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
        with OpenEXR.File(header, {"RGB": np.ascontiguousarray(pixels)}) as file:
            file.write(name)
        return Path(name).read_bytes()


def _damaged(path: Path, reason: str) -> PlaygroundError:
    return PlaygroundError(
        f"the picture {path} is damaged or no picture", got=reason, fix="Make it again."
    )
