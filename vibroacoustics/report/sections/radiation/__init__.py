"""Section of the report: radiation and levels."""
