"""`explain` of a traced pixel: the tree adds up, and every number of it means what it says."""

import json

import numpy as np
import pytest

import playground as pg
from playground.cli import main
from playground.explain.ray_tree import ARRIVING, BLOCKED, KINDS, REFLECTION, REFRACTION, TOTAL
from playground.render.trace.tracer import Tracing

SIZE = (32, 24)
PIXELS = [(16, 12), (10, 17), (22, 17), (5, 20), (0, 0)]
WHITE = (1.0, 1.0, 1.0)
BALL = pg.Material(diffuse=(0, 0, 0), ambient=(0, 0, 0), specular=(0, 0, 0))


def rays_of(setup, pixel, size=SIZE):
    return pg.explain(setup, pixel, size, method="ray-tracing")


def glass_ball(**more):
    """A glass ball of radius 1 seen from (0, 0, 4), in front of white."""
    from dataclasses import replace

    glass = replace(BALL, transmittance=WHITE, index=1.5, **more)
    return pg.Setup(
        scene=pg.Scene(background=WHITE, objects=(pg.Object("sphere", material=glass),), lights=()),
        camera=pg.Camera(eye=(0.0, 0.0, 4.0), target=(0.0, 0.0, 0.0), fov=30.0),
    )


@pytest.mark.parametrize("name", pg.library())
def test_the_weights_multiply_out_to_the_pixel(name):
    setup = pg.load(name)
    tracing = Tracing(setup, SIZE)
    for _ in tracing.steps():
        pass
    picture = tracing.image().pixels
    for x, y in PIXELS:
        tree = rays_of(setup, (x, y))
        assert tree.adds_up, tree.text()
        if setup.settings.samples == 1:
            # The picture holds float32: half a unit of its last place, and float64's rounding.
            allowed = np.spacing(picture[y, x]) / 2.0 + tree.rounding
            assert (np.abs(tree.colour - picture[y, x]) <= allowed).all()


def test_local_colours_are_what_the_lights_add():
    tree = rays_of(pg.load("whitted-room"), (22, 17))
    hits = [node for node in tree.nodes if node.end is not None]
    assert len(hits) > 4
    for node in hits:
        told = node.glow + sum(light.added for light in node.lights)
        # At most three roundings for each of two terms of one light.
        np.testing.assert_allclose(told, node.local, rtol=8 * np.finfo(float).eps)


def test_pruning_takes_away_what_the_branch_brings():
    tree = rays_of(pg.load("whitted-room"), (22, 17))
    assert not tree.prune(tree.root).any()
    for node in tree.nodes:
        left, gone = tree.prune(node), tree.branch(node.number)
        # Both sums are rounded once, and their sum once more.
        allowed = 3.0 * np.spacing(tree.colour)
        assert (np.abs(left + gone - tree.colour) <= allowed).all()
        np.testing.assert_array_equal(gone, tree.branch(node))
        if not gone.any():
            np.testing.assert_array_equal(left, tree.colour)


def test_without_its_reflection_a_mirror_is_as_at_depth_0():
    setup = pg.load("whitted-room")
    tree = rays_of(setup, (10, 16))
    assert tree.root.name == "object 6 (sphere)"
    (mirrored,) = tree.root.children
    np.testing.assert_array_equal(mirrored.factor, [0.9] * 3)
    pruned = rays_of(setup.with_(depth=0), (10, 16)).colour
    np.testing.assert_allclose(tree.prune(mirrored), pruned, atol=1e-15)


def test_a_tree_has_no_such_node():
    tree = rays_of(pg.load("sphere"), (16, 12))
    with pytest.raises(pg.PlaygroundError, match="0 to 0"):
        tree.prune(7)


def test_angles_obey_snell_and_weights_fresnel():
    setup = glass_ball()
    tree = rays_of(setup, (20, 12))
    first = tree.root
    assert first.kind == "primary" and first.name == "object 0 (sphere)"
    sine = np.sin(np.radians(first.incidence))
    assert sine == pytest.approx(np.linalg.norm(np.cross(first.normal, first.direction)))
    assert sine == pytest.approx(1.5 * np.sin(np.radians(first.refraction)))
    assert (first.index_i, first.index_t, first.critical) == (1.0, 1.5, None)
    reflected, refracted = first.children
    assert (reflected.kind, refracted.kind) == (REFLECTION, REFRACTION)
    np.testing.assert_allclose(reflected.factor, first.fresnel)
    np.testing.assert_allclose(refracted.factor, 1.0 - first.fresnel)
    assert reflected.end is None and reflected.name == "background"
    # A chord of the ball: as steep where it ends as where it begins.
    assert refracted.incidence == pytest.approx(first.refraction)
    assert refracted.critical == pytest.approx(np.degrees(np.arcsin(1 / 1.5)))
    assert refracted.length == pytest.approx(2.0 * np.cos(np.radians(first.refraction)))
    np.testing.assert_allclose(refracted.end @ refracted.normal, -1.0)
    for node in tree.nodes:
        assert len(node.children) <= 2 and all(c.depth == node.depth + 1 for c in node.children)
        assert tree.nodes[node.number] is node


def test_a_medium_fades_what_goes_through_it():
    absorption = np.array([0.1, 0.5, 2.0])
    tree = rays_of(glass_ball(absorption=tuple(absorption)), (18, 13))
    (_, within) = tree.root.children
    np.testing.assert_allclose(within.faded, np.exp(-absorption * within.length), rtol=1e-12)
    np.testing.assert_array_equal(tree.root.faded, WHITE)
    assert "left by the medium" in tree.text()


def test_total_internal_reflection_has_its_name():
    setup = glass_ball().with_(eye=(0.0, 0.9, 0.0), target=(1.0, 0.9, 0.0), fov=20.0)
    # The eye is in the glass, 0.9 from the centre: it looks at the wall at arcsin 0.9 = 64°.
    tree = rays_of(setup, (16, 12))
    assert tree.root.incidence == pytest.approx(np.degrees(np.arcsin(0.9)), abs=1.0)
    assert tree.root.refraction is None and tree.root.fresnel == 1.0
    (only,) = tree.root.children
    assert only.kind == TOTAL and "total internal reflection, F = 1" in tree.text()
    assert {node.kind for node in tree.nodes} <= set(KINDS)


def test_shadow_rays_say_what_blocks_them():
    setup = pg.load("whitted-room")
    lamp = setup.scene.lights[0].position
    tree = rays_of(setup, (11, 18))  # the floor behind the mirror sphere
    (light,) = tree.root.lights
    (ray,) = light.rays
    assert (ray.kind, ray.blocker) == (BLOCKED, 6)
    assert not light.added.any() and not ray.share.any()
    centre = setup.scene.objects[6].transform.translate
    assert np.linalg.norm(ray.end - centre) == pytest.approx(0.85)
    assert "blocked by object 6 (sphere)" in tree.text()

    (free,) = rays_of(setup, (12, 20)).root.lights[0].rays
    assert (free.kind, free.blocker, free.through) == (ARRIVING, None, ())
    np.testing.assert_allclose(free.end, lamp, atol=1e-12)
    (clear,) = rays_of(setup, (27, 19)).root.lights[0].rays
    assert (clear.kind, clear.through) == (ARRIVING, (7,))
    (dark,) = rays_of(setup.with_(clear_shadows=False), (27, 19)).root.lights[0].rays
    assert (dark.kind, dark.blocker) == (BLOCKED, 7)


def test_an_area_light_is_asked_point_by_point():
    setup = pg.load("area-light")
    tree = rays_of(setup, (15, 17))
    lights = tree.root.lights
    assert {len(light.rays) for light in lights} == {setup.settings.light_samples}
    for light in lights:
        kinds = [ray.kind for ray in light.rays]
        assert set(kinds) <= {ARRIVING, BLOCKED}
        assert (light.share_diffuse < 1.0).all() == (BLOCKED in kinds)
        for ray in light.rays:
            assert (ray.blocker is None) == (ray.kind == ARRIVING)


def test_what_is_cut_off_is_told():
    tree = rays_of(glass_ball().with_(depth=1, threshold=0.0), (20, 12))
    # Before white, the sum and what was cut off are everything: no light is lost.
    np.testing.assert_allclose(tree.colour + tree.unfollowed, 1.0, atol=1e-15)
    assert tree.unfollowed.min() > 0.9
    assert "left out" in tree.text()


def test_the_tree_can_be_written_down():
    tree = rays_of(pg.load("whitted-room"), (22, 17))
    told = json.loads(json.dumps(tree.to_dict(), allow_nan=False))

    def added(node):
        return np.sum([node["added"], *map(added, node["children"])], axis=0)

    np.testing.assert_allclose(added(told["root"]), told["colour"], atol=1e-15)
    assert told["adds_up"] is True and told["rays"] == len(tree.nodes)
    assert tree.text().count("depth ") == len(tree.nodes) + 1
    assert tree.latex().count(r"\otimes c_{") == len(tree.nodes) + 2
    assert r"(k_r+k_t F)\otimes c_{reflected}" in tree.latex()


def test_the_command_line_tells_the_tree(capsys):
    words = ["explain", "whitted-room", "--pixel", "22", "17", "--size", "32x24"]
    assert main([*words, "--method", "ray-tracing", "--json", "--depth", "2"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["depth"] == 2 and told["root"]["name"] == "object 7 (sphere)"
    assert main([*words, "--method", "ray-tracing"]) == 0
    assert "which is the rendered pixel" in capsys.readouterr().out
    assert main([*words, "--method", "photons"]) == 2
    assert "unknown method" in capsys.readouterr().err
    assert main(["explain", "sphere", "--pixel", "99", "0", "--size", "32x24"]) == 2
