"""The command line: the only parser of arguments.

Exit status 0 for success, 1 for a check or comparison that failed, 2 for a mistake of
the user, told in one message without a traceback.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from playground.errors import PlaygroundError

if TYPE_CHECKING:
    from playground.render.image import Image
    from playground.scene.setup import Setup

    Commands = argparse._SubParsersAction[argparse.ArgumentParser]

PROGRAM = "playground"
DEFAULT_SIZE = (640, 480)
COMMANDS = ("render", "compare", "explain", "measure", "doctor")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; returns the exit status."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    try:
        if not words or (words[0] not in COMMANDS and not words[0].startswith("-")):
            words = ["window", *words]
        options = _parser(words).parse_args(words)
        return int(options.run(options) or 0)
    except PlaygroundError as error:
        print(f"{PROGRAM}: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print(f"{PROGRAM}: stopped", file=sys.stderr)
        return 130
    except BrokenPipeError:
        return 0


def _parser(arguments: Sequence[str] = ()) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        PROGRAM,
        usage=f"{PROGRAM} [SETUP]\n       {PROGRAM} {{{','.join(COMMANDS)}}} ... [-h]",
        description='The lecture "Lighting" as a playground. Without a command: the window.',
        epilog="SETUP is a .toml setup, a model (.obj .ply .stl .glb .gltf), a .png saved by this "
        f"program, or a name of the library: {', '.join(_library(arguments))}.",
    )
    parser.add_argument("--version", action="version", version=_version())
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")

    for add in (_add_window, _add_render, _add_compare, _add_explain, _add_measure, _add_doctor):
        add(commands)
    return parser


def _add_window(commands: Commands) -> None:
    window = commands.add_parser("window", help="the window; without a display, a picture")
    window.add_argument("setup", nargs="?", default="teapot", metavar="SETUP")
    _setup_options(window)
    window.set_defaults(run=_window)


def _add_render(commands: Commands) -> None:
    render = commands.add_parser("render", help="a setup as a picture")
    render.add_argument("setup", metavar="SETUP")
    render.add_argument("-o", "--output", type=Path, required=True, help=".png, .exr or .npy")
    render.add_argument("--sheet", help="a figure of the lecture: terms, shininess or shading")
    render.add_argument("--method", default="raster", help="raster")
    _picture_options(render)
    render.set_defaults(run=_render)


def _add_compare(commands: Commands) -> None:
    compare = commands.add_parser("compare", help="how two pictures differ")
    compare.add_argument("a", metavar="A", help="a picture or a setup: the reference")
    compare.add_argument("b", metavar="B", help="a picture or a setup")
    compare.add_argument("-o", "--output", type=Path, help="the difference in false colours")
    compare.add_argument("--json", action="store_true", help="one JSON document, nothing else")
    compare.add_argument(
        "--tolerance", type=float, help="status 1 if the largest difference exceeds"
    )
    _picture_options(compare)
    compare.set_defaults(run=_compare)


def _add_explain(commands: Commands) -> None:
    explain = commands.add_parser("explain", help="why a pixel has its colour")
    explain.add_argument("setup", metavar="SETUP")
    explain.add_argument("--pixel", nargs=2, type=int, required=True, metavar=("X", "Y"))
    explain.add_argument("--json", action="store_true", help="one JSON document, nothing else")
    explain.add_argument("--latex", action="store_true", help="the equation as LaTeX")
    _picture_options(explain)
    explain.set_defaults(run=_explain)


def _add_measure(commands: Commands) -> None:
    measure = commands.add_parser("measure", help="speed against error")
    measure.add_argument(
        "experiments", nargs="*", metavar="EXPERIMENT", help="frames, first-image (all if none)"
    )
    measure.add_argument("-o", "--output", type=Path, help="folder for the tables")
    measure.add_argument("--rounds", type=int, default=9, help="interleaved rounds")
    measure.add_argument("--json", action="store_true", help="one JSON document, nothing else")
    measure.set_defaults(run=_measure)


def _add_doctor(commands: Commands) -> None:
    doctor = commands.add_parser("doctor", help="what works here, what is missing, how to get it")
    doctor.add_argument("--json", action="store_true", help="one JSON document, nothing else")
    doctor.set_defaults(run=_doctor)


def _picture_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--size", type=_size, metavar="WxH", help="in pixels, 640x480 unless given")
    parser.add_argument("--renderer", default="auto", help="auto, gl or numpy")
    _setup_options(parser)


def _setup_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--shading", help="flat, per-vertex or per-fragment")
    parser.add_argument("--terms", help="comma list of diffuse, specular, ambient, emissive")
    parser.add_argument("--shininess", help="exponent of the highlight, for every object")
    parser.add_argument(
        "--light",
        action="append",
        metavar="'TYPE KEY=VALUE ...'",
        help="replaces the setup's lights; may be repeated",
    )
    parser.add_argument(
        "--set",
        action="append",
        metavar="KEY=VALUE",
        default=[],
        help="any knob: shininess=20, gate=on, light.0.diffuse=1,0,0",
    )


def _size(text: str) -> tuple[int, int]:
    width, cross, height = text.lower().partition("x")
    if not (cross and width.isdigit() and height.isdigit()):
        raise argparse.ArgumentTypeError(f"'{text}' is no size; write WxH, for example 640x480")
    return int(width), int(height)


def _setup(options: argparse.Namespace, name: str | None = None) -> Setup:
    """The setup that the options describe."""
    from playground.scene.assign import assign, parse_light
    from playground.scene.library import load

    setup = load(options.setup if name is None else name)
    if options.light:
        setup = setup.with_(lights=tuple(parse_light(text) for text in options.light))
    for key in ("shading", "terms", "shininess"):
        if getattr(options, key) is not None:
            setup = assign(setup, f"{key}={getattr(options, key)}")
    for assignment in options.set:
        setup = assign(setup, assignment)
    return setup


def _window(options: argparse.Namespace) -> int:
    from playground.gui import open_window

    return open_window(_setup(options))


def _render(options: argparse.Namespace) -> int:
    from playground.files import write_whole
    from playground.render.image_file import check_suffix, png_bytes

    suffix = check_suffix(options.output)
    if options.sheet is None:
        if suffix == ".png":
            renderer = _save_png(options, _setup(options))
        else:
            image = _picture(options, _setup(options))
            image.save(options.output)
            renderer = image.renderer
        width, height = options.size or DEFAULT_SIZE
        _say(f"{options.output}  {width}x{height}  {renderer}")
        _hint(options.renderer, renderer)
        return 0
    from playground.explain.sheet import make_sheet

    if options.output.suffix.lower() != ".png":
        raise PlaygroundError("a sheet is saved as .png", got=str(options.output))
    setup = _setup(options)
    sheet = make_sheet(setup, options.sheet, options.size or (400, 300), options.renderer)
    write_whole(options.output, png_bytes(sheet.codes, setup, sheet.message))
    _say(f"{options.output}  {sheet.message}")
    return 0


def _save_png(options: argparse.Namespace, setup: Setup) -> str:
    """Write the 8-bit picture without making one of floats first; returns the renderer's name."""
    import numpy as np

    from playground.files import write_whole
    from playground.render.image_file import png_bytes
    from playground.render.renderer import check_method, open_renderer

    check_method(options.method)
    with open_renderer(options.size or DEFAULT_SIZE, options.renderer) as renderer:
        codes = np.empty((renderer.size[1], renderer.size[0], 4), dtype=np.uint8)
        renderer.render(setup, out=codes)
        write_whole(options.output, png_bytes(codes[..., :3], setup))
        return renderer.name


def _picture(options: argparse.Namespace, setup: Setup) -> Image:
    from playground.render.renderer import render

    method = getattr(options, "method", "raster")
    return render(setup, options.size or DEFAULT_SIZE, options.renderer, method)


def _compare(options: argparse.Namespace) -> int:
    from playground.measure.compare import compare

    result = compare(_picture_or_setup(options, options.a), _picture_or_setup(options, options.b))
    if options.output is not None:
        result.heatmap().save(options.output)
    print(result.to_json() if options.json else result)
    return int(options.tolerance is not None and result.max > options.tolerance)


def _picture_or_setup(options: argparse.Namespace, name: str) -> Image:
    from playground.render.image_file import SUFFIXES, read_image

    if Path(name).suffix.lower() in SUFFIXES:
        return read_image(Path(name))
    return _picture(options, _setup(options, name))


def _explain(options: argparse.Namespace) -> int:
    from playground.explain.pixel import explain

    why = explain(_setup(options), tuple(options.pixel), options.size or DEFAULT_SIZE)
    if options.json:
        _print_json(why.to_dict())
    else:
        print(why.latex() if options.latex else why.text())
    return 0


def _measure(options: argparse.Namespace) -> int:
    from playground.measure.experiments import run_experiments

    return run_experiments(options.experiments, options.output, options.rounds, options.json)


def _doctor(options: argparse.Namespace) -> int:
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


def _library(arguments: Sequence[str]) -> list[str]:
    """The names of the library, where the help will show them."""
    if not {"-h", "--help"} & set(arguments):
        return []
    from playground.scene.library import library

    return library()


def _say(text: str) -> None:
    print(text, file=sys.stderr)


def _hint(asked: str, took: str) -> None:
    """Where NumPy stepped in for a missing driver, say how to get one."""
    if asked == "auto" and took == "numpy":
        from playground.render.gl.context import INSTALL_DRIVER

        _say(f"no GL driver was found, so NumPy drew it; for speed: {INSTALL_DRIVER}")


def _version() -> str:
    from playground import __version__

    return f"{PROGRAM} {__version__}"
