"""
Designs: stroke, offset and clearance of a slider-link compressor
=================================================================

Efficiency and silence together, as Dagilis, Vaitkus and Kirejchick require. Both depend on the
crank radius, the offset of the link and the clearance of the piston. None of them is linear, so
each design is a run.

.. literalinclude:: /gallery/studies/designs_slider_link.toml
   :language: toml
"""

import matplotlib.pyplot as plt
from rough_radiation import rough_radiation

import vibroacoustics as va

study = va.load_study("studies/designs_slider_link.toml")
search = va.optimise(study, radiation=rough_radiation)

# %%
# Efficiency against force
# ------------------------
# A longer stroke and a wide clearance improve the efficiency. The force grows with the stroke.
values = search["wanted_value"].sel(wanted=["efficiency", "foot"])
front = search["on_front"] == 1
figure, axes = plt.subplots(layout="constrained", figsize=(6.4, 4.0))
axes.plot(*values.T, ".", color="0.75", label="designs")
axes.plot(*values[front].sortby(values[front][:, 0]).T, "o-", label="front")
axes.set(xlabel="Mechanical efficiency, %", ylabel="1x force into a foot, N")
axes.legend()

# %%
# The designs of the front
# ------------------------
shown = search["design_value"][front].to_pandas()
shown.columns = [key.rpartition(".")[2] for key in shown.columns]
print(shown.join(values[front].to_pandas()).round(3).to_string())
