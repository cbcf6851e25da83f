"""Evaluated designs on disk: pieces with their hashes, from which a later command resumes."""
