"""Pictures as files: PNG with the setup inside, EXR and NPY with linear floats."""

from __future__ import annotations

from contextlib import suppress
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from playground.errors import PlaygroundError, unknown_name
from playground.files import read_bytes, write_whole
from playground.render.shown import light_shown
from playground.scene.setup_picture import SETUP_KEY, picture_flaw, setup_inside, setup_text

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
        data = png_bytes(image.codes(), image.setup, folder=path.parent)
    elif suffix == ".npy":
        buffer = BytesIO()
        np.save(buffer, image.pixels)
        data = buffer.getvalue()
    else:
        data = _exr_bytes(image.pixels)
    write_whole(path, data)


def png_bytes(
    codes: NDArray[np.uint8],
    setup: Setup | None = None,
    title: str = "",
    folder: Path | None = None,
) -> bytes:
    """A PNG file of 8-bit codes (H, W, 3) that carries ``setup`` as JSON text.

    The setup names files in ``folder``, where the picture is to be saved, from there.
    """
    from PIL import Image as PillowImage
    from PIL.PngImagePlugin import PngInfo

    info = PngInfo()
    if setup is not None:
        text = setup_text(setup, folder)
        if text is not None:
            info.add_itxt(SETUP_KEY, text)
    if title:
        info.add_itxt("Title", title)
    buffer = BytesIO()
    PillowImage.fromarray(codes).save(buffer, "PNG", pnginfo=info, compress_level=1)
    return buffer.getvalue()


def read_image(path: Path, like: Setup | None = None) -> Image:
    """The picture in a file, as linear light.

    Exposure and curve of a PNG are undone, as far as they are known: from the setup inside it,
    else from ``like``, the setup of a picture that it is compared with. Without either its codes
    count as linear values. A setup inside that cannot be understood does not count: the pixels
    are sound.

    Raises
    ------
    PlaygroundError
        The file is missing, damaged, of another kind, or holds no real finite numbers.
    """
    from playground.render.image import Image

    suffix = check_suffix(path)
    data = read_bytes(path)
    try:
        if suffix == ".npy":
            pixels = _read_npy(data)
        elif suffix == ".exr":
            pixels = _read_exr(path)
        else:
            pixels = _read_png(data)
    except MemoryError:
        raise
    except Exception as error:  # each library has its own way to complain
        raise PlaygroundError(
            f"the picture {path} is damaged or no picture",
            got=picture_flaw(error) if suffix == ".png" else str(error),
            fix="Make it again.",
        ) from None
    setup = None
    if suffix == ".png":
        with suppress(PlaygroundError):
            setup = setup_inside(data, path.parent)
    setup = setup or like
    if suffix == ".png" and setup is not None:
        pixels = light_shown(pixels, setup.settings)
    return Image(_as_pixels(pixels, path), setup=setup, renderer="file")


def _as_pixels(values: NDArray[Any], path: Path) -> NDArray[np.float32]:
    """The values of a file as pixels, float32 (H, W, 3)."""
    if values.ndim != 3 or values.shape[2] not in (3, 4) or 0 in values.shape:
        raise PlaygroundError(f"{path} holds no picture", got=values.shape, allowed="(H, W, 3)")
    if values.dtype.kind not in "iuf":
        raise PlaygroundError(
            f"{path} holds no picture", got=f"values of type {values.dtype}", allowed="real numbers"
        )
    with np.errstate(over="ignore"):
        pixels = np.ascontiguousarray(values[..., :3], dtype=np.float32)
    if not np.isfinite(pixels).all():
        row, column, _ = np.argwhere(~np.isfinite(pixels))[0]
        raise PlaygroundError(
            f"{path}: the pixel ({column}, {row}) is not finite",
            got=str(values[row, column, :3].tolist()),
            allowed="numbers from -3.4e38 to 3.4e38",
        )
    return pixels


def _read_npy(data: bytes) -> NDArray[Any]:
    values = np.load(BytesIO(data), allow_pickle=False)
    if not isinstance(values, np.ndarray):
        raise ValueError("an archive of arrays")
    return values


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
