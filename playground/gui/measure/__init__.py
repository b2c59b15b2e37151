"""What is measured while the window draws: popping, speed and error, what a scene needs."""
