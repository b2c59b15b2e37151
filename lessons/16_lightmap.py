# %% [markdown] slides=[2] minutes=2
# # Global illumination in a texture
#
# The first lesson ended with a promise. Global illumination costs too much for pictures that
# follow the hand, so what is done today is to *pre-compute it, store the result in a texture, and
# use it at run time*. Which part of the light can be stored, and what is lost?

# %%
import atexit
import shutil
import tempfile
import time

import numpy as np

import playground as pg
from playground.lesson import figure, goal, number, plot, predict, show

box = pg.load("cornell-box").with_(patches=300)
folder = tempfile.mkdtemp()  # for the textures
atexit.register(shutil.rmtree, folder, ignore_errors=True)
SIZE = (320, 240)

# %%
show(box, method="radiosity")
predict(
    "You walk through a room in which nothing moves but you. Which part of the light at a fixed "
    "spot of the wall changes?",
    "all of it: other walls come into view",
    "the highlights and mirror images",
    "the light that came by way of other walls",
    answer="the highlights and mirror images",
    why="The diffuse term is view-independent, and so is all the light that it passes on. Only "
    "what has a $v$ in its formula follows the eye.",
)


# %%
def moved(setup, side):
    """The setup, seen from so many millimetres to the side."""
    x, y, z = setup.camera.eye
    return setup.with_(eye=(x + side, y, z))


wall = box.with_(target=(278, 430, 559), fov=1)  # through a telescope
here, there = (
    pg.render(setup, (9, 9), method="radiosity").pixels[4, 4] for setup in (wall, moved(wall, 250))
)
# A pixel is 2.6 mm of the wall, its middle known to a tenth of that; there 30 mm change 1 %.
number("change", 100 * np.abs(there / here - 1).max(), expected=0, tolerance=0.01)

# %% [markdown]
# Seen from a quarter of a metre to the side, the same spot of the wall has changed by
# {change:.1f} %. Radiosity is *view-independent*: solved once, it is right from everywhere.

# %% [markdown] tags=["notes"]
# That is why radiosity, and not ray tracing, is the method to store: its result lives on the
# surfaces, that of a ray tracer in the pixels of one eye.

# %% [markdown] slides=[2] minutes=3
# ## Bake
#
# *Baking* lays all surfaces of the scene flat on one square, so that each point has a place of
# its own, and computes for every texel the light that arrives there: straight from the lamp, and
# from all patches around it. The square is called a *lightmap*.

# %%
began = time.perf_counter()
solution = pg.radiosity(box).solve()
solve_time = time.perf_counter() - began


def baked(result, size):
    """The setup of a solution with its light in a texture of ``size`` × ``size`` texels."""
    lightmap = result.bake(size)
    path = f"{folder}/{result.setup.name}-{size}.npz"
    lightmap.save(path)
    return result.setup.with_(lightmap=path), lightmap


began = time.perf_counter()
stored, lightmap = baked(solution, 64)
bake_time = time.perf_counter() - began
kibibytes = (lightmap.direct.nbytes + lightmap.indirect.nbytes) / 1024
number("kibibytes", kibibytes, expected=64 * 64 * 2 * 3 * 4 / 1024)  # two colours, four bytes each
large = pg.Image(np.repeat(np.repeat(lightmap.image(charts=True).pixels, 5, axis=0), 5, axis=1))
figure(
    pg.Image(large.pixels, setup=box),
    "The lightmap: every surface of the box, laid flat. One colour per texel, no camera, no "
    "paint: it is the light that *arrives*. Grey belongs to no surface.",
    shows=lambda picture: (
        0.2 < np.mean(np.ptp(picture.pixels, axis=2) < 1e-6) < 0.6  # grey, or without any light
        and picture.pixels.max() > 0.5
    ),
)
show(
    stored,
    "The Cornell box, drawn with that texture of 64 × 64 texels.",
    method="lightmap",
    panel="Lightmap",
    shows=lambda picture: (
        picture.pixels[22:42, 110:160, 0].min() > 0.03
        and picture.pixels[180:290, 160:168, 0].mean()
        > 4 * picture.pixels[180:290, 160:168, 1].mean()
    ),
)

# %% [markdown]
# Drawing it is a lookup in a texture, times the colour of the surface: $m_d \otimes H$. No lamp, no
# shadow ray, no other patch is asked for. All the light of the box is {kibibytes:.0f} kibibytes.

# %% [markdown] tags=["notes"]
# The pieces are called charts. Around each one its border colour is repeated for some texels:
# bilinear lookups at a border must not mix in what lies beside it. In the panel Lightmap, hover a
# texel to see where in the room it is.

# %% [markdown] slides=[2] minutes=3
# ## How many texels
#
# Two plates that face each other, one of them a lamp. Without anything in between, the light on the
# other plate is known exactly, in closed form: so the error of a lightmap can be measured.

# %%
predict(
    "A lightmap with twice as many texels along an edge takes four times the memory. Its error, "
    "where the light is smooth, is",
    "half as large",
    "a quarter as large",
    "the same: it comes from the patches",
    answer="a quarter as large",
    why="Between the centres of texels the lookup goes straight, where the light is a curve. The "
    "gap between the two grows with the square of the distance.",
)

# %%
plates = pg.load("facing-plates").with_(patches=100)
exact = pg.render(plates, SIZE)
plate = exact.coverage > 0
lit = pg.radiosity(plates).solve()


def error(size):
    """The error of the lightmapped picture on the plates, relative to what is there."""
    picture = pg.render(baked(lit, size)[0], SIZE, method="lightmap")
    off = (picture.pixels - exact.pixels)[plate]
    return np.sqrt(np.mean(off**2)) / exact.pixels[plate].mean()


texels = [16, 32, 64]
errors = np.array([error(size) for size in texels])
plot(
    "Error of the lightmap against the closed form, for two plates.",
    x=("texels along an edge", texels),
    y="error in %",
    curves={"relative error": 100 * errors},
    shows=lambda error: all(error[1:] < error[:-1] / 3) and error[-1] < 0.01,
    log="xy",
)
number("coarse", 100 * errors[0], expected=0.08, tolerance=0.02)
number(
    "quotient", np.sqrt(errors[0] / errors[2]), expected=4, tolerance=0.8
)  # with a border: 16/15 ...
sharp = [pg.render(baked(solution, size)[0], SIZE, method="lightmap") for size in (24, 40)]
sharp.append(pg.render(stored, SIZE, method="lightmap"))
figure(
    sharp,
    "Where the light is not smooth, too few texels show: look at the shadows of the blocks.",
    names=["24 × 24 texels", "40 × 40", "64 × 64"],
    shows=lambda a, b, c: (
        np.abs(a.pixels - c.pixels)[100:].mean()
        > 1.5 * np.abs(b.pixels - c.pixels)[100:].mean()
        > 0
    ),
)
show(stored, method="lightmap", panel="Lightmap")

# %% [markdown]
# With only 16 texels along an edge the light on the plates is {coarse:.2f} % off, and each doubling
# makes the error {quotient:.1f} times smaller. A shadow ends within a short way, though: where that
# is narrower than a texel, its edge is lost, and a small shadow altogether.

# %% [markdown] tags=["notes"]
# 24 × 24 for the whole box: walls of some 5 × 5 texels. In the window, bake 128 or 256 in the panel
# Lightmap, and wipe over the picture.

# %% [markdown] slides=[2] minutes=3
# ## What a texture cannot know
#
# Paint the lamp blue.

# %%
predict(
    "You change the colour of the lamp, in the window or in the setup. The picture with the "
    "lightmap",
    "becomes blue at once",
    "becomes blue where the lamp shines straight, and not where light was reflected",
    "stays as it is, but for the lamp itself",
    answer="stays as it is, but for the lamp itself",
    why="The light has been computed before. A texture does not know where its colours came from.",
)

# %%
lamp = box.scene.lights[0]
blue_lamp = pg.RectangleLight(
    position=lamp.position, facing=lamp.facing, width=130, height=105, diffuse=(0.05, 0.15, 20)
)
relit = stored.with_(lights=[blue_lamp])
before, after = (pg.render(setup, SIZE, method="lightmap") for setup in (stored, relit))
anew = pg.render(relit, SIZE, method="radiosity")
number("stays", np.abs(after.pixels - before.pixels)[60:].max(), expected=0)
number("warned", any("Bake it again" in warning for warning in after.warnings), expected=1)
figure(
    [before, after, anew],
    "With the lamp as it was baked; with a blue lamp and the old lightmap; solved anew.",
    names=["as baked", "blue lamp, old lightmap", "blue lamp, radiosity"],
    shows=lambda a, b, c: (
        np.array_equal(a.pixels[60:], b.pixels[60:])
        and c.pixels[60:, ..., 2].sum() > 1.5 * c.pixels[60:, ..., 0].sum()
        and a.pixels[60:, ..., 0].sum() > 1.5 * a.pixels[60:, ..., 2].sum()
    ),
)
shiny = stored.with_(specular=(0.5, 0.5, 0.5), shininess=20)
added = pg.render(shiny, SIZE, method="lightmap").pixels - before.pixels
local = pg.render(shiny.with_(terms=["specular"]), SIZE).pixels
number("highlight", added[60:].max(), expected=local[60:].max(), tolerance=1e-5)
show(relit, method="lightmap", beside="radiosity", layout="side by side")

# %% [markdown]
# Below the ceiling the two pictures differ by {stays:.0f}. (The program has noticed, and warns.)
# So a lightmap is for what stands still: lamps, walls, furniture. Nothing that moves throws a
# shadow into it, or is lit by it.
#
# And it has no *highlights*: those need $v$. What the picture shows of them is the specular term
# of the local model on top, up to {highlight:.2f} here, without any shadow.

# %% [markdown] tags=["notes"]
# In practice: static light baked, moving lamps and objects lit locally, and one's own shadow made
# by a third trick. The lightmap keeps direct and indirect light apart, so that direct light can
# be computed at run time, with sharp shadows, and only the indirect part comes from the texture.

# %% [markdown] slides=[2] minutes=4
# ## One scene, five answers
#
# The same box by the four methods of this course: local illumination, ray tracing, radiosity, and
# a lightmap. Who is right? A fifth method decides: *path tracing* sends rays at random from wall to
# wall and takes the mean. It is slow and grainy, but it assumes nothing: no patches, no texels, no
# ambient term.

# %%
predict(
    "Which of the four comes nearest to the truth in this box?",
    "ray tracing: it has the sharpest shadows",
    "radiosity with its 300 patches",
    "the lightmap of 64 × 64 texels that was baked from that radiosity",
    answer="the lightmap of 64 × 64 texels that was baked from that radiosity",
    why="It has more texels than there are patches, and each of them looks at the lamp and at the "
    "patches from its own place.",
)

# %%
SMALL = (60, 45)
truth = pg.PathTracing(box, SMALL)
for _ in truth.steps(16):
    pass
methods = {
    "local": (box, "raster"),
    "ray tracing": (box, "ray-tracing"),
    "radiosity": (box, "radiosity"),
    "lightmap": (stored, "lightmap"),
}
regions = {  # rows and columns; none has the lamp in it
    "ceiling": (slice(3, 8), slice(14, 23)),
    "back wall": (slice(13, 18), slice(20, 40)),
    "floor": (slice(40, 43), slice(14, 26)),
    "red wall": (slice(15, 25), slice(10, 15)),
    "green wall": (slice(15, 25), slice(45, 50)),
    "front of the tall block": (slice(23, 36), slice(23, 29)),
    "its red side": (slice(23, 36), slice(20, 21)),
}


def means(picture):
    """The mean colour of each region, (7, 3)."""
    return np.array([picture.pixels[part].mean(axis=(0, 1)) for part in regions.values()])


right = means(truth.image())
spread = [np.sqrt((truth.standard_error()[p] ** 2).sum(axis=(0, 1))) for p in regions.values()]
pixels = [truth.standard_error()[p][..., 0].size for p in regions.values()]
noise = (np.array(spread) / np.array(pixels)[:, None]).sum() / right.sum()
wrong = {
    name: 100 * np.abs(means(pg.render(setup, SMALL, method=method)) - right).sum() / right.sum()
    for name, (setup, method) in methods.items()
}
# What chance has done to the reference, and so to what is measured with it:
number("noise", 100 * noise, expected=4, tolerance=1)
number("local", wrong["local"], expected=32, tolerance=4)
number("traced", wrong["ray tracing"], expected=32, tolerance=4)
number("solved", wrong["radiosity"], expected=12, tolerance=4)
number("mapped", wrong["lightmap"], expected=4, tolerance=4)


def of_region(name, method):
    """How wrong a method is in one region, in percent."""
    i = list(regions).index(name)
    setup, way = methods[method]
    seen = means(pg.render(setup, SMALL, method=way))[i]
    return 100 * np.abs(seen - right[i]).sum() / right[i].sum()


# Of these two regions the reference is known to 8 % and to 13 % of what is there.
number("guess", of_region("ceiling", "local"), expected=15, tolerance=9)
number("red_side", of_region("its red side", "local"), expected=177, tolerance=13 * 2.77)
show(stored, method="lightmap", layout="five answers")

# %% [markdown]
# Over seven regions of the picture, held against the path-traced means, which themselves are known
# to {noise:.0f} %:
#
# - local illumination is {local:.0f} % wrong, and so is ray tracing, {traced:.0f} %: both have
#   the ambient term for all that is indirect. On the ceiling that guess is {guess:.0f} % off, on
#   the red side of the block {red_side:.0f} %;
# - radiosity with 300 patches is {solved:.0f} % wrong: shadows are as coarse as its patches;
# - the lightmap that was baked from it is only {mapped:.0f} % wrong, as each texel has looked
#   around for itself: about as much as chance has done to the means.

# %% [markdown] tags=["notes"]
# What the box cannot tell: it has no mirror and no glass. With those, ray tracing is the only one
# of the four that has a chance. Let the class say which scene each of the methods would win.

# %% [markdown] slides=[2] minutes=3
# ## How fast, and how wrong
#
# There is no best method, only one for a scene and a purpose. What are the questions to ask?

# %%
predict(
    "A game on a phone, 60 pictures per second. An old house, its lamps fixed, warm light from "
    "wall to wall; the player walks. Which method?",
    "ray tracing: it is the most general",
    "radiosity, solved for each picture",
    "a lightmap",
    answer="a lightmap",
    why="Nothing that gives light moves, and the walls are matt. All of it can be computed before "
    "the game is sold.",
)

# %%
FRAME = (240, 180)


def frame_time(setup, method):
    """The shortest time of three pictures with a moving eye; the first one is not counted."""
    times = []
    with pg.open_renderer(FRAME, method=method) as renderer:
        for side in (0, 5, 10, 15):
            began = time.perf_counter()
            renderer.render(moved(setup, side))
            times.append(time.perf_counter() - began)
    return min(times[1:])


frames = {name: frame_time(*methods[name]) for name in methods}
grains = pg.Image(truth.image().pixels.repeat(4, axis=0).repeat(4, axis=1), setup=box)


def beside_truth(names, caption, shows):
    """Two of the methods, with error and time below, and the reference as a third."""
    pictures = [pg.render(methods[name][0], FRAME, method=methods[name][1]) for name in names]
    below = [f"{n}: {wrong[n]:.0f} % wrong, {frames[n] / frames['local']:.1f} ×" for n in names]
    figure([*pictures, grains], caption, names=[*below, "path traced"], shows=shows)


LIT = (slice(14, 32), slice(75, 100))  # a piece of the ceiling
beside_truth(
    ["local", "ray tracing"],
    "With the ambient term for what is indirect. The times are for a further picture, in units of "
    f"the local one's {1000 * frames['local']:.0f} ms on the machine that ran this lesson.",
    lambda local, traced, true: (
        np.ptp(local.pixels[LIT], axis=(0, 1)).max() < 1e-3  # one and the same everywhere
        and np.ptp(traced.pixels[LIT], axis=(0, 1)).max() < 1e-3
        and np.ptp(true.pixels[LIT], axis=(0, 1)).max() > 0.01
        and traced.pixels[160:172].sum() < 0.95 * local.pixels[160:172].sum()  # shadows
    ),
)
beside_truth(
    ["radiosity", "lightmap"],
    f"With all the light there is. Before the first picture, radiosity took {solve_time:.1f} s, "
    f"and the lightmap {bake_time:.1f} s more.",
    lambda solved, mapped, true: all(
        np.ptp(picture.pixels[LIT], axis=(0, 1)).max() > 0.01
        and abs(picture.pixels[LIT].mean() / true.pixels[LIT].mean() - 1) < 0.3
        for picture in (solved, mapped)
    ),
)
show(pg.load("whitted-room"), method="ray-tracing", panel="What the scene needs")

# %% [markdown]
# - Does anything mirror or refract? Then *rays*, at least for those objects.
# - Is all of it matt, and does light go from wall to wall? Then *radiosity*.
# - Do the lamps stand still? Then store it: a *lightmap* costs no more than any texture.
# - Does everything move, at 60 pictures per second? Then the *local* model, and an honest guess for
#   the ambient term.
#
# For a scene of your own the program measures it: `playground measure needs SETUP`, or the panel
# *What the scene needs*, leaves out one part after the other, and says how much time each one
# costs and how much of the picture it is.

# %% [markdown] tags=["notes"]
# The times under the pictures are of the machine that made them, and they are not checked by
# anything; the errors are. On a processor without a GPU, local and lightmap differ little; on a
# GPU both are far below a millisecond, and ray tracing is what one pays for.

# %% [markdown] minutes=2
# ## Try this
#
# The box with its lightmap. The panels Lights and Material may be used; the lightmap stays.


# %%
def truth_over_picture(setup):
    """How bright the box really is, over what its lightmap says."""
    try:
        now = pg.radiosity(setup).solve()
    except pg.PlaygroundError:  # no light at all
        return 0.0
    return np.mean(now.patches.area @ now.arriving) / np.mean(
        solution.patches.area @ solution.arriving
    )


def highlights(setup):
    """The largest difference that the specular term makes to the lightmapped picture."""
    dull = setup.with_(specular=(0, 0, 0))
    pair = [pg.render(s, (120, 90), method="lightmap").pixels for s in (setup, dull)]
    return np.abs(pair[0] - pair[1])[22:].max()


dim_lamp = pg.RectangleLight(
    position=lamp.position, facing=lamp.facing, width=130, height=105, diffuse=(5, 3, 1)
)
show(stored, method="lightmap", panel="Lights")
goal(
    "Make the picture lie: the room is really less than half as bright as the lightmap shows it.",
    reached=lambda setup: truth_over_picture(setup) < 0.5,
    hint="The lightmap does not notice what you do to the lamp.",
    solution=stored.with_(lights=[dim_lamp]),
)
goal(
    "Make something shine that is not in the texture.",
    reached=lambda setup: highlights(setup) > 0.05,
    hint="The specular term is not stored.",
    solution=shiny,
)
