"""Designs of a study: what varies, what is wanted, and every design computed at once."""
