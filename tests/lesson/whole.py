"""A lesson from its first step to its last, as nobody in front of a window has it at once."""

from playground.lesson.run import Running
from playground.lesson.script import read_lesson


def run_whole(path):
    """The lesson in a file, and all of its pages; raises what is wrong with it."""
    running = Running(read_lesson(path))
    for _ in running.lesson.steps:
        running.step()
    return running.lesson, running.pages
