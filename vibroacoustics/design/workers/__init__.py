"""Designs evaluated by processes beside this one: local ones, or those of a scheduler."""
