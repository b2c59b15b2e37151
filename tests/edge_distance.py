"""How near the edges of triangles come to samples: where two rasterisers may honestly disagree."""

import numpy as np

from playground.render.raster import coverage
from playground.render.raster.clip import clip_triangles, frustum_planes


def edge_distance(clip, faces, size, cull=None, offset=(0.5, 0.5), reach=0.05):
    """Distance (h, w) in pixels of each sample from the nearest edge of any triangle.

    Two rasterisers differ where it is below the rounding of positions, 1/256 pixel (and a little
    more with float32 positions); a comparison leaves those pixels out. Infinite where no edge is
    within `reach` pixels, at most 1/4.

    The arguments are those of `rasterize`. The cuts of clipped triangles are edges too; of faces
    seen exactly edge-on none is culled, and what is hidden counts.
    """
    assert 0 < reach <= 0.25  # `stroke` looks at one pixel per column of an edge
    nearest = np.full((size[1], size[0]), np.inf)
    position = clip_triangles(np.asarray(clip, float), faces, frustum_planes(size)).position
    xy, _ = coverage.to_window(position, size)
    if cull is not None:
        area = coverage.doubled_area(coverage.snap(xy))
        xy = xy[area <= 0 if cull == "back" else area >= 0]
    a = (xy - offset).reshape(-1, 2)
    b = (np.roll(xy, -1, axis=1) - offset).reshape(-1, 2)
    flat = (np.abs(b - a) @ [1.0, -1.0]) >= 0
    stroke(nearest, a[flat], b[flat], reach)
    stroke(nearest.T, a[~flat, ::-1], b[~flat, ::-1], reach)
    return nearest


def stroke(nearest, a, b, reach):
    """Lower `nearest` (h, w) to the distance from segments a, b (S, 2) with |dx| >= |dy|.

    Samples lie on whole numbers here. In one column only the sample nearest to the segment can be
    within reach (<= 1/4): its vertical distance is at most twice the true one.
    """
    height, width = nearest.shape
    low, high = np.minimum(a, b), np.maximum(a, b)
    near = (high[:, 1] > -1) & (low[:, 1] < height)
    first = np.maximum(np.ceil(low[:, 0] - reach), 0).astype(np.int64)
    last = np.minimum(np.floor(high[:, 0] + reach), width - 1).astype(np.int64)
    counts = np.where(near, np.maximum(last - first + 1, 0), 0)
    for batch in coverage.batches(counts, coverage.BATCH_PIXELS):
        slot, step = coverage.owners(counts[batch])
        column = first[batch][slot] + step
        start, along = a[batch][slot], (b[batch] - a[batch])[slot]
        run = np.where(along[:, 0] == 0, 1.0, along[:, 0])
        share = np.clip((column - start[:, 0]) / run, 0.0, 1.0)
        row = np.rint(start[:, 1] + share * along[:, 1]).astype(np.int64)

        # Measure to the segment itself: project the sample on it, stop at its ends.
        sample = np.stack([column, row], axis=-1) - start
        length = np.maximum((along**2).sum(axis=-1), np.finfo(np.float64).tiny)
        share = np.clip((sample * along).sum(axis=-1) / length, 0.0, 1.0)
        distance = np.sqrt(((sample - share[:, None] * along) ** 2).sum(axis=-1))
        seen = (distance <= reach) & (row >= 0) & (row < height)
        np.minimum.at(nearest, (row[seen], column[seen]), distance[seen])
