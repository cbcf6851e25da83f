"""Rules that rate sound at a window: limits by area and period, adjustments; one file each."""
