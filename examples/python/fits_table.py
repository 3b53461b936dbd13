"""Plots the planes' distances of an export: nlcwfs export results/optimize-1.

python3 fits_table.py results/export-1/evaluations.fits planes.png
"""

import sys

import matplotlib.pyplot as plt
import numpy as np
from astropy.table import QTable

path, picture = sys.argv[1:]
table = QTable.read(path)  # columns with units
tried = table[np.isfinite(table["cost"])]

figure, axis = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
planes = [name for name in table.colnames if name.startswith("planes_m_")]
for name in planes:
    shown = axis.scatter(tried[name].to_value("km"), tried["residual_wfe_nm"].to_value("nm"),
                         c=np.log10(tried["cost"]), s=12, cmap="viridis")
axis.set_yscale("log")
axis.set_xlabel("distance of a plane, km")
axis.set_ylabel("residual WFE, nm")
figure.colorbar(shown, ax=axis, label="log10 of the cost")
figure.savefig(picture, dpi=100, bbox_inches="tight")
print(f"{path}: {len(table)} rows of {len(table.colnames)} columns, {len(planes)} planes")
