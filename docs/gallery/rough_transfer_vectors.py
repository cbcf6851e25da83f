"""
Your own transfer vectors
=========================

The radiation is an argument of ``va.run``: any function from a study to transfer vectors, measured
or by a second method. The other pages use this one, which takes a tenth of a second:

.. literalinclude:: /gallery/rough_radiation.py
   :language: python
   :lines: 1-60
"""

import matplotlib.pyplot as plt
from rough_radiation import rough_radiation

import vibroacoustics as va

study = va.load_study("studies/field.toml")
rough, _ = rough_radiation(study, None)
print(rough)

# %%
# Comparison with the radiation of the package
# --------------------------------------------
own = va.run(study)["transfer_vector"]
figure, axes = plt.subplots(layout="constrained")
for number, dof in enumerate(("tx", "tz", "ry")):
    for values, style in ((own, "-"), (rough["transfer_vector"], "--")):
        size = abs(values.sel(receiver="front_1m", dof=dof))
        axes.loglog(size["frequency"], size, style, color=f"C{number}", label=dof * (style == "-"))
axes.set(xlabel="frequency, Hz", ylabel="Pa s/m (ry: Pa s/rad)", title="dashed: the rough estimate")
axes.legend(fontsize="small")
