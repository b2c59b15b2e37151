"""Divides the surfaces of a setup into patches: evenly, corner to corner."""

from __future__ import annotations

import numpy as np

from playground.render.radiosity.patch.colours import colours
from playground.render.radiosity.patch.cut import cut
from playground.render.radiosity.patch.memory import check_memory
from playground.render.radiosity.patch.outline import Outline, outline
from playground.render.radiosity.patch.parts import Parts
from playground.render.radiosity.patch.patches import Patches
from playground.scene.setup import Setup


def divide(setup: Setup) -> Patches:
    """About ``setup.settings.patches`` patches of the objects and area lights of ``setup``.

    Coplanar triangles that make a convex quad go together first. Then everything is cut evenly,
    with the same points along edges that the pieces of an object share, so that no corner lies
    in the middle of an edge. Where meshes have more triangles already, they keep them; what is
    much larger than those is cut into as many patches again; ``warnings`` says so.

    Raises
    ------
    PlaygroundError
        Corners that are not finite, nothing with an area, a reflectance of 1 or more, nothing
        that sends out light, or form factors that would not fit into memory: said before any
        of the work is done.
    """
    wanted = setup.settings.patches
    shape = outline(setup)
    warnings = list(shape.warnings)
    parts = Parts(shape)
    fewest = len(shape.corners)
    edges = parts.near(wanted) if fewest <= wanted else parts.of_the_large(fewest + wanted)
    number = parts.patches(edges)
    check_memory(number, fewest)
    if fewest > wanted:
        warnings.append(
            f"The meshes have {fewest} pieces, more than the {wanted} patches asked for: each is "
            f"a patch, and large ones are cut: {number} in all. A lower tessellation gives fewer."
        )
    return _patches(setup, shape, edges, tuple(warnings))


def _patches(setup: Setup, shape: Outline, edges: np.ndarray, warnings: tuple[str, ...]) -> Patches:
    pieces = cut(shape, edges)
    owner = shape.owner[pieces.parent]
    texcoords = None if pieces.texcoords is None else pieces.texcoords[pieces.corners]
    reflectance, emission = colours(setup, owner, pieces.points[pieces.corners], texcoords)
    return Patches(
        origin=shape.origin,
        points=pieces.points,
        normals=pieces.normals,
        texcoords=pieces.texcoords,
        corners=pieces.corners.astype(np.int32),
        owner=owner.astype(np.int32),
        parent=pieces.parent.astype(np.int32),
        reflectance=reflectance,
        emission=emission,
        parents=pieces.parents,
        warnings=warnings,
    )
