"""Gas in a space between the shell's wall and parts in it: acoustic modes, response, wall force."""
