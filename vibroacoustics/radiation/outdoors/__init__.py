"""Sound over porous ground and over a barrier."""
