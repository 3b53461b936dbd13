"""Plots the images of a FITS file of nlcwfs: maps, phase screens, detector images, phases.

python3 fits_images.py results/screens-1/screens.fits screens.png
"""

import sys

import matplotlib.pyplot as plt
import numpy as np
from astropy.io import fits
from astropy.wcs import WCS
from matplotlib.ticker import EngFormatter

path, picture = sys.argv[1:]
with fits.open(path) as file:
    header = file[0].header
    images = file[0].data.reshape(-1, *file[0].data.shape[-2:])  # image, y, x
unit = header.get("BUNIT", "").strip()
# What pixels stand for: metres in the pupil, distances of planes, ...
height, width = images.shape[1:]
(left, bottom), (right, top) = WCS(header).sub(2).wcs_pix2world(
    [[-0.5, -0.5], [width - 0.5, height - 0.5]], 0)

shown = images[:4]
scale = "log" if np.nanmin(shown) > 0 else "linear"
limits = {"norm": scale, "vmin": np.nanmin(shown), "vmax": np.nanmax(shown)}
figure, axes = plt.subplots(1, len(shown), figsize=(3.6 * len(shown) + 1, 3.6), squeeze=False,
                            layout="constrained", sharey=True)
for number, (axis, image) in enumerate(zip(axes[0], shown), start=1):
    drawn = axis.imshow(image, origin="lower", extent=(left, right, bottom, top), **limits)
    axis.set_title(f"{number} of {len(images)}")
    for side, index in ((axis.xaxis, 1), (axis.yaxis, 2)):
        side.set_label_text(header.get(f"CTYPE{index}", "pixel"))
        side.set_major_formatter(EngFormatter(header.get(f"CUNIT{index}", "")))
        side.set_major_locator(plt.MaxNLocator(4))
figure.colorbar(drawn, ax=axes, label=unit)
figure.savefig(picture, dpi=100, bbox_inches="tight")
print(f"{path}: {len(images)} images of {width} x {height} samples,"
      f" {np.nanmin(images):.4g} to {np.nanmax(images):.4g} {unit}")
