"""Every knob of a setup by its control: used, it changes just this knob; undo takes it back."""

from dataclasses import replace

import pytest

from playground.errors import PlaygroundError
from playground.gui.widget.spans import tidy
from playground.render.gl.bugs import zoo
from playground.scene.camera import Camera
from playground.scene.knob import knobs
from playground.scene.light import LIGHTS
from playground.scene.material import Material
from playground.scene.scene import Object, Scene
from playground.scene.settings import BUGS, TERMS, Settings
from playground.scene.shapes import SHAPES
from playground.scene.transform import Transform

pytestmark = pytest.mark.gl
SETTINGS, SCENE, CAMERA = ("settings",), ("scene",), ("camera",)
OBJECT, LIGHT = ("scene", "objects", 0), ("scene", "lights", 0)
WEIGHTS = tuple(f"{term}_weight" for term in TERMS)
TRACING = ("depth", "threshold", "light_samples", "fresnel", "surfaces", "clear_shadows")
RADIOSITY = ("patches", "refinement", "form_factors", "hemicube", "occlusion", "normalise")
SOLVER = ("solver", "convergence", "light_shown")
DISPLAY = ("exposure", "clamp", "curve", "samples", "precision", "marks")
UNFOLDED = "Lights/$$0/###light"
PARTS = (  # where in the controls, where in the setup, of which class, which knobs
    ("View", SETTINGS, Settings, ("shading",)),
    ("Terms", SETTINGS, Settings, (*WEIGHTS, "highlight", "gate")),
    ("Ray tracing", SETTINGS, Settings, TRACING),
    ("Radiosity", SETTINGS, Settings, (*RADIOSITY, *SOLVER)),
    ("Radiosity", SCENE, Scene, ("lightmap",)),
    ("Display", SETTINGS, Settings, DISPLAY),
    ("Material", (*OBJECT, "material"), Material, tuple(knobs(Material))),
    ("Scene", OBJECT, Object, ("tessellation", "normals")),
    ("Scene", SCENE, Scene, ("background",)),
    ("Scene/camera", CAMERA, Camera, tuple(knobs(Camera))),
    ("Scene/place", (*OBJECT, "transform"), Transform, tuple(knobs(Transform))),
    *((UNFOLDED, LIGHT, kind, tuple(knobs(kind))) for kind in LIGHTS.values()),
)
OTHERWISE = {  # knobs with controls of their own, in tests of their own; a title is for files
    Settings: {"terms", "bugs"},
    Object: {"mesh"},
    Scene: {"title"},
}


def at(whole, where):
    for step in where:
        whole = whole[step] if isinstance(step, int) else getattr(whole, step)
    return whole


def put(whole, where, value):
    """``whole`` with ``value`` at the place ``where``."""
    if not where:
        return value
    first, *rest = where
    inner = put(at(whole, (first,)), rest, value)
    if isinstance(first, int):
        return (*whole[:first], inner, *whole[first + 1 :])
    return replace(whole, **{first: inner})


def another(item, name):
    """Values to try on a knob: for a colour or vector one per component, else a single one."""
    knob, value = knobs(type(item))[name], getattr(item, name)

    def fits(new):
        try:
            return new != value and getattr(replace(item, **{name: new}), name) == new
        except PlaygroundError:
            return False

    if knob.kind == "integer" and item.label == "object":
        return [SHAPES[item.mesh].default_tessellation + 1]
    if knob.kind in ("colour", "vector"):
        numbers = [tidy(0.5 * x + 0.25) for x in value]
        wanted = [(*value[:i], numbers[i], *value[i + 1 :]) for i in range(3)]
        return [new for new in wanted if fits(new)]
    if knob.kind == "vertices":
        middle = tuple((a + b) / 2.0 for a, b in zip(value[-1], value[0], strict=True))
        moved = [
            ((*value[0][:i], tidy(0.5 * value[0][i] + 0.25), *value[0][i + 1 :]), *value[1:])
            for i in range(3)
        ]
        return [new for new in ((*value, middle), value[:-1], *moved) if fits(new)]
    tries = {
        "number": lambda: [tidy(x) for x in (0.5 * value, value + 0.25, 1.5 * value)],
        "integer": lambda: [value + 1, value - 1],
        "switch": lambda: [not value],
        "choice": lambda: knob.choices,
        "text": lambda: ["tiles.png"],
        "names": lambda: [knob.choices[:1], knob.choices[1:]],
    }[knob.kind]()
    return [next(new for new in tries if fits(new))]


def type_in(c, path, text):
    c.item_click(path)
    c.key_chars_replace_enter(text)


def choose(c, path, name, choice):
    """One of several names: by its button, or from a list where there is no room for buttons."""
    if c.item_exists(f"{path}/{choice}##{name}"):
        c.item_click(f"{path}/{choice}##{name}")
        return
    c.item_click(f"{path}/##{name}")
    c.yield_(2)
    c.item_click(f"//##Combo_00/**/{choice}")


def use(c, path, name, kind, before, after):
    """Turn one knob by its control."""
    if kind in ("colour", "vector"):
        i = next(i for i in range(3) if before[i] != after[i])
        part = f"##{'XYZ'[i]}" if kind == "colour" else f"$${i}"
        c.item_input_value(f"{path}/##{name}/{part}", after[i])
    elif kind == "vertices" and len(before) != len(after):
        c.item_click(f"{path}/{'+' if len(before) < len(after) else '-'} corner##{name}")
    elif kind == "vertices":
        i = next(i for i in range(3) if before[0][i] != after[0][i])
        c.item_input_value(f"{path}/##{name}0/$${i}", after[0][i])
    elif kind in ("number", "integer"):
        c.item_input_value(f"{path}/##{name}", after)
    elif kind == "switch":
        c.item_click(f"{path}/##{name}")
    elif kind == "text":
        type_in(c, f"{path}/##{name}", after)
    elif kind == "names":
        for choice in sorted(set(before) ^ set(after)):
            c.item_click(f"{path}/{choice}##{name}")
    else:
        choose(c, path, name, after)
    c.yield_(2)


def opened(c, path):
    """Unfold what leads to a path, and nothing else."""
    from playground.gui.panels import PANELS

    c.set_ref("//Controls")
    parts = [part for part in path.split("/") if part != "$$0"]
    for panel in PANELS:
        if c.item_is_opened(panel) != (panel == parts[0]):
            (c.item_open if panel == parts[0] else c.item_close)(panel)
    if len(parts) > 1:
        c.item_open(path)
    c.yield_(2)


def undo(hands, c):
    keys = hands.imgui.Key
    c.key_press(keys.mod_ctrl.value | keys.z.value)
    c.yield_(2)


@pytest.mark.parametrize("kind", [Settings, Scene, Camera, Object, Material, Transform])
def test_every_knob_has_a_control(kind):
    placed = {name for _, _, of, names in PARTS if of is kind for name in names}
    assert placed | OTHERWISE.get(kind, set()) == set(knobs(kind))


@pytest.mark.parametrize(
    ("path", "where", "kind", "names"), PARTS, ids=[f"{p[0]} {p[2].__name__}" for p in PARTS]
)
def test_a_control_changes_its_knob_and_undo_takes_it_back(hands, path, where, kind, names):
    if where == LIGHT:  # what fades with distance has knobs for it
        fading = {"attenuate": True} if "attenuate" in knobs(kind) else {}
        hands.load("teapot", lights=(kind(**fading),))
    elif kind is Material:  # a texture has a knob for its encoding
        hands.load("textured")
    before = hands.state.setup
    item = at(before, where)

    def script(c):
        opened(c, path)
        for name in names:
            for value in another(item, name):
                use(c, path, name, knobs(kind)[name].kind, getattr(item, name), value)
                assert hands.state.setup == put(before, (*where, name), value), name
                undo(hands, c)
                assert hands.state.setup == before, name

    hands.do(script)
    assert not hands.state.failed


def test_every_shape_is_chosen_and_tessellated(hands):
    hands.load("sphere")
    first = put(hands.state.setup, (*OBJECT, "tessellation"), 5)
    hands.window.state = hands.state.opened(first)

    def script(c):
        opened(c, "Scene")
        for mesh, shape in SHAPES.items():
            before = hands.state.setup
            item = replace(at(before, OBJECT), mesh=mesh, tessellation=0)
            if mesh != at(before, OBJECT).mesh:
                choose(c, "Scene", "mesh", mesh)
                c.yield_(2)
                assert hands.state.setup == put(before, OBJECT, item), mesh
            c.item_input_value("Scene/##tessellation", shape.min + 1)
            c.yield_(2)
            tessellated = put(before, OBJECT, replace(item, tessellation=shape.min + 1))
            assert hands.state.setup == tessellated, mesh
        while hands.state.history.past and hands.state.setup != first:
            undo(hands, c)
        assert hands.state.setup == first

    hands.do(script)


def test_every_term_and_every_mistake_is_switched(hands):
    before = hands.state.setup
    mistakes = ((bug, f"Bug zoo/{bug}/{zoo()[bug].title}", {"bugs": (bug,)}) for bug in BUGS)
    terms = (
        (term, f"Terms/{term}", {"terms": tuple(other for other in TERMS if other != term)})
        for term in TERMS
    )

    def script(c):
        for panel, rows in (("Terms", terms), ("Bug zoo", mistakes)):
            opened(c, panel)
            for name, path, changes in rows:
                c.item_click(path)
                c.yield_(2)
                assert hands.state.setup == before.with_(**changes), name
                undo(hands, c)
                assert hands.state.setup == before, name

    hands.do(script)


def test_every_kind_of_light_is_chosen(hands):
    hands.load("teapot", lights=(LIGHTS["point"](diffuse=(0.5, 0.25, 0.125)),))
    before = hands.state.setup

    def script(c):
        opened(c, UNFOLDED)
        for kind, made in LIGHTS.items():
            if kind == "point":
                continue
            choose(c, UNFOLDED, "type", kind)
            c.yield_(2)
            (light,) = hands.state.setup.scene.lights
            assert type(light) is made and light.diffuse == (0.5, 0.25, 0.125), kind
            undo(hands, c)
            assert hands.state.setup == before, kind

    hands.do(script)
