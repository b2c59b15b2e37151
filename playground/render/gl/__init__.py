"""The rasteriser on the GPU."""
