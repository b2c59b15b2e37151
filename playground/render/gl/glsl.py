"""Reads GLSL as far as rewriting its arithmetic takes: tokens, statements, expressions.

A `Walk` goes through a shader and calls its own methods `binary`, `assign`, `call`,
`number` and `name` for what it finds, innermost first; a subclass changes the tokens there.
Comments, spaces and lines of the preprocessor stay where they are, so that every line
keeps its number.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

_TOKEN = re.compile(
    r"(?P<space>\s+|//[^\n]*|/\*.*?\*/|^[ \t]*\#[^\n]*)"
    r"|(?P<number>0[xX][0-9a-fA-F]+[uU]?|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?(?:lf|LF|[fFuU])?)"
    r"|(?P<name>[A-Za-z_]\w*)"
    r"|(?P<mark><<=|>>=|[-+*/%&|^<>=!]=|&&|\|\||\^\^|\+\+|--|<<|>>|.)",
    re.MULTILINE | re.DOTALL,
)
_BINARY = {
    op: level
    for level, ops in enumerate(
        ("||", "^^", "&&", "|", "^", "&", "== !=", "< > <= >=", "<< >>", "+ -", "* / %"), 2
    )
    for op in ops.split()
}
_ASSIGNING = ("=", "+=", "-=", "*=", "/=", "%=", "<<=", ">>=", "&=", "^=", "|=")
_QUALIFIERS = ("const", "highp", "mediump", "lowp", "precise")


@dataclass
class Token:
    """A word, number or mark; ``text`` is what stands there, ``new`` what shall stand there."""

    kind: str
    text: str
    line: int
    new: str = ""
    before: str = ""
    after: str = ""

    def __post_init__(self) -> None:
        self.new = self.text

    def enclose(self, last: Token, before: str, after: str = ")") -> None:
        """Put ``before`` in front of this token and ``after`` behind ``last``, outside of all."""
        self.before = before + self.before
        last.after += after


def tokens(text: str) -> list[Token]:
    """All tokens of a shader, space and comments included; lines count from 0."""
    found, line = [], 0
    for match in _TOKEN.finditer(text):
        kind = str(match.lastgroup)
        found.append(Token(kind, match[0], line))
        line += match[0].count("\n")
    return found


def written(everything: list[Token]) -> str:
    """The text of tokens after changes."""
    return "".join(token.before + token.new + token.after for token in everything)


class Walk:
    """Goes once through ``words``, the tokens of a shader without spaces."""

    def __init__(self, words: list[Token], where: Callable[[int], str]) -> None:
        self.words, self._where = words, where
        self._at = 0
        self.function = ""  # whose body this is
        self.constant = False  # whether this is the value of a constant

    def binary(self, operator: Token, first: Token, last: Token) -> None:
        """``first`` to ``last`` is ``a operator b``."""

    def assign(self, operator: Token, target: list[Token], first: Token, last: Token) -> None:
        """``target operator first...last``."""

    def call(self, name: Token, last: Token) -> None:
        """``name(...)``, a function or a constructor."""

    def leaf(self, word: Token) -> None:
        """A number, or a name that is not called."""

    def skip_statement(self, first: Token) -> bool:
        """Whether to leave alone the statement that starts so."""
        return False

    def walk(self) -> None:
        """Go through all functions and constants."""
        while self._at < len(self.words):
            start = self._at
            while self._peek() not in ("{", ";", "=", ""):
                self._at += 1
            stop = self._peek()
            if stop == "{" and self.words[self._at - 1].text == ")":
                names = [w.text for w in self.words[start : self._at]]
                self.function = names[names.index("(") - 1]
                self._statement()
                self.function = ""
            elif stop == "=":
                self._at = start
                self._simple()
                self._take(";")
            else:
                self._skip(stop)

    def _skip(self, stop: str) -> None:
        """Past a declaration; a struct ends with its own brace and the semicolon after it."""
        while stop == "{" and self._peek() not in ("}", ""):
            self._at += 1
        self._at += 1

    def _peek(self, ahead: int = 0) -> str:
        at = self._at + ahead
        return self.words[at].text if at < len(self.words) else ""

    def _take(self, expected: str) -> None:
        if self._peek() != expected:
            at = self.words[min(self._at, len(self.words) - 1)]
            raise ValueError(
                f"{self._where(at.line + 1)}: '{expected}' expected, not '{self._peek()}': "
                "only GLSL without macros or #if inside a statement has another precision"
            )
        self._at += 1

    def _statement(self) -> None:
        word = self._peek()
        if word == "{":
            self._at += 1
            while self._peek() not in ("}", ""):
                self._statement()
            self._take("}")
        elif word in ("if", "while"):
            self._at += 1
            self._bracketed()
            self._statement()
            if self._peek() == "else":
                self._at += 1
                self._statement()
        elif word == "for":
            self._at += 1
            self._take("(")
            for end in (";", ";", ")"):
                if self._peek() != end:
                    self._simple()
                self._take(end)
            self._statement()
        elif self.skip_statement(self.words[self._at]):
            while self._peek() not in (";", ""):
                self._at += 1
            self._take(";")
        else:
            if word in ("return", "break", "continue", "discard"):
                self._at += 1
            if self._peek() != ";":
                self._simple()
            self._take(";")

    def _simple(self) -> None:
        """A declaration with values, or expressions with commas between them."""
        self.constant = self._peek() == "const"
        while self._peek() in _QUALIFIERS:
            self._at += 1
        kinds = [word.kind for word in self.words[self._at : self._at + 2]]
        if kinds == ["name", "name"]:
            self._at += 1
        self._expression(0)
        while self._peek() == ",":
            self._at += 1
            self._expression(0)
        self.constant = False

    def _bracketed(self) -> None:
        self._take("(")
        self._expression(0)
        self._take(")")

    def _expression(self, least: int) -> None:
        first = self._at
        self._operand()
        while (word := self._peek()) != "":
            operator = self.words[self._at]
            level = _BINARY.get(word, -1)
            if word in _ASSIGNING and least == 0:
                self._at += 1
                target, start = self.words[first : self._at - 1], self._at
                self._expression(0)
                self.assign(operator, target, self.words[start], self.words[self._at - 1])
            elif word == "?" and least <= 1:
                self._at += 1
                self._expression(0)
                self._take(":")
                self._expression(1)
            elif level >= max(least, 2):
                self._at += 1
                self._expression(level + 1)
                self.binary(operator, self.words[first], self.words[self._at - 1])
            else:
                return

    def _operand(self) -> None:
        """A name, number or bracket with signs before it, and calls, parts, indices after it."""
        while self._peek() in ("+", "-", "!", "~", "++", "--"):
            self._at += 1
        start = self._at
        if self._peek() == "(":
            self._bracketed()
        elif start < len(self.words) and self.words[start].kind in ("name", "number"):
            self._at += 1
            if self._peek() != "(":
                self.leaf(self.words[start])
        else:
            self._take("an expression")
        while (word := self._peek()) in ("(", "[", ".", "++", "--"):
            self._at += 1
            if word == "(":
                while self._peek() != ")":
                    self._expression(0)
                    if self._peek() != ")":
                        self._take(",")
                self._at += 1
                self.call(self.words[start], self.words[self._at - 1])
            elif word == "[":
                if self._peek() != "]":
                    self._expression(0)
                self._take("]")
            elif word == ".":
                self._at += 1
