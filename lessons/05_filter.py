# %% [markdown] minutes=1
# # Colours that filter: ⊗
#
# A lemon is yellow, but only under white light. Take it into a darkroom with its red lamp, and
# it is red; a blueberry there is black. No colour sits in the lemon itself: what does?

# %%
import numpy as np

import playground as pg
from playground.lesson import figure, goal, number, predict, show

BLACK, BACKDROP = (0, 0, 0), (0.12, 0.12, 0.14)  # on which a black ball can be seen


def lamp(colour):
    """A directional light from above the right shoulder, of one colour and nothing else."""
    return pg.DirectionalLight(to_light=(0.5, 0.6, 1), diffuse=colour, ambient=BLACK)


def ball(material, light):
    """A matt ball under one lamp."""
    setup = pg.load("sphere").with_(lights=[lamp(light)], diffuse=material, background=BACKDROP)
    return setup.with_(terms=["diffuse"], eye=(0, 0, 6), fov=25)


def colour(setup):
    """The colour of the ball's brightest pixel, with its largest channel made 1."""
    picture = pg.render(setup, (120, 120))
    pixels = picture.pixels[picture.coverage == 1]
    if not len(pixels):  # the camera looks elsewhere
        return np.zeros(3)
    brightest = pixels[pixels.sum(axis=1).argmax()]
    return brightest / max(brightest.max(), 1e-9)


show(ball((1, 1, 0), (1, 0, 0)), panel="Lights")

# %% [markdown] slides=[5] minutes=3
# ## White light on a yellow object
#
# White light is red, green and blue together: (1, 1, 1). An object that looks yellow in
# it reflects red and green, and absorbs blue.

# %%
yellow = ball((1, 1, 0), (1, 1, 1))
show(
    yellow,
    "White light (1, 1, 1) on a ball with $m_d$ = (1, 1, 0): yellow.",
    shows=lambda picture: (
        picture.pixels[..., :2].max() > 0.9 and picture.pixels[picture.coverage == 1, 2].max() == 0
    ),
    pixel=(0.55, 0.4),
    panel="Explain",
)
seen = colour(yellow)
# The same product in float32 for every channel: equal to a rounding.
for name, value, expected in zip(("red", "green", "blue"), seen, (1, 1, 0), strict=True):
    number(name, value, expected=expected, tolerance=1e-6)

# %% [markdown]
# What is left is ({red:.0f}, {green:.0f}, {blue:.0f}). So the material parameter is no colour that
# is *put* anywhere. It is a filter, one share for each channel:
#
# $$s_d \otimes m_d = (1, 1, 1) \otimes (1, 1, 0) = (1, 1, 0)$$
#
# where $\otimes$ multiplies component by component: red by red, green by green, blue by blue.
# Farther down the panel Explain draws it as bars: three of the light, three of the material, three
# of what is left.

# %% [markdown] tags=["notes"]
# ⊗ is neither the dot product (which gives one number) nor the cross product (which gives a
# vector at right angles). Ask which of the three makes sense for colours, and why.

# %% [markdown] slides=[5] minutes=3
# ## Red light on a blue ball
#
# In white light this ball is blue. Now the lamp is changed for a red one.

# %%
show(ball((0, 0, 1), (1, 1, 1)), panel="Lights")
predict(
    "A red lamp (1, 0, 0) shines on a blue ball, $m_d$ = (0, 0, 1). The ball is",
    "red",
    "blue",
    "purple: red and blue mixed",
    "black",
    answer="black",
    why=r"$(1, 0, 0) \otimes (0, 0, 1) = (0, 0, 0)$: the lamp has no blue to give, and the ball "
    "takes all of the red.",
)

# %%
lights = {"red lamp": (1, 0, 0), "green lamp": (0, 1, 0), "white lamp": (1, 1, 1)}
materials = {"yellow ball": (1, 1, 0), "blue ball": (0, 0, 1), "white ball": (1, 1, 1)}
SIZE = (200, 200)


def filtered(light):
    """Whether balls have light in a channel just where the lamp and the ball both have some."""
    return lambda *pictures: all(
        np.array_equal(
            picture.pixels[picture.coverage == 1].max(axis=0) > 0.01, np.multiply(light, m) > 0
        )
        for picture, m in zip(pictures, materials.values(), strict=True)
    )


for name, light in lights.items():
    figure(
        [pg.render(ball(material, light), SIZE) for material in materials.values()],
        f"Under a {name} each ball shows only what lamp and ball both have.",
        names=list(materials),
        shows=filtered(light),
    )
number("red_on_blue", colour(ball((0, 0, 1), (1, 0, 0))).max(), expected=0)
show(ball((0, 0, 1), (1, 0, 0)), pixel=(0.5, 0.5), panel="Explain")

# %% [markdown]
# Red light on blue leaves {red_on_blue:.0f}, in all three channels. "Purple" is what adding the
# two would give. *Lights* do add up, one lamp and another, but *filters* multiply.

# %% [markdown] minutes=3
# ## Lamps add, filters multiply
#
# So much for one lamp. What do two of them make? Here is the red one alone, on a white ball.

# %%
show(ball((1, 1, 1), (1, 0, 0)), panel="Lights")
predict(
    "Now a red lamp and a green lamp shine on the white ball from the same place. It looks",
    "brown, as when paints are mixed",
    "yellow",
    "black: a red filter lets no green through",
    answer="yellow",
    why="Each lamp is filtered by the white ball by itself, and the results are added: "
    "(1, 0, 0) + (0, 1, 0).",
)

# %%
both = ball((1, 1, 1), BLACK).with_(lights=[lamp((1, 0, 0)), lamp((0, 1, 0))])
one, other = (pg.render(ball((1, 1, 1), c), SIZE) for c in ((1, 0, 0), (0, 1, 0)))
together = pg.render(both, SIZE)
on_ball = together.coverage == 1
off = np.abs(together.pixels - one.pixels - other.pixels)[on_ball].max()
number("off", off, expected=0, tolerance=1e-6)  # two sums of the same float32 numbers
show(
    both,
    "A red and a green lamp on a white ball: yellow, the sum of both.",
    shows=lambda picture: (
        picture.pixels.max() > 0.5
        and picture.pixels[picture.coverage == 1, 2].max() == 0
        and np.allclose(picture.pixels[..., 0], picture.pixels[..., 1])
    ),
    panel="Lights",
)

# %% [markdown]
# The picture with both lamps is the sum of the pictures with one of them; the largest difference
# is {off:.0e}. That is a law of light, and it is why the terms and lights of the Phong model are
# simply summed.

# %% [markdown] tags=["notes"]
# Paints are filters on white paper: red paint takes green and blue away, green paint takes red and
# blue away, and what is left of both is little. That is the "brown" that people expect.

# %% [markdown] minutes=3
# ## Try this
#
# The ball is white. Change the lamp, or the ball, in the panels Lights and Material.

# %%
show(ball((1, 1, 1), (1, 1, 1)), panel="Lights")
goal(
    "Make the ball cyan (no red, as much green as blue) without touching its material.",
    reached=lambda setup: (
        set(setup.scene.objects[0].material.diffuse) == {1.0}
        and np.allclose(colour(setup), (0, 1, 1), atol=0.02)
    ),
    hint="Which channel must the lamp not have?",
    solution=ball((1, 1, 1), (0, 1, 1)),
)
goal(
    "Now under a yellow lamp: make the ball green by its material.",
    reached=lambda setup: (
        np.allclose(setup.scene.lights[0].diffuse, (1, 1, 0), atol=0.02)
        and np.allclose(colour(setup), (0, 1, 0), atol=0.02)
    ),
    hint="The lamp brings red and green. Which of them must the ball absorb? Its blue does not "
    "matter: try it.",
    solution=ball((0, 1, 1), (1, 1, 0)),
)
