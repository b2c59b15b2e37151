# %% [markdown] slides=[20] minutes=2
# # Hemisphere, hemicube and the solution
#
# The form factor of two *points* is a short formula. Patches are no points, and other patches
# stand in between. How does one find what fraction of a patch's light arrives at each of
# thousands of others? By taking five small pictures.

# %%
import numpy as np

import playground as pg
from playground.lesson import figure, goal, number, plot, predict, show

NONE = (0, 0, 0)
up = np.array([0.0, 0.0, 1.0])  # the normal of the patch, whose centre p is at (0, 0, 0)
square = 0.5 * np.array([(-1, -1, 2), (-1, 1, 2), (1, 1, 2), (1, -1, 2)])  # faces it, 1 away
from_point = pg.shading.area_light.form_factor
show(pg.load("facing-plates").with_(patches=100), method="radiosity")
of_patches = pg.shading.polygon_pair.pair_form_factor

# %% [markdown]
# In principle the formula has to be integrated over *both* patches. If the radiosity is constant
# over a patch, and the patch is small, then one of its points can speak for all of them. That
# leaves *point-to-patch*: one integral, over the other patch alone.

# %%
predict(
    "The form factor of the unit squares of lesson 14, a side apart, is 0.200 from patch to patch "
    "and 0.318 from centre to centre. From the centre of the one to all of the other it is",
    "0.200 as well: the centre is the mean of all points",
    "between the two",
    "0.318 as well",
    answer="between the two",
    why="The centre is not the mean: of all the points it sees the other square best. But it sees "
    "all of that square, and not only its centre.",
)

# %%
mine = square * (1, 1, 0)


def by_centres(n):
    """The mean over the centres of n × n pieces of one square, each seeing all of the other."""
    middle = (np.arange(n) + 0.5) / n - 0.5
    x, y = np.meshgrid(middle, middle)
    return from_point(np.stack([x, y, 0 * x], axis=-1), up, square, False).mean()


one, both = by_centres(1), of_patches(mine[::-1], square)
off = {n: 100 * (by_centres(n) / both - 1) for n in (1, 2, 4)}
# A square that faces a point: four times a corner's factor, Howell, B-3, with a = b = 1/2.
corner = 0.5 / np.sqrt(1.25) * np.arctan(0.5 / np.sqrt(1.25)) / np.pi
number("one", one, expected=4 * corner, tolerance=1e-14)
number("both", both, expected=0.199825, tolerance=1e-6)
number("off", off[1], expected=19.8, tolerance=0.1)
number("off_16", off[4], expected=off[2] / 4, tolerance=0.1)  # it falls as 1/n²

# %% [markdown]
# It is {one:.3f}, {off:.0f} % too large: these squares are as close as they are wide. Cut
# one of them into 4 × 4 smaller patches, each with a point of its own, and {off_16:.1f} % are left.

# %% [markdown] slides=[20] minutes=3
# ## The hemisphere
#
# Nusselt found in 1928 how to *see* the form factor between $p$ and a patch $s_j$. Put a hemisphere
# of radius 1 over $p$. Project the patch onto it, towards $p$, and the result straight down onto
# the base.
#
# $$f = \frac{\mathrm{area\ on\ the\ base}}{\mathrm{area\ of\ the\ base}}$$
#
# The first projection brings $\cos\theta_j$ and the square of the distance, the second brings
# $\cos\theta_i$, and the area of the base is the $\pi$.

# %%
patch = np.array([(0.3, -0.2, 1.3), (1.3, 0.1, 0.9), (1.2, 1.0, 1.3), (0.2, 0.7, 1.7)])


def glowing(mesh, at, colour, scale, rotate=NONE):
    """An object that shows its colour, lit or not; x, y, z of the lesson with z up."""
    glow = pg.Material(diffuse=NONE, specular=NONE, ambient=NONE, emissive=colour)
    place = pg.Transform(translate=tuple(upright(at)), scale=scale, rotate=rotate)
    return pg.Object(
        mesh=mesh, material=glow, transform=place, tessellation=48 if mesh == "disc" else 6
    )


def upright(vector):
    """From z up to the program's y up."""
    x, y, z = vector
    return np.array([x, z, -y])


def line(points, colour, radius=0.012):
    """Rods from point to point."""
    made = []
    for i in range(1, len(points)):
        a, b = points[i - 1], points[i]
        x, y, z = upright(np.subtract(b, a))
        length = np.sqrt(x * x + y * y + z * z)
        turn = (np.degrees(np.arccos(y / length)), np.degrees(np.arctan2(x, z)), 0)
        middle = np.add(a, b) / 2
        made.append(glowing("cylinder", middle, colour, (radius, length / 2, radius), turn))
    return made


def circle(first, second, half=False):
    """Points of a circle of radius 1, or of half of one."""
    angle = np.linspace(0, np.pi if half else 2 * np.pi, 25 if half else 49)[:, None]
    return np.cos(angle) * first + np.sin(angle) * second


GREY, YELLOW, ORANGE, PINK = (0.3, 0.3, 0.35), (0.9, 0.8, 0.1), (1.0, 0.5, 0.1), (0.9, 0.3, 0.6)
edge = np.linspace(patch, np.roll(patch, -1, axis=0), 9)[:-1].transpose(1, 0, 2).reshape(-1, 3)
outline = np.vstack([edge, edge[:1]])
on_sphere = outline / np.linalg.norm(outline, axis=1, keepdims=True)
on_base = on_sphere * (1, 1, 0)
x, y = np.array([1.0, 0, 0]), np.array([0, 1.0, 0])
drawn = line(circle(x, y), GREY) + line(circle(x, up, True), GREY) + line(circle(y, up, True), GREY)
drawn += line(outline, YELLOW) + line(on_sphere, ORANGE) + line(on_base, PINK, 0.02)
for i in (0, 8, 16, 24):
    drawn += line([NONE, outline[i]], YELLOW, 0.004) + line([on_sphere[i], on_base[i]], PINK, 0.004)
drawn.append(glowing("disc", (0, 0, -0.03), (0.12, 0.12, 0.15), (1, 1, 1)))
nusselt = pg.load("sphere").with_(objects=drawn, lights=[pg.DirectionalLight()])
nusselt = nusselt.with_(eye=(1.2, 2.4, 4.6), target=(0.3, 0.6, -0.2), fov=32, background=NONE)


def pixels_of(picture, colour):
    """How many pixels have this colour."""
    return np.sum(np.abs(picture.pixels - colour).max(axis=2) < 0.01)


show(
    nusselt,
    "A patch (yellow), on the hemisphere (orange), and down on the base (pink).",
    shows=lambda picture: all(pixels_of(picture, c) > 200 for c in (YELLOW, ORANGE, PINK)),
)
predict(
    "The patch is pushed away from $p$, twice as far, and made twice as large. Its form factor is",
    "a quarter: the square of the distance",
    "half",
    "the same",
    answer="the same",
    why="It covers the same part of the hemisphere. All that $p$ knows of a patch is in which "
    "directions it is seen.",
)


# %%
def on_the_base(corners, n=400):
    """A picture of the base from above: white where the direction over it meets the polygon."""
    u, v = np.meshgrid(*[(np.arange(n) + 0.5) / n * 2 - 1] * 2)
    height = np.sqrt(np.clip(1 - u**2 - v**2, 0, None))
    inside = u**2 + v**2 < 1
    return met(np.stack([u, v, height], axis=-1), corners) & inside, inside


def met(directions, corners):
    """Which rays from p meet a flat convex polygon: those on one side of all its edges."""
    edges = zip(corners, np.roll(corners, -1, axis=0), strict=True)
    sides = np.array([directions @ np.cross(a, b) for a, b in edges])
    ahead = directions @ corners.mean(axis=0) > 0
    return (np.all(sides > 0, axis=0) | np.all(sides < 0, axis=0)) & ahead


seen, base = on_the_base(patch)
exact = from_point(NONE, up, patch[::-1], False)
# The outline crosses some 800 pixels of 126,000; their errors are ±0.3 each, at random: 1e-4.
number("nusselt", seen.sum() / base.sum(), expected=exact, tolerance=3e-4)
number("farther", from_point(NONE, up, 2 * patch[::-1], False), expected=exact, tolerance=1e-12)
grey = np.where(seen[..., None], PINK, np.where(base[..., None], (0.3, 0.3, 0.35), NONE))
figure(
    pg.Image(grey[::-1].astype(np.float32)),
    "The base from above. The form factor is the pink share of the disc.",
    shows=lambda picture: (
        abs(pixels_of(picture, PINK) / np.sum(picture.pixels.max(axis=2) > 0) - exact) < 1e-3
    ),
)

# %% [markdown]
# Counted in the picture, {nusselt:.4f} of the base is covered, and that is the form factor. Of the
# patch twice as far and twice as large it is {farther:.4f}. A fisheye lens of the kind that is
# called orthographic, put at $p$, takes such photographs.

# %% [markdown] tags=["notes"]
# Hold a sheet of paper over a table and let the class guess the shadow's share. A patch near the
# horizon has hardly any base: Lambert's cosine of the receiver. What covers all of the
# hemisphere has 1: the form factors of a closed room sum to 1.

# %% [markdown] slides=[19, 20] minutes=4
# ## The hemicube
#
# A rasteriser draws flat pictures with straight edges; it cannot draw on a hemisphere. But *any*
# surface around $p$ will do, so Cohen and Greenberg took half a cube in 1985: a square picture at
# the top and four halves at the sides.
#
# Its pixels do not all count alike. The form factor of each is a number that depends on where
# the pixel is, and on nothing else: it can be *pre-computed*.


# %%
def onto_cube(points):
    """Where the ways from p to these points pass through a cube of half edge 1."""
    return points / np.abs(points).max(axis=1, keepdims=True)


rim = np.array([(1, 1, 0), (-1, 1, 0), (-1, -1, 0), (1, -1, 0), (1, 1, 0)])
halves = line(rim, GREY) + line(rim + up, GREY)
for foot in rim[:4]:
    halves += line([foot, foot + up], GREY)
# Fine pieces, so that none cuts through the edge of the cube.
fine = np.linspace(outline[:-1], outline[1:], 8, endpoint=False).transpose(1, 0, 2).reshape(-1, 3)
halves += line(outline, YELLOW) + line(onto_cube(np.vstack([fine, fine[:1]])), ORANGE, 0.02)
for i in (0, 8, 16, 24):
    halves += line([NONE, outline[i]], YELLOW, 0.004)
show(
    nusselt.with_(objects=halves, eye=(3.6, 2.6, 3.8), target=(0.3, 0.5, -0.2), fov=35),
    "The same patch (yellow) on half a cube (orange): on its top, and on one of its sides.",
    shows=lambda picture: all(pixels_of(picture, c) > 200 for c in (YELLOW, ORANGE)),
)
predict(
    "Which pixel of the hemicube has the largest form factor?",
    "one in the middle of the top",
    "one in a corner of the top, as that is farthest away",
    "one at the horizon, at the foot of a side",
    answer="one in the middle of the top",
    why="It is nearest, straight above $p$, and faces it. At the horizon light arrives at a "
    "grazing angle: next to nothing.",
)


# %%
def pixel_factors(n):
    """The form factors of the pixels of the top (n, n), and of a side (n/2, n), from its foot."""
    column, row = np.arange(n), np.arange(n)[:, None]
    rule = pg.shading.hemicube.exact_delta_form_factor
    return rule(column, row, n, False), rule(column, row[: n // 2], n, True)


def unfolded(top, left, right, above, below, n):
    """Five faces laid flat; the sides are pictures with the horizon in their last row."""
    flat, h = np.zeros((2 * n, 2 * n, *top.shape[2:])), n // 2
    flat[h : h + n, h : h + n] = top
    flat[h : h + n, :h] = np.rot90(left, -1)
    flat[h : h + n, h + n :] = np.rot90(right)
    flat[:h, h : h + n] = np.rot90(above, 2)
    flat[h + n :, h : h + n] = below
    return flat


top, side = pixel_factors(64)
number("sum_all", top.sum() + 4 * side.sum(), expected=1, tolerance=1e-12)
# In closed form: a square of half edge 1 at distance 1, as in the first step.
number(
    "sum_top",
    top.sum(),
    expected=4 / np.sqrt(2) * np.arctan(1 / np.sqrt(2)) / np.pi,
    tolerance=1e-12,
)
# Height over (1 + u² + v²)², in the middle of either pixel; within a pixel it changes a little.
number("most", top.max() / side.min(), (1 + (63 / 64) ** 2 + (1 / 64) ** 2) ** 2 * 64, tolerance=1)
flat = unfolded(top, *[side[::-1]] * 4, n=64) / top.max()
figure(
    pg.Image(
        np.repeat(np.repeat(flat, 3, axis=0), 3, axis=1)[..., None].repeat(3, 2).astype(np.float32)
    ),
    "The hemicube unfolded: how much each pixel counts. The outer borders are the horizon.",
    shows=lambda picture: (
        picture.pixels[192, 192].min() > 0.9
        and picture.pixels[192, 3].max() < 0.1
        and np.all(np.diff(picture.pixels[192, 195:288:3, 0]) < 0)  # from the middle to the edge
    ),
)


def by_hemicube(corners, n):
    """The sum of the form factors of the pixels in whose centre the polygon is seen."""
    top, side = pixel_factors(n)
    along, height = (np.arange(n) + 0.5) / n * 2 - 1, (np.arange(n // 2) + 0.5) / n * 2
    u, v = np.meshgrid(along, along)
    s, z = np.meshgrid(along, height)
    ones = np.ones_like(s)
    total = top[met(np.stack([u, v, np.ones_like(u)], axis=-1), corners)].sum()
    for directions in ((ones, s, z), (-ones, s, z), (s, ones, z), (s, -ones, z)):
        total += side[met(np.stack(directions, axis=-1), corners)].sum()
    return total


def turned(degrees):
    """The patch, turned around the normal: the form factor stays."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return patch @ np.array([(c, s, 0), (-s, c, 0), (0, 0, 1)])


sizes = np.array([8, 16, 32, 64, 128])
turns = np.arange(48) * 137.5  # degrees: no two alike, as far as a cube can tell
errors = np.array([[by_hemicube(turned(a), n) / exact - 1 for a in turns] for n in sizes])
typical = np.sqrt(np.mean(errors**2, axis=1))
plot(
    "The typical error of the hemicube, over 48 turns of the patch.",
    x=("pixels along an edge", sizes),
    y="error in %",
    curves={"typical error": 100 * typical},
    shows=lambda error: 5 < error[0] < 16 and all(error[1:] < error[:-1] / 1.6),
    log="xy",
)
# Of 48 samples such a mean is known to 1/√96 = 10 %; three times that.
number("at_8", 100 * typical[0], expected=10, tolerance=3)
number("at_64", 100 * typical[3], expected=0.45, tolerance=0.14)
slope = np.polyfit(np.log2(sizes), np.log2(typical), 1)[0]
# Pixels at the outline are wrong by about half: √n of them, each 1/n² large, at random: n to −1.5.
number("slope", -slope, expected=1.5, tolerance=0.3)
number("shrinks", 2**-slope, expected=2**1.5, tolerance=0.7)

# %% [markdown]
# All pixels together count {sum_all:.0f}, as they must: they cover the hemisphere. The top alone
# counts {sum_top:.2f}, and its middle {most:.0f} times as much as the lowest corner of a side.
#
# The form factor of a patch is now the sum over the pixels that it covers. Of the patch above, it
# is {at_8:.0f} % off with 8 pixels along an edge and {at_64:.1f} % with 64. Each doubling makes
# the error {shrinks:.1f} times smaller.

# %% [markdown] tags=["notes"]
# What falls between the centres of two pixels is not seen at all: a lamp far away may vanish. And
# neighbouring hemicubes with parallel rows make their errors in the same places: the program turns
# each one by another angle. In the panel Form factors, both can be seen in the item buffer.

# %% [markdown] slides=[19, 20] minutes=3
# ## Five pictures of a room
#
# Now the patch lies on the floor of the Cornell box. Five cameras at its centre, each with a
# field of view of 90°: the rasteriser draws them, and its depth buffer takes care of what hides
# what. Let every object have its number for a colour, and count.

# %%
box = pg.load("cornell-box").with_(patches=300)
N = 64


def five(setup, p, n, method="raster"):
    """The faces of the hemicube over a point of the floor, whose normal is y."""
    x, y, z = np.eye(3)
    looks = [(y, z), (-x, y), (x, y), (z, y), (-z, y)]  # where to, and what is up
    faces = []
    for look, upward in looks:
        camera = setup.with_(eye=tuple(p), target=tuple(p + 100 * look), up=tuple(upward), fov=90)
        faces.append(pg.render(camera, (n, n), method=method).pixels)
    return [faces[0], *(face[: n // 2] for face in faces[1:])]


objects = [
    pg.Object(
        mesh=item.mesh,
        transform=item.transform,
        material=pg.Material(emissive=(i, 0, 0), diffuse=NONE, specular=NONE, ambient=NONE),
    )
    for i, item in enumerate(box.scene.objects, 1)
]
numbered = box.with_(objects=objects, terms=["emissive"])
result = pg.radiosity(box)
centre = result.patches.centre + result.patches.origin
chosen = np.linalg.norm(centre - (386, 0, 140), axis=1).argmin()
eye = centre[chosen] + (0, 0.1, 0)  # a tenth of a millimetre above the floor
buffer = [np.rint(face[..., 0]).clip(0, 7).astype(int) for face in five(numbered, eye, N)]
top, side = pixel_factors(N)
share = np.zeros(8)
for i, face in enumerate(buffer):
    share += np.bincount(face.ravel(), (side[::-1] if i else top).ravel(), minlength=8)
program = result.form_factors.rows([chosen])[0]
owner = result.patches.owner
by_program = [program[owner == i].sum() for i in range(7)]

OPEN, LIGHT, CEILING, RED = (0.1, 0.1, 0.2), (0.8, 0.8, 0.8), (0.4, 0.4, 0.5), (0.8, 0.15, 0.1)
GREEN, SHORT, TALL, LAMP = (0.15, 0.6, 0.1), (0.9, 0.7, 0.3), (0.3, 0.5, 0.9), (1.0, 1.0, 0.0)
COLOURS = np.array([OPEN, LIGHT, CEILING, RED, GREEN, SHORT, TALL, LAMP])


def sheet(faces):
    """The five faces as one picture, each pixel drawn 3 × 3."""
    flat = unfolded(*faces, n=N)
    return pg.Image(np.repeat(np.repeat(flat, 3, axis=0), 3, axis=1).astype(np.float32))


shine = five(box, eye, N, method="radiosity")
figure(
    [sheet([(face / 0.4) ** (1 / 2.2) for face in shine]), sheet([COLOURS[k] for k in buffer])],
    "The hemicube, unfolded: what the patch sees, and the same with a colour for each object: "
    "ceiling (grey) with the lamp (yellow), red, green and back wall, short block (orange), tall "
    "block (blue). Dark blue is the open front; the four black corners belong to no face.",
    names=["what the patch sees", "the item buffer"],
    shows=lambda sight, item: (
        pixels_of(item, RED) > 5000
        and pixels_of(item, GREEN) > 2000
        and 100 < pixels_of(item, LAMP) < 1000
        and pixels_of(item, NONE) == 4 * 96**2
        and np.all(sight.pixels[np.abs(item.pixels - OPEN).max(axis=2) < 0.01] == 0)
        and sight.pixels[np.abs(item.pixels - RED).max(axis=2) < 0.01][:, 0].mean() > 0.3
    ),
)
number("red", 100 * share[3], expected=100 * by_program[2], tolerance=2)
number("lamp", 100 * share[7], expected=100 * by_program[6], tolerance=0.3)
number("open", 100 * share[0], expected=100 * (1 - program.sum()), tolerance=2)
number("sum", share.sum(), expected=1, tolerance=1e-12)
show(box, method="radiosity", panel="Form factors")

# %% [markdown]
# The patch sends {red:.0f} % of its light to the red wall, {lamp:.1f} % into the lamp, and
# {open:.0f} % out of the open front. The shares of all sum to {sum:.0f}. One hemicube gives all the
# form factors of a patch, one *row* of the table, at the price of five small pictures. Number the
# patches in place of the objects, and that is all there is to the method.

# %% [markdown] tags=["notes"]
# The numbers are held against the closed form of the program, which takes all of the patch and not
# only its centre: they agree to a percentage point. In the panel Form factors two patches can be
# chosen: every method, one below the other, with the exact value.

# %% [markdown] slides=[20] minutes=4
# ## The solution
#
# With the table of form factors, what is left is a system of equations. It can be solved as light
# itself would do it, bounce by bounce. *Gathering*: in each round every patch collects from all
# others what they had in the round before. *Shooting*: the patch that has most light to give sends
# it to all the others; then the next one.

# %%
count = len(result.patches)
predict(
    f"The box has {count} patches, and the lamp is 2 of them. After how many shots has all the "
    "direct light arrived?",
    "2",
    f"{count}, one for each patch",
    f"{2 * count}: each of the {count} has to be lit by both",
    answer="2",
    why="Nothing but the lamp has light at the beginning. The first round of gathering does the "
    f"same, and needs all {count} rows of the table for it.",
)

# %%
gathering = list(pg.radiosity(box.with_(solver="jacobi")).steps())
result = pg.radiosity(box.with_(solver="progressive"))
shooting = list(result.steps())
lamp_done = next(step for step in shooting if step.done == 2)
same = np.abs(lamp_done.exact - gathering[1].light).max()
number("same", same, expected=0, tolerance=1e-5 * gathering[1].light.max())  # float32 reciprocity
number("rounds", len(gathering) - 1, expected=14, tolerance=1)
number("shots", shooting[-1].done, expected=1900, tolerance=200)
imbalance = max(step.ledger.imbalance for step in (*gathering, *shooting))
number("imbalance", imbalance, expected=0, tolerance=1e-12)  # sums of 300 float64 numbers


def after(rounds):
    """The box after so many rounds of gathering: stopped at the light that was left then."""
    left = gathering[rounds].residual * 1.000001
    return pg.render(box.with_(solver="jacobi", convergence=left), (320, 240), method="radiosity")


figure(
    [after(1), after(2), after(4)],
    "Light after one bounce, two and four: the ceiling is dark in the first picture only.",
    names=["1 bounce", "2 bounces", "4 bounces"],
    shows=lambda a, b, c: (
        a.pixels[14:28, 75:105].max() == 0
        and b.pixels[14:28, 75:105, 0].min() > 0.02
        and c.pixels.sum() > 1.02 * b.pixels.sum() > 1.1 * a.pixels.sum()
    ),
)
marks = np.linspace(2, 1000, 60)
early = [
    max((step for step in shooting if step.done <= mark), key=lambda s: s.done) for mark in marks
]
books = {
    part: [getattr(step.ledger, part)[0] / step.ledger.emitted[0] for step in early]
    for part in ("absorbed", "escaped", "unshot")
}
plot(
    "Where the red light has gone, shot by shot: absorbed, out of the front, or still to be sent.",
    x=("shots", marks),
    y="share of what is emitted",
    curves=books,
    shows=lambda absorbed, escaped, unshot: (
        np.allclose(absorbed + escaped + unshot, 1) and unshot[0] > 0.3 and unshot[-1] < 0.01
    ),
)
escaped = gathering[-1].ledger.escaped / gathering[-1].ledger.emitted
number("escaped", 100 * escaped[0], expected=31, tolerance=2)
show(box.with_(solver="progressive"), method="radiosity", panel="Radiosity")

# %% [markdown]
# After its first 2 shots, shooting has what gathering has after a whole round: they differ by
# {same:.0e}. So it shows a useful picture at once, and the hemicubes of dark corners are
# never needed for that. To the end it took {rounds:.0f} rounds, or {shots:.0f} shots.
#
# At every step the books balance, to {imbalance:.0e}: what the lamp emits has been absorbed, has
# left by the open front ({escaped:.0f} % in the end), or waits to be sent. Light is neither made
# nor lost.

# %% [markdown] tags=["notes"]
# In the window the panel Radiosity steps through the solution, marks the patch that shoots, and
# shows the light bounce by bounce; the panel Solvers lets all solvers race. Shooting shows more
# than has arrived: it adds an estimate of the light that is still under way, as ambient light;
# the books do without.

# %% [markdown] slides=[20] minutes=2
# ## The furnace
#
# A test with a known answer: a closed room whose walls all glow by $E$ and all reflect
# $\rho$. Everything is equally bright then, and $B = E + \rho B$. So
#
# $$B = \frac{E}{1 - \rho}$$
#
# whatever the shape of the room. The form factors of each patch sum to 1, since all of its light
# arrives somewhere.

# %%
predict(
    r"$\rho$ = 0.9, and by some inaccuracy the form factors of each patch sum to 1.01. How much "
    r"too "
    "bright is the room?",
    "1 %",
    "about 2 %",
    "about 10 %",
    answer="about 10 %",
    why=r"$1 - 0.9 \cdot 1.01 = 0.091$ stands where $0.1$ should. Light is made at every bounce, "
    "and there are many of them.",
)

# %%
furnace = pg.load("furnace").with_(
    patches=100, diffuse=(0.9, 0.9, 0.9), emissive=(0.05, 0.05, 0.05)
)
solved = pg.radiosity(furnace.with_(solver="direct")).solve()
number("answer", solved.light.mean(), expected=0.05 / (1 - 0.9), tolerance=1e-9)  # rows sum to 1
table = solved.form_factors.matrix()


def too_bright(factor, rho):
    """By how many percent a furnace is too bright if all form factors are too large by a factor."""
    light = np.linalg.solve(np.eye(len(table)) - factor * rho * table, np.full(len(table), 1 - rho))
    return 100 * (light.mean() - 1)


number("at_09", too_bright(1.01, 0.9), expected=100 * (0.1 / 0.091 - 1), tolerance=1e-6)
number(
    "at_099", too_bright(1.01, 0.99) / 100 + 1, expected=0.01 / (1 - 1.01 * 0.99), tolerance=1e-6
)

coarse = furnace.with_(form_factors="point-to-point", solver="direct", diffuse=(0.7, 0.7, 0.7))
coarse = coarse.with_(emissive=(0.15, 0.15, 0.15), patches=150)
raw, whole = (pg.radiosity(coarse.with_(normalise=on)).solve() for on in (False, True))
sums = raw.form_factors.raw_sums()
number("largest", sums.max(), expected=1.24, tolerance=0.01)
# Brightness must lie between that of furnaces with the smallest and with the largest sum.
low, high = (0.15 / (1 - 0.7 * s) for s in (sums.min(), sums.max()))
number("raw", raw.light.max(), expected=(low + high) / 2, tolerance=(high - low) / 2)
number("mended", whole.light.max(), expected=0.5, tolerance=1e-9)
pictures = [
    pg.render(coarse.with_(normalise=on), (320, 240), method="radiosity") for on in (False, True)
]
figure(
    pictures,
    "A furnace by the formula of two points. Left as it is; right with every row divided by its "
    "sum.",
    names=["as they come", "normalised"],
    shows=lambda a, b: (
        np.ptp(b.pixels) < 1e-5 and abs(b.pixels.mean() - 0.5) < 1e-5 and np.ptp(a.pixels) > 0.02
    ),
)
show(coarse.with_(normalise=False), method="radiosity", panel="Radiosity")

# %% [markdown]
# It is {at_09:.1f} %. At $\rho$ = 0.99 the room is {at_099:.0f} times as bright as it should be,
# and at 0.991 there is no answer at all: light would grow without end. So in a closed scene each
# row is divided by its sum first. With the formula of two points, sums go up to {largest:.2f},
# and the walls of the furnace up to {raw:.2f} in the place of 0.5; normalised, they have
# {mended:.1f}.

# %% [markdown] tags=["notes"]
# Dividing mends the energy, not the form factors: in the furnace nobody can tell, as all senders
# are alike. It is a switch in the panel Radiosity, and the program reports what the sums were
# before.

# %% [markdown] minutes=2
# ## Try this
#
# The furnace, solved by hemicubes. Material and emission are in the panel Material.


# %%
def brightness(setup):
    """How bright the furnace is, over what its walls emit."""
    try:
        light = pg.radiosity(setup).solve().light
    except pg.PlaygroundError:  # it grows without end, or the walls do not glow at all
        return np.inf if setup.scene.objects[0].material.emissive != NONE else 0.0
    return light.mean() / max(np.mean(setup.scene.objects[0].material.emissive), 1e-9)


start = furnace.with_(form_factors="hemicube", diffuse=(0.5, 0.5, 0.5), emissive=(0.1, 0.1, 0.1))
show(start, method="radiosity", panel="Material")
goal(
    "Make the furnace 5 times as bright as its walls glow.",
    reached=lambda setup: len(setup.scene.objects) == 1 and 4.9 < brightness(setup) < 5.1,
    hint=r"Solve $1/(1 - \rho) = 5$.",
    solution=start.with_(diffuse=(0.8, 0.8, 0.8)),
)
goal(
    "In the panel Radiosity: let the program *make* light. Switch off what keeps the sums at 1, "
    "and find form factors for which the furnace is brighter than it can be.",
    reached=lambda setup: (
        not setup.settings.normalise
        and len(setup.scene.objects) == 1
        and brightness(setup) * (1 - np.mean(setup.scene.objects[0].material.diffuse)) > 1.02
    ),
    hint="Which of the methods takes patches for points?",
    solution=start.with_(normalise=False, form_factors="point-to-point"),
)
