"""The window: the only importer of moderngl_window and imgui_bundle."""
