"""The metrics, against closed forms and published properties."""

import numpy as np
import pytest

import playground as pg
from playground.explain.colour_map import VIRIDIS, colour_of
from playground.measure import metrics


def image(pixels):
    return pg.Image(np.asarray(pixels, np.float32))


def test_rmse_max_and_psnr_of_a_constant_difference():
    a, b = np.zeros((20, 30, 3)), np.full((20, 30, 3), 0.1)
    assert metrics.rmse(a, b) == pytest.approx(0.1)
    assert metrics.largest(a, b) == pytest.approx(0.1)
    assert metrics.psnr(a, b) == pytest.approx(20.0)
    assert metrics.psnr(a, a) == float("inf")


def test_ssim_of_constant_pictures_is_the_luminance_term():
    """Variances vanish, and (2 x y + c1) / (x² + y² + c1) is left."""
    x, y, c1 = 0.5, 0.7, 0.01**2
    want = (2 * x * y + c1) / (x * x + y * y + c1)
    got = metrics.ssim(np.full((16, 16, 3), x), np.full((16, 16, 3), y))
    assert got == pytest.approx(want, rel=1e-12)


def test_ssim_by_a_second_method(rng):
    """One window at a time, straight from the definition."""
    a, b = rng.uniform(size=(2, 15, 14, 3))
    x, y = a @ metrics.LUMINANCE, b @ metrics.LUMINANCE
    offset = np.arange(-5, 6)
    weight = np.exp(-(offset[:, None] ** 2 + offset[None] ** 2) / (2 * 1.5**2))
    weight /= weight.sum()
    values = []
    for i in range(5, 10):
        for j in range(5, 9):
            u, v = x[i - 5 : i + 6, j - 5 : j + 6], y[i - 5 : i + 6, j - 5 : j + 6]
            mu, mv = (weight * u).sum(), (weight * v).sum()
            suu, svv = (weight * (u - mu) ** 2).sum(), (weight * (v - mv) ** 2).sum()
            suv = (weight * (u - mu) * (v - mv)).sum()
            values.append(
                (2 * mu * mv + 1e-4) * (2 * suv + 9e-4)
                / ((mu**2 + mv**2 + 1e-4) * (suu + svv + 9e-4))
            )  # fmt: skip
    assert metrics.ssim(a, b) == pytest.approx(np.mean(values), rel=1e-10)


def test_ssim_and_flip_order_pictures_as_eyes_do(rng):
    flat = np.full((48, 64, 3), 0.5)
    slight = flat + rng.normal(size=flat.shape) * 0.01
    strong = np.clip(flat + rng.normal(size=flat.shape) * 0.2, 0, 1)
    assert metrics.ssim(flat, flat) == pytest.approx(1.0)
    assert metrics.flip_map(flat, flat).max() == 0
    flips = [metrics.flip_map(flat, other).mean() for other in (slight, strong)]
    assert 0 < flips[0] < flips[1] < 1
    black, white = np.zeros((48, 64, 3)), np.ones((48, 64, 3))
    assert metrics.flip_map(black, white).mean() > 0.9


def test_a_tiny_picture_is_one_window():
    assert metrics.ssim(np.zeros((1, 1, 3)), np.zeros((1, 1, 3))) == 1.0
    assert metrics.ssim(np.zeros((2, 3, 3)), np.ones((2, 3, 3))) < 0.01


def test_compare_reports_and_maps():
    a, b = np.zeros((12, 12, 3)), np.zeros((12, 12, 3))
    b[3, 4, 1] = 0.5
    result = pg.compare(image(a), image(b))
    assert result.max == pytest.approx(0.5)
    assert set(result.to_dict()) == {"rmse", "max", "psnr", "ssim", "flip"}
    heat = result.heatmap().pixels
    np.testing.assert_allclose(heat[3, 4], VIRIDIS[-1], atol=1e-6)
    np.testing.assert_allclose(heat[0, 0], VIRIDIS[0], atol=1e-6)
    assert pg.compare(image(a), image(a)).to_dict()["psnr"] is None


def test_compare_refuses_what_cannot_be_compared():
    with pytest.raises(pg.PlaygroundError, match="different sizes"):
        pg.compare(image(np.zeros((2, 2, 3))), image(np.zeros((2, 3, 3))))
    with pytest.raises(pg.PlaygroundError, match="NaN"):
        pg.compare(image(np.zeros((2, 2, 3))), image(np.full((2, 2, 3), np.nan)))


def test_the_colour_map_runs_from_dark_to_bright():
    luminance = colour_of(np.linspace(0, 1, 65)) @ metrics.LUMINANCE
    assert (np.diff(luminance) > 0).all()
    assert (colour_of([-1.0, 2.0]) == VIRIDIS[[0, -1]]).all()
