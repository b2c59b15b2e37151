"""Makes tiles.png: 8 x 8 tiles whose red grows with u and whose green grows with v.

    python assets/textures/tiles.py

Orientation shows at a glance: black corner at (0, 0), yellow corner at (1, 1).
"""

from pathlib import Path

import numpy as np
from PIL import Image

SIDE, TILES = 256, 8

v, u = np.mgrid[SIDE - 0.5 : 0 : -1, 0.5:SIDE] / SIDE
dark = (np.floor(u * TILES) + np.floor(v * TILES)) % 2
gradient = np.stack([0.25 + 0.75 * u, 0.25 + 0.75 * v, 0.9 - 0.6 * u], axis=-1)
pixels = gradient * (1.0 - 0.55 * dark[..., None])
Image.fromarray(np.round(255 * pixels).astype(np.uint8)).save(
    Path(__file__).with_name("tiles.png"), optimize=True
)
