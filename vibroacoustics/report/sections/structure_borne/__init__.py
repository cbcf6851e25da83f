"""Section of the report: structure-borne sound."""
