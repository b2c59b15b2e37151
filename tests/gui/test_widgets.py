"""Every control by its label, found and used by the ImGui test engine."""

import pytest

from playground.gui.panels import PANELS

pytestmark = pytest.mark.gl


def test_every_panel_by_its_labels(hands):
    def script(c):
        c.set_ref("Controls")
        for name in PANELS:
            c.item_open(name)
        c.item_uncheck("Terms/specular")
        assert "specular" not in hands.state.setup.settings.terms
        c.item_check("Terms/specular")
        c.item_click("Material/80##sh")
        assert hands.state.setup.scene.objects[0].material.shininess == 80.0
        c.item_input_value("Material/##shininess", 12.5)
        assert hands.state.setup.scene.objects[0].material.shininess == 12.5
        c.item_click("View/per-vertex##shading")
        assert hands.state.setup.settings.shading == "per-vertex"
        for layout in ("terms", "single"):
            c.item_click("View/##layout")
            c.yield_(2)
            c.item_click(f"//##Combo_00/**/{layout}")
            assert hands.state.layout == layout
        c.item_click("Lights/Add a light")
        assert len(hands.state.setup.scene.lights) == 2
        c.item_click("Lights/$$1/solo")
        assert hands.state.solo == 1
        c.item_click("Lights/$$1/×")
        assert len(hands.state.setup.scene.lights) == 1 and hands.state.solo is None
        for name in ("View", "Terms", "Material", "Lights"):
            c.item_close(name)
        c.item_click("Scene/##mesh")
        c.yield_(2)
        c.item_click("//##Combo_00/**/torus")
        assert hands.state.setup.scene.objects[0].mesh == "torus"
        c.item_uncheck("Display/##clamp")
        assert not hands.state.setup.settings.clamp
        c.item_click("Display/light##theme")
        assert hands.state.theme == "light"
        c.item_open("View")
        c.item_click("View/Reset")
        assert hands.state.setup == hands.state.loaded

    hands.do(script)
    assert not hands.state.failed


def test_right_click_sets_the_declared_default(hands):
    def script(c):
        c.set_ref("Controls")
        c.item_open("Material")
        c.item_click("Material/##shininess", 1)

    hands.do(script)
    assert hands.state.setup.scene.objects[0].material.shininess == 20.0


def test_a_number_out_of_range_is_refused_with_a_message(hands):
    def script(c):
        c.set_ref("Controls")
        c.item_open("Material")
        c.item_input_value("Material/##shininess", -3.0)

    hands.do(script)
    assert hands.state.setup.scene.objects[0].material.shininess == 40.0
    assert hands.state.failed and "shininess" in hands.state.message


def test_menus_open_setups(hands):
    def script(c):
        c.menu_click("//##MainMenuBar/Setups/red-on-blue")
        assert hands.state.setup.name == "red-on-blue"
        c.menu_click("//##MainMenuBar/Edit/Undo")
        assert hands.state.setup.name == "teapot"

    hands.do(script)
