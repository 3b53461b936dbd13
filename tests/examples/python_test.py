"""Runs the examples of examples/python on small runs of the program. Argument: the program.

Ends with 77 where the distribution's astropy, pandas or matplotlib is missing.
"""

from __future__ import annotations

import csv
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import matplotlib.image
    import numpy as np
    import pandas  # noqa: F401
    from astropy.io import fits
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

PROGRAM = str(Path(sys.argv.pop()).resolve())
EXAMPLES = Path(__file__).resolve().parents[2] / "examples/python"
SMALL = """[detector]
pupil_pixels = 16
window = 2
[reconstruction]
window = 4
[simulation]
pupil_samples = 32
[screens]
count = 2
[verify]
screens = 2
[search]
budget = 6
"""


class PythonExamples(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = Path(cls.folder.name)
        cls.environment = {**os.environ, "MPLBACKEND": "Agg", "MPLCONFIGDIR": str(cls.path / "mpl")}
        # Matplotlib says on standard error when it makes its list of fonts.
        subprocess.run([sys.executable, "-c", "import matplotlib.pyplot"], env=cls.environment,
                       check=True, capture_output=True)
        (cls.path / "small.cfg").write_text(SMALL)
        cls.nlcwfs("optimize", "--config", "small.cfg", "--output", "search")
        cls.nlcwfs("screens", "--config", "small.cfg", "--output", "screens")
        cls.nlcwfs("export", "search", "--output", "table")

    @classmethod
    def tearDownClass(cls) -> None:
        cls.folder.cleanup()

    @classmethod
    def nlcwfs(cls, *arguments: str) -> None:
        subprocess.run([PROGRAM, *arguments], cwd=cls.path, check=True, capture_output=True)

    def output_of(self, example: str, file: str) -> str:
        """What an example prints, once its picture has been found to show something."""
        done = subprocess.run(
            [sys.executable, str(EXAMPLES / f"{example}.py"), file, "picture.png"],
            cwd=self.path, capture_output=True, text=True, env=self.environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "")
        picture = matplotlib.image.imread(self.path / "picture.png")
        self.assertGreater(picture.shape[0], 200)
        self.assertGreater(picture[..., :3].std(), 0.05, "a blank picture")
        (self.path / "picture.png").unlink()
        return done.stdout

    def summary(self) -> dict:
        return json.loads((self.path / "search/summary.json").read_text())

    def test_every_example_is_tried_here(self) -> None:
        tried = {name.removeprefix("test_") for name in dir(self) if name.startswith("test_")}
        self.assertLessEqual({path.stem for path in EXAMPLES.glob("*.py")}, tried)

    def test_fits_images(self) -> None:
        screens = fits.getdata(self.path / "screens/screens.fits")
        output = self.output_of("fits_images", "screens/screens.fits")
        self.assertIn("2 images of 32 x 32 samples", output)
        self.assertIn(f"{np.min(screens):.4g} to {np.max(screens):.4g} rad", output)

    def test_csv_table(self) -> None:
        with open(self.path / "search/search.csv", newline="", encoding="utf-8") as file:
            cheapest = min(float(row["cost"]) for row in csv.DictReader(file))
        output = self.output_of("csv_table", "search/search.csv")
        self.assertIn(f"6 designs, the cheapest costs {cheapest:.4g} with", output)

    def test_json_summary(self) -> None:
        loops = self.summary()["best"]["performance"]["loops"]
        self.assertIn(f"best: loops {loops['mean']:.4g} +- {loops['standard_error']:.2g}",
                      self.output_of("json_summary", "search/summary.json"))

    def test_sqlite_archive(self) -> None:
        output = self.output_of("sqlite_archive", "search/archive.sqlite")
        self.assertIn("'search': 6", output)

    def test_fits_table(self) -> None:
        with open(self.path / "table/evaluations.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        output = self.output_of("fits_table", "table/evaluations.fits")
        self.assertIn(f"{len(rows) - 1} rows of {len(rows[0])} columns, 4 planes", output)


if __name__ == "__main__":
    unittest.main()
