"""The one kind of error that is the user's: it says what, got, allowed and fix.

Everything a person can get wrong (a file, a name, a number) ends in a
`PlaygroundError`. The command line prints it and leaves with status 2; the
window shows it and goes on. A traceback is always a bug of ours.
"""

from __future__ import annotations

from collections.abc import Iterable


class PlaygroundError(ValueError):
    """A mistake of the user, told in up to four parts.

    Parameters
    ----------
    what : str
        What is wrong, naming the thing: ``"light.inner_angle must be below outer_angle"``.
    got : object, optional
        The offending value, shown as it was given.
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
            parts.append(f"got {got if isinstance(got, str) else repr(got)}")
        if allowed is not None:
            parts.append(f"allowed: {allowed}")
        message = "; ".join(parts) + "."
        super().__init__(f"{message} {fix}" if fix else message)


def unknown_name(kind: str, name: object, known: Iterable[str]) -> PlaygroundError:
    """An error for a name nobody knows: lists the known ones, suggests the nearest."""
    from difflib import get_close_matches

    known = sorted(set(known))
    near = get_close_matches(str(name), known, n=1, cutoff=0.5)
    return PlaygroundError(
        f"unknown {kind}",
        got=f"'{name}'",
        allowed=", ".join(known),
        fix=f"Did you mean '{near[0]}'?" if near else None,
    )
