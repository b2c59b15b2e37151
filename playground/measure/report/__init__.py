"""What came of the experiments, as text, as data, as pictures and as one page."""
