"""Sound over ground that gives way to it, and over a barrier."""
