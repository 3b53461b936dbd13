"""Plots a search: what each design cost, in the order in which they were tried.

python3 csv_table.py results/optimize-1/search.csv search.png
"""

import sys

import matplotlib.pyplot as plt
import pandas as pd

path, picture = sys.argv[1:]
search = pd.read_csv(path)  # a header with units, empty cells where there is no value
tried = search[search["cost"].notna()]

figure, axis = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
axis.plot(tried["evaluation"], tried["cost"], ".", color="#0072b2", label="a design")
axis.step(tried["evaluation"], tried["cost"].cummin(), color="#d55e00", where="post", label="best so far")
axis.set_yscale("log")
axis.set_xlabel("evaluation")
axis.set_ylabel("cost")
axis.legend()
figure.savefig(picture, dpi=100, bbox_inches="tight")
best = tried.loc[tried["cost"].idxmin()]
print(f"{path}: {len(tried)} designs, the cheapest costs {best['cost']:.4g} with"
      f" planes at {best['planes_m']} m, {best['residual_wfe_nm']:.4g} nm")
