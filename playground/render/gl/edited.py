"""Shader files with other texts in their place: the last ones that compiled keep running."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from playground.render.gl.program import Program, ShaderError, sources_for

if TYPE_CHECKING:
    import moderngl

    from playground.render.needs import Needs


class Edited:
    """The texts that someone types in place of shader files, and the last good ones.

    ``error`` says, with file and line, why ``texts`` are not what runs; it is empty while
    they do.
    """

    def __init__(self) -> None:
        self.texts: Mapping[str, str] = {}
        self.error = ""
        self._good: Mapping[str, str] = {}
        self._refused = False

    def change(self, texts: Mapping[str, str]) -> bool:
        """Take other texts; false if they are the same, so that programs can stay."""
        if texts == self.texts:
            return False
        if not self.error:
            self._good = self.texts
        self.texts, self.error, self._refused = dict(texts), "", False
        return True

    def refuse(self, error: str) -> None:
        """Take the texts for wrong although they compile: they cannot be drawn with."""
        self.error, self._refused = error, True

    def program(
        self, context: moderngl.Context, needs: Needs, constants: Mapping[str, Any] | None = None
    ) -> Program:
        """The program for these needs, of the newest texts that compile.

        Raises
        ------
        ShaderError
            The files themselves do not compile.
        """
        for texts in (self._good,) if self._refused else (self.texts, self._good):
            try:
                return Program(context, sources_for(needs, constants, texts))
            except (ShaderError, ValueError, FileNotFoundError) as error:
                if not texts:
                    raise
                if texts is self.texts:
                    self.error = str(error)
        return Program(context, sources_for(needs, constants))
