"""The frame as load path: from loads on the parts in the shell to forces on its wall."""
