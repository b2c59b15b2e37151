"""A lesson beside the live scene: its text, its formulas, its goals."""
