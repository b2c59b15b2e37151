"""How fast and how wrong: metrics, timing, experiments."""
