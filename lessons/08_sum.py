# %% [markdown] minutes=1
# # Ambient, emissive, and the sum of four
#
# The side of a teapot that is turned away from the lamp is not black. A firefly shines with
# no lamp at all. Two terms for that are still missing, and they are the simplest of the four. Then
# the Phong model is complete: how do its terms come together?

# %%
import numpy as np

import playground as pg
from playground.lesson import figure, goal, number, predict, show

SIZE, BLACK = (480, 360), (0, 0, 0)
teapot = pg.load("teapot").with_(background=BLACK)
show(teapot, panel="Terms")

# %% [markdown] slides=[9] minutes=3
# ## Light from everywhere
#
# *Ambient light* stands for what the other objects of a scene reflect, the *indirect* light. It has
# bounced around so much that it arrives at a point from all directions, and from there it is
# scattered with equal intensity in all directions. So nothing is left to compute but the filter:
#
# $$s_a \otimes m_a$$

# %%
predict(
    "The teapot with the ambient term alone. How many different colours are there on it?",
    "one",
    "two: the side towards the lamp, and the side away from it",
    "thousands, as with the diffuse term",
    answer="one",
    why="The formula has no $n$, no $l$ and no $v$. With nothing to tell one point of the surface "
    "from another, they are all alike.",
)


# %%
def colours(setup):
    """The different colours on the objects, away from their outlines."""
    picture = pg.render(setup, SIZE)
    return np.unique(picture.pixels[picture.coverage == 1], axis=0)


lamp_behind = pg.DirectionalLight(to_light=(-1, 0.4, -1), ambient=(0.4, 0.4, 0.45))
behind = teapot.with_(lights=[lamp_behind], emissive=BLACK)
ambient = colours(behind.with_(terms=["ambient"]))
number("of_ambient", len(ambient), expected=1)
# s_a is 0.4 and m_a 0.66 in red; a product and a uniform in float32.
number("red", ambient[0, 0], expected=0.4 * 0.66, tolerance=1e-7)
without = behind.with_(terms=["diffuse", "specular"])
pair = [
    pg.render(setup, (200, 150)) for setup in (without, behind.with_(terms=["ambient"]), behind)
]
body = (slice(73, 93), slice(87, 113))  # of the pot, in its shadow
figure(
    pair,
    "The lamp stands behind the teapot. Without ambient light its front is black; ambient light "
    "alone makes a silhouette; together one can see what it is.",
    names=["without ambient", "ambient alone", "together"],
    shows=lambda without, alone, both: (
        without.pixels[body].max() < 0.001 < without.pixels.max()
        and np.ptp(alone.pixels[body], axis=(0, 1)).max() == 0
        and alone.pixels[body].min() > 0.03
        and both.pixels.max() > 2 * alone.pixels.max()
    ),
)
show(behind, panel="Terms")

# %% [markdown]
# The silhouette has {of_ambient:.0f} colour, with {red:.3f} of red: 0.4 of the light times 0.66
# of the material. Of all terms this is the roughest guess: real indirect light is weaker in a
# corner and under a table, and it is red beside a red wall.

# %% [markdown] tags=["notes"]
# Ask what ambient light would be in the room you sit in: everything that is not lit straight from
# a lamp or a window, averaged over the room. Too much of it makes a picture flat and foggy, which
# can be shown with the slider of its weight in the panel Terms.

# %% [markdown] slides=[9] minutes=3
# ## A surface that shines
#
# The last term is the light that a surface sends out by itself: a glowing coal, a screen, a
# traffic light. It is a colour of the material, $m_e$, and that is all.

# %%
grey = pg.Material(diffuse=(0.5, 0.5, 0.5), specular=BLACK, ambient=(0.5, 0.5, 0.5))


def lantern(glow):
    """A ball over a floor, under a faint bluish light; ``glow`` is its m_e."""
    floor = pg.Object(
        mesh="quad", material=grey, transform=pg.Transform(translate=(0, -1.2, 0), size=3)
    )
    ball = pg.Object(
        mesh="sphere",
        tessellation=64,
        material=pg.Material(
            diffuse=(0.3, 0.3, 0.3), specular=BLACK, ambient=(0.3, 0.3, 0.3), emissive=glow
        ),
    )
    dusk = pg.DirectionalLight(
        to_light=(1, 2, 1), diffuse=(0.25, 0.28, 0.4), ambient=(0.05, 0.05, 0.08)
    )
    setup = pg.load("sphere").with_(objects=[ball, floor], lights=[dusk], background=BLACK)
    return setup.with_(eye=(0, 1.5, 7), target=(0, -0.3, 0), fov=32)


show(lantern(BLACK), panel="Material")
predict(
    "A dark ball hangs over a grey floor. Now it begins to glow, $m_e$ = (1, 0.6, 0.1). By how "
    "much does the floor become brighter?",
    "not at all",
    "a little, under the ball",
    "as if a lamp hung there",
    answer="not at all",
    why="For that, a point of the floor would have to know of the ball. In a local model it knows "
    "the lights of the scene and its own material; an object is not a light.",
)

# %%
dark, glowing = (pg.render(lantern(glow), (320, 240)) for glow in (BLACK, (1, 0.6, 0.1)))
change = glowing.pixels - dark.pixels
ground = (slice(190, 215), slice(80, 240))  # the floor in front of the ball
number("floor_change", np.abs(change[ground]).max(), expected=0)
number("ball_change", change[..., 0].max(), expected=1, tolerance=1e-6)  # a sum in float32
figure(
    [dark, glowing],
    "A ball over a floor, and the same ball with $m_e$ = (1, 0.6, 0.1). The floor does not notice.",
    names=["dark", "glowing"],
    shows=lambda a, b: (
        np.array_equal(a.pixels[ground], b.pixels[ground])
        and a.pixels[ground].min() > 0.05
        and b.pixels[100, 160, 0] > a.pixels[100, 160, 0] + 0.9
    ),
)
show(lantern((1, 0.6, 0.1)), panel="Material")

# %% [markdown]
# On the ball red has grown by {ball_change:.0f}, on the floor by {floor_change:.0f}. The glow only
# *looks* like light. In practice one puts a point light into the lamp as well. Radiosity, which
# is global, makes no difference between lights and objects at all: it has a lesson of its own.

# %% [markdown] slides=[10] minutes=3
# ## The sum
#
# That is all of it. The Phong model sums the four terms:
#
# $$\max(n \cdot l, 0) \, s_d \otimes m_d + (\max(r \cdot v, 0))^{sh} \, s_s \otimes m_s$$
#
# $$+ \; s_a \otimes m_a + m_e$$
#
# Each term can be drawn by itself. Is the sum of the four pictures the picture of the sum?

# %%
TERMS = ("diffuse", "specular", "ambient", "emissive")
terms = [pg.render(teapot.with_(terms=[term]), SIZE) for term in TERMS]
whole = pg.render(teapot, SIZE)
added = np.sum([picture.pixels for picture in terms], axis=0, dtype=np.float64)
# Numbers below 2 in float32: each of four terms and three sums is rounded by at most 1.2e-7.
number("off", np.abs(added - whole.pixels).max(), expected=0, tolerance=7 * 1.2e-7)
small = [pg.render(teapot.with_(terms=[term]), (130, 98)) for term in TERMS]
figure(
    [*small, pg.render(teapot, (130, 98))],
    "The slide: the four terms of the teapot, and their sum.",
    names=[f"({letter}) {name}" for letter, name in zip("abcde", (*TERMS, "sum"), strict=True)],
    shows=lambda *made: (
        all(picture.pixels.max() > 0.1 for picture in made[:4])
        and np.allclose(sum(picture.pixels for picture in made[:4]), made[4].pixels, atol=1e-6)
        and made[4].pixels.max() > made[0].pixels.max() + 0.5
    ),
)
show(teapot, layout="terms", panel="Terms")

# %% [markdown]
# It is: the largest difference in any pixel is {off:.0e}, a rounding. With several lights, the
# first three terms are summed over all of them; $m_e$ comes once. Only the specular term sees
# the eye: when the camera moves, the other three keep the colour of each point.

# %% [markdown] tags=["notes"]
# The keys D, S, A and E switch the terms in the window. Let the class guess which term is missing
# from a picture; emissive is the hardest, since it looks like more ambient light. The sum needs a
# black background, or that would be added four times.

# %% [markdown] minutes=3
# ## More than white

# %%
top = [picture.pixels[..., 0].max() for picture in terms]
number("diffuse", top[0], expected=0.66, tolerance=0.001)  # m_d, where a pixel faces the light
number("specular", top[1], expected=0.7, tolerance=0.001)  # m_s, in the middle of the highlight
number("ambient", top[2], expected=0.198, tolerance=1e-6)
number("emissive", top[3], expected=0.12, tolerance=1e-6)
predict(
    "In red, the brightest pixel of the diffuse term has {diffuse:.2f}, of the specular term "
    "{specular:.2f}, of the ambient term {ambient:.2f}, of the emissive term {emissive:.2f}. The "
    "screen can show 0 to 1. What does it show in the middle of the highlight?",
    "1: what is above is cut off",
    "the sum: it is brighter than white there",
    "1, and the rest of the picture gets darker, so that all fits",
    answer="1: what is above is cut off",
    why="The sum is computed as it is. The display then *clamps* it to the range from 0 to 1, each "
    "pixel and each channel by itself.",
)

# %%
clipped = (whole.pixels > 1).any(axis=2)
number("brightest", whole.pixels.max(), expected=added.max(), tolerance=1e-6)  # as above
# Of 48 000 pixels; those that are on the edge of the patch may fall on either side of it.
number("clipped", 100 * clipped.sum() / whole.coverage.sum(), expected=6.6, tolerance=0.2)
codes = sum(picture.codes().astype(int) for picture in terms) - whole.codes()
number("codes", codes.max(), expected=255 * (whole.pixels.max() - 1), tolerance=2)  # of roundings
changes = {"as shown": {}, "clamped pixels": {"marks": ["clamped"]}}
changes["exposure 0.6"] = {"exposure": 0.6}
figure(
    [pg.render(teapot.with_(**change), (200, 150)) for change in changes.values()],
    "The sum as the screen shows it, with the clamped pixels marked, and with the exposure at 0.6, "
    "where all of it fits.",
    names=list(changes),
    shows=lambda a, b, c: (
        np.array_equal((a.shown() != b.shown()).any(axis=2), (a.pixels > 1).any(axis=2))
        and (a.pixels > 1).any()
        and c.shown().max() < 1
    ),
)
show(teapot.with_(marks=["clamped"]), panel="Display")

# %% [markdown]
# The brightest pixel has {brightest:.2f}, and {clipped:.0f} % of the pixels on the teapot are cut
# off: a flat patch where the highlight should rise. The pictures *as shown* do not add up, then:
# their codes, which go from 0 to 255, are off by up to {codes:.0f}.

# %% [markdown] minutes=2
# ## Try this
#
# The teapot with all four terms. What you need is in the panels Terms and Display.


# %%
def light_of(setup):
    """The pixels on the objects, times the exposure, as numbers that are not cut off."""
    picture = pg.render(setup, (120, 90))
    return picture.pixels[picture.coverage == 1] * setup.settings.exposure


show(teapot, panel="Terms")
goal(
    "Make a silhouette: the teapot in one colour, but not in black.",
    reached=lambda setup: (
        len(light_of(setup)) > 500
        and light_of(setup).max() > 0.05
        and np.ptp(light_of(setup), axis=0).max() < 1e-6
    ),
    hint="Which terms do not ask for the normal?",
    solution=teapot.with_(terms=["ambient", "emissive"]),
)
goal(
    "With all four terms on: let the brightest pixel be between 0.9 and 1, so that nothing is cut "
    "off.",
    reached=lambda setup: (
        len(setup.settings.terms) == 4
        and min(setup.settings.weights.values()) > 0.3
        and 0.9 < light_of(setup).max() <= 1
    ),
    hint="Weaken what is too bright (a weight in Terms), or all of it (the exposure in Display).",
    solution=teapot.with_(exposure=0.58),
)
