"""Ray tracing: what a ray meets, and what light comes back along it."""
