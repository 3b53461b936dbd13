"""Reads an archive without the program: every design that a run tried, also while it runs.

python3 sqlite_archive.py results/optimize-1/archive.sqlite archive.png
"""

import json
import sqlite3
import sys

import matplotlib.pyplot as plt
import pandas as pd

path, picture = sys.argv[1:]
with sqlite3.connect(f"file:{path}?mode=ro", uri=True) as database:
    rows = pd.read_sql("SELECT * FROM evaluations WHERE failure IS NULL", database)
designs = pd.json_normalize(rows["design"].map(json.loads))
performances = pd.json_normalize(rows["performance"].map(json.loads))
table = rows[["stage", "cost"]].join(designs).join(performances)

figure, axis = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
for stage, group in table.groupby("stage"):
    axis.errorbar(group["fractional_loops.mean"], group["residual_wfe_nm.mean"],
                  group["residual_wfe_nm.standard_error"], fmt=".", label=stage)
axis.set_yscale("log")
axis.set_xlabel("fractional loops")
axis.set_ylabel("residual WFE, nm")
axis.legend(title="stage")
figure.savefig(picture, dpi=100, bbox_inches="tight")
print(f"{path}: {len(table)} evaluations, {table['stage'].value_counts().to_dict()}")
