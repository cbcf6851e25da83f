"""Section of the report: evidence."""
