"""The window with one panel open and the usual ones closed, for tests of what it does."""

from contextlib import contextmanager

USUAL = ("View", "Terms", "Material")


@contextmanager
def alone(hands, panel):
    """The hands while only `panel`, such as "//Controls/Solvers", is open; then as before."""

    def open_it(context):
        for name in USUAL:
            context.item_close(f"//Controls/{name}")
        context.item_open(panel)

    def as_before(context):
        context.item_close(panel)
        for name in USUAL:
            context.item_open(f"//Controls/{name}")

    hands.do(open_it)
    hands.frames(2)
    yield hands
    hands.do(as_before)
    hands.io.add_mouse_pos_event(-1.0, -1.0)
    hands.frames(2)
