"""What each command of the command line does, given its parsed options.

`playground.cli` parses; here the options meet the Python API. Every function returns the
exit status, and imports only what its command needs.
"""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path
from typing import TYPE_CHECKING

from playground.errors import PlaygroundError
from playground.options import DEFAULT_SIZE, hint, picture_of, print_json, say, setup_of

if TYPE_CHECKING:
    from playground.measure.mistakes import Likely
    from playground.render.image import Image
    from playground.scene.setup import Setup

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


def window(options: Namespace) -> int:
    """Open the window; without a display, make a picture of the same view."""
    from playground.gui import open_window

    if options.lesson is not None:
        from playground.gui.lesson.open_lesson import open_lesson

        return open_lesson(options.lesson)
    said = (options.setup, options.light, options.shading, options.terms, options.shininess)
    again = not any((*said, options.precision, options.marks, options.set))
    return open_window(setup_of(options, options.setup or "teapot"), again)


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
    setup = setup_of(options)
    if raster and suffix == ".png" and not setup.settings.marks:
        renderer = _save_png(options, setup)
    else:
        image = picture_of(options, setup)
        image.save(options.output)
        renderer = image.renderer
        if setup.settings.marks:
            counts = image.marks()
            say("pixels: " + ", ".join(f"{counts[kind]} {kind}" for kind in setup.settings.marks))
        for said in (*image.warnings, image.left_out, *image.notes.values()):
            if said is not None:
                say(str(said))
    width, height = options.size or DEFAULT_SIZE
    say(f"{options.output}  {width}x{height}  {renderer}")
    if raster:
        hint(options.renderer, renderer)
    return 0


def _sheet(options: Namespace, suffix: str) -> int:
    from tqdm import tqdm

    from playground.explain.sheet import make_sheet
    from playground.files import write_whole
    from playground.render.gl.context import available
    from playground.render.image_file import png_bytes

    if suffix != ".png":
        raise PlaygroundError("a sheet is saved as .png", got=str(options.output))
    setup = setup_of(options)
    size, form = options.size or PANEL_SIZE, "{l_bar}{bar}"
    with tqdm(total=1.0, desc=options.sheet, leave=False, disable=None, bar_format=form) as bar:
        sheet = make_sheet(
            setup, options.sheet, size, options.renderer, lambda share: bar.update(share - bar.n)
        )
    folder = options.output.parent
    write_whole(options.output, png_bytes(sheet.codes, setup, sheet.message, folder))

    renderer = "gl" if options.renderer != "numpy" and available() else "numpy"
    height, width = sheet.codes.shape[:2]
    say(f"{options.output}  {width}x{height}  {renderer}  {sheet.message}")
    hint(options.renderer, renderer)
    for key in SHEET_SETS[options.sheet]:
        if getattr(options, key) is not None:
            say(f"--{key} has no effect: the {options.sheet} sheet sets the {key} itself")
    if sheet.error is not None and sheet.error > SHEET_TOLERANCE:
        say(f"the check failed: the sum is off by {sheet.error:.2g}, more than {SHEET_TOLERANCE}")
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
            say(f"this driver takes {taken} samples per pixel, not {asked}; NumPy takes any number")
        return renderer.name


def compare(options: Namespace) -> int:
    """Print how two pictures differ; status 1 beyond the tolerance."""
    from playground.measure.compare import compare
    from playground.render.image_file import check_suffix

    if options.output is not None:
        check_suffix(options.output)
    names = (options.a, options.b)
    if options.mistakes:
        _check_one_file(options, names)
    images = _pictures(options, names)
    result = compare(*images)
    likely = _likely_mistakes(options, images) if options.mistakes else None
    drawn = [image.renderer for image in images if image.renderer != "file"]
    for name, image in zip(names, images, strict=True):
        if image.renderer != "file":
            say(f"{name}  {image.size[0]}x{image.size[1]}  {image.renderer}")
    if drawn:
        hint(options.renderer, drawn[0])
    if options.output is not None:
        result.heatmap().save(options.output)
    if options.json:
        told = {} if likely is None else {"mistakes": likely.to_dict()}
        print_json({**result.to_dict(), **told})
    else:
        print(result if likely is None else f"{result}\n{likely}")
    return int(options.tolerance is not None and result.max > options.tolerance)


def _pictures(options: Namespace, names: tuple[str, str]) -> list[Image]:
    """Files and setups as pictures: a setup is drawn as large as the file it is compared with."""
    from playground.render.image_file import SUFFIXES, read_image

    files = [Path(name).suffix.lower() in SUFFIXES for name in names]
    setups = [None if f else setup_of(options, n) for f, n in zip(files, names, strict=True)]
    like = setups[0] or setups[1]
    images = {n: read_image(Path(n), like) for f, n in zip(files, names, strict=True) if f}
    for image in images.values():
        options.size = options.size or image.size
    like = next((image.setup for image in images.values() if image.setup), None)
    for name, image in images.items():
        if image.setup is None:  # the other file may know how its codes came about
            images[name] = read_image(Path(name), like)
    return [
        images[name] if setup is None else picture_of(options, setup)
        for name, setup in zip(names, setups, strict=True)
    ]


def _check_one_file(options: Namespace, names: tuple[str, str]) -> None:
    """Refuse what has no mistakes to look for, before anything is drawn."""
    from playground.render.image_file import SUFFIXES

    files = sum(Path(name).suffix.lower() in SUFFIXES for name in names)
    if files != 1 or options.method != "raster":
        raise PlaygroundError(
            "--mistakes compares one picture with one setup, drawn by the rasteriser",
            got=f"{options.a} and {options.b}, --method {options.method}",
            fix="playground compare SETUP mine.png --mistakes",
        )


def _likely_mistakes(options: Namespace, images: list[Image]) -> Likely:
    from tqdm import tqdm

    from playground.measure.mistakes import likely_mistakes

    drawn, file = sorted(images, key=lambda image: image.renderer == "file")
    assert drawn.setup is not None
    form = "{l_bar}{bar}"
    with tqdm(total=1.0, desc="mistakes", leave=False, disable=None, bar_format=form) as bar:
        return likely_mistakes(
            file, drawn.setup, options.renderer, lambda share: bar.update(share - bar.n)
        )


def explain(options: Namespace) -> int:
    """Print why a pixel has its colour."""
    from playground.explain.method import explain

    size, to = options.size or DEFAULT_SIZE, options.to and tuple(options.to)
    why = explain(setup_of(options), tuple(options.pixel), size, options.method, to)
    if options.json:
        print_json(why.to_dict())
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
        setup_of(options),
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

    return run_bake(
        setup_of(options), options.output, options.texels, options.rays, options.renderer
    )


def lesson(options: Namespace) -> int:
    """List or run lessons, or check a student's file; status 1 if that is not right."""
    from playground.lesson.command import run_lesson

    return run_lesson(options.which, options.output, options.slides, options.notes, options.check)


def doctor(options: Namespace) -> int:
    """Print what works on this machine."""
    from playground.doctor import examine, report

    findings = examine()
    if options.json:
        print_json(findings)
    else:
        print(report(findings))
    return 0
