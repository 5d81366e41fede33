"""Areas to lines."""
