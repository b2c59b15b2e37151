"""Triangles to pixels in float64 NumPy: the picture the GPU is judged by.

A triangle passes four steps, one file each, in the order a graphics card takes them:
`clip` cuts away what lies outside the view, `coverage` decides which pixel centres lie inside,
`depth` interpolates over the triangle and lets the nearest one win, and `rasterize` runs all
three and keeps, per pixel, who is seen there and with which weights. Shading comes after: this
package knows positions and indices only, no normals, no materials, no lights.
"""
