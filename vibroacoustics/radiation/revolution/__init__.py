"""Sound of bodies of revolution by boundary elements on their meridian, one Fourier order each."""
