"""Results of measurements: orders, levels, sound power, forces, and levels after a change."""
