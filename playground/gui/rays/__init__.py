"""Ray tracing in the window: its pictures, the tree behind a pixel, the Snell bench."""
