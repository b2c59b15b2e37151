"""The words of a lesson: show, figure, plot, number, predict, goal, listing.

In a plain script or a notebook they check and print; when the program runs the lesson, a
`Recorder` keeps what they say for the window, the handout and the tests.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING

from playground.errors import PlaygroundError
from playground.lesson.parts import Figure, Goal, Question, Text, View
from playground.lesson.prose import Block, Span, filled, parse

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from playground.lesson.record import Recorder
    from playground.render.image import Image
    from playground.scene.setup import Setup

SIZE = (480, 360)  # of the picture that the handout has of what the window shows
Check = Callable[..., object]
_recorder: ContextVar[Recorder | None] = ContextVar("recorder", default=None)
_plain: dict[str, float] = {}  # the numbers of a script that runs by itself


@contextmanager
def recording(recorder: Recorder) -> Iterator[None]:
    """Let ``recorder`` keep what is said meanwhile."""
    token = _recorder.set(recorder)
    try:
        yield
    finally:
        _recorder.reset(token)


def show(
    setup: Setup,
    caption: str = "",
    *,
    shows: Check | None = None,
    method: str = "raster",
    beside: str = "",
    layout: str = "",
    pixel: tuple[float, float] | None = None,
    panel: str = "",
) -> Shown:
    """Put a setup into the window, for the student to change; the handout has its picture.

    Parameters
    ----------
    setup : Setup
    caption : str, optional
        Of the picture in the handout; without one there is none.
    shows : function of the Image
        Whether the picture shows what the caption says; needed with a caption.
    method : {"raster", "ray-tracing", "radiosity", "lightmap"}
    beside : str, optional
        What the window shows to compare: a shading, ``"reference"`` or a method.
    layout : str, optional
        Of the window: ``"side by side"`` (default with ``beside``), ``"wipe"``, ``"terms"``, ...
    pixel : (float, float), optional
        What the window explains with its arrows, as shares of the width and height of the
        picture in the handout. A window of another shape explains the same point.
    panel : str, optional
        The panel that the window unfolds; ``"Shaders"`` is the one below the picture.

    Raises
    ------
    PlaygroundError
        The picture does not show what its caption says.
    """
    if bool(caption) != (shows is not None):
        raise PlaygroundError("a caption needs shows=, and shows= a caption", got=caption)
    view = View(setup, method, beside, layout, pixel, panel, _parsed(caption))
    recorder = _recorder.get()
    if recorder is not None:
        recorder.view(view, shows)
    elif caption:
        _print(f"scene: {caption}")
    return Shown(view)


class Shown:
    """What `show` returns: a notebook displays its picture."""

    def __init__(self, view: View) -> None:
        self.view = view

    def picture(self) -> Image:
        """The picture of the setup."""
        from playground.render.renderer import render

        return render(self.view.setup, SIZE, method=self.view.method)

    def _repr_png_(self) -> bytes:
        return self.picture()._repr_png_()


def figure(
    pictures: Image | Sequence[Image], caption: str, *, shows: Check, names: Sequence[str] = ()
) -> Figure:
    """A picture, or several of one size side by side with a name under each.

    ``shows`` is called with all pictures and says whether they show what the caption says; it
    must not be content with empty ones.

    Raises
    ------
    PlaygroundError
        They do not, or the names do not fit.
    """
    from playground.lesson.figures import assert_shows, side_by_side

    every = [pictures] if not isinstance(pictures, Sequence) else list(pictures)
    assert_shows(every, caption, shows)
    return _keep(Figure(_parsed(caption), side_by_side(every, names)), caption)


def plot(
    caption: str,
    *,
    x: tuple[str, ArrayLike],
    y: str,
    curves: Mapping[str, ArrayLike],
    shows: Check,
    log: str = "",
) -> Figure:
    """Curves over a common ``x``, which comes with its label; ``y`` is the label upwards.

    ``shows`` is called with the curves, in order. ``log`` names the axes that are logarithmic:
    ``"x"``, ``"y"`` or ``"xy"``.

    Raises
    ------
    PlaygroundError
        The curves do not show what the caption says, have another length than x, or numbers that
        have no logarithm.
    """
    from playground.lesson.plots import plotted

    codes, svg = plotted(caption, x, y, curves, shows, log)
    return _keep(Figure(_parsed(caption), codes, svg), caption)


def number(name: str, value: float, expected: float, tolerance: float = 0.0) -> float:
    """A number that the prose may name, ``{name:.1f}``; it must be as expected.

    Raises
    ------
    PlaygroundError
        It is off by more than ``tolerance``, or the name is taken.
    """
    value = float(value)
    if not abs(value - expected) <= tolerance:
        raise PlaygroundError(
            f"{name} is not as expected",
            got=f"{value:.9g}",
            allowed=f"{expected:.9g} ± {tolerance:g}",
        )
    recorder = _recorder.get()
    if recorder is not None:
        recorder.number(name, value)
    else:
        _plain[name] = value
        print(f"{name} = {value:.6g}")
    return value


def predict(question: str, *choices: str, answer: str, why: str = "") -> None:
    """Ask the student before the reveal; what comes after waits in the window for the answer.

    Raises
    ------
    PlaygroundError
        Fewer than two choices, or the answer is none of them.
    """
    if len(choices) < 2 or answer not in choices:
        raise PlaygroundError("the answer must be one of two or more choices", got=answer)
    right = choices.index(answer)
    asked = Question(_parsed(question), tuple(map(_parsed, choices)), right, _parsed(why))
    recorder = _recorder.get()
    if recorder is not None:
        recorder.say(asked)
    else:
        _print("\n".join([f"Predict: {question}", *(f"  - {choice}" for choice in choices)]))


def goal(text: str, *, reached: Callable[[Setup], object], solution: Setup, hint: str = "") -> None:
    """Something to reach in the window, from what was shown last.

    Parameters
    ----------
    reached : function of the Setup
        Whether it is; not so at the beginning, and so with the solution.
    solution : Setup
        One way to reach it.

    Raises
    ------
    PlaygroundError
        It is reached from the start, or not by the solution, or nothing is shown.
    """
    recorder = _recorder.get()
    if recorder is not None:
        recorder.goal(Goal(_parsed(text), _parsed(hint), solution), reached)
    else:
        _print(f"Goal: {text}")


def listing(file: str, *, first: str = "", last: str = "", plain: bool = False) -> str:
    """Show lines of a shader file as they stand in it, and return them.

    Parameters
    ----------
    file : str
        Within ``shaders``, for example ``"gouraud.vert"``.
    first, last : str, optional
        How the first and the last line begin; by default those of the file. Comment lines at
        the head of the file are left out.
    plain : bool, optional
        Leave out what ``#if`` keeps for a feature, such as textures: the lines of a plain surface.

    Raises
    ------
    PlaygroundError
        There is no such file, or no such line in it.
    """
    from playground.lesson.shader_lines import shader_lines

    text = shader_lines(file, first, last, plain)
    name = Block("paragraph", (Span("code", f"shaders/{file}"), Span("text", ":")))
    recorder = _recorder.get()
    if recorder is not None:
        recorder.say(Text((name, Block("code", (Span("code", text),)))))
    else:
        print(f"shaders/{file}:\n{text}")
    return text


def _keep(made: Figure, caption: str) -> Figure:
    recorder = _recorder.get()
    if recorder is not None:
        recorder.say(made)
    else:
        _print(f"figure: {caption}")
    return made


def _parsed(text: str) -> tuple[Block, ...]:
    return parse(text)


def _print(text: str) -> None:
    """Say it with the numbers known so far."""
    for block in parse(text.replace("\n", "\n\n")):
        print(("- " if block.kind == "item" else "") + filled(block, _plain).text)
