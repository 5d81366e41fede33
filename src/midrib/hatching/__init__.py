"""Areas to strokes: the hatching of slopes, and the symbols it is made of."""
