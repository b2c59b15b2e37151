"""Where there is little room: lesson, picture and controls side by side, rows of the ray tree."""

import pytest

from playground.explain.ray_pixel import trace_pixel
from playground.scene.library import load

pytest.importorskip("imgui_bundle")

from playground.gui import frame
from playground.gui.panels import lesson
from playground.gui.rays import ray_words


def widths(room, scale=1.0):
    """Of lesson, picture and controls, as they would be, and as they are."""
    read = round(min(lesson.WIDTH * scale, lesson.WIDEST * room))
    wide = round(min(frame.PANEL_WIDTH * scale, frame.WIDEST_PANEL * room))
    kept = frame.between(read, wide, room, scale)
    return (read, wide), (kept[0], room - sum(kept), kept[1])


@pytest.mark.parametrize(("room", "scale"), [(900, 1.0), (1024, 1.0), (1280, 1.4), (1920, 2.0)])
def test_beside_a_lesson_the_picture_keeps_a_third_of_a_small_window(room, scale):
    (read, wide), (left, picture, right) = widths(room, scale)
    assert room - read - wide < 0.3 * room  # it would be too narrow
    # All of its share, or as much as two columns of the least width leave.
    least = round(frame.NARROWEST * scale)
    assert picture == min(round(frame.LEAST_VIEW * room), room - 2 * least)
    assert least <= left < read and least <= right < wide


def test_a_large_window_leaves_them_as_they_are():
    (read, wide), (left, _, right) = widths(1920)
    assert (left, right) == (read, wide)


@pytest.mark.parametrize(("read", "wide"), [(0, 390), (400, 0), (0, 0)])
def test_one_of_them_alone_gives_nothing_away(read, wide):
    assert frame.between(read, wide, 900, 1.0) == (read, wide)


def test_a_row_of_a_ray_says_less_where_there_is_less_room():
    tree = trace_pixel(load("whitted-room"), (422, 302), (640, 480))
    node = next(node for node in tree.nodes if node.refraction is not None)
    texts = ray_words.lines(node)
    angle, beyond = f"{node.incidence:.1f}°", f"{node.refraction:.1f}°"
    number = node.name.removeprefix("object ").split(" (")[0]
    assert texts[0].startswith(f"{node.depth} {node.kind}, {node.name.removeprefix('object ')}")
    assert texts[0].endswith(f"  {angle} → {beyond}  F {node.fresnel:.2f}")
    assert texts[-1] == f"{node.depth} {node.kind}, {number}"
    assert [len(text) for text in texts] == sorted({len(text) for text in texts}, reverse=True)
