"""Pictures of what a collapse does."""
