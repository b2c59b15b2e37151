"""The setup inside a picture: a PNG carries what it shows, and can be loaded back."""

from __future__ import annotations

import json
from io import BytesIO
from pathlib import Path

from playground.errors import PlaygroundError
from playground.files import read_bytes
from playground.scene.setup import Setup
from playground.scene.table import from_table, to_table

SETUP_KEY = "playground-setup"  # the keyword of the PNG's iTXt chunk


def setup_text(setup: Setup) -> str | None:
    """The setup as JSON; None if a mesh made in Python keeps it from having a text form."""
    if any(item.arrays is not None for item in setup.scene.objects):
        return None
    return json.dumps(to_table(setup))


def setup_inside(png: bytes) -> Setup | None:
    """The setup in the bytes of a PNG, if it carries one; damage raises what Pillow raises."""
    from PIL import Image

    with Image.open(BytesIO(png), formats=["PNG"]) as picture:
        picture.load()
        text = getattr(picture, "text", {}).get(SETUP_KEY)
    if text is None:
        return None
    try:
        return from_table(json.loads(text), "picture")
    except (ValueError, TypeError) as error:
        if isinstance(error, PlaygroundError):
            raise
        raise PlaygroundError("the setup in the picture is damaged", got=str(error)) from None


def read_setup_inside(path: Path) -> Setup:
    """The setup that a PNG file carries.

    Raises
    ------
    PlaygroundError
        The file is no PNG, is damaged, or carries no setup.
    """
    data = read_bytes(path)
    try:
        setup = setup_inside(data)
    except PlaygroundError:
        raise
    except Exception as error:  # Pillow has many ways to complain
        raise PlaygroundError(
            f"the picture {path} is damaged or no PNG", got=str(error), fix="Make it again."
        ) from None
    if setup is None:
        raise PlaygroundError(
            f"{path} carries no setup",
            fix="Only pictures that this program has saved do; give a .toml or a name instead.",
        )
    return setup
