"""What could be dropped, by the method that draws the picture."""

from test_advisor import KEY, SIZE, ball

from playground.measure.advice import error_of
from playground.measure.advisor import advise
from playground.measure.candidates import candidates_of, without
from playground.render.renderer import render
from playground.scene.library import load
from playground.scene.material import Material
from playground.scene.scene import Object, Scene
from playground.scene.setup import Setup


def test_a_mesh_made_in_python_keeps_its_triangles():
    mesh = Object("sphere").geometry().mesh
    item = Object(arrays=mesh, material=Material())
    setup = Setup(Scene(objects=(item,), lights=(KEY,)))
    assert {c.kind for c in candidates_of(setup)} == {"light", "term", "shading"}


def test_rays_see_the_triangles_of_shapes_without_a_formula() -> None:
    torus = "tessellation of object 1 (torus): 64 → 32"
    setup = load("glass-ring")
    traced = {c.name: c for c in candidates_of(setup, "ray-tracing")}
    assert {name for name in traced if "→ 32" in name} == {torus}
    less = without(setup, [traced[torus]])
    full, coarse = (render(s, SIZE, "numpy", method="ray-tracing") for s in (setup, less))
    assert error_of("rmse", full, coarse) > 0.0

    def tessellated(**changes) -> bool:
        setup = ball(KEY, **changes)
        return any(c.kind == "tessellation" for c in candidates_of(setup, "ray-tracing"))

    assert not tessellated()
    assert tessellated(surfaces="triangles") and tessellated(normals="flat")


def test_ray_tracing_may_drop_bounces_but_no_triangles() -> None:
    setup = load("whitted-room").with_(depth=2)
    traced = {c.name for c in candidates_of(setup, "ray-tracing")}
    assert {"bounces: 2 → 1", "bounces: 2 → 0"} <= traced
    assert not any(name.startswith(("shading", "tessellation")) for name in traced)
    assert not any(name.startswith("bounces") for name in (c.name for c in candidates_of(setup)))

    # Without the second bounce something of a mirrored mirror is missing; the advisor sees it.
    advised = advise(
        setup,
        size=SIZE,
        renderer="numpy",
        cost=lambda s: 1.0 + s.settings.depth,
        method="ray-tracing",
    )
    found = {f.candidate.name: f for f in advised.findings}
    assert 0.0 < found["bounces: 2 → 1"].errors.rmse < found["bounces: 2 → 0"].errors.rmse
    assert found["bounces: 2 → 0"].saving.saved == 2.0


def test_without_mirrors_there_is_no_bounce_to_drop() -> None:
    kinds = {c.kind for c in candidates_of(ball(KEY), "ray-tracing")}
    assert "bounce" not in kinds and "shadow rays" not in kinds


def test_shadow_rays_are_halved_for_area_lights_only() -> None:
    names = [c.name for c in candidates_of(load("area-light"), "ray-tracing")]
    assert "shadow rays to each area light: 16 → 1" in names
