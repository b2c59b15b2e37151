"""Radiosity in the window: solving, the race of the solvers, the form factor under a lens."""
