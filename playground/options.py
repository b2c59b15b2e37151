"""What the options of a command describe, and how a command speaks.

`playground.commands` says what each command does with it.
"""

from __future__ import annotations

import sys
from argparse import Namespace
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from playground.render.image import Image
    from playground.scene.setup import Setup

DEFAULT_SIZE = (640, 480)


def setup_of(options: Namespace, name: str | None = None) -> Setup:
    """The setup that the options describe."""
    from playground.scene.assign import assign, parse_light
    from playground.scene.library import load

    setup = load(options.setup if name is None else name)
    if options.light:
        setup = setup.with_(lights=tuple(parse_light(text) for text in options.light))
    for key in ("shading", "terms", "shininess", "precision", "marks", "depth", "samples"):
        if getattr(options, key, None) is not None:
            setup = assign(setup, f"{key}={getattr(options, key)}")
    for assignment in options.set:
        setup = assign(setup, assignment)
    return setup


def picture_of(options: Namespace, setup: Setup) -> Image:
    """The picture of ``setup`` that the options ask for."""
    from playground.render.renderer import STORED, render

    size, method = options.size or DEFAULT_SIZE, getattr(options, "method", "raster")
    if method in STORED:
        return _stored_picture(setup, size, options.renderer, method)
    return render(setup, size, options.renderer, method)


def _stored_picture(setup: Setup, size: tuple[int, int], renderer: str, method: str) -> Image:
    """A picture of light computed before; on a terminal a bar shows how far that has come."""
    from tqdm import tqdm

    from playground.render.image import Image
    from playground.render.renderer import open_renderer
    from playground.render.stored_renderer import StoredDrawing

    with open_renderer(size, renderer, method=method) as opened:
        assert isinstance(opened, StoredDrawing)
        bar = tqdm(total=1.0, desc=method, leave=False, disable=None, bar_format="{l_bar}{bar}")
        with bar:
            for share in opened.prepare(setup):
                bar.update(share - bar.n)
        image = opened.render(setup)
    assert isinstance(image, Image)
    return image


def print_json(value: Any) -> None:
    """One JSON document, on one line."""
    import json

    print(json.dumps(value))


def say(text: str) -> None:
    """What is not the result, on the error stream."""
    print(text, file=sys.stderr)


def hint(asked: str, took: str) -> None:
    """Where NumPy stepped in for a missing driver, say how to get one."""
    if asked == "auto" and took == "numpy":
        from playground.render.gl.context import INSTALL_DRIVER

        say(f"no GL driver was found, so NumPy drew it; for speed: {INSTALL_DRIVER}")
