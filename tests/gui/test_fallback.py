"""Without a display the same view goes into a picture."""

import numpy as np
import pytest

from playground.gui import open_window, why_no_window
from playground.render.image_file import read_image
from playground.scene.library import load


@pytest.fixture
def _no_display(monkeypatch, tmp_path):
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    monkeypatch.setattr("sys.platform", "linux")
    monkeypatch.chdir(tmp_path)


@pytest.mark.usefixtures("_no_display")
def test_the_view_is_saved_and_the_reason_said(tmp_path, capsys):
    setup = load("sphere")
    assert open_window(setup) == 0
    said = capsys.readouterr()
    assert said.out.strip() == "sphere.png"
    assert "no display" in said.err
    picture = read_image(tmp_path / "sphere.png")
    assert picture.size == (1280, 720)
    assert picture.setup.with_(name="sphere") == setup
    assert np.ptp(picture.pixels) > 0.5


@pytest.mark.usefixtures("_no_display")
def test_without_a_driver_numpy_draws_and_the_install_line_is_said(monkeypatch, capsys):
    from playground.render.gl import context

    def none():
        raise context.NoDriverError("no GL driver was found")

    monkeypatch.setattr(context, "headless", none)
    monkeypatch.setattr("playground.gui.PICTURE_SIZE", (64, 36))
    assert open_window(load("sphere")) == 0
    assert context.INSTALL_DRIVER in capsys.readouterr().err


def test_a_missing_library_is_named_with_the_line_that_installs_it(monkeypatch):
    import builtins

    real = builtins.__import__

    def refuse(name, *more):
        if name == "imgui_bundle":
            raise ImportError("libX11.so.6: cannot open shared object file")
        return real(name, *more)

    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setattr(builtins, "__import__", refuse)
    reason = why_no_window()
    assert "libX11.so.6" in reason and "sudo apt-get install -y libx11-6 libxext6" in reason
