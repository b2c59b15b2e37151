"""Lightmaps in the window: baking, the atlas, and the pictures of stored light."""
