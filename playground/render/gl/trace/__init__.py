"""The ray tracer on the GPU: one pixel follows its whole tree of rays."""
