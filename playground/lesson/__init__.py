"""Lessons: one file is a script, a guided tour in the window, a handout and a test.

    from playground.lesson import figure, goal, listing, number, plot, predict, show

These words are all that a lesson needs besides the public API; ``lessons/README.md`` says
how to write one.
"""

from playground.lesson.words import figure as figure
from playground.lesson.words import goal as goal
from playground.lesson.words import listing as listing
from playground.lesson.words import number as number
from playground.lesson.words import plot as plot
from playground.lesson.words import predict as predict
from playground.lesson.words import show as show
