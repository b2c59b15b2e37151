"""The pictures of the view: what each shows, what lies over it, and the mouse in it."""
