"""Hemicubes on the GPU: row by row against those that NumPy draws."""

import numpy as np
import pytest

import playground as pg
from playground.errors import PlaygroundError
from playground.measure.blocks_box import blocks_box
from playground.render.gl.radiosity import row_buffer
from playground.render.gl.radiosity.hemicube import Hemicubes
from playground.render.radiosity.factor import hemicube
from playground.render.radiosity.factor.hemicube_view import delta_form_factors, faces_of
from playground.render.radiosity.patch.divide import divide
from tests.radiosity.plates import adjacent_plates, cube, patches_of, rectangle, room
from tests.radiosity.test_hemicube import moved

pytestmark = pytest.mark.gl

# Positions are rounded to 1/256 pixel by either, and not the same way: a pixel may differ whose
# centre is as near as that to a border, on either side.
NARROW = 2 / 256


@pytest.fixture
def made(gl):
    """Makes hemicubes on the GPU, and lets them go in the end."""
    held = []

    def make(*arguments, **more):
        held.append(Hemicubes(gl, *arguments, **more))
        return held[-1]

    yield make
    for one in held:
        one.release()


def at_borders(items):
    """The number of pixels beside a border, to the left or below, in one item buffer."""
    return sum(
        np.count_nonzero(np.diff(face, axis=axis)) for face in faces_of(items) for axis in (0, 1)
    )


def disagreement(gpu, oracle, chosen):
    """Of all item buffers together: differing pixels, pixels at borders; and the most of one."""
    differing, beside = [], []
    for i in chosen:
        got, want = gpu.item_buffer(i).astype(np.int64), oracle.item_buffer(i).astype(np.int64)
        differing.append(np.count_nonzero(got != want))
        beside.append(at_borders(want))
    return sum(differing), sum(beside), max(differing)


SCENES = {
    "cube": lambda: cube(6),
    "room": lambda: room(6, 2),
    "touching": lambda: adjacent_plates(5),
    "cornell-box": lambda: divide(pg.load("cornell-box").with_(patches=300)),
    "two-rooms": lambda: divide(pg.load("two-rooms").with_(patches=300)),
    "tiny": lambda: moved(room(6, 2), 1e-9, 0.0),
    "huge": lambda: moved(room(6, 2), 3e12, 0.0),
    "far": lambda: moved(room(6, 2), 1.0, [1e5, -2e5, 5e4]),
}


@pytest.mark.parametrize("plain", [False, True])
@pytest.mark.parametrize("scene", SCENES)
def test_item_buffers_are_those_of_numpy(made, scene, plain):
    patches = SCENES[scene]()
    gpu, oracle = made(patches, plain=plain), hemicube.Hemicubes(patches, plain=plain)
    differing, beside, most = disagreement(gpu, oracle, range(0, len(patches), 5))
    assert differing <= NARROW * beside
    assert most <= 2 * 64  # of 12,288: borders that go through the centres of a line on two faces


@pytest.mark.parametrize("occlusion", [True, False])
def test_rows_are_those_of_numpy(made, occlusion):
    patches = room(6, 2)
    chosen = np.arange(0, len(patches), 3)
    got = made(patches, occlusion).rows(chosen)
    want = hemicube.hemicube(patches, chosen, occlusion)
    assert np.abs(got - want).max() < 16 * 4 / (np.pi * 64**2)  # so many pixels of the largest kind
    assert np.abs(got - want).sum() < NARROW * want.sum()


def test_rows_at_full_size_sum_to_1(made):
    """The room of the speed measurement: 2,376 patches, nearly all of it drawn in 18 parents."""
    patches = room(18, 6)
    sums = made(patches).rows(np.arange(len(patches))).sum(axis=1)
    # A pixel at the outline of a block may fall between its faces, whose common edges are not
    # rounded alike; the largest of the lower half of a side has 7.8e-5.
    assert np.abs(sums - 1.0).max() < 2e-4
    assert np.count_nonzero(np.abs(sums - 1.0) > 1e-12) < 0.01 * len(sums)


@pytest.mark.parametrize("adder", ["cpu", "gpu"])
def test_a_pixel_lost_at_a_silhouette_goes_to_its_neighbour(gl, made, adder):
    """In the box of the speed measurement, some pixels get the back of a block alone."""
    if adder == "gpu" and not row_buffer.can_add(gl):
        pytest.skip("needs OpenGL 4.3")
    patches = blocks_box(2376)
    sums = made(patches, adder=adder).rows(np.arange(len(patches))).sum(axis=1)
    # Left over are those at the border of a face: one in a row, at most the 8.02e-5 of the top's.
    assert np.abs(sums - 1.0).max() < 8.1e-5


def test_the_order_and_number_of_the_asked_do_not_matter(made):
    patches = room(6, 2)
    gpu = made(patches)
    order = np.random.default_rng(3).permutation(len(patches))
    rows = gpu.rows(order)
    assert np.array_equal(gpu.rows(order[:7]), rows[:7])
    assert gpu.rows([]).shape == (0, len(patches))


@pytest.mark.parametrize("plain", [False, True])
def test_the_gpu_adds_up_as_the_cpu_does(gl, made, plain):
    if not row_buffer.can_add(gl):
        pytest.skip("needs OpenGL 4.3")
    patches = room(6, 2)
    chosen = np.arange(len(patches))
    cpu, gpu = (made(patches, plain=plain, adder=who).rows(chosen) for who in ("cpu", "gpu"))
    # Every delta form factor is rounded to 2^-31.
    assert np.abs(cpu - gpu).max() <= delta_form_factors(64).size * 2.0**-32
    assert np.abs(cpu - gpu).sum(axis=1).max() <= delta_form_factors(64).size * 2.0**-32


def test_a_driver_that_cannot_add_up_says_so(gl, monkeypatch):
    monkeypatch.setattr("playground.render.gl.radiosity.hemicube.can_add", lambda context: False)
    with pytest.raises(PlaygroundError, match="renderer numpy"):
        Hemicubes(gl, cube(1), occlusion=False)


def test_more_patches_than_16_bits_count(made):
    patches = room(80, 60)
    assert len(patches) > 2**16
    gpu, oracle = made(patches), hemicube.Hemicubes(patches)
    got, want = (which.item_buffer(3).astype(np.int64) for which in (gpu, oracle))
    assert want.max() > 2**16
    assert np.count_nonzero(got != want) <= NARROW * at_borders(want)


@pytest.mark.parametrize("resolution", [2, 9, 32, 250])
def test_any_resolution(made, resolution):
    patches = cube(2)
    gpu, oracle = (which(patches, resolution=resolution) for which in (made, hemicube.Hemicubes))
    got, want = gpu.item_buffer(7), oracle.item_buffer(7)
    assert got.shape == want.shape == delta_form_factors(resolution).shape
    assert np.count_nonzero(got != want) <= max(NARROW * at_borders(want), 2 * resolution)


def test_a_back_blocks_and_is_no_patch(made):
    below = rectangle((-1, -1, 0), (2, 0, 0), (0, 2, 0))
    above = rectangle((-1, -1, 2), (0, 2, 0), (2, 0, 0))
    between = rectangle((-5, -5, 1), (10, 0, 0), (0, 10, 0))
    rows = made(patches_of([below, above, between], [(2, 2), (2, 2), (1, 1)])).rows(np.arange(9))
    assert not rows[:4].any()
    assert (rows[4:8, 8] > 0.8).all() and not rows[4:8, :8].any()
