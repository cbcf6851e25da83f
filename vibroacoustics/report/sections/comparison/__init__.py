"""Section of the report: comparison."""
