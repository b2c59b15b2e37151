"""The one kind of error that is the user's: it says what, got, allowed and fix.

Everything a person can get wrong (a file, a name, a number) ends in a
`PlaygroundError`. The command line prints it and leaves with status 2; the
window shows it and goes on. A traceback is always a bug of ours.
"""

from __future__ import annotations

from collections.abc import Iterable

LONGEST = 200  # characters of a value in a message


class PlaygroundError(ValueError):
    """A mistake of the user, told in up to four parts.

    Parameters
    ----------
    what : str
        What is wrong, naming the thing: ``"light.inner_angle must be below outer_angle"``.
    got : object, optional
        The offending value; text is shown as it is, anything else as Python writes it.
    allowed : str, optional
        What would be right: a range with its unit, or the known names.
    fix : str, optional
        One sentence, imperative: how to mend it.
    """

    def __init__(
        self, what: str, *, got: object = None, allowed: str | None = None, fix: str | None = None
    ) -> None:
        self.what, self.got, self.allowed, self.fix = what, got, allowed, fix
        parts = [what.rstrip(".")]
        if got is not None:
            parts.append(f"got {shortened(got if isinstance(got, str) else shown(got))}")
        if allowed is not None:
            parts.append(f"allowed: {allowed}")
        message = "; ".join(parts) + "."
        super().__init__(f"{message} {fix}" if fix else message)


def shown(value: object) -> str:
    """How Python writes ``value``; its type where it cannot: nested too deep, too many digits."""
    try:
        return repr(value)
    except (RecursionError, ValueError):
        return f"a value of type {type(value).__name__}, too large to be shown"


def why_unread(error: ValueError | RecursionError) -> str:
    """What a reader of TOML or JSON complains of, also where it does not say it itself."""
    if isinstance(error, RecursionError):
        return "too many brackets in one another"
    return "a number of too many digits" if type(error) is ValueError else str(error)


def shortened(text: str) -> str:
    """The first `LONGEST` characters of ``text``."""
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}..."


def unknown_name(kind: str, name: object, known: Iterable[str]) -> PlaygroundError:
    """An error for a name nobody knows: lists the known ones, suggests the nearest."""
    from difflib import get_close_matches

    known = sorted(set(known))
    name = shortened(name if isinstance(name, str) else shown(name))
    near = get_close_matches(name, known, n=1, cutoff=0.5)
    return PlaygroundError(
        f"unknown {kind}",
        got=f"'{name}'",
        allowed=", ".join(known),
        fix=f"Did you mean '{near[0]}'?" if near else None,
    )
