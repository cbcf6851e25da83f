"""What measurements alone say: orders, levels, sound power, forces, and levels after a change."""
