# %% [markdown] minutes=1
# # The reflection vector
#
# A ball that bounces off a wall, a sunbeam off a mirror: both leave as they came, only on the
# other side. The specular term needs that direction at every point of a picture, millions of
# times a second. How does one compute it without a single angle?
#
# In the window $l$ (yellow) is the way to the light, and $r$ (pink) the way of its reflection.

# %%
import numpy as np

import playground as pg
from playground.lesson import figure, goal, number, predict, show

NONE = (0, 0, 0)
reflection, unit = pg.shading.vector.reflection, pg.shading.vector.unit


def direction(degrees):
    """The unit vector this far to the right of straight up, in the plane of the picture."""
    return np.array([np.sin(np.radians(degrees)), np.cos(np.radians(degrees)), 0])


def degrees_between(a, b):
    """The angle between two unit vectors, in degrees."""
    return np.degrees(np.arccos(np.clip(a @ b, -1, 1)))


left = pg.DirectionalLight(to_light=tuple(direction(-50)))
mirror = pg.load("quad").with_(lights=[left], eye=(0, 1.2, 5), target=(0, 0.3, 0), fov=32)
show(mirror, pixel=(0.5, 0.6), panel="Explain")


# %% [markdown] slides=[6] minutes=3
# ## Along the normal, and across
#
# The light vector $l$ points from the surface *to the light*, the normal $n$ stands upright on
# the surface, and both have length 1. Cut $l$ into two pieces:
#
# - the piece along the normal is $(n \cdot l) \, n$: its length is the cosine between the two;
# - the rest, $s = l - (n \cdot l) \, n$, lies in the surface.
#
# A mirror keeps the first and turns the second around, so that the *reflection vector* is
#
# $$r = (n \cdot l) \, n - s = 2 \, n \, (n \cdot l) - l$$


# %%
def arrow(vector, colour, start=NONE):
    """A glowing rod with a tip, from ``start`` along a vector in the plane of the picture."""
    glow = pg.Material(diffuse=NONE, specular=NONE, ambient=NONE, emissive=colour)
    start, length = np.array(start), np.linalg.norm(vector)
    turn = (0, 0, -np.degrees(np.arctan2(vector[0], vector[1])))
    parts = {  # the middle of each, as a share of the length, and its half-height
        "cylinder": (0.5 - 0.08 / length, (0.018, 0.5 * length - 0.08, 0.018)),
        "cone": (1 - 0.08 / length, (0.055, 0.08, 0.055)),
    }
    return [
        pg.Object(
            mesh=mesh,
            material=glow,
            transform=pg.Transform(translate=tuple(start + at * vector), rotate=turn, scale=scale),
        )
        for mesh, (at, scale) in parts.items()
    ]


GREEN, YELLOW, PINK, BLUE = (0, 0.6, 0.4), (0.95, 0.85, 0.1), (0.9, 0.4, 0.7), (0.3, 0.6, 0.9)
slate = pg.Material(diffuse=(0.3, 0.3, 0.35), specular=NONE, ambient=NONE)


def drawing(arrows, tilt=0):
    """A plate, tilted to the right, with arrows (vector, colour, start) on it."""
    turned = pg.Transform(size=1.1, rotate=(0, 0, -tilt))
    items = [pg.Object(mesh="disc", transform=turned, material=slate)]
    items += [part for each in arrows for part in arrow(*each)]
    setup = pg.load("sphere").with_(objects=items, background=(0.06, 0.06, 0.08))
    setup = setup.with_(lights=[pg.DirectionalLight(to_light=(0, 1, 0.3), ambient=NONE)])
    return setup.with_(eye=(0, 0.6, 5), target=(0, 0.42, 0), fov=18)


def middle_of(picture, colour):
    """Where the pixels of a colour are on average, from the middle: to the right, and up."""
    height, width = picture.pixels.shape[:2]
    y, x = np.nonzero(np.abs(picture.pixels - colour).max(axis=2) < 0.01)
    if not len(x):
        return np.full(2, np.nan)
    return np.array([x.mean() - (width - 1) / 2, (height - 1) / 2 - y.mean()])


normal, to_light = direction(0), direction(-50)
along = (normal @ to_light) * normal
across = to_light - along
r = along - across
number("same", np.abs(r - reflection(normal, to_light)).max(), expected=0, tolerance=4e-15)
show(
    drawing(
        [
            (normal, GREEN),
            (to_light, YELLOW),
            (across, BLUE, along),
            (-across, BLUE, along),
            (r, PINK),
        ]
    ),
    "On a plate: $n$ (green), $l$ (yellow), and $r$ (pink). In blue the piece $s$ of $l$ that lies "
    "in the surface, and the same turned around.",
    shows=lambda picture: (
        np.allclose(
            middle_of(picture, PINK), middle_of(picture, YELLOW) * (-1, 1), rtol=0, atol=1.5
        )
        and middle_of(picture, PINK)[0] > 20
    ),
)

# %% [markdown]
# No angle, no square root: a dot product, a multiplication, a subtraction. All of it is in the
# plane of $n$ and $l$, so it holds as it stands in three dimensions.

# %% [markdown] tags=["notes"]
# Draw it on the board first, and let the class find $s$. "$2 n (n \cdot l)$" is twice the way up
# to the foot of $l$ on the normal: go there along $l$, and as far again, and you are at
# $r + l$. In the window the arrows can be seen from all sides.

# %% [markdown] slides=[6] minutes=3
# ## Is it true?
#
# Two things must hold for any $n$ and $l$: $r$ has length 1, and leaves at the angle at which
# the light came in. On paper, with $n \cdot n = l \cdot l = 1$:
#
# $$r \cdot r = 4 (n \cdot l)^2 - 4 (n \cdot l)^2 + 1 = 1$$
#
# $$n \cdot r = 2 (n \cdot l) - n \cdot l = n \cdot l$$
#
# And by computer, for ten thousand pairs of directions:

# %%
normals, lights = unit(np.random.default_rng(1).normal(size=(2, 10_000, 3)))
mirrored = reflection(normals, lights)
lengths, in_out = np.linalg.norm(mirrored, axis=1), np.sum(normals * (mirrored - lights), axis=1)
# float64: 34 roundings of 1.1e-16 in each component, so 4e-15, and √3 times that in a length.
number("length_off", np.abs(lengths - 1).max(), expected=0, tolerance=7e-15)
number("cosine_off", np.abs(in_out).max(), expected=0, tolerance=7e-15)
back = reflection(normals, mirrored)
number("twice", np.abs(back - lights).max(), expected=0, tolerance=2e-14)  # twice, and 2 n (n·r)

# %% [markdown]
# The lengths are off 1 by at most {length_off:.0e}, and the cosines differ by at most
# {cosine_off:.0e}: roundings. Reflected twice, $l$ comes back.

# %%
predict(
    "The light stays where it is, and you tilt the mirror by 10°. By how much does the reflected "
    "ray turn?",
    "5°",
    "10°",
    "20°",
    answer="20°",
    why="Tilt it away from the light: the angle between $l$ and $n$ grows by 10°, so that between "
    "$n$ and $r$ grows by 10°, too, and $n$ itself has turned by 10°.",
)

# %%
tilted = direction(10)
turned = reflection(tilted, to_light)
number("turned", degrees_between(r, turned), expected=20, tolerance=1e-9)  # arccos of 1e-16
before = [(normal, GREEN), (to_light, YELLOW), (r, PINK)]
after = [(tilted, GREEN), (to_light, YELLOW), (turned, PINK)]
figure(
    [pg.render(drawing(before), (320, 240)), pg.render(drawing(after, 10), (320, 240))],
    "Before and after tilting the plate by 10°: $l$ (yellow) stays, $n$ (green) turns by 10°, $r$ "
    "(pink) by 20°.",
    names=["before", "tilted by 10°"],
    shows=lambda a, b: (
        middle_of(b, PINK)[1] < middle_of(a, PINK)[1] - 10
        and np.abs(middle_of(b, YELLOW) - middle_of(a, YELLOW)).max() < 2
        and middle_of(b, GREEN)[0] > middle_of(a, GREEN)[0] + 5
    ),
)
show(drawing(after, 10))

# %% [markdown]
# It turns by {turned:.0f}°. That is why a dent in a car shows in its reflections long before one
# sees it in the paint, and why highlights are so small: over a curved surface $r$ turns twice as
# fast as the normal.

# %% [markdown] slides=[6] minutes=4
# ## What goes wrong
#
# The formula trusts you: $n$ and $l$ must have length 1, and $l$ must point *to* the light. Take a
# ball with the light at the eye, so that the highlight $(\max(r \cdot v, 0))^{20}$ belongs in
# its middle.

# %%
bulb = pg.PointLight(position=(0, 0, 3))
sphere = pg.load("sphere").with_(lights=[bulb], tessellation=10, eye=(0, 0, 6), fov=25)
show(sphere, pixel=(0.55, 0.45), panel="Explain")
predict(
    "Somebody forgets to make $l$ unit length, and it is 2 long. How bright is the middle of the "
    "highlight, compared with what is right?",
    "as bright",
    "twice as bright",
    "20 times as bright",
    "a million times as bright",
    answer="a million times as bright",
    why=r"$r$ is twice as long as it should be, so $r \cdot v$ is 2 in place of 1, and $2^{20}$ is "
    "more than a million.",
)

# %%
SIZE = 151  # odd, so that a pixel is exactly in the middle
x, y = np.meshgrid(*2 * [np.linspace(-1.1, 1.1, SIZE)])
on_ball = x**2 + y**2 <= 1
ball = np.stack([x, -y, np.sqrt(np.maximum(1 - x**2 - y**2, 0))], axis=-1)  # its normals
to_eye = np.array([0, 0, 1])


def highlight(normals, to_light):
    """The specular factor with sh = 20 on the ball."""
    r = reflection(normals, np.broadcast_to(to_light, normals.shape))
    return np.maximum(r @ to_eye, 0) ** 20


made = {
    "right": highlight(ball, to_eye),
    "l 2 long": highlight(ball, 2 * to_eye),
    "n 0.9 long": highlight(0.9 * ball, to_eye),
    "l reversed": highlight(ball, -to_eye),
}
brightness = [np.where(on_ball, 0.12 + factor, 0) for factor in made.values()]
figure(
    [pg.Image(np.repeat(b[..., None], 3, axis=2).astype(np.float32)) for b in brightness],
    "The highlight of a light at the eye, and three mistakes: $l$ twice as long, $n$ a tenth too "
    "short, $l$ from the light instead of to it.",
    names=list(made),
    shows=lambda right, long, short, reverse: (
        right.pixels[75, 75, 0] > 1 > right.pixels[75, 25, 0] > 0.1
        and np.sum(long.pixels > 1) > 5 * np.sum(right.pixels > 0.5)
        and short.pixels.max() < 0.13
        and reverse.pixels[75, 7, 0] > 0.4 > 0.2 > reverse.pixels[75, 75, 0]
    ),
)
middle = {name: factor[SIZE // 2, SIZE // 2] for name, factor in made.items()}
number("right", middle["right"], expected=1)
number("million", middle["l 2 long"] / 1e6, expected=2**20 / 1e6)
# At 0.9 the normal counts twice: 2 · 0.81 − 1, to the power of 20.
number("short", middle["n 0.9 long"], expected=0.62**20, tolerance=1e-17)
number("rim", highlight(np.array([1, 0, 0]), -to_eye), expected=1)
number("reversed_middle", middle["l reversed"], expected=0)
show(sphere, pixel=(0.55, 0.45), panel="Bug zoo")

# %% [markdown]
# - With $l$ twice as long the middle is {million:.2f} million times too bright. The screen shows a
#   white disc with a sharp edge.
# - A normal a tenth too short leaves {short:.5f} of the highlight: it is gone. Normals that were
#   interpolated over a triangle *are* too short, so a shader makes them unit length again.
# - With $l$ reversed, $r$ is reversed as well: the highlight has {reversed_middle:.0f} in the
#   middle and {rim:.0f} at the rim, where the ball should be dark.
#
# The panel Bug zoo makes the first two in the real shaders, on a ball of few triangles. Tick one,
# and see what becomes of the highlight.
#
# A trap with a name: `reflect` of GLSL and HLSL wants the vector *to the surface*. In the words of
# the lecture, $r$ is `reflect(-l, n)`.

# %% [markdown] tags=["notes"]
# In the Bug zoo they are "l not normalised" and "Normals not renormalised"; the bulb of this step
# is 2 away from the nearest point of the ball. With a reversed $l$ the diffuse term is black as
# well, which helps to find the mistake: $n \cdot l$ is negative wherever the light should arrive.

# %% [markdown] minutes=2
# ## An aside: Blinn's halfway vector
#
# In 1977 James Blinn proposed to do without $r$. The highlight is brightest where $n$ stands
# half-way between $l$ and $v$. So take that direction, $h = (l + v) / |l + v|$, and ask how far
# $n$ is from it: $(\max(n \cdot h, 0))^{sh}$.

# %%
glossy = pg.load("sphere").with_(
    lights=[pg.DirectionalLight(to_light=(0, 0, 1), ambient=(0.15, 0.15, 0.15))],
    specular=(1, 1, 1),
    diffuse=NONE,
    background=NONE,
    shininess=20,
    eye=(0, 0, 600),
    fov=0.24,
)
near = glossy.with_(eye=(0, 0, 6), fov=24)
show(near, panel="Material")
predict(
    "With the same $sh = 20$ in both formulas, Blinn's highlight is",
    "smaller",
    "of the same size",
    "larger, about twice as wide",
    answer="larger, about twice as wide",
    why="Move the eye by 10°: $v$ and $r$ are 10° more apart, but $h$ follows by 5° only. The same "
    "exponent acts on half of the angle.",
)

# %%
kinds = {"Phong, sh = 20": ("phong", 20), "Blinn, sh = 20": ("blinn", 20)}
kinds["Blinn, sh = 80"] = ("blinn", 80)
setups = [glossy.with_(highlight=formula, shininess=sh) for formula, sh in kinds.values()]
phong, same, fourfold = (pg.render(setup, (200, 200)) for setup in setups)


def width(setup):
    """How wide the part of the highlight is that is at least half as bright as its middle."""
    alone = pg.render(setup.with_(terms=["specular"]), (441, 441))
    return np.sqrt(np.sum(alone.pixels[..., 0] >= 0.5))


figure(
    [phong, same, fourfold],
    "The same ball with Phong's highlight, with Blinn's, and with Blinn's at four times the "
    "shininess.",
    names=list(kinds),
    shows=lambda a, b, c: (
        pg.compare(a, b).rmse > 0.1 and 0 < pg.compare(a, c).rmse < 0.1 * pg.compare(a, b).rmse
    ),
)
# r turns twice as fast as the normal, so Phong's is half as bright at half of this angle, Blinn's
# at all of it. The widths are about 50 and 100 pixels, known to one.
half = np.arccos(0.5 ** (1 / 20))
wider = np.sin(half) / np.sin(half / 2)
number("wider", width(setups[1]) / width(setups[0]), expected=wider, tolerance=wider * 0.03)
number("alike", width(setups[2]) / width(setups[0]), expected=1, tolerance=0.03)
show(near, panel="Terms")

# %% [markdown]
# It is {wider:.1f} times as wide. With four times the exponent the two can hardly be told apart:
# the widths are as {alike:.2f} to 1. Blinn's is what OpenGL had built in, and many programs use it
# still. The panel Terms switches between the two.

# %% [markdown] tags=["notes"]
# "Half the angle" holds exactly where $n$, $l$ and $v$ are in one plane, as here. On a floor seen
# at a slant they are not: there Blinn's highlight gets long and narrow, like that of a lamp on
# a wet road, and Phong's stays round. Both can be tried in the last step, with the panel Terms.

# %% [markdown] minutes=2
# ## Try this
#
# A glossy floor and a bulb. The arrows belong to the point in the middle of the picture. In the
# panels Lights and Scene you can move the bulb and tilt the floor.

# %%
gloss = pg.Material(diffuse=(0.2, 0.3, 0.45), specular=(0.8, 0.8, 0.8), shininess=100)
start = pg.load("sphere").with_(
    objects=[pg.Object(mesh="quad", material=gloss, transform=pg.Transform(size=2))],
    lights=[pg.PointLight(position=(2, 3, 1))],
    eye=(0, 2, 4),
)


def rho(setup):
    """The angle between r and v, in degrees, at the point in the middle of the picture."""
    corners = pg.explain(setup, (20, 15), (41, 31)).corners
    return corners[0].lights[0].rho if corners and corners[0].lights else 180


show(start, pixel=(0.5, 0.5), panel="Lights")
goal(
    "Move the bulb until the highlight is in the middle of the picture: $\\rho$ less than 2°.",
    reached=lambda setup: (
        setup.scene.objects == start.scene.objects
        and setup.camera.eye == start.camera.eye
        and rho(setup) < 2
    ),
    hint="The eye is at (0, 2, 4), and the floor is a mirror: where must the bulb be, so that the "
    "light comes in as it goes out to the eye?",
    solution=start.with_(lights=[pg.PointLight(position=(0, 2, -4))]),
)
upright = unit(unit([2, 3, 1]) + unit([0, 2, 4]))  # the normal half-way between l and v
tilt = np.degrees([np.arcsin(upright[2]), 0, np.arctan2(-upright[0], upright[1])])
goal(
    "From the start again: leave the bulb and the eye alone, and tilt the floor until it is there.",
    reached=lambda setup: (
        setup.scene.lights == start.scene.lights
        and setup.camera.eye == start.camera.eye
        and rho(setup) < 2
    ),
    hint="The normal must stand half-way between $l$ and $v$. Turn it about x and about z (Scene, "
    "place, rotate), and watch $r$ turn twice as fast.",
    solution=start.with_(
        objects=[
            pg.Object(
                mesh="quad",
                material=gloss,
                transform=pg.Transform(size=2, rotate=tuple(tilt)),
            )
        ]
    ),
)
