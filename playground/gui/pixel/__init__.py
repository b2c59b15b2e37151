"""Why a pixel has its colour: the equation with its numbers, and the vectors at its point."""
