"""The window's ray tracing for its tests: traced to the end, and the same without a window."""

from dataclasses import replace

import numpy as np

from playground.gui.state import TRACED


def traced(hands, **changes):
    """The setup traced, until nothing more comes."""
    hands.window.state = replace(hands.state, method=TRACED, **changes)
    settle(hands)


def settle(hands):
    hands.frames(2)
    slots = hands.window.slots.traced
    hands.until(lambda: slots.done and not slots.coming)


def rendered(hands, **changes):
    """The codes (H, W, 3) of a tracer that knows nothing of the window."""
    from playground.gui.picture.orbit import widened
    from playground.render.gl.trace.tracer import GLTracer

    size = hands.window.view_box()[2:]
    setup = hands.state.setup.with_(**changes)
    setup = setup.with_(camera=widened(setup.camera, size[0] / size[1]))
    codes = np.empty((size[1], size[0], 4), dtype=np.uint8)
    with GLTracer(size, hands.window.ctx) as tracer:
        tracer.render(setup, out=codes)
    return codes[..., :3].astype(np.float64)


def same(seen, expected):
    """Up to one code where a constant in a program rounds otherwise than a uniform."""
    assert expected.std() > 5.0
    assert np.abs(seen - expected).max() <= 1.0
