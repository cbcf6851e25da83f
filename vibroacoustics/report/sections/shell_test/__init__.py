"""Section of the report: hammer test of the shell."""
