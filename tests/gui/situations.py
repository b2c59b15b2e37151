"""Where the controls of the panels are to be seen: what all tables of situations share.

A table says, for each situation, its panel, how to come there, and the controls that stand there.
A row with a check only is pressed, a row with a value chooses or types it. Other rows say where
the control is used instead, or that it has nothing to do with the state.
"""

from dataclasses import replace

from playground.scene.library import load
from playground.scene.light import SpotLight

FOLDS, SHOWS, TITLE = "folds", "shows a colour", "of a column"


def prepare(hands, **changes):
    """A spot light that fades, two objects, the first with a texture."""
    base = load("textured")
    pair = (*base.scene.objects, *load("teapot").scene.objects)[:2]
    hands.load("textured", lights=(SpotLight(attenuate=True),), objects=pair)
    hands.window.state = replace(hands.state, layout="wipe", **changes)
    hands.frames(3)


def at_rest(hands):
    """Wait until nothing more comes from beside the frames: it would move the controls below it."""
    slots = hands.window.slots
    hands.frames(2)
    hands.until(lambda: not (slots.factors.now.working or slots.refining))
