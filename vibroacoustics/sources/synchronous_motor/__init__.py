"""Permanent-magnet synchronous motor on an inverter: its torque by order and by switching."""
