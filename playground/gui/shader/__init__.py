"""The shaders in the window: what runs, what the user made of it, its twins."""
