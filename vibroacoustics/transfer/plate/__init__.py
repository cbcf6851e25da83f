"""A plate that forces drive: power into it, sound out of it, how far its modes spread both."""
