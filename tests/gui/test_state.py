"""History, wording, comparison and actions: values in, values out, no window."""

import pytest

from playground.gui import actions
from playground.gui.history import LIMIT, History
from playground.gui.picture.comparison import boxes, grid, pictures
from playground.gui.picture.light_change import added, converted, exchanged, removed
from playground.gui.state import LAYOUTS, shown, start
from playground.gui.wording import difference
from playground.scene.library import library, load
from playground.scene.light import LIGHTS


@pytest.fixture
def setup():
    return load("teapot")


def test_undo_and_redo_lead_back_and_forth(setup):
    other = setup.with_(shininess=5)
    history = History().record(setup, other, held=False)
    history, present = history.undo(other)
    assert present is setup
    history, present = history.redo(present)
    assert present is other
    assert history.redo(present) == (history, other)


def test_a_drag_is_one_step(setup):
    history, present = History(), setup
    for shininess in (30, 20, 10):
        changed = setup.with_(shininess=shininess)
        history, present = history.record(present, changed, held=True), changed
    history = history.record(present, present, held=True)  # the hand rests, and holds on
    changed = setup.with_(shininess=6)
    history = history.record(present, changed, held=True)
    history = history.record(changed, changed, held=False)
    assert len(history.past) == 1
    again = changed.with_(shininess=80)
    history = history.record(changed, again, held=True)
    assert [s.scene.objects[0].material.shininess for s in history.past] == [40.0, 6.0]


def test_a_new_change_forgets_the_future(setup):
    history, present = History().record(setup, setup.with_(gate=True), False).undo(setup)
    assert history.future
    assert not history.record(present, setup.with_(shininess=2), False).future


def test_history_is_limited(setup):
    history = History()
    for i in range(LIMIT + 20):
        history = history.record(setup.with_(shininess=i + 1), setup.with_(shininess=i + 2), False)
    assert len(history.past) == LIMIT


def test_what_differs_is_named(setup):
    assert difference(setup, setup.with_(shininess=5)) == "object 0 shininess"
    assert difference(setup, setup.with_(terms=())) == "terms"
    assert difference(setup, setup.with_(eye=(0, 0, 9))) == "camera eye"
    assert difference(setup, added(setup)) == "number of lights"
    turned = exchanged(setup, 0, converted(setup.scene.lights[0], "spot", setup))
    assert difference(setup, turned) == "light 0 type"
    assert "sphere" in difference(setup, load("sphere"))


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("size", [(920, 650), (1, 1), (400, 900), (3000, 200)])
def test_every_picture_lies_within_the_view(setup, layout, size):
    state = actions.replace(start(setup), layout=layout)
    for picture in pictures(state, *size):
        x, y, w, h = picture.box
        assert w >= 1 and h >= 1 and x >= 0 and y >= 0
        if min(size) > 20:
            assert x + w <= size[0] and y + h <= size[1]


def test_single_shows_the_very_setup(setup):
    assert pictures(start(setup), 920, 650)[0].setup is setup


def test_equal_states_give_the_same_settings_object(setup):
    state = actions.replace(start(setup), layout="terms")
    for a, b in zip(pictures(state, 900, 600), pictures(state, 900, 600), strict=True):
        assert a.setup.settings is b.setup.settings and a.setup.scene is b.setup.scene


def test_terms_are_shown_one_by_one(setup):
    state = actions.replace(actions.toggle_term(start(setup), "specular"), layout="terms")
    shows = [picture.setup.settings.terms for picture in pictures(state, 900, 600)]
    assert shows == [("diffuse",), (), ("ambient",), ("emissive",), state.setup.settings.terms]


def test_grid_prefers_large_pictures():
    assert grid(6, 920, 650) == (3, 2)
    assert grid(2, 1000, 300) == (2, 1)
    assert len({box[:2] for box in boxes(6, 920, 650)}) == 6


def test_solo_shows_one_light_and_leaves_the_setup(setup):
    state = start(added(setup))
    alone = actions.replace(state, solo=1)
    assert shown(alone).scene.lights == state.setup.scene.lights[1:]
    assert shown(alone).scene is shown(alone).scene
    assert alone.setup is state.setup
    assert shown(actions.replace(state, solo=7)) is state.setup


@pytest.mark.parametrize("name", library())
@pytest.mark.parametrize("kind", list(LIGHTS))
def test_a_light_keeps_colours_and_side_as_another_type(name, kind):
    setup = load(name)
    for i, light in enumerate(setup.scene.lights):
        new = converted(light, kind, setup)
        assert new.kind == kind
        assert (new.diffuse, new.specular, new.ambient) == (
            light.diffuse,
            light.specular,
            light.ambient,
        )
        assert exchanged(setup, i, new).scene.lights[i] is new


def test_lights_come_and_go(setup):
    more = added(added(setup))
    assert len(more.scene.lights) == 3
    assert removed(more, 1).scene.lights == (more.scene.lights[0], more.scene.lights[2])
    assert removed(setup, 0).scene.lights == ()


def test_actions_on_settings(setup):
    state = start(setup)
    assert actions.shade(state, "flat").setup.settings.shading == "flat"
    off = actions.toggle_term(state, "diffuse")
    assert off.setup.settings.terms == ("specular", "ambient", "emissive")
    assert actions.toggle_term(off, "diffuse").setup == setup
    assert actions.reset(off).setup is setup


def test_two_compared_pictures_do_not_become_the_same(setup):
    state = start(setup)
    assert (state.setup.settings.shading, state.other) == ("per-fragment", "per-vertex")
    swapped = actions.shade(state, "per-vertex")
    assert (swapped.setup.settings.shading, swapped.other) == ("per-vertex", "per-fragment")
    back = actions.kept_apart(swapped, actions.replace(swapped, other="per-vertex"))
    assert (back.setup.settings.shading, back.other) == ("per-fragment", "per-vertex")


def test_text_size_stays_within_its_range(setup):
    state = start(setup)
    for _ in range(20):
        state = actions.larger_text(state)
    assert state.text_size == 2.5
    assert actions.usual_text(state).text_size == 1.0


def test_saving_never_overwrites_what_it_did_not_make(setup, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "teapot.toml").write_text("mine")
    state = actions.save_setup(start(setup.with_(shininess=7)))
    assert not state.failed and state.file.name == "teapot-2.toml"
    assert (tmp_path / "teapot.toml").read_text() == "mine"
    actions.save_setup(actions.toggle_term(state, "ambient"))
    opened = actions.open_setup(start(setup), state.file)
    assert opened.setup.scene.objects[0].material.shininess == 7.0
    assert "ambient" not in opened.setup.settings.terms
    assert opened.file == state.file


@pytest.mark.parametrize(
    "content", [b"", b"[scene]\ntitle = 3", b"\xff\xfe", b"[[object]]\nmesh='x'"]
)
def test_a_bad_file_changes_nothing_and_says_why(setup, tmp_path, content):
    path = tmp_path / "bad.toml"
    path.write_bytes(content)
    state = actions.open_setup(start(setup), path)
    if content:  # an empty file is a setup in which everything has its default
        assert state.failed and state.message and state.setup is setup
    assert actions.open_setup(start(setup), tmp_path / "none.obj").failed
    assert actions.open_setup(start(setup), tmp_path).failed
