"""A share as people read it."""

from __future__ import annotations


def percent(share: float, form: str = ".3g") -> str:
    """``0.185`` as ``"18.5 %"``: with three digits, however small, or in another format."""
    return f"{100.0 * share:{form}} %"
