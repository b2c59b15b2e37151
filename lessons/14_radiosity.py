# %% [markdown] slides=[18] minutes=2
# # Radiosity
#
# A room that was really built, measured and photographed: the Cornell box. One lamp, white walls,
# one red, one green, and two white blocks. Look at the left side of the tall block, and
# at the right side of the short one. There is no red lamp in that room, and no mirror. And the
# ceiling is lit, though the lamp hangs in it and shines straight down.

# %%
import numpy as np

import playground as pg
from playground.lesson import figure, goal, number, plot, predict, show

box = pg.load("cornell-box").with_(patches=300)
SIZE = (480, 360)
ceiling = (slice(22, 42), slice(110, 160))  # rows and columns of the picture
red_side = (slice(180, 290), slice(160, 168))  # of the tall block
green_side = (slice(255, 310), slice(328, 335))  # of the short one


def tinge(pixels):
    """Red over green, with that of the lamp for 1."""
    red, green, _ = pixels.reshape(-1, 3).mean(axis=0)
    return red / green / (20.6222 / 10.9083)


show(
    box,
    "The Cornell box by radiosity: a side of the tall block is red, one of the short block green, "
    "and the ceiling is not black.",
    method="radiosity",
    shows=lambda picture: (
        tinge(picture.pixels[red_side]) > 3
        and tinge(picture.pixels[green_side]) < 0.6
        and picture.pixels[ceiling].min(axis=(0, 1))[0] > 0.03
    ),
)
predict(
    "The ray tracer of lesson 12 follows shadow rays, reflection rays and refraction rays. Which "
    "of these does *it* get, in this room without mirrors and glass?",
    "the shadows of the blocks",
    "the light on the ceiling",
    "the red on the white block",
    answer="the shadows of the blocks",
    why="Its shadow rays ask for the lamp alone. Light that comes from one matt wall to the next "
    "has no ray of its own.",
)

# %%
traced = pg.render(box.with_(ambient_weight=0), SIZE, method="ray-tracing")
solved = pg.render(box, SIZE, method="radiosity")
number("ceiling_traced", traced.pixels[ceiling].max(), expected=0)
figure(
    [traced, solved],
    "The same room, the same lamp. Ray tracing without an ambient term leaves black what the lamp "
    "does not see.",
    names=["ray tracing", "radiosity"],
    shows=lambda a, b: (
        a.pixels[red_side].max() == 0
        and b.pixels[red_side].min(axis=(0, 1))[0] > 0.03
        and b.pixels.sum() > 1.2 * a.pixels.sum()
    ),
)

# %% [markdown]
# Traced, the ceiling gets exactly {ceiling_traced:.0f}. The Phong model has the ambient term for
# this light: one number, the same everywhere. *Radiosity* computes it.

# %% [markdown] tags=["notes"]
# The box was built at Cornell University; Goral, Torrance, Greenberg and Battaile presented the
# method in 1984, with a simpler box. The left wall is red for the viewer; the geometry and the
# colours here are the measured ones. Let the class name all that the ray traced picture lacks.

# %% [markdown] slides=[18] minutes=4
# ## Every surface shines
#
# The *radiosity* of a surface is the rate at which light leaves it: its brightness. All surfaces
# are cut into *patches*, small flat pieces, and each of them gets one radiosity $B_i$. It is what
# the patch emits by itself, $E_i$, and the share $\rho_i$ that it reflects of what arrives:
#
# $$B_i = E_i + \rho_i \sum_j f_{ij} \, B_j$$
#
# As many equations as patches, and as many unknowns. The numbers $f_{ij}$, the *form factors*, say
# how much the patches see of each other. Nothing else is known of the scene.

# %%
predict(
    "Patch $i$ lies on the ceiling. Over which patches $j$ must the sum in its equation go?",
    "over those of the lamp: they are the light sources",
    "over those that the lamp shines on",
    "over all that it sees",
    answer="over all that it sees",
    why="Each patch sends out light, its own or reflected. A lamp is a patch whose $E$ is not 0, "
    "and that is the only difference.",
)


# %%
def matt(colour, glow=(0, 0, 0)):
    """A material with a diffuse colour, that emits the colour ``glow``."""
    return pg.Material(diffuse=colour, emissive=glow, specular=(0, 0, 0), ambient=(0, 0, 0))


# The lamp of the box is a light in the scene's list of lights. Put an object into its place:
plate = pg.Object(
    mesh="quad",
    material=matt((0, 0, 0), glow=box.scene.lights[0].diffuse),
    transform=pg.Transform(
        translate=(278, 548.8, 279.5), rotate=(180, -90, 0), scale=(52.5, 1, 65)
    ),
)
glowing = box.with_(lights=[], objects=[*box.scene.objects, plate])
by_lamp, by_plate = (pg.radiosity(setup).solve() for setup in (box, glowing))
# The same patches, in the same order: the same numbers, bit for bit.
number("differ", np.abs(by_lamp.light - by_plate.light).max(), expected=0)
number("patches", len(by_lamp.patches), expected=300, tolerance=10)  # "about" 300

row = by_lamp.form_factors.matrix()[by_lamp.patches.centre[:, 1].argmax()]
shining = by_lamp.light.max(axis=1) > 0
number("senders", np.sum((row > 0) & shining), expected=200, tolerance=20)
number("lamps", np.sum((row > 0) & (by_lamp.patches.emission.max(axis=1) > 0)), expected=0)
show(box, method="radiosity", panel="Radiosity")

# %% [markdown]
# The box has {patches:.0f} patches. With a glowing *object* for a lamp the solution differs by
# {differ:.0f}: the algorithm does not distinguish light sources from the objects that
# they light. A patch of the ceiling receives light from {senders:.0f} others, and
# {lamps:.0f} of them are lamps.

# %% [markdown] tags=["notes"]
# The slide says "each surface works itself as a light source". For the proof in numbers, ask
# `playground explain cornell-box --method radiosity --pixel 320 40`: it lists the patches that send
# most to this piece of the ceiling. $\rho$ and $E$ are colours; the system is solved three times,
# for red, green and blue. The program keeps $B/\pi$, as every colour of the project does; the
# equation is the same.

# %% [markdown] slides=[18] minutes=4
# ## The form factor
#
# $f_{ij}$ is the fraction of the light leaving one patch that arrives at the other. For two
# *points* with a vector $v$ between them, the lecture has
#
# $$f_{ij} = \frac{\cos\theta_i \, \cos\theta_j}{\pi \, \|v\|^2}$$
#
# per area of the second. Both cosines are Lambert's: a slanted sender shows less
# of itself, a slanted receiver catches less.

# %%
predict(
    "Two small patches face each other. Now one of them is moved twice as far away and turned "
    "by 60°. The form factor is",
    "half of what it was",
    "a quarter",
    "an eighth",
    answer="an eighth",
    why=r"$\|v\|^2$ grows four times, and $\cos 60°$ halves what is left.",
)

# %%
point_to_point = pg.shading.form_factor.point_to_point
up, down = np.array([0, 0, 1]), np.array([0, 0, -1])
tilted = np.array([np.sin(np.radians(60)), 0, -np.cos(np.radians(60))])
near = point_to_point((0, 0, 0), up, (0, 0, 1), down)
far = point_to_point((0, 0, 0), up, (0, 0, 2), tilted)
number("near", near, expected=1 / np.pi, tolerance=1e-15)  # both cosines 1, distance 1
number("eighth", far / near, expected=1 / 8, tolerance=1e-15)

exact = pg.shading.form_factor.opposite_rectangles(1, 1, 1)


def by_points(n):
    """The form factor of unit squares, a side apart: both cut into n × n, centre to centre."""
    middle = (np.arange(n) + 0.5) / n
    x, y = (a.ravel() for a in np.meshgrid(middle, middle))
    here, there = np.stack([x, y, 0 * x], axis=1), np.stack([x, y, 0 * x + 1], axis=1)
    pairs = point_to_point(here[:, None], up, there[None, :], down)
    return np.mean(np.sum(pairs / n**2, axis=1))


cuts = np.arange(1, 9)
estimates = np.array([by_points(n) for n in cuts])
plot(
    "Cut finer, the sum over pairs of points comes down to the form factor of the squares.",
    x=("pieces along a side", cuts),
    y="$f_{ij}$",
    curves={"centre to centre": estimates, "exact": np.full(len(cuts), exact)},
    shows=lambda sums, true: all(np.diff(sums) < 0) and 0 < sums[-1] / true[-1] - 1 < 0.01,
)
number("exact", exact, expected=0.199825, tolerance=1e-6)  # Howell, C-11
number("too_large", 100 * (estimates[0] / exact - 1), expected=59.3, tolerance=0.1)
# It falls as 1/n²: at n = 8 a quarter of that at n = 4, but for a term in 1/n⁴.
at_4 = 100 * (estimates[3] / exact - 1)
number("at_8", 100 * (estimates[7] / exact - 1), expected=at_4 / 4, tolerance=0.02)
far_off = point_to_point((0, 0, 0), up, (0, 0, 10), down)
far_exact = pg.shading.form_factor.opposite_rectangles(1, 1, 10)
number("at_10", 100 * (far_off / far_exact - 1), expected=0.67, tolerance=0.01)
show(pg.load("facing-plates").with_(patches=100), method="radiosity", panel="Form factors")

# %% [markdown]
# Two unit squares that face each other at distance 1: from centre to centre $1/\pi$ = {near:.3f}.
# But the true fraction is {exact:.3f}. The formula holds for points: most other pairs of points
# are farther apart and see each other at a slant. It is {too_large:.0f} % too large here,
# {at_8:.1f} % with 8 × 8 pieces, and {at_10:.2f} % for whole squares ten sides apart. So it must be
# *integrated* over both patches. The next lesson shows how.

# %% [markdown] tags=["notes"]
# The exact number is the classic of the engineers' catalogues: 0.2, one fifth. Ask where the other
# four fifths go: past the plate. A common mistake is $\|v\|$ for its square, or no
# $\pi$: with it, all directions of the hemisphere together give 1.

# %% [markdown] slides=[18] minutes=2
# ## Who sees how much of whom
#
# A small lamp, half a metre wide, hangs one metre above the middle of a floor of two by two
# metres. Its area is a sixteenth of the floor's. Much of its light arrives at the floor.

# %%
squares = [
    pg.Object(mesh="quad", material=matt((0.5, 0.5, 0.5))),
    pg.Object(
        mesh="quad",
        material=matt((0, 0, 0), glow=(10, 10, 10)),
        transform=pg.Transform(translate=(0, 1, 0), rotate=(180, 0, 0), size=0.25),
    ),
]
show(
    pg.load("facing-plates").with_(
        objects=squares, lights=[], patches=300, eye=(1.2, 0.7, 3.2), target=(0, 0.4, 0), fov=40
    ),
    "The lamp, and the floor that it lights.",
    method="radiosity",
    shows=lambda picture: (
        picture.pixels[245:265, 230:250, 0].mean() > 3 * picture.pixels[5, 5, 0] > 0
        and picture.pixels.max() > 9
    ),
)
lamp_corners = 0.25 * np.array([(-1, 1, 4), (1, 1, 4), (1, -1, 4), (-1, -1, 4)])  # from below
floor_corners = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)])
pair = pg.shading.polygon_pair.pair_form_factor
to_floor, to_lamp = pair(lamp_corners, floor_corners), pair(floor_corners, lamp_corners)
predict(
    f"Of the lamp's light {100 * to_floor:.0f} % arrives at the floor. How much of the light that "
    "leaves the floor arrives at the lamp?",
    f"{100 * to_floor:.0f} % as well: the way is the same",
    f"{100 * to_floor / 16:.1f} %, a sixteenth of that",
    f"{100 - 100 * to_floor:.0f} %, the rest",
    answer=f"{100 * to_floor / 16:.1f} %, a sixteenth of that",
    why="The formula for two points is the same both ways. Summed over the patches, the lamp's "
    "share is per area of the lamp, the floor's per area of the floor.",
)


# %%
def cut(corners, n):
    """The centres of n × n pieces of a parallelogram."""
    s, t = (a.reshape(-1, 1) for a in np.meshgrid(*[(np.arange(n) + 0.5) / n] * 2))
    return corners[0] + s * (corners[1] - corners[0]) + t * (corners[3] - corners[0])


# The same by points, 24 × 24 on both: the error, as 1/n², is 0.1 % of 0.54.
summed = point_to_point(cut(lamp_corners, 24)[:, None], down, cut(floor_corners, 24), up)
number("to_floor", 100 * to_floor, 100 * np.mean(np.sum(summed * 4 / 24**2, axis=1)), 0.1)
number("to_lamp", 100 * to_lamp, expected=100 * to_floor / 16, tolerance=1e-12)

# %% [markdown]
# {to_floor:.1f} % and {to_lamp:.2f} %: with the areas $A$,
#
# $$A_i \, f_{ij} = A_j \, f_{ji}$$
#
# which is called *reciprocity*. It saves half of the work, and every table of form factors
# can be checked with it.

# %% [markdown] slides=[18] minutes=3
# ## Two plates, by hand
#
# The two unit squares again. Both reflect half of what arrives, and the left one also glows:
# $E_1 = 1$. With $f$ for the {exact:.3f} of above there are two equations:
#
# $$B_1 = 1 + 0.5 \, f \, B_2 \qquad B_2 = 0 + 0.5 \, f \, B_1$$

# %%
predict(
    "How bright is the right plate, which does not glow?",
    "0.5: it reflects half",
    "0.1: it gets a fifth, and reflects half of it",
    "0.2: it gets a fifth",
    answer="0.1: it gets a fifth, and reflects half of it",
    why=r"And a little more: $0.1/(1 - 0.01)$, because some light goes to and fro again.",
)


# %%
def plates(gap, patches):
    """Two unit squares that face each other; the left one glows."""
    places = [(-gap / 2, -90), (gap / 2, 90)]
    materials = [matt((0.5, 0.5, 0.5), (1, 1, 1)), matt((0.5, 0.5, 0.5))]
    squares = [
        pg.Object(
            mesh="quad",
            material=material,
            transform=pg.Transform(translate=(x, 0, 0), rotate=(0, 0, turn), size=0.5),
        )
        for (x, turn), material in zip(places, materials, strict=True)
    ]
    setup = pg.load("facing-plates").with_(objects=squares, lights=[], patches=patches)
    return setup.with_(convergence=1e-9, exposure=5)


system = pg.radiosity(plates(1, 2))
program = system.solve().light[:, 0]
half = 0.5 * exact
number("left", program[0], expected=1 / (1 - half**2), tolerance=1e-6)  # form factors in float32
number("right", program[1], expected=half / (1 - half**2), tolerance=1e-6)
fine = pg.radiosity(plates(1, 200)).solve()
side = fine.light[fine.patches.owner == 1, 0]
number("mean", side.mean(), expected=program[1], tolerance=0.01)  # E alike: little else changes
show(
    plates(1, 200),
    "The same with 200 patches: the right plate is brightest in its middle.",
    method="radiosity",
    shows=lambda picture: (
        picture.pixels[170:190, 310:330, 0].mean() > 1.15 * picture.pixels[80:90, 265:280, 0].mean()
        and picture.pixels[175:185, 315:325, 0].mean() > 0.08
    ),
)
number("brightest", side.max(), expected=0.5 * 0.2394565 * 1.01, tolerance=0.005)

# %% [markdown]
# Put one equation into the other: $B_1 = 1 / (1 - (0.5 f)^2)$. That is {left:.4f}, and
# {right:.4f} for $B_2$, as the program finds. The plate that glows has become brighter than
# 1: it lights the other one, which lights it.
#
# With one patch for each plate, one number must do for all of it. With 200, the right plate has
# up to {brightest:.3f} in its middle, and {mean:.3f} on average. Within a patch, radiosity is
# taken for constant: that is the error one makes, and smaller patches are the remedy.

# %% [markdown] tags=["notes"]
# Let them solve the two equations on paper. Series of bounces: 1, then 0.1, then 0.01: the
# geometric series of the glowing plate. In the window, the panel Radiosity changes the number of
# patches.

# %% [markdown] slides=[18] minutes=3
# ## Colours that bleed
#
# Back to the red side of the white block. How red is the light that arrives there? Let us measure
# red over green, with the lamp's own ratio for 1.


# %%
def arriving_at(setup, block, direction):
    """The tinge of the light that arrives at the side of a block, to the left (1) or right (-1)."""
    result = pg.radiosity(setup)
    patches = result.patches
    side = (patches.owner == block) & (patches.normal[:, 0] * direction > 0.9)
    return tinge(result.arriving[side] * patches.area[side, None])


def painted(setup, number, colour):
    """The setup with one of its objects painted."""
    objects = list(setup.scene.objects)
    old = objects[number]
    objects[number] = pg.Object(mesh=old.mesh, material=matt(colour), transform=old.transform)
    return setup.with_(objects=objects)


SHORT, TALL, RED_WALL = 4, 5, 2
# Cut into 2,400 patches it is 6.22 and 0.400. Of the 300 patches these sides have six and four, and
# each has but one value: that is up to a tenth off.
number("red", arriving_at(box, TALL, 1), expected=6.22, tolerance=0.62)
number("green", arriving_at(box, SHORT, -1), expected=0.400, tolerance=0.04)
show(box, method="radiosity")

# %% [markdown]
# It is {red:.1f} at the left side of the tall block: much redder than the lamp. At the right side
# of the short one it is {green:.1f}: greener.

# %%
predict(
    "The red wall is painted white, like the others. The left side of the tall block is then",
    "still reddish: the block itself has become red",
    "as white as the lamp, or a trace greener",
    "black: it had all of its light from the red wall",
    answer="as white as the lamp, or a trace greener",
    why="The light comes from the same wall, but that reflects all colours now. What is left is a "
    "little from the green one.",
)

# %%
white = painted(box, RED_WALL, (0.74, 0.74, 0.75))
number("white", arriving_at(white, TALL, 1), expected=0.96, tolerance=0.03)
show(white, method="radiosity")
pictures = [
    pg.render(box.with_(light_shown=shown), (320, 240), method="radiosity")
    for shown in ("direct", "indirect", "all")
]
figure(
    pictures,
    "Straight from the lamp; by way of other patches; both. The colours bleed in the second.",
    names=["direct", "indirect", "all"],
    shows=lambda direct, indirect, both: (
        np.allclose(direct.pixels[120:190, 107:111], 0)
        and tinge(indirect.pixels[120:190, 107:111]) > 3
        and np.abs(direct.pixels + indirect.pixels - both.pixels)[50:].mean()
        < 0.01 * both.pixels[50:].mean()  # corners are kept within what is around them, each apart
    ),
)

# %% [markdown]
# With a white wall it is {white:.2f} at the tall block. Nobody has told the program of red blocks:
# each wall filters the light that it passes on, by ⊗, and the system of equations adds it all up.

# %% [markdown] minutes=2
# ## Try this
#
# The two plates. Each has a *place* in the panel Scene.


# %%
def share(setup):
    """The fraction of the light leaving the first object that arrives at other ones."""
    result = pg.radiosity(setup.with_(patches=60))
    try:
        first = result.patches.owner == 0
    except pg.PlaygroundError:  # nothing is left that has an area
        return np.nan
    if not first.any():
        return np.nan
    area, rows = result.patches.area[first], result.form_factors.rows(np.flatnonzero(first))
    return area @ rows[:, ~first].sum(axis=1) / area.sum()


show(plates(1, 100), method="radiosity", panel="Scene")
goal(
    "Bring the plates so close together that each gets half of the other's light.",
    reached=lambda setup: 0.47 < share(setup) < 0.53,
    hint="At a gap of 1 it is a fifth, at a gap of 0 it would be all.",
    solution=plates(0.41, 100),
)
goal(
    "Let no light at all pass from one plate to the other, without taking one away.",
    reached=lambda setup: len(setup.scene.objects) == 2 and share(setup) < 1e-6,
    hint="One of the two cosines has to be 0, or less.",
    solution=plates(-1, 100),
)

# %% [markdown]
# And write it yourself: copy `lessons/assignments/form_factor.py` (or `form_factor.glsl`), fill
# it in, and ask `playground lesson 14 --check my_form_factor.py` what is right and what is likely
# wrong.
