# %% [markdown] slides=[13] minutes=1
# # Per-fragment lighting
#
# Per-vertex lighting loses a highlight that lies inside a triangle, because it asks the
# formula at the corners only. So ask it everywhere. But the formula needs a normal, and a
# triangle has normals only at its corners. What should the points in between take?

# %%
import numpy as np

import playground as pg
from playground.lesson import figure, goal, listing, number, plot, predict, show

SIZE = (240, 180)
WAYS = ("per-vertex", "per-fragment")
floor = pg.load("missed-highlight")
show(floor.with_(shading="per-vertex"))


def both(setup, size=SIZE):
    """The picture with the model at the vertices, and with the model at each fragment."""
    return [pg.render(setup.with_(shading=way), size) for way in WAYS]


def difference(setup):
    """How far the two pictures are apart where they are farthest, of full light."""
    return pg.compare(*both(setup)).max


# %% [markdown] slides=[13] minutes=3
# ## Interpolate the normal instead
#
# The rasteriser mixes whatever a vertex hands it: a colour, or a *normal*. It mixes three numbers
# and does not ask what they mean. So let the vertices hand on their normals, and evaluate
# the model behind the rasteriser, in the fragment shader. This is called *per-fragment
# lighting*, *normal interpolation*, or Phong shading: Phong proposed it along with his model.

# %%
ball = pg.load("popping").with_(tessellation=2)  # 80 triangles
pixel = (140, 70)
mixed = pg.explain(ball.with_(shading="per-vertex"), pixel, SIZE)
point = pg.explain(ball.with_(shading="per-fragment"), pixel, SIZE).corners[0]
mixture = sum(w * corner.normal for w, corner in zip(mixed.weights, mixed.corners, strict=True))
length = np.linalg.norm(mixture)
# The same weights and normals, both stored as float32: equal to a few roundings of 6e-8.
number("normals_off", np.abs(mixture / length - point.normal).max(), expected=0, tolerance=1e-6)
number("length", length, expected=0.976, tolerance=0.0005)  # computed in float64: known to 3 digits
figure(
    both(ball),
    "The same ball of 80 triangles: colours interpolated, and normals interpolated.",
    names=["per vertex", "per fragment"],
    shows=lambda a, b: b.pixels.max() > 1 > a.pixels.max() > 2 * a.pixels[5, 5].max(),
)
show(
    ball.with_(shading="per-fragment"),
    beside="per-vertex",
    pixel=((pixel[0] + 0.5) / SIZE[0], (pixel[1] + 0.5) / SIZE[1]),
    panel="Explain",
)

# %% [markdown]
# The highlight is round, though the triangles are as coarse as before; one sees them at the outline
# only. The explanation of a pixel now has one point in place of three corners: its normal is the
# mixture of theirs, with the same barycentric weights. But mind the length of that mixture:
# {length:.2f}. We come back to this.

# %% [markdown] tags=["notes"]
# Two things share a name: Phong's illumination model (the sum of terms) and Phong shading
# (interpolated normals). One can have either without the other. Gouraud is per-vertex lighting.

# %% [markdown] slides=[13] minutes=3
# ## Move the code

# %%
predict(
    "A program has per-vertex lighting. How much of the formula must be rewritten to get "
    "per-fragment lighting?",
    "all: a fragment has other vectors than a vertex",
    "only the specular term, since the diffuse one was right",
    "nothing: the same code is called from the other stage",
    answer="nothing: the same code is called from the other stage",
    why="A position, a normal, a light and an eye go in, a colour comes out. Where the call stands "
    "is all that changes.",
)

# %% [markdown]
# These are the files that draw the pictures of this program. Per vertex, the *vertex* shader calls
# `shade`, by way of `emit_colours`:

# %%
INCLUDED = '#include "shade.glsl"'
vertex = listing("gouraud.vert", first="void main", last="}", plain=True)
colours = listing("vertex_colour.glsl", first=INCLUDED, last="}", plain=True)

# %% [markdown]
# Per fragment, the *fragment* shader calls it:

# %%
fragment = listing("phong.frag", first=INCLUDED, last="}", plain=True)
number("calls", colours.count(" shade(") + fragment.count(" shade("), expected=2)
number("included", colours.count(INCLUDED) + fragment.count(INCLUDED), expected=2)
number("called", vertex.count("emit_colours("), expected=1)
number("formulas", sum(text.count("dot(") for text in (vertex, colours, fragment)), expected=0)

# A vertex gets the same colour both ways: look where the middle of a pixel is on a vertex.
grid = floor.with_(
    tessellation=2, lights=[pg.PointLight(position=(0, 1.1, -2.3))], target=(0, 0, 0)
)
odd = (241, 181)
at_vertex = [picture.pixels[90, 120] for picture in both(grid, odd)]
# float32 in the shader: (r·v)^60 multiplies a rounding of 6e-8 by 60, and there are some ten.
number("vertex_off", np.abs(at_vertex[0] - at_vertex[1]).max(), expected=0, tolerance=1e-4)

# %% [markdown]
# The same `shade.glsl` is included {included:.0f} times, `shade` is called {calls:.0f} times, once
# here and once there. Neither has a formula of its own. (Left out is what only textures need, and
# surfaces that are seen from both sides.)
#
# At a vertex the two ways agree; here they are {vertex_off:.0e} apart. They only differ in
# between: one evaluates and then interpolates, the other interpolates and then evaluates. As the
# formula is no straight line, that is not the same.

# %% [markdown] tags=["notes"]
# The slide: per-vertex lighting followed by colour interpolation is overcome by per-fragment
# lighting, also called normal interpolation shading. In HLSL and Cg the pair is in `shaders/hlsl`
# and `shaders/cg`.

# %% [markdown] slides=[13] minutes=4
# ## Make it unit length again
#
# One line of `phong.frag` is easily forgotten: `unit_moderate(normal)`, which makes the normal
# 1 long. But all normals at the vertices are 1 long already.

# %%
predict(
    "Two unit normals are 60° apart. How long is the vector half-way between them, as the "
    "rasteriser mixes it?",
    "1: the mean of 1 and 1",
    "0.87",
    "0.5",
    answer="0.87",
    why=r"The mean of two arrows ends on the straight line between their tips, not on the circle: "
    r"$\cos 30°$ = 0.87 from the centre.",
)

# %%
share = np.linspace(0, 1, 101)


def mixed_length(degrees):
    """How long the mixture of two unit vectors is, from one to the other."""
    a, b = (
        np.array([1.0, 0.0]),
        np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))]),
    )
    return np.linalg.norm((1 - share)[:, None] * a + share[:, None] * b, axis=1)


plot(
    "Between two vertices the interpolated normal is too short, the more so the more they differ.",
    x=("from one vertex to the other", share),
    y="length of the normal",
    curves={f"normals {d}° apart": mixed_length(d) for d in (30, 60, 90)},
    shows=lambda a, b, c: all((a > b)[1:-1]) and all((b > c)[1:-1]) and max(a) <= 1 + 1e-12,
)
number("half_way", mixed_length(60)[50], expected=np.cos(np.radians(30)), tolerance=1e-12)

# %% [markdown]
# Half-way it is {half_way:.2f} long. Now forget that line, on purpose. Take one of the 20 triangles
# of an icosahedron that stands for a ball. Light and eye are far away, straight above it, so that
# in its middle $n \cdot l$ and $r \cdot v$ should both be 1.

# %%
icosahedron = ball.with_(tessellation=1, shading="per-fragment")
mesh = icosahedron.scene.objects[0].geometry().mesh
normals = mesh.normals[mesh.faces[0]].astype(float)
middle = normals.mean(axis=0)
short = np.linalg.norm(middle)
above = middle / short  # the direction to the light, and to the eye
right = np.cross((0, 1, 0), above) / np.linalg.norm(np.cross((0, 1, 0), above))
axes = np.stack([right, np.cross(above, right)])  # of the picture: to the right, and up
corners = axes @ mesh.positions[mesh.faces[0]].astype(float).T
x, y = np.meshgrid(np.linspace(-0.9, 0.9, 241), np.linspace(0.675, -0.675, 181))
# The weights of the corners at each pixel: they add up to 1 and give the place.
weights = np.linalg.solve(
    np.vstack([corners, np.ones(3)]), np.stack([x, y, 0 * x + 1]).reshape(3, -1)
)
inside = (weights >= 0).all(axis=0)
mixed_normals = weights.T @ normals


def lit(n):
    """Diffuse and specular factor for each of the normals, with sh = 60 and l = v."""
    n_dot_l = n @ above
    r_dot_v = 2 * n_dot_l * n_dot_l - 1  # of r = 2n(n·l) - l, as l·v = 1
    return np.maximum(n_dot_l, 0), np.maximum(r_dot_v, 0) ** 60


def picture(n):
    """The triangle in the green of the ball, with a white highlight."""
    diffuse, specular = lit(n)
    colours = np.outer(diffuse, (0.08, 0.5, 0.3)) + 0.8 * specular[:, None]
    return pg.Image(
        np.where(inside[:, None], colours, 0.01).reshape(*x.shape, 3).astype(np.float32)
    )


forgotten, remembered = lit(middle), lit(above)
number("diffuse_right", remembered[0], expected=1, tolerance=1e-12)
number("diffuse_short", forgotten[0], expected=0.795, tolerance=0.0005)  # as it is written below
number("specular_right", remembered[1], expected=1, tolerance=1e-12)
number("specular_short", forgotten[1], expected=0, tolerance=1e-30)
number("r_dot_v", 2 * short**2 - 1, expected=0.263, tolerance=0.001)
unit_normals = mixed_normals / np.linalg.norm(mixed_normals, axis=1, keepdims=True)
figure(
    [picture(mixed_normals), picture(unit_normals)],
    "Light and eye above one triangle: without the line the highlight in its middle is lost.",
    names=["normal too short", "made unit length"],
    shows=lambda a, b: (
        0.05 < a.pixels[90, 120].max() < 0.5 and b.pixels[90, 120].max() > 0.99 * b.pixels.max() > 1
    ),
)
light = pg.DirectionalLight(to_light=tuple(middle), ambient=(0, 0, 0))
show(
    icosahedron.with_(
        lights=[light], eye=tuple(4 * middle / short), bugs=("normal-not-renormalised",)
    ),
    panel="Bug zoo",
)

# %% [markdown]
# In the middle the diffuse term is {diffuse_short:.3f} where it should be {diffuse_right:.0f}: as
# much too dark as the normal is too short. The specular term suffers more. In
# $r = 2n(n \cdot l) - l$ the normal occurs twice, so $r \cdot v$ is
# $2 \cdot 0.795^2 - 1$ = {r_dot_v:.2f}, and to the power of 60 that is {specular_short:.0f} in
# place of {specular_right:.0f}. The highlight has gone out just where it should be brightest.

# %% [markdown] tags=["notes"]
# In the window the program makes this mistake in its own shader, on the whole icosahedron: the
# panel Bug zoo has it and five others, and switches it off. It hides well: with fine
# triangles the normals hardly differ, and the error vanishes. It shows when somebody saves
# triangles. Ask: could the *vertex* shader make it unit length instead? (No: it is 1 long there.)

# %% [markdown] slides=[13] minutes=4
# ## Or more vertices?
#
# Another way out is to stay with per-vertex lighting and to take more vertices. How many? Take the
# shiny floor of the last lesson, and divide its two triangles.

# %%
predict(
    "The floor has many small triangles. Now they are divided, so that their edges are half as "
    "long. The largest difference between per-vertex and per-fragment lighting becomes",
    "half as large",
    "a quarter as large",
    "no smaller: a highlight inside a triangle stays lost",
    answer="a quarter as large",
    why="Between the vertices the formula is a curve, and the rasteriser draws a straight line. "
    "Over a short way any smooth curve is nearly a parabola, and from that a straight line is off "
    "by the square of the width.",
)

# %%
cells = 2 ** np.arange(8)
errors = np.array([difference(floor.with_(tessellation=int(n))) for n in cells])
plot(
    "The largest difference on the floor: first the highlight must be met, then it falls quickly.",
    x=("cells along an edge of the floor", cells),
    y="largest difference in %",
    curves={"measured": 100 * errors, "1 %": np.ones(len(cells))},
    shows=lambda measured, line: (
        measured[0] > 50 and measured[-1] < line[-1] and all(np.diff(measured) < 0)
    ),
    log="xy",
)
fine = floor.with_(tessellation=128)
number("error_1", 100 * errors[0], expected=85, tolerance=1)
number("error_32", 100 * errors[5], expected=3.65, tolerance=0.1)
number("error_128", 100 * errors[7], expected=0.245, tolerance=0.01)
# Two halvings: 16, but for the next term of the series, which is some 10 % for the first of them.
number("quarter", errors[6] / errors[7], expected=4, tolerance=0.1)
number("vertices", len(fine.scene.objects[0].geometry().mesh.positions), expected=129**2)
covered = np.sum(both(fine)[1].coverage > 0.5)
number("fragments", covered, expected=19_900, tolerance=300)  # drivers may differ at the outline
pictures = [pg.render(floor.with_(shading="per-vertex", tessellation=n), SIZE) for n in (4, 16, 64)]
figure(
    pictures,
    "Per-vertex lighting with more and more vertices: the highlight comes back.",
    names=["4 × 4 cells", "16 × 16", "64 × 64"],
    shows=lambda a, b, c: (
        pg.compare(c, pictures[2]).max == 0
        and pg.compare(a, c).max > 2 * pg.compare(b, c).max > 0.02
    ),
)
show(floor.with_(tessellation=16, shading="per-vertex"), beside="per-fragment", layout="wipe")

# %% [markdown]
# With two triangles the pictures differ by {error_1:.0f} % of full light, with 32 cells by
# {error_32:.1f} %, with 128 by {error_128:.2f} %; in the end every halving makes the difference
# {quarter:.1f} times smaller. But 128 cells are {vertices:.0f} vertices, and in this picture the
# floor covers {fragments:.0f} pixels. The model is evaluated nearly as often as with per-fragment
# lighting, and nothing is won.

# %% [markdown] slides=[13] minutes=2
# ## What it costs
#
# How often is the model evaluated? Per vertex: as often as there are vertices, however large the
# picture. Per fragment: as often as there are pixels to fill, however many triangles.

# %%
teapot = pg.load("teapot")
small, large = (np.sum(pg.render(teapot, size).coverage > 0.5) for size in ((480, 360), (960, 720)))
number("teapot_vertices", len(teapot.scene.objects[0].geometry().mesh.positions), expected=5400)
number("small", small, expected=52_100, tolerance=800)  # drivers may differ at the outline
# Twice as wide and high. The outline is known to a pixel: 1500 of 52 000 in the worst case.
number("growth", large / small, expected=4, tolerance=0.12)
show(teapot, panel="Speed and error")

# %% [markdown]
# The teapot has {teapot_vertices:.0f} vertices. In a small picture of 480 by 360 it fills
# {small:.0f} pixels, in one twice as wide and high {growth:.0f} times as many. Per-fragment
# lighting costs more, and since GPUs can pay for it, nearly everything is drawn that way.

# %% [markdown] tags=["notes"]
# The count is that of what is seen. A fragment that is later covered by a nearer one is shaded in
# vain, unless something (the depth test before the shader, or drawing the depth first) prevents
# it. And tiny triangles cost more than their pixels: a GPU shades in blocks of 2 by 2.

# %% [markdown] minutes=3
# ## Try this
#
# The window shows both ways, a line between them; drag it.

# %%
show(floor, beside="per-vertex", layout="wipe", panel="Scene")
goal(
    "Make per-vertex and per-fragment lighting differ by less than 1 %.",
    reached=lambda setup: difference(setup) < 0.01,
    hint="The tessellation is in the panel Scene. From the plot: between 32 and 128 cells.",
    solution=floor.with_(tessellation=128),
)
goal(
    "The same with at most 500 vertices, and the lamp where it is.",
    reached=lambda setup: (
        difference(setup) < 0.01
        and sum(len(item.geometry().mesh.positions) for item in setup.scene.objects) <= 500
        and setup.scene.lights == floor.scene.lights
        and np.ptp(pg.render(setup, SIZE).pixels[..., 2]) > 0.2
    ),
    hint="What makes the formula so curved on this floor? Without it, 16 cells are enough.",
    solution=floor.with_(tessellation=16, specular=(0, 0, 0)),
)
