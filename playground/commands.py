"""What each command of the command line does, given its parsed options.

`playground.cli` parses; here the options meet the Python API. Every function returns the
exit status, and imports only what its command needs.
"""

from __future__ import annotations

import sys
from argparse import Namespace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from playground.errors import PlaygroundError

if TYPE_CHECKING:
    from playground.render.image import Image
    from playground.scene.setup import Setup

DEFAULT_SIZE = (640, 480)
PANEL_SIZE = (400, 300)  # of each picture of a sheet
SHEET_TOLERANCE = 1e-3  # a quarter of an 8-bit step: the sum of the terms must be this good
SHEET_SETS = {  # the options that a sheet decides itself
    "terms": ("terms", "shading"),
    "shininess": ("shininess",),
    "shading": ("shading",),
    "depth": ("shading",),
    "tests": ("shading",),
    "bounces": (),
    "answers": (),
}


def _setup(options: Namespace, name: str | None = None) -> Setup:
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


def window(options: Namespace) -> int:
    """Open the window; without a display, make a picture of the same view."""
    from playground.gui import open_window

    if options.lesson is not None:
        from playground.gui.lesson.open_lesson import open_lesson

        return open_lesson(options.lesson)
    said = (options.setup, options.light, options.shading, options.terms, options.shininess)
    again = not any((*said, options.precision, options.marks, options.set))
    return open_window(_setup(options, options.setup or "teapot"), again)


def render(options: Namespace) -> int:
    """Write a picture or a sheet; status 1 if a sheet finds its own sum wrong."""
    from playground.files import check_place
    from playground.render.checks import check_method
    from playground.render.image_file import check_suffix

    suffix = check_suffix(options.output)
    check_method(options.method)
    check_place(options.output)
    raster = options.method == "raster"
    if options.sheet is not None:
        if not raster and options.sheet in ("terms", "shininess", "shading"):
            raise PlaygroundError("this sheet is drawn by --method raster", got=options.method)
        return _sheet(options, suffix)
    setup = _setup(options)
    if raster and suffix == ".png" and not setup.settings.marks:
        renderer = _save_png(options, setup)
    else:
        image = _picture(options, setup)
        image.save(options.output)
        renderer = image.renderer
        if setup.settings.marks:
            counts = image.marks()
            _say("pixels: " + ", ".join(f"{counts[kind]} {kind}" for kind in setup.settings.marks))
        for said in (*image.warnings, image.left_out, *image.notes.values()):
            if said is not None:
                _say(str(said))
    width, height = options.size or DEFAULT_SIZE
    _say(f"{options.output}  {width}x{height}  {renderer}")
    if raster:
        _hint(options.renderer, renderer)
    return 0


def _sheet(options: Namespace, suffix: str) -> int:
    from tqdm import tqdm

    from playground.explain.sheet import make_sheet
    from playground.files import write_whole
    from playground.render.gl.context import available
    from playground.render.image_file import png_bytes

    if suffix != ".png":
        raise PlaygroundError("a sheet is saved as .png", got=str(options.output))
    setup = _setup(options)
    size, form = options.size or PANEL_SIZE, "{l_bar}{bar}"
    with tqdm(total=1.0, desc=options.sheet, leave=False, disable=None, bar_format=form) as bar:
        sheet = make_sheet(
            setup, options.sheet, size, options.renderer, lambda share: bar.update(share - bar.n)
        )
    folder = options.output.parent
    write_whole(options.output, png_bytes(sheet.codes, setup, sheet.message, folder))

    renderer = "gl" if options.renderer != "numpy" and available() else "numpy"
    height, width = sheet.codes.shape[:2]
    _say(f"{options.output}  {width}x{height}  {renderer}  {sheet.message}")
    _hint(options.renderer, renderer)
    for key in SHEET_SETS[options.sheet]:
        if getattr(options, key) is not None:
            _say(f"--{key} has no effect: the {options.sheet} sheet sets the {key} itself")
    if sheet.error is not None and sheet.error > SHEET_TOLERANCE:
        _say(f"the check failed: the sum is off by {sheet.error:.2g}, more than {SHEET_TOLERANCE}")
        return 1
    return 0


def _save_png(options: Namespace, setup: Setup) -> str:
    """Write the 8-bit picture without making one of floats first; returns the renderer's name."""
    import numpy as np

    from playground.files import write_whole
    from playground.render.image_file import png_bytes
    from playground.render.renderer import open_renderer

    with open_renderer(options.size or DEFAULT_SIZE, options.renderer) as renderer:
        codes = np.empty((renderer.size[1], renderer.size[0], 4), dtype=np.uint8)
        renderer.render(setup, out=codes)
        folder = options.output.parent
        write_whole(options.output, png_bytes(codes[..., :3], setup, folder=folder))
        if (taken := renderer.samples(setup)) != setup.settings.samples:
            asked = setup.settings.samples
            _say(
                f"this driver takes {taken} samples per pixel, not {asked}; NumPy takes any number"
            )
        return renderer.name


def _picture(options: Namespace, setup: Setup) -> Image:
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


def compare(options: Namespace) -> int:
    """Print how two pictures differ; status 1 beyond the tolerance."""
    from playground.measure.compare import compare
    from playground.render.image_file import check_suffix

    if options.output is not None:
        check_suffix(options.output)
    names = (options.a, options.b)
    images = [_picture_or_setup(options, name) for name in names]
    result = compare(*images)
    drawn = [image.renderer for image in images if image.renderer != "file"]
    for name, image in zip(names, images, strict=True):
        if image.renderer != "file":
            _say(f"{name}  {image.size[0]}x{image.size[1]}  {image.renderer}")
    if drawn:
        _hint(options.renderer, drawn[0])
    if options.output is not None:
        result.heatmap().save(options.output)
    print(result.to_json() if options.json else result)
    return int(options.tolerance is not None and result.max > options.tolerance)


def _picture_or_setup(options: Namespace, name: str) -> Image:
    from playground.render.image_file import SUFFIXES, read_image

    if Path(name).suffix.lower() in SUFFIXES:
        return read_image(Path(name))
    return _picture(options, _setup(options, name))


def explain(options: Namespace) -> int:
    """Print why a pixel has its colour."""
    from playground.explain.method import explain

    size, to = options.size or DEFAULT_SIZE, options.to and tuple(options.to)
    why = explain(_setup(options), tuple(options.pixel), size, options.method, to)
    if options.json:
        _print_json(why.to_dict())
    else:
        print(why.latex() if options.latex else why.text())
    return 0


def measure(options: Namespace) -> int:
    """Run experiments, print their tables, write the report; status 130 if stopped."""
    from playground.measure.session import run_experiments

    return run_experiments(
        options.experiments,
        options.output,
        options.rounds,
        options.json,
        options.quick,
        options.fresh,
    )


def needs(options: Namespace) -> int:
    """Print what each part of a setup contributes and costs, and what to drop."""
    from playground.measure.needs_command import run_needs

    return run_needs(
        _setup(options),
        options.output,
        options.json,
        budget=options.budget,
        metric=options.metric,
        size=options.size or DEFAULT_SIZE,
        renderer=options.renderer,
        method=options.method,
    )


def check(options: Namespace) -> int:
    """Check numeric cases against the formulas; status 1 if one fails."""
    from playground.measure.check import run_check

    return run_check(options.cases, options.backend, options.system, options.json)


def bake(options: Namespace) -> int:
    """Write a setup with a lightmap beside it."""
    from playground.render.lightmap.command import run_bake

    return run_bake(_setup(options), options.output, options.texels, options.rays, options.renderer)


def lesson(options: Namespace) -> int:
    """List or run lessons, or check a student's file; status 1 if that is not right."""
    from playground.lesson.command import run_lesson

    return run_lesson(options.which, options.output, options.slides, options.notes, options.check)


def doctor(options: Namespace) -> int:
    """Print what works on this machine."""
    from playground.doctor import examine, report

    findings = examine()
    if options.json:
        _print_json(findings)
    else:
        print(report(findings))
    return 0


def _print_json(value: Any) -> None:
    import json

    print(json.dumps(value))


def _say(text: str) -> None:
    print(text, file=sys.stderr)


def _hint(asked: str, took: str) -> None:
    """Where NumPy stepped in for a missing driver, say how to get one."""
    if asked == "auto" and took == "numpy":
        from playground.render.gl.context import INSTALL_DRIVER

        _say(f"no GL driver was found, so NumPy drew it; for speed: {INSTALL_DRIVER}")
