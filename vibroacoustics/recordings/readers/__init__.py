"""Readers of recordings that come with the package: one file a format."""
