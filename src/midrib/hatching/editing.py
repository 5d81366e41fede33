"""Changes of a hatching by hand: one stroke more, elsewhere, or less."""
