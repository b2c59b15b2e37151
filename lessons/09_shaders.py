# %% [markdown] minutes=1
# # Shaders
#
# The sum of four terms is a few lines of code. A picture needs it some hundred thousand times,
# and a window sixty pictures a second. Who computes that, and how often, exactly?

# %%
import numpy as np

import playground as pg
from playground.lesson import figure, goal, listing, number, plot, predict, show

SIZE = (480, 360)
teapot = pg.load("teapot")
show(teapot)

# %% [markdown] slides=[11] minutes=4
# ## Small programs, run very often
#
# A *shader* is a program that runs on the GPU: a set of instructions for one vertex or for one
# pixel. The GPU runs it for thousands of them at the same time, so no run can know of
# another. Two *stages* of a picture are shaders:
#
# - the **vertex stage** runs for each vertex of a mesh and says where in the picture it lies;
# - the *rasteriser*, which is no shader but hardware, finds the pixels of each triangle. What it
#   makes of one triangle for one pixel is called a *fragment*;
# - the **fragment stage** runs for each fragment and says which colour it has.


# %%
def vertices(setup):
    """How many vertices the objects of a setup have together."""
    return sum(len(item.geometry().mesh.positions) for item in setup.scene.objects)


def pixels(setup, size):
    """How many pixels the objects cover."""
    return pg.render(setup, size).coverage.sum()


show(
    teapot,
    "The teapot: 32 curved patches of 12 by 12 cells, at 480 by 360 pixels.",
    shows=lambda picture: picture.pixels[150:200, 180:240, 0].mean() > 2 * picture.pixels[0, 0, 0],
)
predict(
    "The teapot has about 5 thousand vertices. At 480 by 360 pixels, which stage runs more often?",
    "the vertex stage: each triangle has three corners",
    "both alike",
    "the fragment stage, about ten times as often",
    answer="the fragment stage, about ten times as often",
    why="Each pixel that the teapot covers is a fragment at least, and it covers a good quarter of "
    "the picture.",
)

# %%
# 13 by 13 vertices in each of 32 patches, one less in the 8 that end in a point.
number("vertices", vertices(teapot), expected=32 * 13**2 - 8)
reference = pg.render(teapot, SIZE, renderer="numpy").coverage.sum()
# Two rasterisers; on the outline, they may round a vertex to another 256th of a pixel.
number("fragments", pixels(teapot, SIZE), expected=reference, tolerance=20)
ratio = pixels(teapot, SIZE) / vertices(teapot)
number("ratio", ratio, expected=reference / 5400, tolerance=20 / 5400)
widths = np.arange(40, 481, 40)
counts = np.array([pixels(teapot, (w, w * 3 // 4)) for w in widths])
equal = 480 / np.sqrt(ratio)
plot(
    "How often each stage runs for one picture of the teapot: only the fragments grow with it.",
    x=("width of the picture in pixels", widths),
    y="thousands of runs",
    curves={
        "vertex stage": np.full(len(widths), vertices(teapot) / 1000),
        "fragment stage": counts / 1000,
    },
    shows=lambda first, second: (
        np.ptp(first) == 0
        and np.allclose(second / widths**2, second[-1] / widths[-1] ** 2, rtol=0.05)
        and second[0] < first[0] < second[-1]
    ),
)
number("equal", equal, expected=480 * np.sqrt(5400 / reference), tolerance=1)
show(teapot)

# %% [markdown]
# {vertices:.0f} vertices and {fragments:.0f} fragments: {ratio:.0f} times as many. The number of
# vertices belongs to the model, that of the fragments grows with the area of the picture. They
# are equal for a picture {equal:.0f} pixels wide.

# %% [markdown] tags=["notes"]
# Both are lower bounds. A GPU may run the vertex stage twice for a vertex that several triangles
# share, and the fragment stage for fragments that another triangle hides later. Ask what happens to
# both numbers on a screen with twice the resolution, and what if the model is made finer.

# %% [markdown] slides=[11] minutes=4
# ## What goes in, what comes out
#
# Each stage gets what the one before gives. Besides, all runs get the same *uniforms*: matrices,
# lights, colours of the material.

# %%
predict(
    "In *per-fragment* lighting the model is evaluated for each fragment. What must the vertex "
    "stage give, besides the place in the picture?",
    "the colour of the vertex",
    "the position and the normal of the vertex, in space",
    "the vectors $n$, $l$, $r$ and $v$",
    answer="the position and the normal of the vertex, in space",
    why="From the two and the uniforms all else follows.",
)

# %% [markdown]
# These are the shaders of this program, from its folder `shaders`, without the lines that only
# textures and open surfaces need. First the vertex stage:

# %%
vertex_stage = listing("phong.vert", first="in vec3 object_position", last="}", plain=True)

# %% [markdown]
# Then the fragment stage, where `shade` is the model:

# %%
fragment_stage = listing("phong.frag", first="in vec3 position", last="}", plain=True)


def passed(word, text):
    """What a stage declares with ``in`` or ``out``."""
    return [line[len(word) :] for line in text.splitlines() if line.startswith(word + " ")]


number("ins", len(passed("in", vertex_stage)), expected=2)
number("outs", len(passed("out", vertex_stage)), expected=2)
handed_on = set(passed("out", vertex_stage)) & set(passed("in", fragment_stage))
number("handed_on", len(handed_on), expected=2)
three = [
    pg.DirectionalLight(to_light=tuple(axis), diffuse=tuple(axis), ambient=(0, 0, 0))
    for axis in np.eye(3)
]
coloured = teapot.with_(
    lights=three, diffuse=(1, 1, 1), terms=["diffuse"], background=(0, 0, 0), eye=(1, 1.15, 3.2)
)
coarse = coloured.with_(tessellation=2)
pair = [
    pg.render(coarse.with_(shading=shading), (320, 240)) for shading in ("flat", "per-fragment")
]


def unit_share(picture):
    """Of the pixels with all three colours, the share whose squares sum to 1."""
    lit = picture.pixels[(picture.pixels > 0.01).all(axis=2)]
    return np.mean(np.abs(np.sum(lit**2, axis=1) - 1) < 1e-5) if len(lit) > 5000 else 0


figure(
    pair,
    "The normals made visible: a red light from the right, a green one from above, a blue one from "
    "the front, so that each colour is a component of $n$. On the left one for each triangle, on "
    "the right one for each fragment, made of those of the three corners.",
    names=["of the triangles", "of the fragments"],
    shows=lambda flat, smooth: (
        min(unit_share(flat), unit_share(smooth)) > 0.99
        and len(np.unique(flat.pixels.reshape(-1, 3), axis=0)) < 300
        and len(np.unique(smooth.pixels.reshape(-1, 3), axis=0)) > 5000
    ),
)
show(coarse, panel="View")

# %% [markdown]
# {ins:.0f} things come in for each vertex, {outs:.0f} go out, and the fragment stage takes the same
# {handed_on:.0f} by their names. In between the rasteriser *interpolates* them: each fragment gets
# a mixture of what the three corners of its triangle gave.

# %% [markdown] tags=["notes"]
# The matrices are those of the lecture on transformations. `unit_moderate` makes a vector 1 long;
# `present` is the display: exposure, clamp, curve. In the window, F4 opens the files below the
# picture, marks where the call of the model stands, and shows the twins in the other languages.

# %% [markdown] slides=[11] minutes=2
# ## Where the call stands
#
# The model is one function, `shade`. Who calls it decides what it costs.

# %%
predict(
    "In *per-vertex* lighting the vertex stage calls `shade` and gives a colour. What is left for "
    "the fragment stage to do?",
    "the specular term, which needs the eye",
    "the sum of the four terms",
    "nothing: it hands on the colour it gets",
    answer="nothing: it hands on the colour it gets",
    why="The colour is finished before the rasteriser gets it, and what comes out is a mixture of "
    "finished colours. The lecture calls this the simplest fragment shader.",
)

# %% [markdown]
# The fragment stage of per-vertex lighting. The mixture of colours arrives in `front_rest`:

# %%
colour_stage = listing("colour.frag", first="void main", last="}", plain=True)
number("in_phong_vert", vertex_stage.count("shade("), expected=0)
number("in_phong_frag", fragment_stage.count("shade("), expected=1)
number("in_colour_frag", colour_stage.count("shade("), expected=0)
number("saved", 100 * (1 - 1 / ratio), expected=90, tolerance=0.5)  # as it is written below
show(teapot.with_(shading="per-vertex"), beside="per-fragment", panel="View")

# %% [markdown]
# `phong.frag` calls the model {in_phong_frag:.0f} time, `colour.frag` {in_colour_frag:.0f} times.
# At this size per-vertex lighting saves {saved:.0f} % of the calls. What that costs in quality is
# the next lesson.

# %% [markdown] slides=[11] minutes=2
# ## Three languages
#
# - **HLSL**, High Level Shading Language, by Microsoft
# - **Cg**, C for graphics, by NVIDIA
# - **GLSL**, OpenGL Shading Language, by OpenGL
#
# This program runs GLSL, and has the same shaders in the other two.

# %%
BOUNDS = {"first": "float diffuse_factor", "last": "}"}
glsl = listing("lib/phong.glsl", **BOUNDS)
predict(
    "That is Lambert's law in GLSL. What must be changed in it, to make it HLSL?",
    "all of it: they are different languages",
    "the names of the types",
    "the order of the arguments",
    answer="the names of the types",
    why="All three languages are C-like.",
)

# %% [markdown]
# In HLSL and in Cg:

# %%
others = [listing("hlsl/lib/phong.hlsl", **BOUNDS), listing("cg/phong.cg", **BOUNDS)]
translated = glsl.replace("vec3", "float3")
number("same", sum(other == translated for other in others), expected=2)
words = glsl.split(), translated.split()
number("changed", sum(a != b for a, b in zip(*words, strict=True)), expected=2)
number("of", len(words[0]), expected=11)
show(teapot, panel="Shaders")

# %% [markdown]
# With `vec3` replaced by `float3`, {changed:.0f} words of {of:.0f}, it is the same text in
# {same:.0f} other languages. Whole shaders differ a little more: in how they name what goes in
# and out, and in how a matrix is multiplied. In the window they are below the picture now; where
# there is room, their twins are beside them.

# %% [markdown] minutes=2
# ## Try this
#
# F4 shows the shaders that run, and hides them. Change a line, and the picture follows; nothing is
# written to the disk. In the last line of `main` in `phong.frag`, for example, show the normal in
# place of the light:
#
# ```
# colour = vec4(0.5 + 0.5 * unit_normal, 1.0);
# ```

# %%
show(teapot, panel="Scene")
goal(
    "Let the vertex stage run more often than the fragment stage, at 480 by 360 pixels.",
    reached=lambda setup: vertices(setup) > pixels(setup, SIZE) > 0,
    hint="There are two ways: more vertices (Scene, tessellation), or fewer pixels that the teapot "
    "covers.",
    solution=teapot.with_(eye=(3, 4.6, 12.8)),
)
