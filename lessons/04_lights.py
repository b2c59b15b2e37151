# %% [markdown] minutes=1
# # Four kinds of light
#
# The sun, a bulb, a torch, a window on a cloudy day: all of them are light, and yet a table looks
# different under each. The lecture names four types, *point*, *area*, *spot* and *directional*
# light sources, and goes on with the simplest. What does a formula have to know of each?

# %%
import numpy as np

import playground as pg
from playground.lesson import figure, goal, number, plot, predict, show

NONE, DOWN = (0, 0, 0), (0, -1, 0)
matt = pg.Material(diffuse=(1, 1, 1), specular=NONE, ambient=NONE)
floor = pg.Object(mesh="quad", material=matt, transform=pg.Transform(size=2))  # 4 by 4


def on_floor(light):
    """The floor under one light, seen from straight above, so that it fills the picture."""
    setup = pg.load("sphere").with_(objects=[floor], lights=[light], background=NONE)
    above = setup.with_(eye=(0, 8, 0), target=NONE, up=(0, 0, -1))
    return above.with_(fov=2 * np.degrees(np.arctan(2 / 8)), terms=["diffuse"])


WIDE = 401
PITCH = 4 / WIDE  # the width of a pixel on the floor
place = PITCH * (np.arange(WIDE) - WIDE // 2)


def across(light):
    """The brightness of the floor along a line through its middle."""
    return pg.render(on_floor(light), (WIDE, WIDE)).pixels[WIDE // 2, :, 0]


sun = pg.DirectionalLight(to_light=(0, 1, 0))
clay = pg.Material(diffuse=(0.9, 0.5, 0.3), specular=NONE, ambient=(0.9, 0.5, 0.3))
grey = pg.Material(diffuse=(0.8, 0.8, 0.8), specular=NONE, ambient=(0.8, 0.8, 0.8))
table = on_floor(sun).with_(
    objects=[
        pg.Object(mesh="quad", material=grey, transform=pg.Transform(size=2)),
        pg.Object(
            mesh="sphere",
            tessellation=64,
            material=clay,
            transform=pg.Transform(size=0.4, translate=(0.9, 0.4, 0)),
        ),
    ],
    terms=["diffuse", "ambient"],
)
table = table.with_(eye=(0, 3.4, 6), target=(0, 0.1, 0), up=(0, 1, 0), fov=34)
show(table, panel="Lights")


# %% [markdown] slides=[4] minutes=2
# ## What each of them knows
#
# - A **directional** light has a direction and nothing else: the light vector $l$ is the same at
#   all points. That is the sun, so far away that where you stand makes no difference.
# - A **point** light has a position $q$. At a point $p$ of a surface, $l$ is the direction from
#   $p$ to $q$, and there is a distance $d$ between them. That is a bulb.
# - A **spot** light has a position as well, and an axis and a cone around it, outside of which it
#   is dark. That is a torch.
# - An **area** light has an outline. There is not one $l$ but as many as the outline has points,
#   and what they bring must be summed. That is a window.

# %%
predict(
    "A large flat floor without any shadow. Under which of the four is it equally bright "
    "everywhere?",
    "the directional light",
    "the point light, straight above its middle",
    "the area light: it is soft",
    answer="the directional light",
    why="From one place of the floor to another only the position changes, and the directional "
    "light is the only one of them that does not ask for it.",
)

# %%
bulb = pg.PointLight(position=(0, 2, 0))
torch = pg.SpotLight(position=(0, 2, 0), axis=DOWN, inner_angle=20, outer_angle=30)
window = pg.RectangleLight(
    position=(0, 2, 0), facing=DOWN, width=2, height=2, diffuse=(4, 4, 4), visible=False
)
kinds = {"directional": sun, "point": bulb, "spot": torch, "area": window}
four = [pg.render(table.with_(lights=[light]), (174, 116)) for light in kinds.values()]
row = (58, slice(36, 87))  # of the floor, from near its left edge to its middle


def evenness(picture):
    """The darkest over the brightest pixel in a row of the floor."""
    return picture.pixels[row].min() / picture.pixels[row].max()


figure(
    four,
    "A floor and a ball under each of them. Only the directional light is even on the floor; the "
    "spot light leaves most of it dark.",
    names=list(kinds),
    shows=lambda *made: (
        made[0].pixels[row].min() > 0.5
        and evenness(made[0]) > 0.999 > 0.8 > max(map(evenness, made[1:]))
        and evenness(made[2]) < 0.1
    ),
)
edges = {kind: across(light)[0] / across(light)[WIDE // 2] for kind, light in kinds.items()}
# At the edge, 2 from the middle, the bulb 2 above it stands 45° high; half a pixel there is
# 0.005 of 2, which changes the cosine by half of that.
number("sun_edge", edges["directional"], expected=1, tolerance=1e-6)
number("bulb_edge", edges["point"], expected=np.sqrt(0.5), tolerance=0.002)
number("torch_edge", edges["spot"], expected=0)
show(table.with_(lights=[bulb]), pixel=(0.5, 0.62), panel="Lights")

# %% [markdown]
# At the edge of the floor the directional light has {sun_edge:.2f} of its brightness in the middle,
# the point light {bulb_edge:.2f} (its light comes from 45° there, and Lambert's cosine is all
# that changes), and the spot light {torch_edge:.0f}.

# %% [markdown] tags=["notes"]
# In the window, the panel Lights turns one type into another, keeping what they share. Drag the
# light: the arrow $l$ of a point light swings, that of a directional light stays.

# %% [markdown] slides=[4] minutes=3
# ## Farther is darker: attenuation
#
# So far the bulb was as strong at a distance as near by. A real one is not.

# %%
predict(
    "A sheet of paper 1 m away from a bulb, facing it. You take it away to 2 m, still facing the "
    "bulb. How bright is it now?",
    "as bright: the light has nothing in its way",
    "half as bright",
    "a quarter as bright",
    answer="a quarter as bright",
    why="What leaves the bulb at one moment is spread over a ball around it, whose surface is "
    r"$4 \pi d^2$. At twice the distance that is four times as much surface.",
)


# %%
def fading(distance, constant=0, quadratic=1):
    """A bulb straight above the floor whose light fades, with 1/d² unless told otherwise."""
    k = {"constant": constant, "linear": 0, "quadratic": quadratic}
    return pg.PointLight(position=(0, distance, 0), attenuate=True, **k)


def under(light):
    """How bright the floor is straight below the light."""
    return pg.render(on_floor(light), (3, 3)).pixels[1, 1, 0]


distances = np.linspace(0.5, 6, 56)
measured = np.array([under(fading(d)) for d in distances])
tame = np.array([under(fading(d, constant=1)) for d in distances])
plot(
    "Straight under a bulb: with $1/d^2$, and with $1/(1 + d^2)$, which stays finite.",
    x=("distance $d$", distances),
    y="brightness",
    curves={"$1/d^2$": measured, "$1/(1 + d^2)$": tame},
    shows=lambda law, other: (
        np.allclose(law * distances**2, 1, rtol=1e-5)
        and np.allclose(other * (1 + distances**2), 1, rtol=1e-5)
    ),
)
# float32, relative to an eye 8 above: 5e-7 of a length, twice that share of its square.
number("at_2", under(fading(2)), expected=1 / 4, tolerance=1e-6)
number("at_3", under(fading(3)), expected=1 / 9, tolerance=1e-6)
number("at_tenth", under(fading(0.1)), expected=100, tolerance=1e-3)
show(table.with_(lights=[fading(2, quadratic=0.5)]), pixel=(0.5, 0.6), panel="Lights")

# %% [markdown]
# At 2 m the paper has {at_2:.2f} of the light, at 3 m {at_3:.2f}, at 10 cm {at_tenth:.0f} times as
# much. The law is right, but it is hard to put into a picture: white here, black there. So
# graphics has long used a divisor with three knobs,
#
# $$\dfrac{1}{k_c + k_l \, d + k_q \, d^2}$$
#
# where $k_c = k_l = 0$ and $k_q = 1$ is the law, and $k_c = 1$ keeps it from growing without
# end as $d$ goes to 0.

# %% [markdown] tags=["notes"]
# "Half" is a common mistake. Let them draw the pyramid: the light that goes through a square hole
# at 1 m covers four such squares at 2 m. Attenuation weakens the diffuse and the specular term.
# The ambient term is light that has been everywhere already, and does not fade.

# %% [markdown] slides=[4] minutes=3
# ## The edge of a torch
#
# The torch hangs 2 m above the floor and shines straight down. Its cone has two angles, counted
# from the axis: up to the *inner* one there is all of the light, beyond the *outer* one none.

# %%
predict(
    "With an outer angle of 30°, how wide is the spot of light on the floor, across?",
    "1.15 m",
    "2.00 m",
    "2.31 m",
    answer="2.31 m",
    why=r"30° are counted from the axis, so the radius is $2 \tan 30^\circ$ = 1.15 m, and the "
    "other half of the cone has as much. 2.00 m comes of taking the sine for the tangent.",
)

# %%
lit = pg.render(on_floor(torch), (WIDE, WIDE)).pixels[..., 0] > 0
# The lit pixels are a disc; each pixel on its edge is in or out.
across_spot = 2 * np.sqrt(lit.sum() * PITCH**2 / np.pi)
number("spot", across_spot, expected=4 * np.tan(np.radians(30)), tolerance=PITCH)
angle = np.degrees(np.arctan(np.abs(place) / 2))
share = across(torch) / across(bulb)  # the bulb at the same place: the torch without its cone
plot(
    "What the cone lets through: all inside 20°, nothing outside 30°, a smooth step in between.",
    x=("place on the floor", place),
    y="share of the light",
    curves={"torch over bulb": share},
    shows=lambda part: (
        np.allclose(part[angle < 19.9], 1, atol=1e-5)
        and not part[angle > 30.1].any()
        and np.all(np.diff(part[place > 0]) <= 1e-5)
    ),
)
show(table.with_(lights=[torch]), panel="Lights")

# %% [markdown]
# Counted in the picture it is {spot:.2f} m wide. A torch with both angles equal has a hard edge,
# as if cut out of paper. With some degrees in between, it is as soft as that of a real lamp.

# %% [markdown] slides=[4] minutes=4
# ## Lights that have a size
#
# A flat lamp, 2 m by 2 m, hangs 1 m above a table. Could we do without area lights, and put a
# tiny flat lamp of the same power in the middle of its place?

# %%
lamp = pg.RectangleLight(position=(0, 1, 0), facing=DOWN, width=2, height=2, visible=False)
show(table.with_(lights=[lamp]), panel="Lights")
predict(
    "In the middle of the table, straight below, the tiny lamp makes it",
    "as bright as the large one does",
    "more than twice as bright",
    "less than half as bright",
    answer="more than twice as bright",
    why="All of the tiny lamp is where it counts most: near, and straight above. Most of the large "
    "one is farther away, and its light leaves and arrives at a slant.",
)


# %%
def by_points(n):
    """The table under n × n small lamps that share the area of the large one.

    Each sends its light as paper does, by the cosine at the lamp; it arrives by the cosine at the
    table, and thins out with the square of the distance.
    """
    x, z = np.meshgrid(*2 * [2 * (np.arange(n) + 0.5) / n - 1])
    squared = x**2 + z**2 + 1
    cosine = 1 / np.sqrt(squared)  # the same at the lamp and at the table: they are parallel
    return np.sum(cosine * cosine / squared) * (4 / n**2) / np.pi


exact = 4 / np.pi / np.sqrt(2) * np.arctan(1 / np.sqrt(2))  # Lambert's formula, for this square
number("area", under(lamp), expected=exact, tolerance=1e-5)  # sums of arcs in float32
number("one", by_points(1) / exact, expected=4 / np.pi / exact, tolerance=1e-12)
counts = np.arange(1, 17)
sums = np.array([by_points(n) for n in counts])
plot(
    "The table under more and more small lamps: the sum comes to what one area light gives.",
    x=("small lamps along each side", counts),
    y="brightness",
    curves={"$n \\times n$ small lamps": sums, "area light": np.full(16, under(lamp))},
    shows=lambda points, area: (
        points[0] > 2 * area[0] > 0 and abs(points[-1] / area[-1] - 1) < 0.01
    ),
)
off = {n: 100 * abs(by_points(n) / exact - 1) for n in (4, 8, 16)}
for n in off:
    number(f"off_{n * n}", off[n], expected={4: 1.6, 8: 0.41, 16: 0.1}[n], tolerance=0.05)
number("ratio", off[8] / off[16], expected=4, tolerance=0.1)  # the midpoint rule: 1/n², nearly

# %% [markdown]
# One tiny lamp makes it {one:.1f} times as bright as it should be. With 16 small lamps the error
# is {off_16:.1f} %, with 64 it is {off_64:.1f} %, with 256 it is {off_256:.1f} %: four times the
# lamps for a quarter of the error. What they come to is an *integral* over the lamp, {area:.3f},
# and for flat lamps with straight edges it has a formula, which Lambert found in 1760. This program
# uses it.
#
# Most of all, one sees the difference in a highlight.

# %%
shiny = pg.Material(diffuse=(0.3, 0.5, 0.9), specular=(25, 25, 25), ambient=NONE, shininess=200)
glossy = on_floor(sun).with_(
    objects=[pg.Object(mesh="sphere", tessellation=96, material=shiny)],
    terms=["diffuse", "specular"],
)
glossy = glossy.with_(eye=(0, 0, 6), fov=22, up=(0, 1, 0))
RADIANCE = 3
panel = pg.RectangleLight(
    position=(0, 2, 3.5),
    facing=(0, -2, -3.5),
    width=2,
    height=2,
    diffuse=3 * (RADIANCE,),
    specular=3 * (RADIANCE,),
    visible=False,
)


def bulbs(n):
    """n × n bulbs that share the area of the panel and its strength."""
    first, second, _, last = np.array(panel.corners)
    strength = 3 * (RADIANCE * 4 / n**2 / np.pi,)
    fade = {"attenuate": True, "constant": 0, "linear": 0, "quadratic": 1}
    steps = (np.arange(n) + 0.5) / n
    places = [first + i * (second - first) + j * (last - first) for i in steps for j in steps]
    return [
        pg.PointLight(position=tuple(q), diffuse=strength, specular=strength, **fade)
        for q in places
    ]


lit_by = {"1 bulb": bulbs(1), "4 bulbs": bulbs(2), "16 bulbs": bulbs(4), "area light": [panel]}
balls = [pg.render(glossy.with_(lights=lights), (150, 150)) for lights in lit_by.values()]
figure(
    balls,
    "The highlight of one bulb, of 4 and of 16 in a square, and of a square area light.",
    names=list(lit_by),
    shows=lambda *made: (
        made[3].pixels.max() > 0.5
        and pg.compare(made[3], made[0]).rmse > 2 * pg.compare(made[3], made[1]).rmse
        and pg.compare(made[3], made[1]).rmse > 2 * pg.compare(made[3], made[2]).rmse > 0
    ),
)
show(glossy.with_(lights=[panel]), panel="Lights")

# %% [markdown] tags=["notes"]
# A bulb that stands for a piece of a lamp should also weaken by the cosine at the lamp, which a
# point light does not know. Here the panel faces the ball, and it hardly matters. Nothing casts
# shadows in this lesson: soft shadows are ray tracing, lesson 12. Of an area light, $s_d$ is what
# each point of it sends (a radiance). From afar it acts like a directional light of strength
# $s_d \, \Omega / \pi$, with $\Omega$ the solid angle that it covers, in steradians.

# %% [markdown] minutes=2
# ## Try this
#
# A floor, a ball, and a bulb 2 m above them. Unfold it in the panel Lights: all you need is there.


# %%
def floor_of(setup):
    """The diffuse light on the floor alone, as the setup's lights make it."""
    setup = on_floor(sun).with_(lights=setup.scene.lights)
    return pg.render(setup, (160, 160)).pixels.max(axis=2)


def only(setup, kind):
    """Whether there is one light, of this kind."""
    return [light.kind for light in setup.scene.lights] == [kind]


show(table.with_(lights=[bulb]), panel="Lights")
goal(
    "Turn the bulb into a sun: still a point light, let it light the floor evenly, to 2 %.",
    reached=lambda setup: (
        only(setup, "point") and 0.1 < floor_of(setup).max() * 0.98 <= floor_of(setup).min()
    ),
    hint="The sun is a bulb, too. What about it is different?",
    solution=table.with_(lights=[pg.PointLight(position=(0, 100, 0))]),
)
goal(
    "Make it a spot light whose spot on the floor is 2 m wide, to 2 %.",
    reached=lambda setup: (
        only(setup, "spot")
        and abs(2 * np.sqrt(np.mean(floor_of(setup) > 0) * 16 / np.pi) - 2) < 0.04
    ),
    hint="From 2 m above, the radius is 2 m times the tangent of the outer angle; or hang the "
    "torch lower. The axis must point straight down: (0, −1, 0).",
    solution=table.with_(
        lights=[pg.SpotLight(position=(0, 2, 0), axis=DOWN, inner_angle=20, outer_angle=26.57)]
    ),
)
