"""``playground --lesson``: a lesson in the window; without a display, its handout instead."""

from __future__ import annotations

import sys
from pathlib import Path

from playground.gui import why_no_window
from playground.lesson.library import find
from playground.lesson.script import read_lesson


def open_lesson(which: str) -> int:
    """Open the window on a lesson and stay until it is closed; returns the exit status.

    Raises
    ------
    PlaygroundError
        There is no such lesson, or it is none.
    """
    path = find(which)
    read_lesson(path)
    reason = why_no_window()
    if reason is None:
        from playground.gui.app import NoWindowError, run
        from playground.scene.library import load

        try:
            run(load("sphere"), lesson=path)
            return 0
        except NoWindowError as error:
            reason = str(error)
    print(f"playground: no window: {reason}; here is the handout:", file=sys.stderr)
    from playground.lesson.command import run_lesson

    return run_lesson(str(path), Path())
