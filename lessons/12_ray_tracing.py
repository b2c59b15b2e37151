# %% [markdown] slides=[15] minutes=1
# # Ray tracing
#
# A mirror shows the room, and a glass ball shows it upside down. Local illumination cannot draw
# either: a point would have to know what stands elsewhere. In 1980 Turner Whitted let it
# find out, by sending *rays*. Which rays, and how many of them, does one pixel need?

# %%
import numpy as np

import playground as pg
from playground.lesson import figure, goal, number, plot, predict, show

SIZE = (240, 180)
TRACED = {"method": "ray-tracing"}
room = pg.load("whitted-room")
show(room, **TRACED)


def rays_behind(setup, x, y):
    """The tree of rays behind a pixel of a picture of 480 by 360."""
    return pg.explain(setup, (x, y), (480, 360), **TRACED)


def shadow_rays(node):
    """The rays from the end of a ray to the lamps."""
    return [ray for light in node.lights for ray in light.rays]


# %% [markdown] slides=[15] minutes=3
# ## One primary ray, three secondary rays
#
# The *primary ray* goes from the eye through a pixel into the scene. Where it meets a surface,
# up to three *secondary rays* are spawned:
#
# - a *shadow ray* to each lamp: does its light arrive here?
# - a *reflection ray*, mirrored about the normal, if the surface mirrors;
# - a *refraction ray* through the surface, if it is transparent.
#
# The last two are rays like the first: where they meet a surface, everything begins again.

# %%
show(
    room,
    "Whitted's room: a mirror ball, a glass ball, a lamp at the ceiling.",
    shows=lambda picture: picture.pixels[190:240, 150:210].std() > 0.05,
    pixel=(240.5 / 480, 340.5 / 360),
    panel="Explain",
    **TRACED,
)
predict(
    "A pixel shows the matt floor in the shadow of the mirror ball. Which secondary rays are sent?",
    "none, as nothing arrives",
    "a shadow ray, which is stopped on its way",
    "a shadow ray and a reflection ray",
    answer="a shadow ray, which is stopped on its way",
    why="Whether the lamp can be seen from there is known only after one has asked. The floor "
    "neither mirrors nor lets anything through.",
)

# %%
on_floor, in_shadow = rays_behind(room, 240, 340), rays_behind(room, 160, 275)
in_mirror, in_glass = rays_behind(room, 180, 240), rays_behind(room, 330, 240)
(asked,), (stopped,) = shadow_rays(on_floor.nodes[0]), shadow_rays(in_shadow.nodes[0])
number("arrives", asked.share.max(), expected=1)
number("blocked", stopped.share.max(), expected=0)
number("blocker", stopped.blocker, expected=6)  # the mirror ball is object 6
number("mirror_children", len(in_mirror.nodes[0].children), expected=1)
number("glass_children", len(in_glass.nodes[0].children), expected=2)

# %% [markdown]
# In front, on the floor, the shadow ray arrives with a share of {arrives:.0f} of the light; in the
# shadow {blocked:.0f} of it arrives, since the ray is stopped by the mirror ball. What is
# left there is the ambient term. From the mirror {mirror_children:.0f} ray goes on, from the glass
# {glass_children:.0f} do.

# %% [markdown] tags=["notes"]
# Click on the floor, the shadow, the mirror and the glass in turn: the window draws the rays. Our
# mirror has no diffuse colour, so its shadow ray is asked only where a highlight could be. Rays
# go backwards, from the eye to the lamp: most light of a lamp never reaches the eye.

# %% [markdown] slides=[15] minutes=4
# ## The tree behind a pixel
#
# Take the pixel in the glass. At every boundary of glass a ray splits: a share $F$ is reflected
# (Fresnel's equations say how much), and $1 - F$ goes through. So the rays form a tree, and each
# brings the colour at its end, times the shares of all boundaries on the way.

# %%
predict(
    "If every ray splits in two, and rays are followed for six bounces: how many rays does a "
    "pixel need?",
    "7",
    "13",
    "127",
    answer="127",
    why=r"1 + 2 + 4 + ... + 64 = $2^7 - 1$. That is why one stops where a ray hardly counts.",
)

# %%
nodes = in_glass.nodes
first = nodes[0]
sine, cosine = np.sin(np.radians(first.incidence)), np.cos(np.radians(first.incidence))
fresnel = float(pg.shading.optics.fresnel(cosine, sine, 1.0, 1.5))
through = 1 - fresnel
# Which way each of the rays came. A ray through a ball meets it at the same angle everywhere.
ways = (1, fresnel, through, through * fresnel, through * fresnel * through, through * through)
for i, (node, weight) in enumerate(zip(nodes, ways, strict=True)):
    # Angles of a sphere, through a square root of float64: 1e-12 leaves three digits to spare.
    number(f"weight_{i}", node.weight[0], expected=weight, tolerance=1e-12)
    number(f"brings_{i}", node.added[0], expected=node.weight[0] * node.local[0], tolerance=1e-15)
number("worst", sum(2**depth for depth in range(7)), expected=127)
number("rays", len(nodes), expected=6)
number("fresnel", fresnel, expected=0.04, tolerance=1e-4)
number("sum", sum(node.added[0] for node in nodes), expected=in_glass.colour[0], tolerance=1e-12)
drawn = pg.render(room, (480, 360), **TRACED).pixels[240, 330]
# The GPU computes in float32; a few roundings of 6e-8 at each of three boundaries.
number("off", np.abs(drawn - in_glass.colour).max(), expected=0, tolerance=1e-5)
number("main", 100 * nodes[5].added[0] / in_glass.colour[0], expected=96, tolerance=1)
show(room, pixel=(330.5 / 480, 240.5 / 360), panel="Explain", **TRACED)

# %% [markdown]
# It would be {worst:.0f} rays at worst. In truth there are {rays:.0f}; each with its weight in the
# pixel, and the red that it brings:
#
# - ray 0, from the eye to the front of the ball: weight {weight_0:.3f}, brings {brings_0:.3f}, as
#   clear glass has no colour of its own
# - ray 1, reflected there, to the blue wall behind us: weight {weight_1:.3f}, brings {brings_1:.3f}
# - ray 2, refracted into the ball, to its back: weight {weight_2:.3f}, brings {brings_2:.3f}
# - ray 3, reflected back into the ball: weight {weight_3:.3f}, brings {brings_3:.3f}
# - ray 4, from there out of the ball: weight {weight_4:.3f}, brings {brings_4:.3f}
# - ray 5, refracted out at the back, to the wall: weight {weight_5:.3f}, brings {brings_5:.3f}
#
# The sum, {sum:.3f}, is the red of the pixel. One ray alone brings {main:.0f} % of it. As
# $F$ is only {fresnel:.2f} here, a ray that is reflected twice has a weight below 0.004: a screen
# could not show it, and it is not shot.

# %% [markdown] tags=["notes"]
# The panel Explain has this tree with all numbers; point at a ray, and the window marks it. The sum
# over the tree is Whitted's recursion, written out. The loss by that threshold is counted:
# see the next step.

# %% [markdown] slides=[17] minutes=4
# ## How deep?
#
# Two mirrors that face each other would keep a ray for ever. So a limit is set, the *depth*: how
# many bounces are followed.

# %%
predict(
    "The room is drawn with depth 1. Which of the balls does not show what it should?",
    "the mirror ball",
    "the glass ball",
    "both show what they should: one bounce is all they need",
    answer="the glass ball",
    why="To look through a ball of glass a ray must go in *and* out: two bounces.",
)

# %%
depths = list(range(9))
pictures = [pg.render(room.with_(depth=depth, threshold=0), SIZE, **TRACED) for depth in depths]
left = np.array([picture.left_out.mean for picture in pictures])
changed = [np.abs(a.shown() - pictures[8].shown()) for a in pictures]
figure(
    [pictures[depth] for depth in (0, 1, 2, 4)],
    "Depth 0: both balls are black. With 1 the mirror shows the room, with 2 the glass does.",
    names=[f"depth {depth}" for depth in (0, 1, 2, 4)],
    shows=lambda a, b, c, d: (
        np.median(a.pixels[95:120, 75:105]) < 0.01 < 0.1 < np.median(b.pixels[105:120, 80:100])
        and np.median(b.pixels[90:140, 145:185]) < 0.1 < np.median(c.pixels[90:140, 145:185])
        and d.pixels[95:120, 75:105].std() > 0.05
    ),
)
plot(
    "What is left out: the mean weight of the rays that are not shot any more.",
    x=("depth", depths),
    y="weight in %",
    curves={"mean over the picture": 100 * left},
    shows=lambda curve: all(np.diff(curve) < 0) and curve[0] > 10 and curve[8] < 0.01,
    log="y",
)
# Counted over 43 200 pixels; at the outline of a ball drivers may differ by one in a hundred.
number("left_0", 100 * left[0], expected=17.8, tolerance=0.3)
number("left_2", 100 * left[2], expected=1.25, tolerance=0.1)
number("left_8", 100 * left[8], expected=0.005, tolerance=0.001)
number("wrong_2", 100 * np.mean(changed[2].max(axis=2) > 1 / 255), expected=12.9, tolerance=1)
number("wrong_6", 100 * np.mean(changed[6].max(axis=2) > 1 / 255), expected=0.35, tolerance=0.1)
show(room.with_(depth=1), panel="Ray tracing", **TRACED)

# %% [markdown]
# A tracer that just stops does not know what it has missed. This one adds up the weights of the
# rays that it did not shoot: on average {left_0:.0f} % at depth 0 (the balls), {left_2:.1f} % at
# depth 2, {left_8:.3f} % at depth 8. By so much the picture would be brighter, had all
# of those rays met white light. With depth 2, {wrong_2:.0f} % of the pixels still differ
# visibly from depth 8, with depth 6 only {wrong_6:.1f} %.

# %% [markdown] tags=["notes"]
# Go through the depths with the slider in the panel Ray tracing. From 2 to 3 the change is in
# the mirror: the glass ball in it needs one bounce more. The menu has a sheet of all depths.

# %% [markdown] slides=[17] minutes=3
# ## The hall of mirrors
#
# Now two mirrors do face each other, and a small lamp glows between them. Each mirror reflects 80 %
# of the light.

# %%
BLACK = {"diffuse": (0, 0, 0), "ambient": (0, 0, 0), "specular": (0, 0, 0)}
MIRROR = pg.Material(**BLACK, reflectance=(0.8, 0.8, 0.8))


def wall(z, degrees):
    """A mirror across the hall."""
    place = pg.Transform(translate=(0, 0, z), rotate=(degrees, 0, 0), size=3)
    return pg.Object(mesh="quad", material=MIRROR, transform=place)


glow = pg.Material(**BLACK, emissive=(1, 1, 1))
lamp = pg.Object(mesh="sphere", material=glow, transform=pg.Transform(size=0.12))
hall = pg.load("sphere").with_(
    objects=[wall(-2, 90), wall(2, -90), lamp],
    lights=[],
    background=(0, 0, 0),
    eye=(1.2, 0.3, 1.5),
    target=(0, 0, -2),
    depth=5,
)


def lamps(setup):
    """How bright the lamp and its images are: all values in the picture but black."""
    picture = pg.render(setup, (480, 360), **TRACED)
    return np.unique(np.round(picture.pixels[..., 0], 4))[::-1][:-1]


predict(
    "Rays are followed for 5 bounces. How many lamps are in the picture, the real one included?",
    "2: one, and its image in the mirror before us",
    "6",
    "as many as one can tell apart: there is no end to them",
    answer="6",
    why="A ray that bounces once shows the first image, one that bounces five times the fifth. "
    "Then the tracer stops, unlike the light.",
)

# %%
seen = lamps(hall)
show(
    hall,
    "A lamp between two mirrors, with depth 5: itself and five images.",
    shows=lambda picture: len(np.unique(np.round(picture.pixels[..., 0], 4))) == 1 + 6,
    panel="Ray tracing",
    **TRACED,
)
number("lamps", len(seen), expected=6)
# Rounded to 4 digits when they were told apart.
for k in (1, 5):
    number(f"image_{k}", seen[k], expected=0.8**k, tolerance=5e-5)
enough = pg.shading.optics.bounces_until(0.8, 1 / 255)
number("enough", enough, expected=np.ceil(np.log(1 / 255) / np.log(0.8)) - 1)
# Where both mirrors glow as brightly as the lamp, images add up to 1 + ρ + ρ² + ... = 1 / (1 − ρ).
series = pg.shading.optics.mirror_series(0.8, np.array([5, enough]))
number("series_5", series[0], expected=sum(0.8**k for k in range(6)), tolerance=1e-12)
number("series", series[1], expected=5, tolerance=5 / 255)
# %% [markdown]
# There are {lamps:.0f} lamps. The first image has {image_1:.1f} of the brightness, the fifth
# {image_5:.2f}: each bounce multiplies by 0.8. If the mirrors themselves glowed, one would see
# $1 + 0.8 + 0.8^2 + ...$ in them: {series_5:.1f} after five bounces, where it should be
# {series:.1f}. Only after {enough:.0f} bounces is less than one 255th of that missing, the smallest
# step of an 8-bit screen.

# %%
goal(
    "Show ten lamps.",
    reached=lambda setup: len(lamps(setup)) >= 10,
    hint="Each bounce adds one. The depth is in the panel Ray tracing.",
    solution=hall.with_(depth=9),
)

# %% [markdown] tags=["notes"]
# The threshold in the panel Ray tracing cuts off where the depth does not: with 0.004 a ray of
# weight $0.8^{25}$ is not shot, whatever the depth.

# %% [markdown] slides=[17] minutes=3
# ## What this ray tracing does not have
#
# Whitted's rays follow light over mirrors and through glass, and from a matt surface straight to
# the lamp. No other ways are followed. Two experiments show it. First, paint the red wall white.

# %%
predict(
    "In a real room a red wall gives the floor beside it a red shine. In this picture of the room, "
    "painting that wall white makes the floor",
    "a little brighter and less red, beside the wall",
    "brighter everywhere",
    "not different in any pixel",
    answer="not different in any pixel",
    why="At a matt point only the lamps are asked. What stands beside it, red or white, does not "
    "matter.",
)


# %%
def repainted(setup, number_of, colour):
    """The setup with another colour of one object."""
    objects = list(setup.scene.objects)
    alone = setup.with_(objects=[objects[number_of]], diffuse=colour, ambient=colour)
    objects[number_of] = alone.scene.objects[0]
    return setup.with_(objects=objects)


white = repainted(room, 4, (0.9, 0.9, 0.9))
empty = room.with_(objects=room.scene.objects[:7])  # without the glass ball, object 7
red, painted, removed = (pg.render(setup, SIZE, **TRACED) for setup in (room, white, empty))
floor = (slice(165, 180), slice(25, 115))  # in front, beside the left wall
under_glass = (slice(163, 172), slice(150, 180))
number("shine", np.abs(red.pixels[floor] - painted.pixels[floor]).max(), expected=0)
number("wall_changed", np.abs(red.pixels[60, 10] - painted.pixels[60, 10]).max(), 0.5, 0.4)
number("caustic", np.abs(red.pixels[under_glass] - removed.pixels[under_glass]).max(), expected=0)
figure(
    [red, painted, removed],
    "A red wall, a white wall, no glass ball: what one sees of the floor is the same.",
    names=["the room", "the left wall white", "no glass ball"],
    shows=lambda a, b, c: (
        np.array_equal(a.pixels[floor], b.pixels[floor])
        and np.array_equal(a.pixels[floor], c.pixels[floor])
        and b.pixels[60, 10, 1] > 2 * a.pixels[60, 10, 1]
        and pg.compare(a, c).max > 0.2
    ),
)
show(white, **TRACED)

# %% [markdown]
# The floor changes by {shine:.0f}: there is no *diffuse interreflection*. And second: take away the
# glass ball. In a real room it is a lens, and under it lies a bright spot, a *caustic*. Here the
# floor under it changes by {caustic:.0f}: the shadow ray goes through the glass as if it
# were not bent.
#
# Light from matt surfaces to matt surfaces is what radiosity computes, two lessons on.

# %% [markdown] tags=["notes"]
# In Heckbert's notation Whitted traces E S* D? L: eye, mirrors and glass, at most one matt surface,
# lamp. Red shine is E D D L, a caustic is E D S L. Path tracing has both. Ambient light stands
# for all that is missing, and is the same everywhere.

# %% [markdown] minutes=2
# ## Try this
#
# The room once more: how much depth does it need, and what does its glass do to the light?


# %%
def left_out(setup):
    """The mean weight of the rays that are not shot."""
    return pg.render(setup, (160, 120), **TRACED).left_out.mean


def on_the_floor(setup):
    """Where a ray ends that meets the floor in front of the glass ball, in its shadow."""
    return rays_behind(setup, 330, 345).nodes[0]


show(room.with_(depth=1), panel="Ray tracing", **TRACED)
goal(
    "Leave out less than 0.2 % of the light on average, with as few bounces as possible.",
    reached=lambda setup: (
        left_out(setup) < 0.002 < left_out(setup.with_(depth=max(setup.settings.depth - 1, 0)))
    ),
    hint="The panel Ray tracing has the depth. Where does the plot of what is left out fall below "
    "0.2 %?",
    solution=room.with_(depth=3, threshold=0),
)
goal(
    "Give the glass ball the shadow of a stone.",
    reached=lambda setup: [ray.blocker for ray in shadow_rays(on_the_floor(setup))] == [7],
    hint="A shadow ray through glass is a simplification, with a switch in the panel Ray tracing.",
    solution=room.with_(clear_shadows=False),
)
