# %% [markdown] minutes=1
# # Bui Tuong Phong
#
# Around 1970 a computer could draw a ball, but it looked like a cut stone: a curved surface
# was made of flat triangles, and one saw each of them. What must be computed, and where, so
# that it looks round and shiny? One man's answer is what this lecture is about.

# %%
import numpy as np

import playground as pg
from playground.lesson import figure, goal, number, plot, predict, show

WAYS = {"flat": "flat", "Gouraud": "per-vertex", "Phong": "per-fragment"}  # who, and where
show(pg.load("sphere").with_(tessellation=12, shading="flat"), panel="View")

# %% [markdown] slides=[3] minutes=2
# ## A life in dates
#
# - 1942: born in Hanoi
# - 1964 to 1966: bachelor in Grenoble
# - 1968: engineer in Toulouse
# - 1971 to 1973: PhD at the University of Utah, supervised by Ivan Sutherland
# - 1973: the illumination model
#
# The teapot comes from Utah, too. Here it is with few triangles, drawn in three ways: as one
# could before, as Henri Gouraud, another student there, had proposed in 1971, and as Phong did.

# %%
teapot = pg.load("teapot").with_(tessellation=3)
pots = [pg.render(teapot.with_(shading=shading), (200, 155)) for shading in WAYS.values()]


def colours(picture):
    """How many colours there are in a picture."""
    return len(np.unique(picture.pixels.reshape(-1, 3), axis=0))


figure(
    pots,
    "One teapot, one light, the same triangles. What differs is where the model is evaluated: once "
    "per triangle, at the vertices, at every point.",
    names=list(WAYS),
    shows=lambda flat, gouraud, phong: (
        2 < colours(flat) < 64 * 3**2 < colours(gouraud)  # the teapot has fewer triangles than that
        and phong.pixels.max() > 1.1 * gouraud.pixels.max() > 0  # the highlight
    ),
)
show(teapot.with_(shading="flat"), panel="View")

# %% [markdown] tags=["notes"]
# Bui is his family name and Phong his given name, by which Vietnamese people are called: hence
# "Phong shading". The thesis is of 1973; the article that everybody cites, *Illumination for
# Computer Generated Pictures*, appeared in the Communications of the ACM in June 1975. In the
# window, the panel View switches between the three; let the class find the differences first.

# %% [markdown] slides=[3] minutes=3
# ## The problem: facets
#
# To see what each way does, take something simpler than a teapot: a column with twelve flat
# sides that stands for a round one. One side faces us, and the light comes from behind us.
# For now there is only the diffuse term, which is a lesson of its own: the brightness is
# $n \cdot l$, the cosine of the angle between the normal and the direction to the light.


# %%
def column(shading, terms, distance=600):
    """A white column of twelve sides, one of them in front, seen from ``distance``."""
    item = pg.Object(
        mesh="cylinder",
        tessellation=12,
        transform=pg.Transform(rotate=(0, 15, 0)),
        material=pg.Material(diffuse=(1, 1, 1), specular=(1, 1, 1), shininess=20),
    )
    light = pg.DirectionalLight(to_light=(0, 0, 1), ambient=(0, 0, 0))
    setup = pg.load("sphere").with_(objects=[item], lights=[light], background=(0, 0, 0))
    setup = setup.with_(eye=(0, 0, distance), fov=150 / distance)
    return setup.with_(shading=shading, terms=terms)


# The picture shows 150/600 of a degree, seen from 600: PITCH is the width of a pixel.
WIDE = 401
PITCH = 2 * 600 * np.tan(np.radians(0.25 / 2)) / WIDE
place = PITCH * (np.arange(WIDE) - WIDE // 2)  # the column reaches from -1 to 1
inside = np.abs(place) < 0.95


def across(shading, term):
    """The brightness along a line across the column."""
    return pg.render(column(shading, [term]), (WIDE, WIDE)).pixels[WIDE // 2, inside, 0]


lines = {who: across(shading, "diffuse") for who, shading in WAYS.items()}


def off(line):
    """How far the brightness is off that of a round column, away from its outline."""
    cosine = np.sqrt(1 - place[inside] ** 2)  # where the sine is the place
    return np.abs(line - cosine)[np.abs(place[inside]) < 0.7].max()


plot(
    "The diffuse term across the column: stairs, a chain of straight pieces, and nearly the "
    "curve of a round column.",
    x=("place across the column", place[inside]),
    y="brightness",
    curves=lines,
    shows=lambda flat, gouraud, phong: (
        np.unique(flat.round(4)).size == 3 and off(phong) < 0.02 < off(gouraud) < off(flat)
    ),
)
largest = {who: np.abs(np.diff(line)).max() for who, line in lines.items()}
# Sides whose normals are 30° and 60° from the light; float32.
number("jump_flat", largest["flat"], expected=np.cos(np.pi / 6) - 0.5, tolerance=1e-6)
# Gouraud's steepest piece runs from the vertex at 45° to that at 75°. Points up to 1 nearer than
# the axis look larger by 1/600.
a, b = np.radians((45, 75))
steepest = (np.cos(a) - np.cos(b)) / (np.sin(b) - np.sin(a)) * PITCH
number("jump_gouraud", largest["Gouraud"], expected=steepest, tolerance=steepest / 300)
show(column("flat", ["diffuse"], 12), panel="View")

# %% [markdown]
# *Flat* shading evaluates the model once per triangle. From one side to the next the brightness
# jumps by {jump_flat:.2f}: an edge for the eye, which is good at finding edges.
#
# *Gouraud* evaluates it at the vertices, with the normals of the round column, and lets the
# *colours* change evenly in between. The largest jump from one pixel to the next is
# {jump_gouraud:.2f}. For a matt column that is nearly all one could wish.

# %% [markdown] tags=["notes"]
# What remains of Gouraud's are kinks, where the straight pieces meet: the eye sees them as
# bright or dark lines (Mach bands). Phong's article begins with them.

# %% [markdown] slides=[3] minutes=3
# ## Two ideas
#
# Phong wanted pictures that look like the real thing, and real things shine. He brought two ideas:
#
# - **A highlight in one formula.** Light is reflected mostly along one direction $r$, and the less
#   the farther the eye is from it: $(r \cdot v)^{sh}$, with an exponent for how shiny the
#   surface is. That is neither physics nor a table of measurements. It looks right and costs
#   little.
# - **Interpolate normals, not colours.** Let the normal $n$ change evenly over the triangle, make
#   it length 1 again, and evaluate the formula at every point of the picture.
#
# The first became one term of a sum, which is now called the Phong model: *diffuse*, *specular*,
# *ambient* and *emissive* term. The next lessons take them one by one:
#
# $$\max(n \cdot l, 0) \, s_d \otimes m_d + (\max(r \cdot v, 0))^{sh} \, s_s \otimes m_s$$
#
# $$+ \; s_a \otimes m_a + m_e$$

# %%
predict(
    "The same column, now with the highlight alone, $sh = 20$, in Gouraud's way: the formula at "
    "the vertices, colours in between. What will be seen on the side in front?",
    "a highlight in its middle, as on a round column",
    "a highlight that fills all of it",
    "almost nothing",
    answer="almost nothing",
    why=r"In the middle of that side $r = v$, but no vertex is there. At its edges the normal is "
    "turned by 15° and $r$ by twice as much: $(\\cos 30^\\circ)^{20}$ is about 0.06.",
)

# %%
lines = {who: across(shading, "specular") for who, shading in WAYS.items()}
plot(
    "The highlight across the column. It should be a narrow peak: flat makes it a block, Gouraud "
    "loses it, Phong finds it.",
    x=("place across the column", place[inside]),
    y="brightness",
    curves=lines,
    shows=lambda flat, gouraud, phong: (
        min(flat.max(), phong.max()) > 0.99 and 0.05 < gouraud.max() < 0.06
    ),
)
# At distance 600 the eye sees the edges of the side 0.026/600 rad off: 20 tan 30° of that,
# 5e-3 of 0.056, which is 3e-4.
number("gouraud", lines["Gouraud"].max(), expected=np.cos(np.radians(30)) ** 20, tolerance=3e-4)
number("phong", lines["Phong"].max(), expected=1, tolerance=1e-5)  # a power of 20 in float32
wide = {who: np.sum(line >= 0.5) * PITCH for who, line in lines.items()}
# A side of the column, and for Phong twice the place where r is 15° from v; to a pixel.
number("wide_flat", wide["flat"], expected=2 * np.sin(np.radians(15)), tolerance=PITCH)
half = np.arccos(0.5 ** (1 / 20)) / 2
number("wide_round", 2 * np.sin(half), expected=0.26, tolerance=0.005)  # as it is written below
number("wide_phong", wide["Phong"], expected=2 * np.sin(half), tolerance=2 * PITCH)
reddish = column("per-vertex", ["diffuse", "specular"], 12).with_(diffuse=(0.5, 0.25, 0.15))
show(reddish, beside="per-fragment", panel="View")

# %% [markdown]
# The brightest pixel is {phong:.0f} in Phong's way and {gouraud:.2f} in Gouraud's. Flat shading has
# a highlight, but it fills the whole side: {wide_flat:.2f} wide, where the one on a round column is
# {wide_round:.2f} and Phong's is {wide_phong:.2f}.
#
# So the two ideas belong together: the formula falls off so fast that it must be evaluated at every
# point. In 1973 that was too much for any picture that moves. Today it is what the fragment
# shader of a GPU does, for millions of points sixty times a second.

# %% [markdown] minutes=3
# ## Try this
#
# The column in Gouraud's way, diffuse and specular. In the panels Scene and View you can turn
# it, divide it more finely, and change the shading; in Lights the light can be turned.


# %%
def pictures(setup):
    """The highlight alone in Gouraud's way, and the whole in Gouraud's and in Phong's way."""
    alone = setup.with_(terms=[t for t in setup.settings.terms if t == "specular"])
    every = [alone.with_(background=(0, 0, 0)), setup, setup.with_(shading="per-fragment")]
    return [pg.render(each, (240, 180)).pixels for each in every]


def honest(setup):
    """Whether the setup still has Gouraud's shading, and a material that shines as much."""
    material = setup.scene.objects[0].material
    return setup.settings.shading == "per-vertex" and material.shininess >= 20


material = reddish.scene.objects[0].material
turned = [pg.Object(mesh="cylinder", tessellation=12, material=material)]  # an edge in front
show(reddish, panel="Scene")
goal(
    "Bring the highlight back, without more sides and without Phong's second idea.",
    reached=lambda setup: (
        honest(setup)
        and setup.scene.objects[0].tessellation == 12
        and pictures(setup)[0].max() > 0.9
    ),
    hint="It is computed at the vertices only. Bring an edge of the column to where $r = v$: turn "
    "the column (Scene, place), or the light.",
    solution=reddish.with_(objects=turned),
)
goal(
    "Make Gouraud as good as Phong: let the two pictures differ nowhere by more than 1 %.",
    reached=lambda setup: (
        honest(setup)
        and pictures(setup)[0].max() > 0.5
        and np.abs(pictures(setup)[1] - pictures(setup)[2]).max() < 0.01
    ),
    hint="The finer the triangles, the less there is to interpolate. How many sides does it take?",
    solution=reddish.with_(tessellation=256),
)
