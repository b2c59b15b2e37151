"""A mistake in a lesson: always with the file and the line."""

from __future__ import annotations

from pathlib import Path

from playground.errors import PlaygroundError


class LessonError(PlaygroundError):
    """What is wrong with a lesson; the message begins with ``file:line``."""

    def __init__(self, path: Path, line: int, what: str, **more: str) -> None:
        self.path, self.line = path, line
        super().__init__(f"{path}:{line}: {what}", **more)
