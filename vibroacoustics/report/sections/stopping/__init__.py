"""Section of the report: stopping."""
