"""
A balancer of your own
======================

A balancing option that the package does not have is one class. This one is a weight on a second
shaft that turns the other way at the same speed: with a counterweight on the crank it takes the
first order of a mass that slides to and fro. A file with such a class is taken in by ``--plugin
FILE.py`` too: :doc:`/add_a_balancer`.
"""

from typing import ClassVar

import matplotlib.pyplot as plt
import numpy as np
from pydantic import Field
from rough_radiation import rough_radiation

import vibroacoustics as va


@va.register
class BackTurningWeight(va.Option):
    """One weight on a shaft of its own, geared to turn against the crank."""

    kind: ClassVar[str] = "back-turning-weight"
    mass_kg: float = Field(gt=0.0, le=1.0)
    radius_m: float = Field(gt=0.0, le=0.1)

    def added(self, machine: va.Machine, revolution: va.Revolution) -> va.Added:
        """A mass on a circle, opposite the crank at angle zero."""
        angle = -revolution.rotation.crank_angle
        circle = np.array([np.cos(angle), np.sin(angle), 0.0 * angle])
        weight = va.MovingPart("balancer", self.mass_kg, -self.radius_m * circle)
        return va.Added((weight,), {"added_mass_kg": self.mass_kg})


# %%
# A study may now name the kind; units and ranges are checked as for the built-in ones:
#
# .. literalinclude:: /gallery/studies/balancer.toml
#    :language: toml
#    :lines: 12-24
study = va.load_study("studies/balancer.toml")
results = va.run(study, radiation=rough_radiation)

# %%
# The ring's force is a line along x. It is the sum of two forces that turn in opposite senses; the
# weight takes the one that turns back, and a circle is left.
figure, axes = plt.subplots(layout="constrained")
for option in results["option"].values:
    force = results["force"].sel(speed=2900.0, option=option).sum("source")
    axes.plot(force.sel(axis="x"), force.sel(axis="y"), label=option)
axes.set(xlabel="force x, N", ylabel="force y, N", aspect="equal")
axes.legend(fontsize="small")

# %%
# Beside the built-in counterweight, at both speeds:
foot = results["foot_force_amplitude"].sel(order=1).max("foot")
level = results["change_1x"].sel(receiver="front_1m")
for option in results["option"].values:
    feet = " ".join(f"{value:5.2f}" for value in foot.sel(option=option).values)
    changes = " ".join(f"{value:+6.1f}" for value in level.sel(option=option).values)
    print(f"{option:20s} {feet} N into a foot   {changes} dB")
