"""Long work beside the window: pieces, estimates, cancelling, and files that take long to read."""

import os
from time import monotonic, sleep

import numpy as np
import pytest

from playground.errors import PlaygroundError
from playground.gui import actions, reading
from playground.gui.measure.speed_run import SpeedRun
from playground.gui.picture import reference_pieces
from playground.gui.reading_run import ReadingRun
from playground.gui.state import start
from playground.gui.work import aside, long_work, progress_bar
from playground.gui.work.long_work import LongWork, Piece, Progress, counted, part, together
from playground.render.numpy_renderer import NumpyRenderer
from playground.scene import read_apart
from playground.scene.library import load
from playground.scene.mesh_file import load_mesh

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n"


def patiently(over, step=lambda: None, seconds=300.0):
    until = monotonic() + seconds
    while not over() and monotonic() < until:
        step()
        sleep(0.002)
    assert over()


def taken(work):
    found = []
    patiently(lambda: work.done, lambda: found.extend(work.take()))
    return found


@pytest.mark.parametrize("beside", [False, True])
def test_all_that_comes_of_work_arrives_in_order(beside):
    work = LongWork(counted((i for i in range(5)), 5), beside)
    assert work.progress.share == 0.0
    assert taken(work) == [0, 1, 2, 3, 4]
    assert work.progress.share == 1.0 and work.take() == ()


@pytest.mark.parametrize("beside", [False, True])
def test_an_error_of_the_work_comes_out_of_take(beside):
    def broken():
        yield Piece(0.5, "half")
        raise OSError("gone")

    with pytest.raises(OSError, match="gone"):
        taken(LongWork(broken(), beside))


@pytest.mark.parametrize("beside", [False, True])
def test_stopped_work_is_closed_and_goes_no_further(beside, monkeypatch):
    monkeypatch.setattr(aside, "PATIENCE", 300.0)
    closed = []

    def endless():
        try:
            while True:
                sleep(0.001)
                yield Piece()
        finally:
            closed.append(True)

    work = LongWork(part(counted(endless(), 10), 0.0, 0.5), beside)
    work.take()
    work.close()
    assert closed == [True]


def test_a_frame_makes_one_piece_even_where_that_takes_long():
    made = []

    def slow():
        for i in range(3):
            sleep(2 * long_work.BUDGET)
            made.append(i)
            yield Piece((i + 1) / 3, i)

    work = LongWork(slow())
    for count in (1, 2, 3):
        assert work.take() == (count - 1,) and len(made) == count and not work.done
    assert work.take() == () and work.done


def test_what_is_left_is_estimated_from_what_was():
    assert Progress(0.25, 3.0).left == pytest.approx(9.0)
    assert Progress(1.0, 3.0).left == 0.0
    assert Progress(0.0, 3.0).left is None and Progress(None, 3.0).left is None


def test_of_works_side_by_side_the_slowest_counts():
    assert together(Progress(0.2, 3.0), Progress(0.6, 2.0)) == Progress(0.2, 3.0)
    assert together(Progress(None, 3.0), Progress(0.6, 5.0)) == Progress(None, 5.0)


def test_a_part_of_work_stands_between_its_ends():
    pieces = part((Piece(s) for s in (0.0, 0.5, None, 1.0)), 0.5, 0.9)
    shares = [piece.share for piece in pieces]
    assert shares[2] is None
    assert [s for s in shares if s is not None] == pytest.approx([0.5, 0.7, 0.9])


@pytest.mark.parametrize(
    ("progress", "words"),
    [
        (Progress(0.25, 3.0), "25 %, 9 s left"),
        (Progress(0.5, 0.01), "50 %, 1 s left"),
        (Progress(0.01, 1.0), "1 %, 1 min 39 s left"),
        (Progress(0.0, 3.0), "0 %"),
        (Progress(1.0, 3.0), "100 %"),
        (Progress(None, 2.5), "3 s so far"),
    ],
)
def test_progress_in_words(progress, words):
    assert progress_bar.words(progress) == words


def test_the_reference_in_pieces_is_the_numpy_renderers_picture():
    setup = load("stretched").with_(samples=2)
    expected = NumpyRenderer((90, 70)).render(setup)
    pieces = list(reference_pieces.pieces(setup, (90, 70)))
    np.testing.assert_array_equal(pieces[-1].item, expected.pixels)
    shares = [piece.share for piece in pieces]
    assert shares == sorted(shares) and len(shares) > 4


@pytest.fixture
def square(tmp_path, monkeypatch):
    """A mesh file that counts as large."""
    path = tmp_path / "square.obj"
    path.write_text(SQUARE)
    monkeypatch.setattr(reading, "LARGE", 10)
    return path


def test_objects_take_the_mesh_that_was_read_apart(square, monkeypatch):
    expected, offset = load_mesh(square)
    for _ in read_apart.read_apart(str(square)):
        pass
    monkeypatch.setattr("playground.scene.mesh_file.load_mesh", None)  # nobody reads it again
    geometry = load(square).scene.objects[0].geometry()
    for name in ("positions", "normals", "faces"):
        np.testing.assert_array_equal(getattr(geometry.mesh, name), getattr(expected, name))
        assert not getattr(geometry.mesh, name).flags.writeable
    np.testing.assert_array_equal(geometry.offset, offset)
    assert geometry.mesh.texcoords is None and geometry.mesh.name == "square"


def test_the_process_tells_what_is_wrong_with_a_file(square):
    square.write_text("v 1 2\nf 1 1 1\n")
    with pytest.raises(PlaygroundError) as apart:
        list(read_apart.read_apart(str(square)))
    with pytest.raises(PlaygroundError) as here:
        load_mesh(square)
    assert str(apart.value) == str(here.value)


def test_a_process_that_dies_is_told(square, monkeypatch):
    monkeypatch.setattr(read_apart, "__name__", "playground.nowhere")
    with pytest.raises(PlaygroundError, match="nowhere"):
        list(read_apart.read_apart(str(square)))


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="a file that never ends is one of POSIX")
def test_closing_ends_the_process(tmp_path, monkeypatch):
    endless_file = tmp_path / "endless.obj"
    os.mkfifo(endless_file)  # nobody writes into it: who reads it waits
    started = []
    popen = read_apart.subprocess.Popen

    def watched(*args, **more):
        started.append(popen(*args, **more))
        return started[0]

    monkeypatch.setattr(read_apart.subprocess, "Popen", watched)
    work = read_apart.read_apart(str(endless_file))
    next(work)
    work.close()
    assert started[0].returncode is not None and started[0].returncode < 0


def test_small_files_and_library_setups_are_opened_at_once(square, monkeypatch):
    assert reading.large_meshes("teapot") == ()
    assert reading.large_meshes("missing.obj") == ()
    assert reading.large_meshes(square) == (str(square.resolve()),)
    monkeypatch.setattr(reading, "LARGE", 10**6)
    assert reading.large_meshes(square) == ()
    assert actions.open_setup(start(load("sphere")), square).setup.name == "square"


def test_the_meshes_of_a_setup_file_count(square, tmp_path):
    file = tmp_path / "setup.toml"
    file.write_text('[[object]]\nmesh = "square.obj"\n')
    (mesh,) = reading.large_meshes(file)
    assert mesh.endswith("square.obj")
    state = actions.open_setup(start(load("sphere")), file)
    assert state.setup.name == "sphere" and state.reading.words == "reading setup.toml ..."
    run, states = ReadingRun(), [state]
    patiently(lambda: states[-1].reading is None, lambda: states.append(run.advance(states[-1])))
    state = states[-1]
    assert state.setup.name == "setup" and not state.failed


@pytest.mark.gl
class TestInTheWindow:
    """Reading and measuring while frames go on."""

    def finish(self, hands):
        hands.until(lambda: hands.state.reading is None)

    def test_a_large_file_that_is_dropped_opens_as_one_step(
        self, hands, window, square, monkeypatch
    ):
        real, dragged = reading.pieces, []

        def held(meshes):
            while not dragged:
                sleep(0.001)
                yield Piece()
            yield from real(meshes)

        monkeypatch.setattr(reading, "pieces", held)
        before = hands.state.setup
        window.on_files_dropped_event(0, 0, [str(square)])
        hands.frames(1)
        assert hands.state.setup is before
        assert hands.state.message == "reading square.obj ..."
        hands.drag((250, 300), (300, 330))  # the window goes on
        moved = hands.state.setup
        assert moved.camera != before.camera
        dragged.append(True)
        self.finish(hands)
        assert hands.state.setup.name == "square" and not hands.state.failed
        hands.key("z", "ctrl")
        assert hands.state.setup == moved
        hands.key("z", "ctrl")
        assert hands.state.setup == before  # the drag, too, was one step

    def test_cancel_leaves_everything_as_it_was(self, hands, window, square, monkeypatch):
        monkeypatch.setattr(reading, "pieces", endless)
        before = hands.state.setup
        window.on_files_dropped_event(0, 0, [str(square)])
        hands.until(lambda: hands.state.reading and hands.state.reading.progress.elapsed > 0.5)
        hands.do(lambda c: c.item_click("//###waiting reading/###cancel"))
        hands.frames(2)
        assert hands.state.reading is None and hands.state.setup is before
        assert "was not opened" in hands.state.message
        assert window.reading._work is None

    def test_a_damaged_large_file_shows_a_message(self, hands, window, square):
        before = hands.state.setup
        square.write_text("v 1 2\nv 1 2 3\nf 1 1 1\n")
        window.on_files_dropped_event(0, 0, [str(square)])
        hands.frames(1)
        self.finish(hands)
        assert hands.state.failed and "square.obj" in hands.state.message
        assert hands.state.setup is before

    def test_another_setup_that_is_opened_meanwhile_stays(self, hands, window, square, monkeypatch):
        monkeypatch.setattr(reading, "pieces", endless)
        window.on_files_dropped_event(0, 0, [str(square)])
        hands.frames(2)
        window.on_files_dropped_event(0, 0, ["torus"])
        hands.frames(2)
        assert hands.state.reading is None and hands.state.setup.name == "torus"

    def test_the_speed_run_comes_nearer_its_end(self, hands, window, piece_by_piece):
        from playground.gui.measure.speed_log import asked

        run = SpeedRun(window.ctx)
        log, shares = asked(start(load("popping"))).speed, []
        while log.of is not None:
            log = run.advance(log)
            shares.append(log.progress.share)
        assert shares == sorted(shares) and len(set(shares)) > 5
        assert not log.error and len(log.dots) == 1
        run.close()

    def test_the_speed_run_is_cancelled_by_its_button(self, hands, monkeypatch):
        from playground.gui.measure import speed_run

        monkeypatch.setattr(speed_run, "TIMED", 10**6)
        hands.do(lambda c: c.item_open("//Controls/Speed and error"))
        hands.frames(3)
        assert hands.state.speed.of is not None
        hands.do(lambda c: c.item_click("//Controls/Speed and error/###measure"))
        hands.frames(2)
        assert hands.state.speed.of is None and hands.state.speed.dots == ()
        hands.do(lambda c: c.item_close("//Controls/Speed and error"))

    def test_a_reference_that_was_given_up_begins_anew_with_a_change(self, hands, monkeypatch):
        from dataclasses import replace

        real = reference_pieces.pieces
        monkeypatch.setattr(reference_pieces, "pieces", endless)
        hands.window.state = replace(hands.state, layout="wipe", other="reference")
        hands.frames(2)
        reference = hands.window.slots.reference
        assert reference.coming
        reference.give_up()
        hands.frames(5)
        assert reference.computing and not reference.coming and reference.progress is None
        monkeypatch.setattr(reference_pieces, "pieces", real)
        hands.key("s")
        hands.until(lambda: not reference.computing)


def endless(*_):
    while True:
        sleep(0.005)
        yield Piece()
