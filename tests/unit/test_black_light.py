"""A light without light: drivers may drop its uniforms once its colours are constants."""

import numpy as np
import pytest

import playground as pg
from playground.render.gl.renderer import STEADY

SIZE = (32, 24)
LIT = pg.PointLight(position=(3, 4, 5))
DARK = pg.PointLight(diffuse=(0, 0, 0), specular=(0, 0, 0), ambient=(0, 0, 0))


@pytest.mark.gl
@pytest.mark.parametrize("lights", [(LIT, DARK), (DARK, LIT)], ids=["last", "first"])
def test_a_black_light_changes_no_pixel_however_long_the_scene_stands_still(gl, lights):
    setup = pg.load("sphere").with_(lights=lights)
    with pg.open_renderer(SIZE, "gl") as renderer:
        frames = [renderer.render(setup).pixels for _ in range(STEADY + 2)]
        alone = renderer.render(setup.with_(lights=(LIT,))).pixels
    # Whole exponents are raised by squaring from the frame STEADY on: off by 2e-6.
    for pixels in frames:
        np.testing.assert_allclose(pixels, alone, rtol=0, atol=1e-5)
