# %% [markdown] minutes=1
# # The diffuse term and Lambert's law
#
# Noon is brighter than evening, though the sun is the same and no farther away. Chalk, paper
# and unpolished wood look equally bright from wherever you look. Both are one law, which
# Lambert wrote down in 1760. What does it say?

# %%
import numpy as np

import playground as pg
from playground.lesson import figure, goal, number, plot, predict, show


def lit_from(setup, angle, **changes):
    """The setup under one directional light, ``angle`` degrees away from straight above."""
    angle = np.radians(angle)
    sun = pg.DirectionalLight(to_light=(np.sin(angle), np.cos(angle), 0), ambient=(0, 0, 0))
    return setup.with_(lights=[sun], terms=["diffuse"], **changes)


field = pg.load("quad").with_(diffuse=(0.9, 0.85, 0.7), eye=(0, 3, 2), target=(0, 0, 0))
chalk = lit_from(pg.load("sphere"), -90, diffuse=(0.9, 0.9, 0.9), background=(0.05, 0.05, 0.1))
show(chalk)

# %% [markdown] slides=[4] minutes=4
# ## The same light on a larger ground
#
# A field, and the sun straight above it. The sun is so far away that its light comes from one
# direction everywhere: a *directional light*, whose light vector $l$ is the same at all points.

# %%
show(
    lit_from(field, 0),
    "A field under the sun at noon, evenly bright.",
    shows=lambda picture: np.allclose(picture.pixels[150:210, 200:280], (0.9, 0.85, 0.7)),
)
predict(
    "Noon is over and the sun goes down, until its light comes from 60° away from straight above. "
    "How bright is the field?",
    "as before: the light is as strong as it was",
    "a third as bright, as 30 of 90 degrees are left",
    "half as bright",
    answer="half as bright",
    why=r"A beam that is one metre wide now lies on $1/\cos 60°$ = 2 metres of ground: each point "
    "gets half of it.",
)


# %%
def brightness(angle):
    """How bright the picture of the field is in its middle, with the sun at noon for 1."""
    noon, now = (pg.render(lit_from(field, a), (41, 41)).pixels[20, 20, 0] for a in (0, angle))
    return now / noon


# float32 on the GPU: 1e-6 is ample for a cosine and a product.
number("at_60", brightness(60), expected=0.5, tolerance=1e-6)
number("at_30", brightness(30), expected=np.cos(np.radians(30)), tolerance=1e-6)
show(lit_from(field, 60), pixel=(0.5, 0.5), panel="Lights")

# %% [markdown]
# At 60° the field has {at_60:.2f} of its brightness at noon, at 30° still {at_30:.2f}: the
# *cosine* of the angle between normal $n$ and light vector $l$. For unit vectors that is
# $n \cdot l$, which is why the formula needs no angle at all.

# %% [markdown] tags=["notes"]
# A torch and a sheet of paper show it: tilt the sheet and the spot of light gets longer. Whoever
# says "a third" counts degrees. In the window, the panel Lights turns the sun.

# %% [markdown] slides=[4] minutes=3
# ## And below the horizon?
#
# Let the sun sink on, past the horizon: the angle between $n$ and $l$ grows beyond 90°, and its
# cosine goes on falling. Should the brightness, too?

# %%
angles = np.arange(0, 181, 5)
measured = np.array([brightness(angle) for angle in angles])
cosine = np.cos(np.radians(angles))
plot(
    r"The measured brightness follows $n \cdot l$ down to 0, where the sun sets, and stays there.",
    x=("angle between $n$ and $l$ in degrees", angles),
    y="brightness, noon = 1",
    curves={r"$n \cdot l$": cosine, "measured": measured},
    shows=lambda law, seen: np.allclose(seen, np.maximum(law, 0), atol=1e-6) and min(law) < -0.99,
)
number("deepest", min(cosine), expected=-1, tolerance=1e-12)
show(lit_from(field, 85), pixel=(0.5, 0.5), panel="Lights")

# %% [markdown]
# In the window the sun has almost set; let it sink farther in the panel Lights.
#
# A light behind the surface would make $n \cdot l$ negative, down to {deepest:.0f}, and take
# light away that others have brought. So the lecture cuts it off:
#
# $$\max(n \cdot l, 0) \; s_d \otimes m_d$$
#
# $s_d$ is the colour of the light and $m_d$ that of the surface; what $\otimes$ does with
# them is a lesson of its own.

# %% [markdown] slides=[4] minutes=3
# ## From wherever you look

# %%
show(chalk.with_(eye=(0, 0, 3.4)))
predict(
    "A ball of chalk, lit from the left. You walk 90° around it, to the left, and keep your eye on "
    "one spot of the lit side. Seen from there, the spot is",
    "darker, since you see it at a slant",
    "as bright as before",
    "brighter, as you are nearer to the light",
    answer="as bright as before",
    why="A Lambertian surface scatters with equal intensity in all directions: the formula has "
    "no $v$.",
)


# %%
def seen_from(angle):
    """The ball of chalk from an eye that has walked around it."""
    angle = np.radians(angle)
    return chalk.with_(eye=(3.4 * np.sin(angle), 0, 3.4 * np.cos(angle)))


def spot_seen_from(angle):
    """How bright the spot with normal (-1, 0, 1)/√2 is, from an eye at this angle."""
    spot = np.array([-1, 0, 1]) / np.sqrt(2)
    size = (201, 201)
    row = [pg.explain(seen_from(angle), (x, 100), size).corners for x in range(201)]
    x = max((corners[0].normal @ spot, x) for x, corners in enumerate(row) if corners)[1]
    return pg.render(seen_from(angle), size).pixels[100, x, 0]


front, side = spot_seen_from(0), spot_seen_from(-90)
# A pixel is 1.2° of the ball there, so the spot is found to 0.6°: 1 % of the cosine of 45°.
number("front", front, expected=0.9 * np.sqrt(0.5), tolerance=0.007)
number("side", side, expected=0.9 * np.sqrt(0.5), tolerance=0.007)
pictures = [pg.render(seen_from(angle), (240, 240)) for angle in (0, -45, -90)]
figure(
    pictures,
    "The ball of chalk from three sides: the bright half stays with the light.",
    names=["from the front", "after 45°", "after 90°, from the light"],
    shows=lambda a, b, c: a.pixels.sum() < b.pixels.sum() < c.pixels.sum(),
)
show(seen_from(0))

# %% [markdown]
# The same spot has brightness {front:.1f} from the front and {side:.1f} from the side. The
# picture of the *ball* changes, since we see other parts of it; each *point* keeps its
# brightness: the diffuse term is view-independent.

# %% [markdown] tags=["notes"]
# "Darker at a slant": the piece of surface does send less light at a slant, by the cosine. But it
# looks smaller by the same cosine, so that the two cancel. "Equal intensity", in the words of the
# lecture, means equal brightness to the eye, which physics calls radiance.

# %% [markdown] minutes=3
# ## Try this
#
# Unfold the light in the panel Lights and turn it, or move the camera. The lit part of the ball
# wanes like the moon.


# %%
def lit_share(setup):
    """The share of the ball's picture that the light reaches."""
    picture = pg.render(setup.with_(terms=["diffuse"], background=(0, 0, 0)), (120, 90))
    return np.mean(picture.pixels.max(axis=2) > 0.01) / max(np.mean(picture.coverage), 1e-9)


show(seen_from(0), panel="Lights")
goal(
    "Make a crescent: at most a fifth of the ball is lit, but not none of it.",
    reached=lambda setup: 0.01 < lit_share(setup) < 0.2,
    hint=r"The lit share of the disc is $(1 + \cos\varphi)/2$, where $\varphi$ is the angle "
    "between light and eye, as seen from the ball.",
    solution=seen_from(50),
)
goal(
    "Make a full moon: all of the ball is lit.",
    reached=lambda setup: lit_share(setup) > 0.97,
    hint="Where does the moon stand, seen from us, when it is full?",
    solution=seen_from(-90),
)
