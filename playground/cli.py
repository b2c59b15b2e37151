"""The command line: the only parser of arguments.

Exit status 0 for success, 1 for a check or comparison that failed, 2 for a mistake of
the user, told in one message without a traceback.
"""

from __future__ import annotations

import argparse
import io
import math
import os
import re
import sys
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from playground import commands
from playground.errors import PlaygroundError

if TYPE_CHECKING:
    Subparsers = argparse._SubParsersAction[argparse.ArgumentParser]

PROGRAM = "playground"
COMMANDS = ("render", "compare", "explain", "measure", "check", "bake", "lesson", "doctor")
METHODS = "raster, ray-tracing, radiosity or lightmap"
SHEETS = "a figure: terms, shininess, shading; depth, tests; bounces, answers"
TO = "radiosity: a second pixel; tells the form factors of the two patches"
TOO_LARGE = PlaygroundError(
    "the picture, or the model, is too large for this machine's memory",
    fix="Choose a smaller --size.",
)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; returns the exit status."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    if isinstance(sys.stdout, io.TextIOWrapper):  # no terminal is too poor for a ρ
        sys.stdout.reconfigure(errors="replace")
    try:
        first = words[0] if words else "--lesson"
        if first not in COMMANDS and (first[:1] != "-" or first.startswith("--lesson")):
            words = ["window", *words]
        if words[:2] == ["measure", "needs"]:  # a command of its own: it takes a setup
            words = words[1:]
        options = _parser(words).parse_args(words)
        status = int(options.run(options) or 0)
        if sys.stdout is not None:
            sys.stdout.flush()
        return status
    except PlaygroundError as error:
        return _refuse(error)
    except MemoryError:
        return _refuse(TOO_LARGE)
    except KeyboardInterrupt:
        print(f"{PROGRAM}: stopped", file=sys.stderr)
        return 130
    except BrokenPipeError:
        _drop_output()
        return 0
    except OSError as error:
        _drop_output()
        fix = "Check the space on the disk and where the output goes."
        return _refuse(PlaygroundError("cannot read or write", got=str(error), fix=fix))


def _refuse(error: PlaygroundError) -> int:
    print(f"{PROGRAM}: {error}", file=sys.stderr)
    return 2


def _drop_output() -> None:
    """Send what is still to be printed nowhere: nobody takes it, and the exit would complain."""
    with suppress(OSError, ValueError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _parser(arguments: Sequence[str] = ()) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        PROGRAM,
        usage=f"{PROGRAM} [SETUP]\n       {PROGRAM} {{{','.join(COMMANDS)}}} ... [-h]",
        description='The lecture "Lighting" as a playground. Without a command: the window.',
        epilog="SETUP is a .toml setup, a model (.obj .ply .stl .glb .gltf), a .png saved by this "
        f"program, or a name of the library: {', '.join(_library(arguments))}.",
    )
    parser.add_argument("--version", action="version", version=_version())
    subparsers = parser.add_subparsers(
        prog=PROGRAM, dest="command", required=True, metavar="COMMAND"
    )

    for add in (
        _add_window,
        _add_render,
        _add_compare,
        _add_explain,
        _add_measure,
        _add_needs,
        _add_check,
        _add_bake,
        _add_lesson,
        _add_doctor,
    ):
        add(subparsers)
    return parser


def _add_window(subparsers: Subparsers) -> None:
    window = subparsers.add_parser("window", help="the window; without a display, a picture")
    window.add_argument("setup", nargs="?", metavar="SETUP")
    window.add_argument("--lesson", metavar="N", help="opens a lesson: its number, or a path")
    _setup_options(window)
    window.set_defaults(run=commands.window)


def _add_render(subparsers: Subparsers) -> None:
    render = subparsers.add_parser("render", help="a setup as a picture")
    render.add_argument("setup", metavar="SETUP")
    render.add_argument("-o", "--output", type=Path, required=True, help=".png, .exr or .npy")
    render.add_argument("--sheet", help=SHEETS)
    render.add_argument("--method", default="raster", help=METHODS)
    render.add_argument("--depth", help="ray tracing: bounces followed, 5 unless given")
    render.add_argument("--samples", help="samples per pixel: 1 to 16")
    _picture_options(render)
    render.set_defaults(run=commands.render)


def _add_compare(subparsers: Subparsers) -> None:
    compare = subparsers.add_parser("compare", help="how two pictures differ")
    compare.add_argument("a", metavar="A", help="a picture or a setup: the reference")
    compare.add_argument("b", metavar="B", help="a picture or a setup")
    compare.add_argument("-o", "--output", type=Path, help="the difference in false colours")
    compare.add_argument("--json", action="store_true", help="one JSON document, nothing else")
    compare.add_argument("--method", default="raster", help=f"of setups: {METHODS}")
    compare.add_argument("--mistakes", action="store_true", help="how the picture was got wrong")
    compare.add_argument(
        "--tolerance", type=_tolerance, help="status 1 if the largest difference exceeds"
    )
    _picture_options(compare, "that of the picture, or 640x480")
    compare.set_defaults(run=commands.compare)


def _add_explain(subparsers: Subparsers) -> None:
    explain = subparsers.add_parser("explain", help="why a pixel has its colour")
    explain.add_argument("setup", metavar="SETUP")
    explain.add_argument("--pixel", nargs=2, type=int, required=True, metavar=("X", "Y"))
    explain.add_argument("--json", action="store_true", help="one JSON document, nothing else")
    explain.add_argument("--latex", action="store_true", help="the equation as LaTeX")
    explain.add_argument("--method", default="raster", help=METHODS)
    explain.add_argument("--to", nargs=2, type=int, metavar=("X", "Y"), help=TO)
    explain.add_argument("--depth", help="ray tracing: bounces followed, 5 unless given")
    _picture_options(explain)
    explain.set_defaults(run=commands.explain)


def _add_measure(subparsers: Subparsers) -> None:
    measure = subparsers.add_parser(
        "measure",
        help="speed against error",
        epilog="'measure needs SETUP' tells what a setup could do without; see 'measure needs -h'.",
    )
    measure.add_argument(
        "experiments",
        nargs="*",
        metavar="EXPERIMENT",
        help="all if none; an unknown one is answered with the list",
    )
    measure.add_argument("-o", "--output", type=Path, help="folder for the report")
    measure.add_argument("--rounds", type=int, help="interleaved rounds: 9, or 3 if quick")
    measure.add_argument("--quick", action="store_true", help="a first look in under a minute")
    measure.add_argument("--fresh", action="store_true", help="forget what the folder holds")
    measure.add_argument("--json", action="store_true", help="one JSON document, nothing else")
    measure.set_defaults(run=commands.measure)


def _add_needs(subparsers: Subparsers) -> None:
    needs = subparsers.add_parser(
        "needs",
        prog=f"{PROGRAM} measure needs",
        description="What each part of a setup contributes and costs, and what could be dropped.",
    )
    needs.add_argument("setup", metavar="SETUP")
    needs.add_argument(
        "--budget", type=_budget, default=0.01, help="the largest error, 0.01 unless given"
    )
    needs.add_argument("--method", default="raster", help="raster or ray-tracing")
    needs.add_argument("--metric", default="rmse", help="of the error: rmse, flip or max")
    needs.add_argument("-o", "--output", type=Path, help="the proposal: a .toml, or a folder")
    needs.add_argument("--json", action="store_true", help="one JSON document, nothing else")
    _picture_options(needs)
    needs.set_defaults(run=commands.needs)


def _add_check(subparsers: Subparsers) -> None:
    check = subparsers.add_parser("check", help="numeric cases against the formulas")
    check.add_argument("cases", type=Path, metavar="CASES", help="a .json file of cases")
    check.add_argument("--backend", default="numpy", help="numpy (float64) or gl (float32)")
    check.add_argument(
        "--system", nargs="+", action="extend", default=[], metavar="NAME", help="only these"
    )
    check.add_argument("--json", action="store_true", help="one JSON document, nothing else")
    check.set_defaults(run=commands.check)


def _add_bake(subparsers: Subparsers) -> None:
    bake = subparsers.add_parser("bake", help="radiosity into a lightmap, and a setup that uses it")
    bake.add_argument("setup", metavar="SETUP")
    bake.add_argument("-o", "--output", type=Path, required=True, help="the setup: .toml")
    bake.add_argument("--texels", type=int, default=256, help="along an edge, 256 unless given")
    bake.add_argument(
        "--rays", type=int, default=256, help="per texel, 256 unless given; 0: light as of patches"
    )
    bake.add_argument("--renderer", default="auto", help="of form factors: auto, gl or numpy")
    _setup_options(bake)
    bake.set_defaults(run=commands.bake)


def _add_lesson(subparsers: Subparsers) -> None:
    lesson = subparsers.add_parser("lesson", help="the lecture, lesson by lesson, without a window")
    lesson.add_argument("which", nargs="?", default="list", metavar="list|all|N|PATH")
    lesson.add_argument("-o", "--output", type=Path, help="folder for handouts and figures")
    lesson.add_argument("--slides", action="store_true", help="which slide is in which step")
    lesson.add_argument("--notes", action="store_true", help="the handout of the lecturer")
    lesson.add_argument("--check", type=Path, metavar="FILE", help="a student's .py or .glsl")
    lesson.set_defaults(run=commands.lesson)


def _add_doctor(subparsers: Subparsers) -> None:
    doctor = subparsers.add_parser("doctor", help="what works here, what is missing, how to get it")
    doctor.add_argument("--json", action="store_true", help="one JSON document, nothing else")
    doctor.set_defaults(run=commands.doctor)


def _picture_options(parser: argparse.ArgumentParser, usual: str = "640x480 unless given") -> None:
    parser.add_argument("--size", type=_size, metavar="WxH", help=f"in pixels; {usual}")
    parser.add_argument("--renderer", default="auto", help="auto, gl, numpy; embree for rays")
    _setup_options(parser)


def _setup_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--shading", help="flat, per-vertex or per-fragment")
    parser.add_argument("--terms", help="comma list of diffuse, specular, ambient, emissive")
    parser.add_argument("--shininess", help="exponent of the highlight, for every object")
    parser.add_argument("--precision", help="of the shading: native, float16, float32, float64")
    parser.add_argument(
        "--marks",
        action="store_const",
        const="nan,infinite,negative,denormal,clamped",
        help="false colours for NaN, infinite, negative, denormal and clamped pixels",
    )
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
    match = re.fullmatch(r"([0-9]{1,9})x([0-9]{1,9})", text.lower())
    if match is None:
        raise argparse.ArgumentTypeError(f"'{text}' is no size; write WxH, for example 640x480")
    return int(match[1]), int(match[2])


def _tolerance(text: str) -> float:
    with suppress(ValueError):
        if 0.0 <= (value := float(text)) < math.inf:
            return value
    raise argparse.ArgumentTypeError(f"'{text}' is no tolerance; write a number such as 0.01")


def _budget(text: str) -> float:
    with suppress(ValueError):
        if 0.0 < (value := float(text)) < math.inf:
            return value
    raise argparse.ArgumentTypeError(f"'{text}' is no error budget; write a number such as 0.01")


def _library(arguments: Sequence[str]) -> list[str]:
    """The names of the library, where the help will show them."""
    if not {"-h", "--help"} & set(arguments):
        return []
    from playground.scene.library import library

    return library()


def _version() -> str:
    from playground import __version__

    return f"{PROGRAM} {__version__}"
