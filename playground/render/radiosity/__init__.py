"""Radiosity: patches, form factors, solvers and what becomes of them in a picture."""
