"""Responses of designs: by linear algebra where that is exact, else run by run."""
