"""What differs between two setups, in a few words: for the status line after undo."""

from __future__ import annotations

from typing import Any

from playground.scene.knob import knobs
from playground.scene.setup import Setup

MOST = 3  # names that are listed before it is only "several things"


def difference(a: Setup, b: Setup) -> str:
    """The quantities in which two setups differ: ``"camera eye"``, ``"light 0 diffuse"``."""
    found: list[str] = []
    if a.name != b.name:
        return f"from {a.name} to {b.name}"
    for part in ("settings", "camera", "scene"):
        found += _knobs(part, getattr(a, part), getattr(b, part))
    for kind in ("light", "object"):
        old, new = getattr(a.scene, f"{kind}s"), getattr(b.scene, f"{kind}s")
        if len(old) != len(new):
            found.append(f"number of {kind}s")
            continue
        for i, (x, y) in enumerate(zip(old, new, strict=True)):
            found += _item(f"{kind} {i}", x, y)
    return ", ".join(found) if len(found) <= MOST else "several things"


def _item(label: str, x: Any, y: Any) -> list[str]:
    if type(x) is not type(y):
        return [f"{label} type"]
    found = _knobs(label, x, y)
    for inner in ("material", "transform"):
        if hasattr(x, inner):
            found += _knobs(label, getattr(x, inner), getattr(y, inner))
    return found


def _knobs(label: str, x: Any, y: Any) -> list[str]:
    if x is y:
        return []
    label = "" if label == "settings" else f"{label} "
    changed = [name for name in knobs(type(x)) if getattr(x, name) != getattr(y, name)]
    return [f"{label}{name.replace('_', ' ')}" for name in changed]
