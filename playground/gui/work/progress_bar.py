"""How far long work has come, as a bar with an estimate, and the button that stops it."""

from __future__ import annotations

from math import ceil

from imgui_bundle import imgui

from playground.gui.work.long_work import Progress
from playground.percent import percent

MINUTE = 60.0


def draw(progress: Progress, key: str = "cancel") -> bool:
    """Button and bar over the whole width; returns whether the work shall stop."""
    cancelled = bool(imgui.button(f"Cancel###{key}"))
    imgui.same_line()
    room = imgui.ImVec2(-1, 0)
    if progress.share is None:  # a piece that runs to and fro
        imgui.progress_bar(-float(imgui.get_time()), room, words(progress))
    else:
        imgui.progress_bar(progress.share, room, words(progress))
    return cancelled


def words(progress: Progress) -> str:
    """Per cent and what is left, or the time so far where that is all one can say."""
    if progress.share is None:
        return f"{seconds(progress.elapsed)} so far"
    left = f", {seconds(progress.left)} left" if progress.left else ""
    return f"{percent(progress.share, '.0f')}{left}"


def seconds(time: float) -> str:
    """A time as people say it; never "0 s left"."""
    whole = max(ceil(time), 1)
    return f"{whole} s" if whole < MINUTE else f"{whole // 60} min {whole % 60} s"
