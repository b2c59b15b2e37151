"""Light straight from lamps: closed forms where patches are whole, and shadows."""

import numpy as np
import pytest
from plates import BELOW, patches_of, rectangle, room

import playground as pg
from playground.render.radiosity.direct import arriving_at, direct_light
from playground.render.radiosity.patch.divide import divide

UP = (0.0, 0.0, 1.0)
SCREEN = rectangle((-2, -2, 0.25), (5, 0, 0), (0, 5, 0))  # over all of BELOW


def lit_by(*lights, **settings):
    return pg.Setup(pg.Scene(lights=lights)).with_(**settings)


def test_the_sun_gives_the_cosine():
    patches = patches_of([BELOW, BELOW[::-1]], [(2, 2)] * 2)
    sun = pg.DirectionalLight(to_light=(0.0, 3.0, 4.0), diffuse=(1.0, 0.5, 0.25))
    found = direct_light(lit_by(sun), patches)
    np.testing.assert_allclose(found[:4], np.tile([0.8, 0.4, 0.2], (4, 1)), rtol=1e-14)
    assert not found[4:].any(), "the back of a patch is dark"


@pytest.mark.parametrize("height", [1.0, 2.0, 5.0])
def test_a_lamp_that_fades_with_the_square_gives_the_solid_angle(height):
    # ∫ cos θ / d² over the square is the solid angle it fills as seen from the lamp over its
    # middle: 4 asin(a² / (a² + h²)), a half its side.
    lamp = pg.PointLight(
        position=(0.5, 0.5, height), attenuate=True, constant=0.0, linear=0.0, quadratic=1.0
    )
    found = direct_light(lit_by(lamp), patches_of([BELOW], [(1, 1)]))
    expected = 4.0 * np.arcsin(0.25 / (0.25 + height**2))

    # In half sides the function is (1 + x²/4h²)^(-3/2), which ends at x = 2hi. Within an ellipse
    # of radius r about the square it is at most m, and Gauss's four points are off by
    # 64/15 m r^-8 / (1 − r^-2) (Trefethen, Is Gauss Quadrature Better than Clenshaw-Curtis?, 2008),
    # of an integral of 2, in either direction.
    radius = 0.8 * (2.0 * height + np.sqrt(4.0 * height**2 + 1.0))
    reach = 0.5 * (radius - 1.0 / radius) / (2.0 * height)
    most = (1.0 - reach**2) ** -1.5
    allowed = 64.0 / 15.0 * most * radius**-8 / (1.0 - radius**-2)
    np.testing.assert_allclose(found[0], expected, rtol=allowed)


def test_a_spot_is_a_point_light_inside_its_cone_and_nothing_outside():
    patches = patches_of([BELOW, BELOW + np.array([10, 0, 0])], [(2, 2)] * 2)
    place = {"position": (0.5, 0.5, 2.0)}
    cone = {"axis": (0.0, 0.0, -1.0), "inner_angle": 30.0, "outer_angle": 40.0}
    spot = direct_light(lit_by(pg.SpotLight(**place, **cone)), patches)
    point = direct_light(lit_by(pg.PointLight(**place)), patches)
    np.testing.assert_allclose(spot[:4], point[:4], rtol=1e-14)  # corners are at 19°
    assert not spot[4:].any() and point[4:].all()


LAMPS = [
    pg.DirectionalLight(to_light=(0.2, 0.3, 2.0)),
    pg.PointLight(position=(0.4, 0.5, 3.0)),
    pg.SpotLight(position=(0.4, 0.5, 3.0), axis=(0.0, 0.0, -1.0)),
]


@pytest.mark.parametrize("lamp", LAMPS, ids=lambda lamp: lamp.kind)
def test_what_stands_in_between_casts_a_shadow(lamp):
    for screen in (SCREEN, SCREEN[::-1]):
        shaded = patches_of([BELOW, screen], [(2, 2), (1, 1)])
        assert not direct_light(lit_by(lamp), shaded)[:4].any()
        bare = direct_light(lit_by(lamp), patches_of([BELOW], [(2, 2)]))
        open_ = direct_light(lit_by(lamp, occlusion=False), shaded)[:4]
        np.testing.assert_array_equal(open_, bare)
        assert bare.all()


def test_a_lamp_between_screen_and_patch_is_not_hidden():
    patches = patches_of([BELOW, SCREEN], [(2, 2), (1, 1)])
    lamp = pg.PointLight(position=(0.5, 0.5, 0.2))
    bare = direct_light(lit_by(lamp), patches_of([BELOW], [(2, 2)]))
    np.testing.assert_array_equal(direct_light(lit_by(lamp), patches)[:4], bare)
    # Also one that hangs in the very plane of the screen
    lamp = pg.PointLight(position=(0.5, 0.5, 0.25))
    assert direct_light(lit_by(lamp), patches)[:4].all()


def test_the_edge_of_a_shadow_is_seen_within_a_patch():
    # The sun stands overhead, the screen covers exactly half of the patch.
    half = rectangle((-1, -1, 0.5), (1.5, 0, 0), (0, 3, 0))
    patches = patches_of([BELOW, half], [(1, 1)] * 2)
    found = direct_light(lit_by(pg.DirectionalLight(to_light=UP)), patches)
    np.testing.assert_allclose(found[0], 0.5, rtol=1e-13)


def test_the_walls_of_a_closed_room_keep_a_lamp_outside_out():
    patches = room(2, 1)
    outside = pg.PointLight(position=(3.0, 4.0, 5.0)), pg.DirectionalLight(to_light=(1.0, 2.0, 3.0))
    assert not direct_light(lit_by(*outside), patches).any()
    inside = direct_light(lit_by(pg.PointLight(position=(0.0, 0.8, 0.0))), patches)
    assert inside[:24].any(axis=1).sum() > 12


def test_area_lights_and_black_lights_add_nothing_here():
    dark = pg.PointLight(diffuse=(0.0, 0.0, 0.0))
    setup = lit_by(dark, pg.RectangleLight(position=(0.5, 3.0, 0.5)))
    assert not direct_light(setup, patches_of([BELOW], [(1, 1)])).any()


@pytest.mark.parametrize("away", [0.0, 1e6])
def test_points_on_surfaces_get_what_patches_get(away):
    lamp = pg.PointLight(position=(0.3 + away, 2.0, 0.1), attenuate=True)
    item = pg.Object("quad", transform=pg.Transform(translate=(away, 0.0, 0.0)))
    setup = pg.Setup(pg.Scene(objects=(item,), lights=(lamp,)))
    points = np.array([[0.25, 0.0, -0.5], [-0.9, 0.0, 0.9]])
    normals = np.tile([0.0, 1.0, 0.0], (2, 1))
    patches = divide(setup)
    there = points + np.array([away, 0.0, 0.0]) - patches.origin
    found = arriving_at(setup, patches, there, normals)
    apart = np.array([0.3, 2.0, 0.1]) - points
    distance = np.linalg.norm(apart, axis=1)
    expected = apart[:, 1] / distance / (1.0 + 0.1 * distance**2)
    # 0.3 + 1e6 is known to 6e-11 of a distance of 2
    np.testing.assert_allclose(found, np.repeat(expected[:, None], 3, axis=1), rtol=2e-10)


SUNSET = pg.DirectionalLight(to_light=(1.0, -0.1, 0.0))


def test_a_normal_that_leans_does_not_see_through_its_own_surface():
    setup = pg.Setup(pg.Scene(objects=(pg.Object("quad"),), lights=(SUNSET,)))
    leaning = np.array([[0.6, 0.8, 0.0]])
    patches, up = divide(setup), np.array([[0.0, 1.0, 0.0]])
    middle = -patches.origin[None]
    assert arriving_at(setup.with_(occlusion=False), patches, middle, leaning, leaning).any()
    for occlusion in (True, False):
        shown = setup.with_(occlusion=occlusion)
        found = arriving_at(shown, patches, middle, leaning, up)
        assert not found.any(), "the light is below the flat piece"
