# %% [markdown] slides=[16] minutes=1
# # Refraction and Snell's law
#
# A straw in a glass of water looks broken, and a pool looks shallower than it is. Neither is true.
# Light that goes from one medium into another changes its direction there. By how much, and does it
# always get through?

# %%
import numpy as np

import playground as pg
from playground.lesson import figure, goal, number, plot, predict, show

TRACED = {"method": "ray-tracing"}
SIZE = (240, 240)
WATER, GLASS = 1.333, 1.5  # refractive indices; air has 1.0
optics = pg.shading.optics
glass = pg.load("glass-of-water")


def is_straw(picture):
    """Which pixels are red."""
    red, green = picture.pixels[..., 0], picture.pixels[..., 1]
    return (red > 3 * green) & (red > 0.25)


show(
    glass,
    "A glass of water with a straw, which is straight.",
    shows=lambda picture: is_straw(picture)[20:270].sum() > 500,
    **TRACED,
)

# %% [markdown] slides=[16] minutes=4
# ## Snell's law
#
# A clear medium has a *refractive index* $n$: air 1, water 1.333, glass about 1.5. It says how many
# times slower light is there than in empty space. A ray that meets the boundary at an angle
# $\theta_1$ to the normal goes on at another angle, $\theta_2$.
#
# Here is a pool, full to the brim.

# %%
BLACK = {"diffuse": (0, 0, 0), "ambient": (0, 0, 0), "specular": (0, 0, 0)}
TILES = pg.Material(
    diffuse=(0.8, 0.3, 0), ambient=(1, 0.4, 0), specular=(0, 0, 0), texture="tiles.png"
)


def tiles(y, size):
    """A floor of tiles at this height."""
    return pg.Object(
        mesh="quad", material=TILES, transform=pg.Transform(translate=(0, y, 0), size=size)
    )


def clear(index):
    """A clear material without colour."""
    return pg.Material(**BLACK, transmittance=(1, 1, 1), index=index)


def water(index=WATER):
    """A lake of it, its surface at y = 0."""
    place = pg.Transform(translate=(0, -1.5, 0), scale=(30, 1.5, 30))
    return pg.Object(mesh="box", material=clear(index), transform=place)


pool = pg.load("sphere").with_(
    objects=[tiles(-2, 8), water()],
    lights=[pg.DirectionalLight(to_light=(0, 1, 0))],
    background=(0.5, 0.7, 0.9),
    eye=(0, 2, 6),
    target=(0, 0, 2.5359),
    fov=50,
    depth=6,
)
show(
    pool,
    "A pool of water, two metres deep, with tiles on its bottom.",
    shows=lambda picture: (
        picture.pixels[250:, :, 0].std() > 0.1 and picture.pixels[10, 240, 2] > 0.6
    ),
    **TRACED,
)
predict(
    "A ray meets the water at 60° to the normal. At which angle to the normal does it go on?",
    "60°: it goes straight on",
    "about 45°, which is 60° divided by 1.333",
    "about 40°",
    "about 70°",
    answer="about 40°",
    why=r"It is not the angles that are in proportion but their sines: $\sin 60° / 1.333$ = 0.65 "
    "is the sine of 40.5°. The ray bends towards the normal.",
)


# %%
def angle(a, b):
    """The angle between two directions in degrees; from its tangent, which is exact everywhere."""
    return np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b))


def bending(setup, y):
    """The angles to the normal before and behind the surface, for a pixel of the middle column."""
    first = pg.explain(setup, (SIZE[0] // 2, y), SIZE, **TRACED).nodes[0]
    if first.object != 1:
        return None
    (inside,) = (child for child in first.children if child.kind == "refraction")
    return angle(first.direction, -first.normal), angle(inside.direction, -first.normal)


measured = np.array([found for y in range(0, 240, 8) if (found := bending(pool, y))])
sines = np.sin(np.radians(measured))
# Directions of float64, an angle from a tangent: 1e-9 leaves many digits to spare.
number("snell_off", np.abs(sines[:, 0] - WATER * sines[:, 1]).max(), expected=0, tolerance=1e-9)
theta_1, theta_2 = bending(pool, SIZE[1] // 2)
# The camera looks down at 30°; the middle of the pixel is 0.1° beside the middle of the picture.
number("theta_1", theta_1, expected=60, tolerance=0.2)
number("theta_2", theta_2, expected=40.5, tolerance=0.2)
number("side_1", 1.0 * np.sin(np.radians(theta_1)), expected=0.866, tolerance=0.003)
number("side_2", WATER * np.sin(np.radians(theta_2)), expected=0.866, tolerance=0.003)
plot(
    "Rays into the pool: the sines of the two angles lie on a straight line of slope 1/1.333.",
    x=(r"$\sin\theta_1$ in air", sines[::-1, 0]),
    y=r"$\sin\theta_2$ in water",
    curves={"measured": sines[::-1, 1], "straight on": sines[::-1, 0]},
    shows=lambda inside, straight: np.allclose(WATER * inside, straight) and straight.max() > 0.9,
)
show(pool, pixel=(0.5, 0.5), panel="Explain", **TRACED)

# %% [markdown]
# Measured at the ray in the middle: $\theta_1$ = {theta_1:.1f}° and $\theta_2$ = {theta_2:.1f}°.
# That is *Snell's law*,
#
# $$n_1 \sin\theta_1 = n_2 \sin\theta_2$$
#
# with {side_1:.3f} on its left and {side_2:.3f} on its right. The same law holds for the way back:
# swap 1 and 2.

# %% [markdown] tags=["notes"]
# Why sines: along the surface, the crests of the wave must fit on both sides. A column of
# soldiers that marches from the road into mud at a slant turns towards the normal. Snell found
# the law in 1621; Ibn Sahl had it in 984.

# %% [markdown] slides=[16] minutes=3
# ## How deep is the pool?
#
# A coin lies on the bottom, two metres deep. You look straight down on it.

# %%
coin = pg.Object(
    mesh="disc",
    tessellation=128,
    material=pg.Material(**BLACK, emissive=(1, 1, 0)),
    transform=pg.Transform(translate=(0, -1.999, 0), size=0.5),
)
HEIGHT, DEPTH = 6, 1.999


def above_coin(index):
    """The coin from straight above, under a medium of this index."""
    return pool.with_(
        objects=[tiles(-2, 8), water(index), coin],
        eye=(0, HEIGHT, 0),
        target=(0, 0, 0),
        up=(0, 0, 1),
        fov=12,
    )


def coin_width(picture):
    """The diameter of the coin in pixels, from its area."""
    return 2 * np.sqrt(np.sum(picture.pixels[..., 1] > 0.75) / np.pi)


predict(
    "With water in the pool, the coin looks",
    "smaller: the water spreads the rays",
    "as large as without",
    "larger, as if it were nearer",
    answer="larger, as if it were nearer",
    why="Rays from the coin bend away from the normal when they leave the water. To the eye they "
    "seem to come from a point higher up.",
)

# %%
dry, wet = (pg.render(above_coin(index), SIZE, **TRACED) for index in (1.0, WATER))
figure(
    [dry, wet],
    "The same coin, 2 m deep, seen from 6 m above: without water and with it.",
    names=["air", "water"],
    shows=lambda a, b: 1.05 < coin_width(b) / coin_width(a) < 1.08 and coin_width(a) > 50,
)
larger = coin_width(wet) / coin_width(dry)
apparent = (HEIGHT + DEPTH) / larger - HEIGHT
# A disc of 140 pixels, its area known to some ten of 15000: 0.04 % of the distance, 0.003. And
# tan θ is no sine: at the rim of the coin, at 4.7°, that makes 0.2 % of the depth.
number("larger", larger, expected=8 / 7.5, tolerance=0.002)
number("apparent", apparent, expected=DEPTH / WATER, tolerance=0.015)
number("ratio", apparent / DEPTH, expected=1 / WATER, tolerance=0.008)
show(above_coin(WATER), **TRACED)

# %% [markdown]
# It is {larger:.3f} times as large. So it seems to be {apparent:.2f} m below the surface, where
# it is 2 m below: the pool looks {ratio:.2f} times as deep. For small angles a sine is nearly the
# angle, and this number is $1/1.333$. Mind that when you jump in.

# %% [markdown] slides=[16] minutes=4
# ## Total internal reflection
#
# Now dive, and look up from below. Going out, light bends *away* from the normal:
# $\sin\theta_2 = 1.333 \sin\theta_1$. But no sine is larger than 1.

# %%
dive = pool.with_(
    objects=[tiles(-2, 30), water()],
    eye=(0, -1.5, 0),
    target=(0, 0, 0),
    up=(0, 0, 1),
    fov=120,
)
predict(
    "From under water you look up to the surface at a slant of 60° to the normal. You see",
    "the sky near the horizon, darkened",
    "a black surface",
    "the bottom of the pool",
    answer="the bottom of the pool",
    why=r"$1.333 \sin 60°$ = 1.15: no angle has this sine, so no light gets through. All of it is "
    "reflected, and the surface is a perfect mirror.",
)


# %%
def window_angle(picture):
    """The half-angle, in degrees, of the disc in which the sky is seen: the bottom has no blue."""
    radius = np.sqrt(np.sum(picture.pixels[..., 2] > 0.01) / np.pi)
    height = picture.size[1] / 2
    return np.degrees(np.arctan(radius / height * np.tan(np.radians(60))))


up = pg.render(dive, SIZE, **TRACED)
critical = np.degrees(np.arcsin(1 / WATER))
number("critical", critical, expected=48.6, tolerance=0.02)
lowest = np.degrees(
    np.arcsin(np.sin(np.radians(70)) / WATER)
)  # of light from 20° above the horizon
number("rim", critical - lowest, expected=3.8, tolerance=0.05)
# The radius is 79 pixels; half of one, where they are densest, is 0.2°.
number("window", window_angle(up), expected=critical, tolerance=0.2)
figure(
    pg.render(dive, (480, 360), **TRACED),
    "From under water: the whole sky is in a round window, around it the bottom is mirrored.",
    shows=lambda picture: (
        picture.pixels[180, 240, 2] > 0.8
        and picture.pixels[180, 20, 2] < 0.01 < 0.2 < picture.pixels[180, 20:60, 0].max()
    ),
)

# %% [markdown]
# Beyond the *critical angle*, where $\sin\theta_1 = n_2/n_1$, everything is reflected. From water
# to air that is {critical:.1f}°. In the picture the sky ends at {window:.1f}°, counted in
# pixels: the whole sky, from horizon to horizon, is squeezed into that window. Divers know it;
# glass fibres live on it. From air into water there is no such angle.

# %%
tilted = dive.with_(target=(0, -0.5, 1), up=(0, 1, 0), fov=40)


def middle_ray(setup):
    """The first ray of the pixel in the middle."""
    return pg.explain(setup, (120, 120), (241, 241), **TRACED).nodes[0]


show(tilted, panel="Explain", pixel=(0.5, 0.5), **TRACED)
goal(
    "Find the critical angle: look up so that the ray in the middle meets the surface within half "
    "a degree of it, from under water.",
    reached=lambda setup: (
        (node := middle_ray(setup)).critical is not None
        and abs(node.incidence - node.critical) < 0.5
    ),
    hint="Turn the camera (panel Scene, camera, target) until the edge of the window is in the "
    "middle. Explain tells both angles.",
    solution=dive.with_(target=(0, 0, 1.5 * np.tan(np.radians(critical))), up=(0, 1, 0), fov=40),
)

# %% [markdown] tags=["notes"]
# In the window open the Snell bench: a ray that one can turn, with both angles and the shares. Or
# drag the camera in this view slowly past the edge of the window: the lowest 20° of the sky are
# pressed into {rim:.1f}° there.

# %% [markdown] slides=[16] minutes=4
# ## How much goes through
#
# Snell says where the refracted ray goes. How much light goes there, and how much into the
# reflection ray? *Fresnel's equations* say it: a share $F$ is reflected, $1 - F$ is refracted.

# %%
predict(
    "Light falls on glass, $n$ = 1.5, straight from the front. What share is reflected?",
    "nothing: it is clear",
    "about 4 %",
    "about 20 %",
    answer="about 4 %",
    why=r"$((1.5 - 1)/(1.5 + 1))^2$ = 0.04. You see it in a window at night.",
)

# %%
degrees = np.linspace(0, 90, 181)
cosine, sine = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
entering = optics.fresnel(cosine, sine, 1.0, GLASS)
guessed = optics.schlick(cosine, sine, 1.0, GLASS)
leaving = optics.fresnel(cosine, sine, GLASS, 1.0)
plot(
    "The share that glass reflects. Along the surface it is all, and from inside much sooner.",
    x=(r"$\theta_1$ in degrees", degrees),
    y="$F$",
    curves={"into the glass": entering, "Schlick's": guessed, "out of the glass": leaving},
    shows=lambda a, b, c: (
        all(np.diff(a) > -1e-6)
        and a[-1] > 0.99
        and 0.03 < abs(a - b).max() < 0.04
        and all(c[degrees > 42] == 1)
    ),
)
number("front", 100 * entering[0], expected=4, tolerance=1e-9)
number("slanted", 100 * entering[160], expected=38.8, tolerance=0.05)
number("off", 100 * np.abs(guessed - entering).max(), expected=3.57, tolerance=0.01)
number("off_at", degrees[np.abs(guessed - entering).argmax()], expected=85, tolerance=0.25)
number("edge", np.degrees(np.arcsin(1 / GLASS)), expected=41.8, tolerance=0.02)
rays = pg.explain(pool, (120, 120), SIZE, **TRACED).nodes
reflected, refracted = rays[0].children
number(
    "pool_share",
    rays[0].fresnel,
    expected=float(
        optics.fresnel(np.cos(np.radians(theta_1)), np.sin(np.radians(theta_1)), 1.0, WATER)
    ),
    tolerance=1e-12,
)
number("together", reflected.weight[0] + refracted.weight[0], expected=1, tolerance=1e-12)
show(pool, pixel=(0.5, 0.5), panel="Explain", **TRACED)

# %% [markdown]
# From the front glass reflects {front:.0f} %, at 80° already {slanted:.0f} %, and along the surface
# everything. Out of the glass it is 100 % from the critical angle of {edge:.1f}° on. Schlick's
# approximation, $F_0 + (1 - F_0)(1 - \cos\theta_1)^5$, needs no square root and is off by at most
# {off:.1f} % of the light, at {off_at:.0f}°. For going out, it must be given the angle *outside*.
#
# In the pool, the ray in the middle is reflected by {pool_share:.3f}; the weights of its two
# children add up to {together:.0f}. No light is lost, and none is made.

# %% [markdown] tags=["notes"]
# Look at a pool: straight down one sees the bottom, far away the sky. Fresnel's equations
# treat two polarisations; $F$ is the mean of both. At Brewster's angle (56° for glass) one of
# them is not reflected at all: polarised sunglasses.

# %% [markdown] slides=[16] minutes=2
# ## The broken straw
#
# Back to the glass. Fill it with something that has the colour of water, but the index of air, and
# with something that has an even higher index than water.


# %%
def filled(index):
    """The glass with a liquid of this index; object 3 is the water."""
    objects = list(glass.scene.objects)
    objects[3] = glass.with_(objects=[objects[3]], index=index).scene.objects[0]
    return glass.with_(objects=objects)


def straw_at(picture, row):
    """The middle of the straw in a row of pixels."""
    return np.mean(np.nonzero(is_straw(picture)[row])[0])


def bent(picture):
    """By how many pixels the straw in row 175 is beside where its upper part points to."""
    slope = (straw_at(picture, 85) - straw_at(picture, 5)) / 80
    return straw_at(picture, 175) - (straw_at(picture, 85) + 90 * slope)


pictures = [pg.render(filled(index), SIZE, **TRACED) for index in (1.0, WATER, 1.6)]
wide = np.sum(is_straw(pictures[1])[15])
# Each middle is known to half a pixel; as 90 rows are extrapolated from 80, to 1.5 together.
number("straight", abs(bent(pictures[0])), expected=0, tolerance=1.5)
number("broken", -bent(pictures[1]), expected=9.5, tolerance=1.5)
number("wide", wide, expected=7, tolerance=1)
figure(
    pictures,
    "The straw in liquids of index 1, 1.333 and 1.6: the same straw, more and more broken.",
    names=["n = 1", "water", "n = 1.6"],
    shows=lambda a, b, c: is_straw(c)[:100].sum() > 300 and abs(bent(a)) < 2 < 5 < abs(bent(b)),
)
show(glass, panel="Material", **TRACED)

# %% [markdown]
# With index 1 the lower part of the straw is {straight:.1f} pixels beside the line of its upper
# part; in water it is {broken:.0f} pixels to the left of that line, more than its width of
# {wide:.0f}. Of a clear thing one sees only that the index changes, and its colour, if it has one.
# In the window, choose object 3 in the panel Material and turn its index.

# %% [markdown] minutes=2
# ## Try this
#
# A ball of glass over a floor of tiles. It shows the floor above, and the sky below.

# %%


def crystal(index):
    """A ball of this index over tiles."""
    ball = pg.Object(mesh="sphere", material=clear(index))
    return pool.with_(objects=[ball, tiles(-1.2, 8)], eye=(0, 1.2, 6), target=(0, 0, 0), fov=30)


def ball_index(setup):
    """The refractive index of the ball."""
    return setup.scene.objects[0].material.index


show(crystal(GLASS), panel="Material", **TRACED)
goal(
    "Make the ball invisible, without taking it away or making it less clear.",
    reached=lambda setup: (
        middle_ray(setup).object == 0  # the ball is still there
        and pg.compare(
            pg.render(setup, (120, 90), **TRACED),
            pg.render(setup.with_(objects=setup.scene.objects[1:]), (120, 90), **TRACED),
        ).max
        < 0.01
    ),
    hint="It has no colour. Of a clear thing without colour one sees only that the index changes.",
    solution=crystal(1.0),
)
goal(
    "Make it a diamond: light that is inside leaves it only within 24.4° of the normal.",
    reached=lambda setup: (
        ball_index(setup) > 1 and abs(np.degrees(np.arcsin(1 / ball_index(setup))) - 24.4) < 0.2
    ),
    hint=r"At the critical angle $n \sin 24.4° = 1$.",
    solution=crystal(2.42),
)

# %% [markdown]
# And write it yourself: copy `lessons/assignments/refract.py` (or `refract.glsl`), fill in the
# refracted direction, and ask `playground lesson 13 --check my_refract.py` what is right and what
# is likely wrong.
