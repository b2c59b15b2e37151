"""From form factors to light: gathering, shooting, and the whole system at once."""
