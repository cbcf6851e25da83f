"""Pages of `balance`: weights, readings, pictures of angles, and the bench sheet."""
