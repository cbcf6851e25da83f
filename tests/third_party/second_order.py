"""A third party's criterion: the largest force on the housing at twice the speed."""

import vibroacoustics


@vibroacoustics.register
class SecondForce(vibroacoustics.Criterion):
    """Less is better."""

    name = "force_2x_n"
    label = "Largest force at twice the speed"
    unit = "N"

    def value(self, results):
        """Worst over the speeds."""
        return results["force_amplitude"].sel(order=2).max("speed")
