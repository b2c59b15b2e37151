"""What a lesson sets in the window: the pixel it explains, the panel it opens, its files."""

import gc
from dataclasses import replace
from pathlib import Path
from time import monotonic, sleep

import numpy as np
from imgui_bundle import imgui

import playground as pg
from playground.gui.lesson.lesson_course import answer, open_lesson
from playground.gui.lesson.lesson_pictures import LessonPictures
from playground.gui.lesson.lesson_run import LessonRun
from playground.gui.picture.orbit import widened
from playground.gui.state import State
from playground.scene.library import load

PATIENCE = 300.0  # seconds that a step may take on a busy machine


def test_a_pixel_is_the_same_point_in_a_view_of_any_shape(hands, tmp_path):
    """A lesson names it in the picture of the handout, 480 × 360."""
    file = tmp_path / "pixel.py"
    shown = (
        'import playground as pg\nfrom playground.lesson import show\nball = pg.load("sphere")\n'
    )
    shown += "show(ball, pixel=(180.5 / 480, 150.5 / 360))\n"
    file.write_text(f"# %% [markdown]\n# # A pixel\n\n# %%\n{shown}", encoding="utf-8")
    hands.window.state = open_lesson(hands.state, file)
    hands.until(lambda: hands.state.pixel is not None)
    width, height = hands.window.view_box()[2:]
    x, y = hands.state.pixel
    ball = load("sphere")
    there = pg.explain(ball, (180, 150), (480, 360)).corners[0].position
    seen = widened(ball.camera, width / height)
    size, pixel = (width, height), (int(x * width), int(y * height))
    here = pg.explain(replace(ball, camera=seen), pixel, size)
    across = 2 * np.linalg.norm(np.subtract(ball.camera.eye, ball.camera.target)) / height
    assert width / height < 1  # far from 480 by 360
    # A pixel is less than ``across`` wide; both are the middles of theirs, on a slanting ball.
    assert np.linalg.norm(here.corners[0].position - there) < 2 * across
    hands.window.state = replace(hands.state, lesson=None)
    hands.frames(2)


def test_temporary_files_of_a_lesson_stay_as_long_as_the_window(tmp_path):
    """Its process is killed, and the scene that stays may use them."""
    file, told = tmp_path / "files.py", tmp_path / "told"
    code = f"import tempfile\nopen({str(told)!r}, 'w').write(tempfile.mkdtemp())\n"
    file.write_text(f"# %% [markdown]\n# # Files\n\n# %%\n{code}", encoding="utf-8")
    run, state = LessonRun(LessonPictures(None)), open_lesson(State(), file)
    end = monotonic() + PATIENCE
    while state.lesson.page is None:
        assert monotonic() < end, state.message
        state = run.advance(state)
        sleep(0.005)
    made = Path(told.read_text())
    run.advance(replace(state, lesson=None))
    assert made.is_dir()
    del run
    gc.collect()
    assert not made.exists()


def test_a_panel_is_opened_on_top_though_those_above_it_change(hands, monkeypatch):
    """Another scene makes the panel Radiosity shorter in the frame after."""
    hands.load("cornell-box", patches=300)
    hands.window.state = replace(hands.state, method="radiosity", unfold="Radiosity")
    hands.frames(2)
    hands.until(lambda: not hands.window.slots.refining)
    plates = hands.state.opened(load("facing-plates"))
    paused = replace(plates.solving, playing=False)  # what is told of a solution would come later
    hands.window.state = replace(plates, method="radiosity", unfold="Form factors", solving=paused)
    hands.frames(8)
    assert hands.state.unfold == ""
    places, header = {}, imgui.collapsing_header

    def noted(name):
        places[name] = imgui.get_cursor_screen_pos().y - imgui.get_window_pos().y
        return header(name)

    monkeypatch.setattr(imgui, "collapsing_header", noted)
    hands.frames(1)
    assert 0 <= places["Form factors"] < imgui.get_frame_height()


def test_an_answer_below_what_is_seen_is_scrolled_to(hands, tmp_path, monkeypatch):
    file = tmp_path / "long.py"
    prose = 60 * "#\n# A paragraph of a long step, which takes its room.\n"
    code = "from playground.lesson import predict\n"
    code += 'predict("Up?", "yes", "no", answer="no", why="Down.")'
    file.write_text(f"# %% [markdown]\n# # Long\n{prose}\n# %%\n{code}\n", encoding="utf-8")
    hands.window.state = open_lesson(hands.state, file)
    hands.until(lambda: hands.state.lesson.page is not None)
    places, radio = [], imgui.radio_button

    def noted(name, chosen):
        if name == "##choose":
            places.append(imgui.get_cursor_screen_pos().y - imgui.get_window_pos().y)
        return radio(name, chosen)

    monkeypatch.setattr(imgui, "radio_button", noted)
    hands.frames(2)
    assert min(places) > hands.window.wnd.height  # the end of the page is not in sight
    hands.window.state = answer(hands.state, 0, 0)
    hands.frames(12)
    places.clear()
    hands.frames(1)
    assert len(places) == 2 and 0 < min(places) < max(places) < hands.window.wnd.height
    hands.window.state = replace(hands.state, lesson=None)
    hands.frames(2)
