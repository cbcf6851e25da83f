"""Section of the report: measured baseline."""
