"""Results along the axis of speed: curves, lines and modes that cross, speeds to avoid."""
