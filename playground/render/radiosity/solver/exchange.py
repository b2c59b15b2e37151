"""Form factors made symmetric: the power K_ij = A_i F_ij that patches exchange, both ways equal."""

from __future__ import annotations

import numpy as np

from playground.render.radiosity.factor.matrix import FormFactors
from playground.shading.floats import Array

BALANCED = 1e-10  # relative error of the row sums that is no longer worth a product
MOST_ROUNDS = 30


class Exchange:
    """Products with a symmetric matrix K, for methods that need one.

    K is the mean of A F and its transpose. That changes nothing where F keeps reciprocity; where
    it does not, as with hemicubes, the mean loses the row sums. In a closed scene whose rows
    are normalised they are given back by scaling row and column i with x_i (Sinkhorn
    and Knopp, Concerning Nonnegative Matrices and Doubly Stochastic Matrices, Pacific Journal of
    Mathematics 21(2), 1967): a room of one colour keeps its exact answer.
    """

    def __init__(self, factors: FormFactors) -> None:
        self._factors = factors
        self._scale = np.ones((len(factors), 1))
        power = factors.exchange(self._scale)
        if factors.normalise and factors.closed:
            power = self._balance(power)
        # Of the light of patch j the share 1 − sum_j arrives nowhere.
        self.sums: Array = power / factors.area[:, None]  # (N, 1): Σ_i K_ij / A_j

    def __call__(self, light: Array) -> Array:
        """K C, (N, c): the power that arrives everywhere."""
        return self._scale * self._factors.exchange(self._scale * light)

    def _balance(self, power: Array) -> Array:
        """Choose the scale; the row sums of K that it leads to, (N, 1)."""
        factors = self._factors
        wanted = (factors.area * factors.row_sums(np.arange(len(factors))))[:, None]
        for _ in range(MOST_ROUNDS):
            some = (power > 0.0) & (wanted > 0.0)
            ratio = np.divide(wanted, power, out=np.ones_like(power), where=some)
            if np.max(np.abs(ratio - 1.0)) <= BALANCED:
                break
            # ratio^e multiplies the error of mode λ of F by 1 − e (1 + λ), and λ is 1 or small:
            # e = 1/2 would settle the first at once but only halve the others; 2/3 leaves a third.
            self._scale *= ratio ** (2.0 / 3.0)
            power = self(np.ones_like(power))
        return power
