"""Section of the report: scores and ranks."""
