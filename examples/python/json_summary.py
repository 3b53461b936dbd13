"""Compares the best design of a search with its baseline: means with standard errors.

python3 json_summary.py results/optimize-1/summary.json summary.png
"""

import json
import sys

import matplotlib.pyplot as plt

path, picture = sys.argv[1:]
with open(path, encoding="utf-8") as file:
    summary = json.load(file)

metrics = {"residual_wfe_nm": "residual WFE, nm", "total_wfe_nm": "total WFE, nm", "loops": "loops"}
figure, axes = plt.subplots(1, len(metrics), figsize=(8, 3.6), layout="constrained")
for axis, (metric, label) in zip(axes, metrics.items()):
    for name, color in (("best", "#0072b2"), ("baseline", "#d55e00")):
        value = summary[name]["performance"][metric]
        axis.bar(name, value["mean"], yerr=value["standard_error"], color=color, capsize=6)
        print(f"{name}: {label} {value['mean']:.4g} +- {value['standard_error']:.2g}")
    axis.set_ylabel(label)
figure.savefig(picture, dpi=100, bbox_inches="tight")
