# %% [markdown] slides=[12] minutes=1
# # Per-vertex lighting
#
# A picture on your screen has about two million pixels, and a game draws it sixty times a second.
# A triangle has three corners. What if the formula of Phong were evaluated at the corners
# only, and the pixels between them got a mixture? It is cheap. What does it cost?

# %%
import numpy as np

import playground as pg
from playground.lesson import figure, goal, listing, number, plot, predict, show

CORNERS = np.array([(-1.0, -0.7, 0.0), (1.0, -0.7, 0.0), (0.0, 1.0, 0.0)])  # of one triangle
AXES = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
MESH = pg.Mesh(positions=CORNERS, normals=np.array(AXES, dtype=float), faces=np.array([[0, 1, 2]]))

# Three lights and three normals, so that the corners are just red, green and blue.
triangle = pg.load("sphere").with_(
    objects=[pg.Object(arrays=MESH, material=pg.Material(diffuse=(1, 1, 1)))],
    lights=[pg.DirectionalLight(to_light=a, diffuse=a, ambient=(0, 0, 0)) for a in AXES],
    terms=["diffuse"],
    shading="per-vertex",
    eye=(0, 0, 4),
    background=(1, 1, 1),
)
SIZE = (240, 180)
show(triangle)

# %% [markdown] slides=[12] minutes=4
# ## What the rasteriser does
#
# Each vertex brings its *attributes*: a position, and for example a normal, texture coordinates
# or a colour. The vertex shader runs once for each vertex. The *rasteriser* then finds the pixels
# that the triangle covers, and hands to each of these *fragments* a mixture of what the three
# vertices have.
#
# Here the corner $A$ on the left is red, $B$ on the right is green, and $C$ on top is blue.

# %%
show(
    triangle,
    "One triangle. Only its three corners were lit; the rest is a mixture.",
    shows=lambda picture: (
        picture.pixels[255, 150].argmax() == 0
        and picture.pixels[255, 330].argmax() == 1
        and picture.pixels[105, 240].argmax() == 2
    ),
)
predict(
    "Which colour is in the very middle of the triangle?",
    "white: red, green and blue light together",
    "a dark grey, a third of each",
    "black: none of the three corners is there",
    answer="a dark grey, a third of each",
    why="The weights of a mixture add up to 1. In the middle all corners count alike: a third "
    "of red, of green and of blue.",
)


# %%
def area(a, b, c):
    """Twice the area of a triangle in the plane of the screen."""
    return np.cross(b - a, c - a)[2]


def place(x, y):
    """Where in the plane of the triangle the middle of pixel (x, y) is."""
    pitch = 2 * 4 * np.tan(np.radians(triangle.camera.fov / 2)) / SIZE[1]
    return np.array([(x + 0.5 - SIZE[0] / 2) * pitch, (SIZE[1] / 2 - y - 0.5) * pitch, 0])


def weights_by_area(x, y):
    """Of each corner: the triangle opposite to it, with the pixel as a corner, by the whole."""
    p, (a, b, c) = place(x, y), CORNERS
    return np.array([area(p, b, c), area(a, p, c), area(a, b, p)]) / area(a, b, c)


pixel = (105, 110)
why = pg.explain(triangle, pixel, SIZE)
# The positions of a mesh are float32: 6e-8 of 1, and an area is a sum of a few products of them.
for name, weight, expected in zip("abc", why.weights, weights_by_area(*pixel), strict=True):
    number(f"weight_{name}", weight, expected=expected, tolerance=1e-6)
number("sum", sum(why.weights), expected=1, tolerance=1e-12)
# A GPU moves corners to 1/256 of a pixel, and this triangle is a hundred pixels high: 1e-4.
drawn = pg.render(triangle, SIZE).pixels[pixel[1], pixel[0]]
number("off", np.abs(drawn - why.weights).max(), expected=0, tolerance=1e-4)
show(triangle, pixel=(0.5, 0.546), panel="Explain")  # its very middle

# %% [markdown]
# The weights are called *barycentric coordinates*. The weight of a corner is the area of the
# small triangle between the pixel and the two *other* corners, divided by the whole area:
#
# $$c = \lambda_A c_A + \lambda_B c_B + \lambda_C c_C, \quad \lambda_A + \lambda_B + \lambda_C = 1$$
#
# A pixel a little to the lower left has $\lambda_A$ = {weight_a:.2f}, $\lambda_B$ = {weight_b:.2f}
# and $\lambda_C$ = {weight_c:.2f}. That is its red, green and blue, too: here you see the
# weights themselves.

# %%
row = SIZE[1] // 2 + 20
inside = np.arange(80, 160)
line = pg.render(triangle, SIZE).pixels[row, inside]
plot(
    "Along a row of pixels every attribute changes evenly: straight lines, and nothing else.",
    x=("pixel of the row", inside),
    y="weight",
    curves={rf"$\lambda_{corner}$": line[:, i] for i, corner in enumerate("ABC")},
    shows=lambda *curves: all(
        np.abs(np.diff(curve, n=2)).max() < 1e-4 and (curve.min() > 0) for curve in curves
    ),
)

# %% [markdown] tags=["notes"]
# Let the class name the weights of a corner (1, 0, 0) and of the middle of an edge. In the window,
# move over the triangle with Explain open: it says the weights of every pixel. The
# weights are those of the point in space. For a triangle that leans away they are not those
# of the area on the screen; the GPU divides by the depth to get that right.

# %% [markdown] slides=[12] minutes=3
# ## The simplest fragment shader
#
# With per-vertex lighting the colour is finished before the rasteriser gets it. What is left to do
# for the fragment shader? The slide's answer, in HLSL:
#
# ```
# float4 FS_PhongPerVertex(float4 Color : COLOR) : COLOR {
#     return Color;
# }
# ```
#
# The program's, in HLSL of today and in GLSL (`present` is the display: exposure, clamp, curve):

# %%
hlsl = listing("hlsl/phong_per_vertex.hlsl", first="float4 FS_PhongPerVertex", last="}")
glsl = listing("colour.frag", first="void main", last="}", plain=True)
number("formulas", hlsl.count("shade(") + glsl.count("shade("), expected=0)

teapot = pg.load("teapot").with_(shading="per-vertex")
vertices = len(teapot.scene.objects[0].geometry().mesh.positions)
fragments = np.sum(pg.render(teapot, (960, 720)).coverage > 0)
number("vertices", vertices, expected=5400)
# An outline of some 3000 pixels, where drivers may differ by half a pixel.
number("fragments", fragments, expected=208_900, tolerance=1500)
number("ratio", fragments / vertices, expected=38.7, tolerance=0.3)
show(teapot)

# %% [markdown]
# Neither evaluates a formula: the model is called {formulas:.0f} times. The teapot has
# {vertices:.0f} vertices, and on a picture of 960 by 720 pixels it covers {fragments:.0f} of
# them. Lighting per vertex evaluates the model {ratio:.0f} times less often. On the graphics
# hardware of the nineties this was the only way.

# %% [markdown] tags=["notes"]
# COLOR behind the bracket is the old name of the result; since Direct3D 10 it is SV_Target. The
# vertex shader is in the next lesson, beside the one that replaces it.

# %% [markdown] slides=[13] minutes=4
# ## The lost highlight
#
# A shiny floor of just two triangles, a lamp above it. At first the model is evaluated at each
# pixel.

# %%
floor = pg.load("missed-highlight").with_(shading="per-vertex")
show(
    floor.with_(shading="per-fragment"),
    "Lit at each pixel, the floor has a highlight inside one of its two triangles.",
    shows=lambda picture: picture.pixels[:, :240].min(axis=2).max() > 0.9,
)
predict(
    "With per-vertex lighting, what becomes of the highlight?",
    "it is there, a little blurred",
    "it is spread evenly over the triangle",
    "it is gone",
    answer="it is gone",
    why="The model is asked at the corners only, and no corner sees the highlight. What is mixed "
    "from nothing is nothing.",
)


# %%
def highlight(setup, size=SIZE):
    """The picture of the specular term alone, its first channel."""
    alone = setup.with_(terms=["specular"], background=(0, 0, 0))
    return pg.render(alone, size).pixels[..., 0]


asked_at_vertices = highlight(floor)
asked_everywhere = highlight(floor.with_(shading="per-fragment"))
y, x = np.unravel_index(asked_everywhere.argmax(), asked_everywhere.shape)
corners = pg.explain(floor, (int(x), int(y)), SIZE).corners
nearest = min(corner.lights[0].rho for corner in corners)
# Full light times m_s = 0.8; the brightest pixel is at most a pixel beside the top.
number("everywhere", asked_everywhere.max(), expected=0.8, tolerance=0.01)
number("at_vertices", asked_at_vertices.max(), expected=0, tolerance=1e-9)
number("nearest", nearest, expected=54.8, tolerance=0.1)
number("there", np.cos(np.radians(nearest)) ** 60, expected=4e-15, tolerance=1e-15)
both = [pg.render(floor.with_(shading=s), SIZE) for s in ("per-vertex", "per-fragment")]
matt = [
    pg.render(floor.with_(shading=s, terms=["diffuse"]), SIZE)
    for s in ("per-vertex", "per-fragment")
]
number("diffuse_off", pg.compare(*matt).max, expected=0.30, tolerance=0.01)
figure(
    both,
    "Two triangles under a lamp: the highlight is missed, since it lies inside a triangle.",
    names=["per vertex", "per fragment"],
    shows=lambda a, b: (
        b.pixels[y, x].min() > 0.9
        and a.pixels[y, x].min() < 0.5
        and np.allclose(a.pixels[5, 5], b.pixels[5, 5])
    ),
)
show(floor, beside="per-fragment", pixel=(float(x + 0.5) / SIZE[0], float(y + 0.5) / SIZE[1]))

# %% [markdown]
# Where the highlight should be, it has brightness {everywhere:.1f}. Of the corners of that triangle
# the best one has an angle of $\rho$ = {nearest:.0f}° between $r$ and $v$, and
# $(\cos\rho)^{60}$ is {there:.0e}. The rasteriser is not to blame: it mixes what it gets.
#
# The diffuse term is wrong, too, by up to {diffuse_off:.1f}: look at the far edge of the floor.

# %% [markdown] tags=["notes"]
# The lecture: the colours at the vertices are *evenly* interpolated along the edges and then along
# the scan lines, so highlights inside a triangle cannot be caught. In the window the arrows
# $n$, $l$, $r$ and $v$ stand at the three corners, and the panel *Explain* draws the triangle
# enlarged: as its corners are mixed, as it is at every point, and the difference.

# %% [markdown] slides=[13] minutes=2
# ## The smeared highlight
#
# Now the floor has eight triangles, and the lamp is moved so that the highlight falls on the vertex
# in the middle, and on no other.

# %%
hit = floor.with_(tessellation=2, lights=[pg.PointLight(position=(0, 1.1, -2.3))])
smeared, true = highlight(hit), highlight(hit.with_(shading="per-fragment"))
# The eye, too, is as steep over the vertex: there ρ = 0. A pixel beside it lacks 1 %.
number("at_the_vertex", smeared.max(), expected=0.8, tolerance=0.01)
larger = np.sum(smeared > 0.4) / np.sum(true > 0.4)
number("larger", larger, expected=6.3, tolerance=0.3)  # counted in some 500 and 3000 pixels
figure(
    [pg.render(hit.with_(shading=s), SIZE) for s in ("per-vertex", "per-fragment")],
    "The highlight falls on the vertex in the middle: per vertex it spreads over six triangles.",
    names=["per vertex", "per fragment"],
    shows=lambda a, b: np.sum(a.pixels > 0.8) > 2 * np.sum(b.pixels > 0.8) > 0,
)
show(hit, beside="per-fragment")

# %% [markdown]
# At the vertex itself the brightness is right, {at_the_vertex:.2f}. From there it falls in straight
# lines to the next vertices, however far away they are. The spot is {larger:.0f} times too
# large, and it has corners.

# %% [markdown] slides=[14] minutes=4
# ## Popping
#
# So a highlight is too small between the vertices and too large upon them. Now the camera moves.

# %%
predict(
    "A camera moves evenly around a coarse ball. With per-vertex lighting, the highlight",
    "glides evenly over the ball",
    "lights up and goes out, again and again",
    "stays where it is on the ball",
    answer="lights up and goes out, again and again",
    why="The highlight does glide on. But it is only seen while it passes a vertex.",
)

# %%
ball = pg.load("popping")


def from_around(setup, degrees):
    """The same setup after the camera has moved around the vertical axis."""
    (x, y, z), angle = setup.camera.eye, np.radians(degrees)
    c, s = np.cos(angle), np.sin(angle)
    return setup.with_(eye=(c * x + s * z, y, c * z - s * x))


def peaks(setup, shading, angles):
    """The brightest value of the highlight from each angle."""
    alone = setup.with_(shading=shading, terms=["specular"], background=(0, 0, 0))
    with pg.open_renderer((160, 120)) as renderer:
        pictures = [renderer.render(from_around(alone, angle)) for angle in angles]
    return np.array([picture.pixels.max() for picture in pictures])


angles = np.arange(0, 121, 2)  # degrees: 2 from frame to frame
vertex, fragment = (peaks(ball, s, angles) for s in ("per-vertex", "per-fragment"))
plot(
    "The camera moves evenly; the brightest point of the highlight, from frame to frame.",
    x=("angle of the camera in degrees", angles),
    y="brightest point",
    curves={"per vertex": vertex, "per fragment": fragment},
    shows=lambda a, b: np.ptp(a) > 0.4 and 0 < np.ptp(b) < 0.03 and b.min() > a.max(),
)
# Counted on the pixels of one picture each: the third digit is the driver's.
number("jump_vertex", np.abs(np.diff(vertex)).max(), expected=0.110, tolerance=0.004)
number("jump_fragment", np.abs(np.diff(fragment)).max(), expected=0.011, tolerance=0.003)
number("darkest", vertex.min(), expected=0.01, tolerance=0.004)
number("brightest", vertex.max(), expected=0.52, tolerance=0.01)
number("steady", fragment.mean(), expected=0.9, tolerance=0.01)  # m_s = 0.9, wherever it is seen
figure(
    [pg.render(from_around(ball, angle), SIZE) for angle in (38, 46, 52)],
    "Three frames of the per-vertex movement: the highlight goes out and lights up.",
    names=["at 38°", "at 46°", "at 52°"],
    shows=lambda a, b, c: c.pixels.max() - a.pixels.max() > 0.2 and a.pixels.std() > 0.05,
)
show(ball, beside="per-fragment", panel="Popping scope")

# %% [markdown]
# It should be as bright as {steady:.1f} all the time. Per vertex it varies from {darkest:.2f} to
# {brightest:.2f}; the largest jump from one frame to the next, 2° on, is {jump_vertex:.2f}, against
# {jump_fragment:.2f} with per-fragment lighting, where the pixels alone are to blame. This is
# *popping*. In a still picture one may overlook a wrong highlight; flashing catches every eye.

# %%
goal(
    "Calm it: over the first 60°, in steps of 2°, there is no jump above 0.05, and the highlight "
    "is always there (above 0.4). Stay with per-vertex lighting.",
    reached=lambda setup: (
        setup.settings.shading == "per-vertex"
        and np.abs(np.diff(peaks(setup, "per-vertex", angles[:31]))).max() < 0.05
        and peaks(setup, "per-vertex", angles[:31]).min() > 0.4
    ),
    hint="There are two ways: more vertices, so that none is ever far; or a highlight so wide that "
    "it always reaches one. The panels Scene and Material have what you need.",
    solution=ball.with_(tessellation=40),
)

# %% [markdown] tags=["notes"]
# Play it: the panel Popping scope moves the camera and draws these curves while it does. With more
# vertices the jumps at first get larger (the highlight is brighter when it is there) before
# they get smaller. Let the class try 8, 12, 16, 32.

# %% [markdown] minutes=2
# ## Try this
#
# Back to the floor without a highlight.

# %%
show(floor, beside="per-fragment", panel="Lights")
goal(
    "Bring the highlight back, at least half as bright as it should be, with per-vertex lighting.",
    reached=lambda setup: (
        setup.settings.shading == "per-vertex"
        and highlight(setup).max()
        > 0.5 * highlight(setup.with_(shading="per-fragment")).max()
        > 0.2
    ),
    hint="A vertex must see the highlight. Either there are more of them (Scene, tessellation), or "
    "the lamp moves until the highlight is on one that is there.",
    solution=floor.with_(tessellation=32),
)
goal(
    "Now with the two triangles alone: the floor has four vertices.",
    reached=lambda setup: (
        setup.settings.shading == "per-vertex"
        and setup.scene.objects[0].tessellation in (0, 1)
        and setup.scene.objects[0].mesh == "quad"
        and highlight(setup).max()
        > 0.5 * highlight(setup.with_(shading="per-fragment")).max()
        > 0.2
    ),
    hint="Move the lamp: at a corner of the floor, its light must come in as steeply as you "
    "look, from the other side. The corners are at (±2, 0, ±2), the eye is at (0, 2.2, 4.6).",
    solution=floor.with_(lights=[pg.PointLight(position=(-2.6, 0.66, -3.98))]),
)
