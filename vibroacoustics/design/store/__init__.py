"""Evaluated designs on disk: chunks with their hashes, gone on with after any end."""
