"""
A balancer of your own
======================

A further balancing option is one class. This one is a weight on a second shaft that rotates against
the crank at the same speed: with a counterweight on the crank it balances the first order of a
reciprocating mass. ``--plugin FILE.py`` loads a file with such a class: :doc:`/add_a_balancer`.
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
# A study may now name the kind. Units and ranges are checked as for built-in kinds:
#
# .. literalinclude:: /gallery/studies/balancer.toml
#    :language: toml
#    :lines: 12-24
study = va.load_study("studies/balancer.toml")
results = va.run(study, radiation=rough_radiation)

# %%
# The force of the ring is a line along x, the sum of two counter-rotating forces. The weight
# cancels the backward one, and a circle remains.
figure, axes = plt.subplots(layout="constrained")
for option in results["option"].values:
    force = results["force"].sel(speed=2900.0, option=option).sum("source")
    axes.plot(force.sel(axis="x"), force.sel(axis="y"), label=option)
axes.set(xlabel="force x, N", ylabel="force y, N", aspect="equal")
axes.legend(fontsize="small")

# %%
# Comparison with the built-in counterweight, at both speeds:
foot = results["foot_force_amplitude"].sel(order=1).max("foot")
level = results["change_1x"].sel(receiver="front_1m")
for option in results["option"].values:
    feet = " ".join(f"{value:5.2f}" for value in foot.sel(option=option).values)
    changes = " ".join(f"{value:+6.1f}" for value in level.sel(option=option).values)
    print(f"{option:20s} {feet} N into a foot   {changes} dB")
