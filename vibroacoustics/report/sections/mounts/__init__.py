"""Section of the report: mounts."""
