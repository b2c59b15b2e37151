"""Form factors: GLSL against the float64 twin, on the same float32 inputs."""

import numpy as np
import pytest

from playground.measure.cases.formulas import GLFormulas
from playground.render.gl import probe
from playground.shading import edge_log, edge_pair, flat_polygon, form_factor, polygon_pair
from playground.shading import form_factor_shapes as shapes
from playground.shading.vector import dot

pytestmark = pytest.mark.gl
U = 2.0**-24
N = 3000


def f32(a):
    return np.asarray(a, dtype=np.float32).astype(np.float64)


def sizes(rng, low=-3.0, high=3.0):
    return f32(10.0 ** rng.uniform(low, high, N))


def vectors(rng):
    return f32(rng.normal(size=(N, 3)) * 10.0 ** rng.uniform(-2, 2, (N, 1)))


def assert_within(got, want, bound):
    assert np.isfinite(got).all()
    excess = np.abs(got - want) / bound
    worst = np.argmax(excess)
    assert excess[worst] <= 1.0, f"row {worst}: {got[worst]} != {want[worst]}"


# Every formula of lengths alone promises at most 40 roundings and loses no digit; the built-in
# square root and the two polynomials for log and atan add up to 4 roundings each.
LENGTHS = [
    (form_factor, "opposite_rectangles", 3),
    (form_factor, "adjacent_rectangles", 3),
    (form_factor, "stretch_of_angle", 2),
    (form_factor, "log_share", 2),
    (shapes, "coaxial_discs", 3),
    (shapes, "element_to_disc", 3),
    (shapes, "sphere_to_rectangle", 3),
    (shapes, "sphere_to_zone", 2),
    (shapes, "outer_to_inner_sphere", 2),
]


@pytest.mark.parametrize(("module", "name", "count"), LENGTHS, ids=lambda x: str(x)[:24])
def test_formulas_of_lengths(gl, rng, module, name, count):
    given = [sizes(rng) for _ in range(count)]
    want = getattr(module, name)(*given)
    got = probe.call(module.__name__.split(".")[-1], name, *given)
    if name == "stretch_of_angle":  # two angles of one sign are subtracted: relative to the larger
        bound = 40 * U * np.maximum(np.arctan(given[0]) * given[1] ** 2, np.abs(want))
    elif name == "element_to_disc":  # under the disc it is ½ (1 − Q/P), under the rim Q cancels
        h, a, r = given
        rim = (h**2 + np.abs((a - r) * (a + r))) / np.hypot(h, a - r) / np.hypot(h, a + r)
        bound = 40 * U * (want + rim * (a < r))
    else:
        bound = 40 * U * np.abs(want) + 1e-37  # GPUs flush what is smaller
    assert_within(got, want, bound)


def test_outer_to_itself(gl, rng):
    inner = sizes(rng)
    outer = f32(inner * (1 + 10.0 ** rng.uniform(-6, 2, N)))
    got = probe.call("form_factor_shapes", "outer_to_itself", inner, outer)
    want = shapes.outer_to_itself(inner, outer)
    assert_within(got, want, 8 * U * want)


def test_adjacent_strips(gl, rng):
    a, b, half = sizes(rng), sizes(rng), rng.uniform(0, np.pi / 2, N)
    sine, cosine = f32(np.sin(half)), f32(np.cos(half))
    got = probe.call("form_factor", "adjacent_strips", a, b, sine, cosine)
    want = form_factor.adjacent_strips(a, b, sine, cosine)
    assert_within(got, want, 16 * U * want)


def test_points(gl, rng):
    x, y, nx, ny, area = vectors(rng), vectors(rng), vectors(rng), vectors(rng), sizes(rng)
    got = probe.call("form_factor", "point_to_point", x, nx, y, ny)
    want = form_factor.point_to_point(x, nx, y, ny)
    apart = y - x
    squared = dot(apart, apart)
    # 20 roundings of the product; those of n·r count by 1/cosine, a cosine of 1 in the bound.
    bound = 20 * U / (np.pi * squared)
    assert_within(got, want, bound)
    assert (want > 0).sum() > N // 8
    got = probe.call("form_factor", "point_to_disc", x, nx, y, ny, area)
    want = form_factor.point_to_disc(x, nx, y, ny, area)
    assert_within(got, want, 24 * U * area / (np.pi * squared + area))


def test_atan_rest(gl, rng):
    x = f32(rng.uniform(0, 0.7, N))
    got = probe.call("form_factor_shapes", "atan_rest", x)
    assert_within(got, shapes.atan_rest(x), 8 * U * np.ones(N) / 3)


def test_element_to_sphere(gl, rng):
    """Whole, F is good to 20 roundings; cut by the horizon it has those of its largest term."""
    radius = sizes(rng, -1, 1)
    distance = f32(radius * (1 + 10.0 ** rng.uniform(-3, 2, N)))
    height = distance / radius
    cosine = f32(np.clip(rng.uniform(-1.2, 1.2, N) / height, -1, 1))
    got = probe.call("form_factor_shapes", "element_to_sphere", distance, radius, cosine)
    want = shapes.element_to_sphere(distance, radius, cosine)
    near = np.where(height < 3, 1.0, 1.0 / height**3)  # a near sphere's terms are of order 1
    assert_within(got, want, 20 * U * (want + near))
    assert ((want > 0) & (np.abs(cosine * height) < 1)).sum() > N // 2


def test_cut_sphere(gl, rng):
    h = f32(1 + 10.0 ** rng.uniform(-1, 2, N))
    c = f32(rng.uniform(-0.99, 0.99, N))
    q, w = f32(np.sqrt(h * h - 1)), f32(np.sqrt(1 - c * c))
    got = probe.call("form_factor_shapes", "cut_sphere", h, c, q, w)
    want = shapes.cut_sphere(h, c, q, w)
    assert_within(got, want, 20 * U * (want + np.where(h < 3, 1.0, 1.0 / h**3)))


def edges(rng):
    """Offsets and edges of lengths about 1; a third parallel, some of these on one line."""
    offset, u, v = (f32(rng.normal(size=(N, 3)) * 0.5) for _ in range(3))
    factor = f32(2.0 ** rng.integers(-3, 1, (N, 1)) * rng.choice([-1.0, 1.0], (N, 1)))
    u = np.where(np.arange(N)[:, None] % 3 == 0, v * factor, u)
    offset = np.where(np.arange(N)[:, None] % 6 == 0, 2.0 * v, offset)
    return offset, u, v


def test_mean_log(gl, rng):
    offset, _, v = edges(rng)
    got, want = probe.call("edge_log", "mean_log", offset, v), edge_log.mean_log(offset, v)
    # Logarithms of squares from 1e-6 to 1e2, weighed by f and 1 − f, which may be 1/|v|.
    reach = np.linalg.norm(offset, axis=1) / np.linalg.norm(v, axis=1)
    assert_within(got, want, 24 * U * (1 + reach) * (2 + np.abs(want)))


def test_parallel_logs(gl, rng):
    offset, _, v = edges(rng)
    u = -0.5 * v
    got = probe.call("edge_log", "parallel_logs", offset, u, v)
    want = edge_log.parallel_logs(offset, u, v)
    far = (np.linalg.norm(offset, axis=1) + 2 * np.linalg.norm(v, axis=1)) ** 2
    assert_within(got, want, 24 * U * far * (1 + np.abs(np.log(far))))


def test_edge_logs(gl, rng):
    offset, u, v = edges(rng)
    got, want = (
        probe.call("edge_pair", "edge_logs", offset, u, v),
        edge_pair.edge_logs(offset, u, v),
    )
    # 1e-6 of Gauss's eight points and 40 roundings of what is integrated, ln r + 1 below 4.
    lengths = np.linalg.norm(u, axis=1) * np.linalg.norm(v, axis=1)
    far = (np.linalg.norm(offset, axis=1) + np.linalg.norm(u, axis=1)) / np.linalg.norm(v, axis=1)
    assert_within(got, want, (1e-6 + 40 * U * (4 + far)) * lengths + 40 * U * np.abs(want))


SQUARE = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], float)
TURNS = (20, 60, 100, 140, 165, 175, 179)


def hinged(degrees):
    """A square that shares the edge x = 0 with `SQUARE`, opened by an angle; float32."""
    x, z = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return f32([(0, 0, 0), (0, 1, 0), (x, 1, z), (x, 0, z)])


OTHERS = {
    **{f"hinged {t}": hinged(t) for t in TURNS},
    "opposite": np.add(SQUARE[::-1], (0, 0, 1)),
    "nearly touching": np.add(SQUARE[::-1], (0, 0, 2.0**-10)),
    "far": np.add(SQUARE[::-1], (0, 0, 256)),
    "beside, low": np.add(SQUARE[::-1], (1, 0.25, 2.0**-6)),
    "a corner in common": np.add(hinged(90), (0, 1, 0)),
    "half an edge in common": np.add(hinged(120), (0, 0.5, 0)),
    "crossing": np.array([(0.25, 0, -1), (0.25, 1, -1), (0.5, 1, 1), (0.5, 0, 1)]),
    "huge": (SQUARE[::-1] - 0.5) * 64 + (0, 0, 0.5),
    "triangle": np.array([(2, 0, 0.5), (0, 1, 1.5), (1, -1, 2), (1, -1, 2)]),
    "coplanar": np.add(SQUARE[::-1], (2, 0, 0)),
    "turned away": np.add(SQUARE, (0, 0, 1)),
}


@pytest.mark.parametrize("name", OTHERS)
def test_polygon_pairs(gl, name):
    """float32 promises 5e-6 relative for compact polygons, next to a plane as well."""
    formulas = GLFormulas().polygon_pair
    for a, b in ((SQUARE, OTHERS[name]), (OTHERS[name], SQUARE)):
        want = polygon_pair.pair_form_factor(a, b)
        assert abs(formulas.pair_form_factor(a, b) - want) <= 5e-6 * want
        got = formulas.exchange_area(a, b)
        assert abs(got - polygon_pair.exchange_area(a, b)) <= 5e-6 * got


def test_ribbons(gl):
    """Where the edges' sum would lose three digits, the points keep 2e-5."""
    a = np.array([(0, 0, 0), (100, 0, 0), (100, 0.0625, 0), (0, 0.0625, 0)])
    b = np.add(a[::-1], (0, 0, 1))
    want = polygon_pair.pair_form_factor(a, b)
    assert abs(GLFormulas().polygon_pair.pair_form_factor(a, b) - want) <= 2e-5 * want


def test_areas(gl):
    formulas = GLFormulas().flat_polygon
    for corners in OTHERS.values():
        area = flat_polygon.polygon_area(corners)
        assert abs(formulas.polygon_area(corners) - area) <= 8 * U * area
        apart = formulas.area_vector(corners) - flat_polygon.area_vector(corners)
        assert np.linalg.norm(apart) <= 8 * U * area
