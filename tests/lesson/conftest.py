"""A lesson in a temporary folder, as somebody who copies one would write it."""

import pytest

OWN = """# %% [markdown] slides=[2] minutes=1
# # My own lesson
#
# How bright is *half* a light?

# %%
import playground as pg
from playground.lesson import figure, goal, number, plot, predict, show

ball = pg.load("sphere")

# %% [markdown] slides=[4, 5] minutes=2.5
# ## The experiment
#
# A formula, $\\\\max(n \\\\cdot l, 0)$, with `code` and **weight**.

# %%
show(ball, "A red ball.", shows=lambda p: p.pixels[180, 240, 0] > 2 * p.pixels[180, 240, 1])
predict("And with half the light?", "half", "a quarter", answer="half", why="It is $linear$.")

# %%
half = ball.with_(diffuse_weight=0.5)
pair = [pg.render(s, (64, 48), renderer="numpy") for s in (ball, half)]
figure(
    pair,
    "Bright and dark.",
    names=["all", "half"],
    shows=lambda a, b: a.pixels.sum() > b.pixels.sum(),
)
x = [0, 1, 2]
plot("A line.", x=("x", x), y="y", curves={"a": x}, shows=lambda a: a[2] == 2 * a[1] > 0)
number("share", half.settings.diffuse_weight, expected=0.5)
show(half)
goal(
    "Double it.",
    reached=lambda setup: setup.settings.diffuse_weight >= 1,
    hint="A weight.",
    solution=ball,
)

# %% [markdown]
# It is {share:.2f}.

# %% [markdown] tags=["notes"]
# Say it {share:.1f} times.
"""


@pytest.fixture
def own(tmp_path):
    """A lesson of one's own; call it with (old, new) pairs to spoil it first."""

    def write(*changes):
        text = OWN.replace("\\\\", "\\")
        for old, new in changes:
            assert text.count(old) == 1, old
            text = text.replace(old, new)
        file = tmp_path / "mine.py"
        file.write_text(text, encoding="utf-8")
        return file

    return write
