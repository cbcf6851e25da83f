"""JSON schemas of study and machine files, for editors: keys with every unit that files may use."""
