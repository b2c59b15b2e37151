"""From the declaration of a knob to the slider that moves it; no ImGui here.

A declared range says what is *valid*, often far more than what is useful: a slider
from 0 to a million cannot be aimed. The span of a slider lies around the default, and
grows where the present value lies outside. Typing a number reaches the whole range.
"""

from __future__ import annotations

from playground.scene.knob import UNBOUNDED, Knob

STRETCH = 32.0  # a logarithmic slider spans default/32 to default·32: five stops each way
SHORT = 10.0  # a linear slider up to this long shows hundredths
RIGHT_CLICK = ("number", "integer", "switch", "colour", "vector")  # their widgets set the default
WIDE = 20.0  # a range more than this many times the default is not spanned as a whole


def span(knob: Knob, value: float) -> tuple[float, float]:
    """The ends of the slider of a number: around the default, within the declared range."""
    low, high, default = knob.low, knob.high, float(knob.default)
    if knob.scale == "log" and default > 0.0:
        low, high = max(low, default / STRETCH), min(high, default * STRETCH)
    elif high - low > WIDE * max(abs(default), 1.0) and knob.unit != "degrees":
        high = max(low + 1.0, 2.0 * default)
    return min(low, value), max(high, value)


def bounded(knob: Knob) -> bool:
    """Whether a slider makes sense; a number without an upper end is dragged instead."""
    return knob.low > -UNBOUNDED and knob.high < UNBOUNDED


def drag_speed(values: tuple[float, ...]) -> float:
    """Change per pixel of a dragged number: a two-hundredth of its size, or of 1."""
    return 0.005 * max(1.0, *(abs(value) for value in values))


def number_format(knob: Knob, low: float = 0.0, high: float = UNBOUNDED) -> str:
    """How a slider from ``low`` to ``high`` prints its value (a printf format).

    Degrees carry their sign. Lengths are in the scene's own unit, which has no sign; the
    tooltip says so.
    """
    plain = knob.scale == "linear" and high - low <= SHORT
    return ("%.2f" if plain else "%.3g") + ("°" if knob.unit == "degrees" else "")


def tidy(value: float) -> float:
    """A float32 of ImGui as the decimal number that was meant: 0.7, not 0.699999988."""
    return float(f"{value:.6g}")


def hint(knob: Knob) -> str:
    """What the tooltip says: the sentence, the symbol, the range, the default, the mouse."""
    default = knob.default
    if knob.kind == "vertices":
        default = f"{len(default)} corners"
    elif isinstance(default, tuple):
        parts = (part if isinstance(part, str) else f"{part:g}" for part in default)
        default = ", ".join(parts)
    elif isinstance(default, bool):
        default = "on" if default else "off"
    elif isinstance(default, float):
        default = f"{default:g}"
    lines = [f"{knob.symbol}: {knob.help}" if knob.symbol else knob.help]
    if knob.kind not in ("switch", "choice", "names", "text"):
        lines.append(knob.allowed)
    way = "   (right-click sets it)" if knob.kind in RIGHT_CLICK else ""
    lines.append(f"default {default}{way}" if default != "" else "")
    if knob.kind in ("number", "integer", "vector"):
        lines.append("Ctrl-click to type a value")
    return "\n".join(line for line in lines if line)
