"""Section of the report: summary."""
