"""Into how many parts each edge is cut, so that pieces meet corner to corner."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from playground.render.radiosity.patch.outline import Outline

Integers = NDArray[np.int64]
LARGE = 4.0  # times the median edge: what is longer is large beside the pieces of a fine mesh


class Parts:
    """The edges of an outline in classes that must be cut alike.

    Opposite edges of a quad are cut into as many parts as each other, and so are the three of a
    triangle and the edges at which pieces of one object meet. All edges linked in this way are one
    class, and what is cut class by class has no corner in the middle of an edge (Baum, Mann,
    Smith, Winget, "Making Radiosity Usable", SIGGRAPH 1991, on why none may be there).
    """

    def __init__(self, shape: Outline) -> None:
        corners = shape.corners
        self.triangle = corners[:, 2] == corners[:, 3]
        start = shape.place[corners]
        end = np.roll(start, -1, axis=1)
        low, high = np.minimum(start, end), np.maximum(start, end)
        width = int(shape.place.max()) + 1
        _, edge = np.unique(low * width + high, return_inverse=True)
        edge = edge.reshape(-1, 4)
        quad, three = edge[~self.triangle], edge[self.triangle]
        pairs = [quad[:, [0, 2]], quad[:, [1, 3]], three[:, [0, 1]], three[:, [0, 3]]]
        class_of = classes(int(edge.max()) + 1, np.concatenate(pairs))
        self.of = class_of[edge]  # (M, 4): the class of each edge; of a triangle's third, nothing
        polygon = shape.points[corners]
        lengths = np.linalg.norm(np.roll(polygon, -1, axis=1) - polygon, axis=-1)
        self.longest = np.zeros(int(class_of.max()) + 1)
        np.maximum.at(self.longest, self.of, lengths)

    def cut(self, size: float) -> Integers:
        """Parts of each edge, (M, 4), where none may be longer than ``size``."""
        count = np.maximum(np.ceil(self.longest / size), 1.0).astype(np.int64)
        return np.asarray(count[self.of])

    def patches(self, parts: Integers) -> int:
        """How many patches that makes."""
        return int((parts[:, 0] * parts[:, 3]).sum())

    def of_the_large(self, wanted: int) -> Integers:
        """Parts of each edge, (M, 4), about ``wanted`` patches, but only much too long ones cut."""
        coarse = LARGE * float(np.median(self.longest[self.of].max(axis=1)))
        parts = self.cut(coarse)
        return parts if self.patches(parts) <= wanted else self.near(wanted)

    def near(self, wanted: int) -> Integers:
        """Parts of each edge, (M, 4), that make about as many patches as ``wanted``."""
        large = 2.0 * float(self.longest.max())  # every edge stays whole
        if self.patches(self.cut(large)) >= wanted:
            return self.cut(large)
        small = large / 2.0
        while self.patches(self.cut(small)) < wanted:
            small /= 2.0
        # The number falls with the size, in steps; 40 halvings leave no step between the two
        for _ in range(40):
            middle = float(np.sqrt(small * large))
            if self.patches(self.cut(middle)) >= wanted:
                small = middle
            else:
                large = middle
        few, many = self.cut(large), self.cut(small)
        below, above = self.patches(few), self.patches(many)
        return few if wanted * wanted < below * above else many  # nearer by ratio


def classes(count: int, pairs: Integers) -> Integers:
    """For each of ``count`` things the number of its class, where pairs (K, 2) are alike."""
    name = np.arange(count)
    while True:
        before = name.copy()
        least = name[pairs].min(axis=1)
        np.minimum.at(name, name[pairs], least[:, None])
        name = name[name]
        if np.array_equal(before, name):
            return np.unique(name, return_inverse=True)[1]
