# %% [markdown] minutes=1
# # The specular term and shininess
#
# Metal, wet stone, an apple: they look shiny because of a small bright spot, the *highlight*.
# The diffuse term cannot make one. What must a formula know to put a highlight in its
# place, and what decides how large it is?

# %%
import numpy as np

import playground as pg
from playground.lesson import figure, goal, number, plot, predict, show

ball = pg.load("sphere").with_(
    lights=[pg.DirectionalLight(to_light=(0, 0, 1))], eye=(0, 0, 6), fov=25
)
highlight = ball.with_(terms=["specular"], background=(0, 0, 0), specular=(1, 1, 1))
show(ball, panel="Material")

# %% [markdown] slides=[7] minutes=3
# ## It moves when you move
#
# The light stands behind the camera, so the highlight is in the middle of the ball. Now
# walk around the ball, by an angle of 40°. The light stays where it is.

# %%
show(
    ball,
    "A ball, its light behind the camera: the highlight is in the middle.",
    shows=lambda picture: np.argmax(picture.pixels.sum(axis=2)) % 480 in range(225, 256),
)
predict(
    "You have walked 40° around the ball. Where on the ball is the highlight now?",
    "where it was: it belongs to the ball",
    "20° from where it was, half as far as you went",
    "40° from where it was, it follows you",
    answer="20° from where it was, half as far as you went",
    why="The highlight sits where $r = v$: there the normal stands half-way between light and eye.",
)


# %%
def walked(setup, degrees, distance=6):
    """The same setup, seen after a walk around the ball."""
    angle = np.radians(degrees)
    eye = (distance * np.sin(angle), 0, distance * np.cos(angle))
    return setup.with_(eye=eye, fov=150 / distance)


def brightest_normal(setup):
    """The normal of the ball where its picture is brightest."""
    bright = pg.render(setup, (401, 401), renderer="numpy").pixels[..., 0]
    y, x = np.mean(np.nonzero(bright > 0.999 * bright.max()), axis=1)
    why = pg.explain(setup, (round(x), round(y)), (401, 401))
    return why.corners[0].normal


# From far away, so that v is the same at all points. In the middle a pixel is 0.4° wide.
before, after = (brightest_normal(walked(highlight, a, distance=600)) for a in (0, 40))
number("moved", np.degrees(np.arccos(before @ after)), expected=20, tolerance=0.4)
show(walked(ball, 40), pixel=(0.5, 0.5), panel="Explain")

# %% [markdown]
# The brightest point has moved by {moved:.0f}°. The diffuse term is *view-independent*; the
# specular term is highly *view-dependent*. It needs two more vectors than the light vector $l$:
# the view vector $v$ and the reflection vector $r$. With $\rho$ the angle between them,
#
# - a perfectly shiny surface shows its highlight at $p$ only when $\rho = 0$;
# - any other one shows most of it when $\rho = 0$, and less and less as $\rho$ grows.

# %% [markdown] tags=["notes"]
# Let the class point at the ball before the answer. Whoever says "it follows you" may
# think of a mirror image of the lamp at the camera. In the window, drag to orbit: the
# arrows $n$, $l$, $r$ and $v$ are those of the point in the middle.

# %% [markdown] slides=[7, 8] minutes=4
# ## How fast it falls off
#
# The lecture lets it fall off as a power:
#
# $$(\max(r \cdot v, 0))^{sh} \; s_s \otimes m_s$$
#
# where $sh$ is the *shininess*. The slide has four pictures, with $sh$ = 5, 10, 20 and 80.

# %%
show(ball.with_(shininess=5), panel="Material")
predict(
    "From $sh$ = 5 to $sh$ = 80, the shininess grows 16 times. What happens to the diameter of "
    "the highlight?",
    "it gets 16 times larger",
    "it gets about 4 times smaller",
    "it gets 16 times smaller",
    answer="it gets about 4 times smaller",
    why=r"Near its top the cosine is $1 - \rho^2/2$, so that $(\cos\rho)^{sh}$ depends on "
    r"hardly more than $\rho\,\sqrt{sh}$.",
)

# %%
shininess = (5, 10, 20, 80)
rho = np.linspace(0, 90, 181)
plot(
    "The larger the shininess, the faster the highlight falls off around the reflection vector.",
    x=(r"$\rho$ in degrees", rho),
    y=r"$(r \cdot v)^{sh}$",
    curves={f"$sh$ = {sh}": np.cos(np.radians(rho)) ** sh for sh in shininess},
    shows=lambda a, b, c, d: all((a > b)[1:-1]) and all((b > c)[1:-1]) and all((c > d)[1:-1]),
)
pictures = [pg.render(ball.with_(shininess=sh), (174, 174)) for sh in shininess]
figure(
    pictures,
    "The slide: the same ball under the same light, with growing shininess.",
    names=[f"({letter}) sh = {sh}" for letter, sh in zip("abcd", shininess, strict=True)],
    shows=lambda a, b, c, d: a.pixels.sum() > b.pixels.sum() > c.pixels.sum() > d.pixels.sum(),
)


# %%
def half_angle(sh):
    """The angle ρ, in degrees, at which the highlight is half as bright as in its middle."""
    return np.degrees(np.arccos(0.5 ** (1 / sh)))


def measured_half_angle(sh):
    """The same, from the area of the picture in which the highlight is at least half as bright.

    The ball seen from far away: r turns twice as fast as n, whose distance from the
    middle of the disc is the sine of its angle.
    """
    far = walked(highlight.with_(shininess=sh), 0, distance=600)
    picture = pg.render(far, (400, 400), renderer="numpy")
    share = np.mean(picture.pixels[..., 0] >= 0.5) / np.mean(picture.coverage)
    return np.degrees(2 * np.arcsin(np.sqrt(share)))


# Counting pixels, the edge of the spot is known to about half a pixel: 0.2°, twice that for r.
for sh in shininess:
    number(f"half_{sh}", measured_half_angle(sh), expected=half_angle(sh), tolerance=0.4)
number("ratio", half_angle(5) / half_angle(80), expected=4, tolerance=0.1)
show(ball, panel="Material")

# %% [markdown]
# The highlight is half as bright as in its middle at $\rho$ = {half_5:.0f}°, {half_10:.0f}°,
# {half_20:.0f}° and {half_80:.1f}°, counted in the pictures. From the first to the last it
# gets {ratio:.1f} times smaller: the size goes with one over the square root of $sh$.

# %% [markdown] tags=["notes"]
# The slider of the shininess is in the panel Material, with buttons for the four values of the
# slide. A common mistake: the exponent is taken for a size. Ask what $sh$ = 0 would show: a
# surface as bright as the light wherever $r \cdot v$ is positive.

# %% [markdown] slides=[7] minutes=2
# ## Which colour it has
#
# $m_d$ is the colour of the surface. $m_s$ is usually a grey. Light a blue ball with a yellow
# lamp; in the window its specular term is still off.

# %%
yellow = pg.DirectionalLight(
    to_light=(0, 0, 1), diffuse=(1, 1, 0), specular=(1, 1, 0), ambient=(0.2, 0.2, 0.2)
)
blue = ball.with_(
    lights=[yellow], diffuse=(0, 0, 0.8), ambient=(0, 0, 0.8), specular=(0.9, 0.9, 0.9)
)
show(blue.with_(terms=["diffuse", "ambient"]), panel="Lights")
predict(
    "Yellow light (1, 1, 0) on a blue ball (0, 0, 0.8) with grey $m_s$. Which colour is the "
    "highlight?",
    "blue",
    "yellow",
    "white",
    answer="yellow",
    why="A grey $m_s$ weakens all three channels of $s_s$ alike.",
)

# %%
middle = pg.render(blue, (101, 101)).pixels[50, 50]
number("red", middle[0], expected=0.9, tolerance=0.01)
number("green", middle[1], expected=0.9, tolerance=0.01)
number("blue", middle[2], expected=0.16, tolerance=0.001)  # s_a ⊗ m_a, and nothing else
show(
    blue,
    "Yellow light on a blue ball: the ball stays dark, its highlight is yellow.",
    shows=lambda picture: (
        picture.pixels[180, 240, 1] > 5 * picture.pixels[180, 240, 2]
        and max(picture.pixels[180, 140]) < 0.2
    ),
)

# %% [markdown]
# In the middle the picture is ({red:.1f}, {green:.1f}, {blue:.2f}): red and green are the
# specular term, and the little blue is ambient light. A grey $m_s$ lets the highlight have
# *the colour of the light source*.

# %% [markdown] minutes=4
# ## Try this
#
# Change the scene until the goals are reached. What you need is in the panels Terms, Material
# and Lights.


# %%
def peak(setup):
    """The brightest pixel of the specular term alone."""
    dark = setup.with_(terms=[t for t in setup.settings.terms if t == "specular"])
    return pg.render(dark.with_(background=(0, 0, 0)), (120, 90)).pixels.max()


show(ball.with_(shininess=10), panel="Material")
goal(
    "Make the highlight disappear.",
    reached=lambda setup: peak(setup) < 0.01,
    hint="There are at least three ways: a term, a colour of the material, a colour of the light. "
    "Turning the ball or the light is none: some normal always stands half-way between.",
    solution=ball.with_(specular=(0, 0, 0)),
)
goal(
    "Find the shininess for which the highlight is half as bright at $\\rho$ = 10°.",
    reached=lambda setup: (
        abs(half_angle(max(setup.scene.objects[0].material.shininess, 1)) - 10) < 0.1
    ),
    hint=r"Solve $(\cos 10°)^{sh} = 0.5$ for $sh$, or use that twice the angle needs a "
    "quarter of the shininess.",
    solution=ball.with_(shininess=45),
)

# %% [markdown]
# And write it yourself: copy `lessons/assignments/phong.py` (or `phong.glsl`), fill in both
# terms, and ask `playground lesson 7 --check my_phong.py` what is right and what is likely wrong.
