"""What panels are made of: sliders from knobs, symbols of the lecture, axes and colours."""
