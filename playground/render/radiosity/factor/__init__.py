"""How much of the light that leaves a patch arrives at another: every method, and the matrix."""
