"""Section of the report: levels in a room."""
