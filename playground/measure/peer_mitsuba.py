"""The peer of rays through a mesh: Mitsuba 3 on the processor, where it is installed.

Its LLVM variant traces whole arrays of rays by Embree, in float32. Arrays go in from NumPy and
come out to it, as ours do.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec

import numpy as np
from numpy.typing import NDArray

from playground.measure.ray_kinds import Rays
from playground.scene.mesh import Mesh

NAME = "Mitsuba"
INSTALLED = find_spec("mitsuba") is not None
FARTHEST = np.float32(np.finfo(np.float32).max)


def mitsuba_asked(mesh: Mesh, rays: Rays) -> Callable[[], NDArray[np.float64]]:
    """What Mitsuba does: t of each ray, −1 if it hits nothing; of shadow rays 1 if blocked."""
    mitsuba = import_module("mitsuba")
    mitsuba.set_variant("llvm_ad_rgb")
    shape = mitsuba.Mesh(mesh.name, len(mesh.positions), len(mesh.faces))
    given = mitsuba.traverse(shape)
    given["vertex_positions"] = mesh.positions.astype(np.float32).ravel()
    given["faces"] = mesh.faces.astype(np.uint32).ravel()
    given.update()
    scene = mitsuba.load_dict({"type": "scene", "mesh": shape})
    limit = np.minimum(rays.limit, FARTHEST).astype(np.float32)

    def asked() -> NDArray[np.float64]:
        ray = mitsuba.Ray3f(
            mitsuba.Point3f(rays.origin.astype(np.float32).T),
            mitsuba.Vector3f(rays.direction.astype(np.float32).T),
        )
        ray.maxt = mitsuba.Float(limit)
        if rays.any_hit:
            return np.where(scene.ray_test(ray).numpy(), 1.0, -1.0)
        t = scene.ray_intersect_preliminary(ray).t.numpy().astype(np.float64)
        return np.where(np.isfinite(t), t, -1.0)

    return asked
