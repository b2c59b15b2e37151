"""What a slider is dragged to is in the picture of the very same frame."""

import numpy as np
import pytest

pytestmark = pytest.mark.gl


def test_the_picture_follows_a_dragged_slider_without_delay(hands):
    hands.load("teapot", tessellation=56)  # about 100,000 triangles
    places = []

    def find(c):
        c.set_ref("Controls")
        c.scroll_to_item_y("Material/##shininess")
        places.append(c.item_info("Material/##shininess").rect_full)

    hands.do(find)
    box = places[0]
    y = (box.min.y + box.max.y) / 2
    hands.io.add_mouse_pos_event(box.min.x + 30, y)
    hands.frames(2)
    hands.io.add_mouse_button_event(0, True)
    hands.frames(2)
    seen = set()
    for x in np.linspace(box.min.x + 40, box.max.x - 20, 6):
        hands.io.add_mouse_pos_event(float(x), y)
        got = hands.pixels()  # one frame
        shininess = hands.state.setup.scene.objects[0].material.shininess
        assert shininess not in seen
        seen.add(shininess)
        want = hands.expected((got.shape[1], got.shape[0]))
        assert np.mean(np.abs(got - want) > 1) < 0.01  # but for what is drawn over the picture
        assert np.abs(got - want)[want.shape[0] // 3 : -100].max() <= 1
    hands.io.add_mouse_button_event(0, False)
    hands.frames(2)
