# %% [markdown] slides=[1] minutes=2
# # What is illumination?
#
# Look under your table. From there no lamp can be seen and no window, and yet it is not black.
# Where does that light come from, and who would have to compute it?
#
# The room in the picture is drawn with care for such things: a mirror ball, a glass ball, a lamp
# at the ceiling.

# %%
import numpy as np

import playground as pg
from playground.lesson import figure, goal, number, predict, show

room = pg.load("whitted-room")
SIZE = (480, 360)
in_shadow = (slice(270, 280), slice(140, 190))  # rows and columns: the floor below the mirror
in_mirror = (slice(190, 240), slice(150, 210))
show(
    room,
    "A room with a mirror and a glass ball: the room is seen in both.",
    method="ray-tracing",
    shows=lambda picture: (
        picture.pixels[in_mirror].std() > 0.05 and picture.pixels[180:320, 260:400].std() > 0.05
    ),
)

# %% [markdown] slides=[2] minutes=4
# ## Local illumination
#
# *Illumination*, or lighting, is how light and objects come together. The simple kind is *local*:
# what a point of a surface looks like depends only on the lights, on the surface itself, and on
# where the eye is. No other surface counts.

# %%
predict(
    "If the same room is drawn with local illumination alone, what will *not* be in the picture?",
    "the highlight on the glass ball",
    "the brightness of the floor, which falls off to the sides",
    "the shadow of the mirror ball on the floor",
    answer="the shadow of the mirror ball on the floor",
    why="For a shadow, a point of the floor would have to know of the ball between it and the "
    "lamp. That is another surface, so local illumination cannot ask.",
)

# %%
local, whole = pg.render(room, SIZE), pg.render(room, SIZE, method="ray-tracing")
show(
    room,
    "Local illumination: no shadows; mirror and glass are black but for their highlights.",
    shows=lambda picture: (
        np.median(picture.pixels[in_mirror]) < 0.01
        and picture.pixels[in_shadow].mean() > 2 * whole.pixels[in_shadow].mean()
    ),
)

# %% [markdown]
# Nothing mirrors, nothing shines through, nothing throws a shadow. This kind has been
# dominant in real-time graphics all the same: each point can be computed by itself, which is
# just what the rasterising hardware of a GPU is good at.

# %% [markdown] tags=["notes"]
# Let the class list what is missing before the next step: shadows, mirror images, refraction, and
# the light that the coloured walls should throw on the floor. Somebody may ask for the shadow of
# the glass ball: our shadow rays go straight through glass, which lesson 12 comes back to. The blue
# in the mirror is the background: the room has no fourth wall.

# %% [markdown] slides=[2] minutes=5
# ## Global illumination
#
# In the real world every surface receives light *indirectly* too: where the lamp itself cannot be
# seen, its light still arrives over other surfaces, reflected or refracted. *Global*
# illumination takes all objects of the scene for possible sources of light.
#
# One method for a part of that is ray tracing. The same room, the same lamp:

# %%
changed = np.abs(whole.shown() - local.shown()).max(axis=2) > 0.05
number("changed", 100 * np.mean(changed), expected=21, tolerance=1)
figure(
    [local, whole],
    "The same room, local and global: with ray tracing come shadows, a mirror and glass.",
    names=["local illumination", "ray tracing"],
    shows=lambda a, b: (
        b.pixels[in_shadow].mean() < 0.5 * a.pixels[in_shadow].mean()
        and b.pixels[in_mirror].mean() > 5 * a.pixels[in_mirror].mean()
    ),
)
show(room, method="ray-tracing")

# %% [markdown]
# About {changed:.0f} % of the pixels have changed visibly. Click one in the mirror ball, and the
# panel Explain follows its light back through the room.
#
# Even this picture lacks something: the red wall should tinge the floor beside it. That light
# goes from one *diffuse* surface to the next, which radiosity computes; it has a lesson of its own.

# %% [markdown] slides=[2] minutes=3
# ## What it costs
#
# Why not always global?

# %%
predict(
    "Local illumination asks once per pixel. How many rays does ray tracing need for a pixel in "
    "the middle of the glass ball?",
    "1",
    "2: to the glass, and through it",
    "about 10",
    answer="about 10",
    why="Each time a ray meets the glass it splits in two, a reflected and a refracted one; and "
    "from every surface that faces the lamp a shadow ray asks whether the lamp is seen there.",
)

# %%
tree = pg.explain(room, (330, 240), SIZE, method="ray-tracing")
number("rays", len(tree.nodes), expected=6)
shadow_rays = [ray for node in tree.nodes for light in node.lights for ray in light.rays]
number("shadow_rays", len(shadow_rays), expected=4)
number("all_rays", len(tree.nodes) + len(shadow_rays), expected=10)
show(room, method="ray-tracing", pixel=(330 / 480, 240 / 360), panel="Explain")

# %% [markdown]
# It takes {rays:.0f} rays and {shadow_rays:.0f} shadow rays, {all_rays:.0f} in all, and each of
# them is held against everything in the room. The cost of global illumination is often too high
# for pictures that must follow the hand, and the rasterising hardware was made for the local
# kind. What is done about it today:
#
# - be content with an *approximation* of global illumination;
# - or compute it *beforehand*, store the result in a texture, and use that at run time.

# %% [markdown] tags=["notes"]
# The window draws the tree of the pixel's rays. Lessons 12 and 14 come back to both methods, 16 to
# the texture; this one only needs the two words *local* and *global*.

# %% [markdown] minutes=2
# ## Try this
#
# A ball on a floor, ray traced without mirrors: all that is global here is the shadow. Unfold the
# lamp in the panel Lights: there is its position.

# %%
floor = pg.Object(mesh="quad", transform=pg.Transform(translate=(0, -1, 0), size=5))
ball = pg.load("sphere").with_(
    objects=[*pg.load("sphere").scene.objects, floor],
    lights=[pg.PointLight(position=(3, 4, 1))],
    specular=(0, 0, 0),
    eye=(0, 1.5, 7),
    depth=0,
)


def shadow(setup):
    """The share of the picture that is in shadow: where tracing rays makes it darker."""
    lit, traced = (pg.render(setup, (120, 90), method=m) for m in ("raster", "ray-tracing"))
    return np.mean(traced.pixels.sum(axis=2) < lit.pixels.sum(axis=2) - 0.05)


show(ball, method="ray-tracing", panel="Lights")
goal(
    "Hide the shadow: move the lamp until local illumination would be as good.",
    reached=lambda setup: (
        shadow(setup) < 0.003 and pg.render(setup, (120, 90)).pixels.max() > 0.3  # the lamp is on
    ),
    hint="Whatever the lamp cannot see is in shadow. From where does it see just what you see? "
    "Your eye is at (0, 1.5, 7).",
    solution=ball.with_(lights=[pg.PointLight(position=(0, 1.5, 7))]),
)
