"""Light stored in a texture: global illumination computed once, looked up when drawing."""
