"""Long work beside the window: on a thread, in a process, some milliseconds of every frame."""
