"""Section of the report: transfer paths."""
