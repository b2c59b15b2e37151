"""The walk through a tree of boxes on the GPU against its float64 twin, on the same rays."""

import numpy as np
import pytest

from playground.render.gl.trace.bvh_texels import bvh_texels
from playground.render.gl.trace.ray_batch import RayBatch
from playground.render.trace import walk
from playground.render.trace.bvh import build, bvh_of
from playground.scene.shapes import make
from playground.scene.shapes_curved import icosphere
from tests.parity.test_parity import U, f32

pytestmark = pytest.mark.gl
N = 6_000


def shot(rng, place, size):
    """Rays from around a mesh towards it, of any length, some along an axis."""
    origin = rng.normal(0.0, 1.5, (N, 3))
    direction = rng.uniform(-0.7, 0.7, (N, 3)) - origin
    direction[: N // 20, 0] = 0.0
    direction[N // 20 : N // 10, 1:] = 0.0
    direction *= rng.uniform(0.1, 10.0, (N, 1))
    return f32(place + size * origin), f32(size * direction)


def answers(gl, bvh, origin, direction, limit):
    """Hits of both kinds of batch on the GPU."""
    closest = RayBatch(gl, bvh, origin, direction, limit)
    blocked = RayBatch(gl, bvh, origin, direction, limit, any_hit=True)
    closest.run()
    blocked.run()
    found = closest.hits(), blocked.hits()[1] >= 0
    closest.release()
    blocked.release()
    return found


def bounds(bvh, triangle, origin, direction):
    """What float32 may do to a hit: to its t (N,), and to its least weight (N,).

    A corner in the ray's frame is off by six roundings of its distance, at most the reach M to the
    mesh's farthest corner; so is a weight by that over an altitude of the triangle as the
    ray sees it, and t by that over the cosine. Twice 6 u M for the two corners of an
    edge, the rest of a factor 4 for the products and the division.
    """
    slot = np.argsort(bvh.order)[triangle]
    a, b, c = np.moveaxis(bvh.corners[slot].astype(np.float64), 1, 0)
    normal = np.cross(b - a, c - a)
    area = np.linalg.norm(normal, axis=1)
    longest = np.max([np.linalg.norm(x, axis=1) for x in (b - a, c - b, a - c)], axis=0)
    length = np.linalg.norm(direction, axis=1)
    cosine = np.abs(np.sum(normal * direction, axis=1)) / (area * length)
    low, high = bvh.low[0].astype(np.float64), bvh.high[0].astype(np.float64)
    reach = np.max(np.maximum(np.abs(origin - low), np.abs(high - origin)), axis=1)
    off = 48 * U * reach / np.maximum(cosine, 1e-6)
    return off / length, off * longest / area


@pytest.mark.parametrize("name", ["teapot", "torus", "box", "grid"])
@pytest.mark.parametrize(("place", "size"), [(0.0, 1.0), (3.0, 2.0**-10), (0.0, 2.0**20)])
def test_gpu_walk(gl, rng, name, place, size):
    mesh = make(name)
    bvh = build(f32(place + size * mesh.positions.astype(np.float64)), mesh.faces)
    origin, direction = shot(rng, place, size)
    limit = f32(np.where(rng.random(N) < 0.5, 1e30, rng.uniform(0.0, 1.0, N)))
    (t, triangle, weights), blocked = answers(gl, bvh, origin, direction, limit)
    want, wanted, want_weights = walk.closest(bvh, origin, direction, limit)
    assert np.array_equal(blocked, triangle >= 0)

    hit, due = triangle >= 0, wanted >= 0
    same = hit & due & (triangle == wanted)
    slack, blur = bounds(bvh, wanted[same], origin[same], direction[same])
    assert np.mean(same == due) > 0.99
    assert np.all(np.abs(t[same] - want[same]) <= slack)
    assert np.all(np.abs(weights[same] - want_weights[same]).max(axis=1) <= blur)

    # Where another triangle or none is found, the ray passes within float32 of an edge or a limit.
    for mine, number, weight, time in (
        (due & ~same, wanted, want_weights, want),
        (hit & ~same, triangle, weights, t),
    ):
        slack, blur = bounds(bvh, number[mine], origin[mine], direction[mine])
        edge = weight[mine].min(axis=1) <= blur
        end = np.abs(time[mine] - limit[mine]) <= slack
        twin = hit[mine] & due[mine] & (np.abs(t[mine] - want[mine]) <= slack)
        assert np.all(edge | end | twin)


def test_nothing_slips_through_a_closed_mesh_on_the_gpu(gl, rng):
    mesh = icosphere(16)
    a, b = (mesh.positions[mesh.faces[:, k]].astype(np.float64) for k in (0, 1))
    share = rng.uniform(0.0, 1.0, (len(a), 1)).round(1)
    origin = f32(rng.uniform(-0.5, 0.5, (len(a), 3)))
    direction = f32(a + share * (b - a) - origin)
    (_, triangle, _), blocked = answers(gl, bvh_of(mesh), origin, direction, 1.5)
    assert np.all(triangle >= 0)
    assert blocked.all()


def test_several_meshes_share_the_textures():
    meshes = [make("box"), make("teapot"), make("quad")]
    bvhs = [bvh_of(mesh) for mesh in meshes]
    texels = bvh_texels(bvhs)
    corners = texels.corners.reshape(-1, 4)[:, :3]
    words = texels.nodes.reshape(-1, 4)[:, 3].astype(np.int64)
    for bvh, tree_of in zip(bvhs, texels.trees, strict=True):
        # Following the words from the root meets every slot of this mesh once, and no other.
        slots, waiting = [], [tree_of.root]
        while waiting:
            word = waiting.pop()
            if word >= 1 << 31:
                first = (word & 0x7FFFFFFF) >> 4
                slots += range(first, first + (word & 15))
            else:
                waiting += words[4 * word : 4 * word + 4].tolist()
        first = tree_of.first_slot
        assert sorted(slots) == list(range(first, first + len(bvh.order)))
        mine = corners[3 * first : 3 * (first + len(bvh.order))]
        assert np.array_equal(mine.reshape(-1, 3, 3), bvh.corners)
    assert len(bvhs[2].child) == 1  # the quad's two triangles are a leaf, its root a leaf's word
    assert texels.trees[2].root >= 1 << 31


def test_boxes_of_texels_hold_those_of_the_tree():
    bvh = bvh_of(make("teapot"))
    texels = bvh_texels([bvh])
    low, cell = (x.astype(np.float64) for x in (texels.trees[0].low, texels.trees[0].cell))
    rows = texels.nodes.reshape(-1, 4)
    leaf = {int(f): n for n, f in enumerate(bvh.first) if bvh.child[n] < 0}
    seen = 0
    for box in rows[(rows[:, 3] >= 1 << 31) & ((rows[:, 3] & 15) > 0)]:
        node = leaf[int(box[3] & 0x7FFFFFFF) >> 4]
        assert np.all(low + (box[:3] & 0xFFFF) * cell <= bvh.low[node])
        assert np.all(low + (box[:3] >> 16) * cell >= bvh.high[node])
        seen += 1
    assert seen == len(leaf)


def test_what_was_drawn_before_changes_nothing(gl_context):
    """Culling is left on by the rasteriser; the batch is drawn all the same."""
    bvh = bvh_of(make("box", None))
    rays = *shot(np.random.default_rng(2), 0.0, 1.0), np.inf
    plain = answers(gl_context, bvh, *rays)
    gl_context.enable_only(gl_context.CULL_FACE | gl_context.DEPTH_TEST)
    after = answers(gl_context, bvh, *rays)
    assert np.array_equal(plain[1], after[1]) and plain[1].any()
    assert all(np.array_equal(a, b) for a, b in zip(plain[0], after[0], strict=True))
