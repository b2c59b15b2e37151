"""The setup inside a picture: a PNG carries what it shows, and can be loaded back."""

from __future__ import annotations

import json
from io import BytesIO
from pathlib import Path

from playground.errors import PlaygroundError, shown, why_unread
from playground.files import read_bytes
from playground.scene.setup import Setup
from playground.scene.table import from_table, to_table

SETUP_KEY = "playground-setup"  # the keyword of the PNG's iTXt chunk


def setup_text(setup: Setup, folder: Path | None = None) -> str | None:
    """The setup as JSON; None if a mesh made in Python keeps it from having a text form.

    Files that lie in ``folder``, where the picture will be, are named from there: it may be moved
    with them.
    """
    if any(item.arrays is not None for item in setup.scene.objects):
        return None
    return json.dumps(to_table(setup, folder))


def setup_inside(png: bytes, folder: Path | None = None) -> Setup | None:
    """The setup in the bytes of a PNG, if it carries one; a damaged PNG raises what Pillow raises.

    Relative files are looked up in ``folder``.

    Raises
    ------
    PlaygroundError
        The picture is sound, but the setup in it is not.
    """
    from PIL import Image

    with Image.open(BytesIO(png), formats=["PNG"]) as picture:
        picture.load()
        text = getattr(picture, "text", {}).get(SETUP_KEY)
    if text is None:
        return None
    try:
        return from_table(json.loads(text), "picture", folder)
    except PlaygroundError as error:
        got = error.got if isinstance(error.got, str) else shown(error.got)
        reason = f"{error.what} ({got})"
    except (ValueError, RecursionError) as error:
        reason = why_unread(error)
    raise PlaygroundError(
        "the setup inside the picture is damaged",
        got=reason,
        fix="Make the picture again, or give a .toml or a name instead.",
    )


def picture_flaw(error: Exception) -> str:
    """What Pillow complains of, in words for the owner of the file."""
    from PIL import UnidentifiedImageError

    return "another kind of file" if isinstance(error, UnidentifiedImageError) else str(error)


def read_setup_inside(path: Path) -> Setup:
    """The setup that a PNG file carries.

    Raises
    ------
    PlaygroundError
        The file is no PNG, is damaged, or carries no setup.
    """
    data = read_bytes(path)
    try:
        setup = setup_inside(data, path.parent)
    except PlaygroundError as error:
        raise PlaygroundError(f"{path}: {error.what}", got=error.got, fix=error.fix) from None
    except MemoryError:
        raise
    except Exception as error:  # Pillow has many ways to complain
        raise PlaygroundError(
            f"the picture {path} is damaged or no PNG",
            got=picture_flaw(error),
            fix="Make it again.",
        ) from None
    if setup is None:
        raise PlaygroundError(
            f"{path} carries no setup",
            fix="Only pictures that this program has saved do; give a .toml or a name instead.",
        )
    return setup
