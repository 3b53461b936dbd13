"""Opens the page of every command in a real browser.

    pages_test.py PROGRAM

Each page is made by a small run of PROGRAM. It must load without a message on the console and
without a request, fit the screen of a laptop and of a phone, show something there in light and in
dark colours, and print. What can be chosen on a page is chosen.
"""

import base64
import io
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

SKIPPED = 77

try:
    from PIL import Image, ImageChops
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
    from selenium.webdriver.support.ui import Select, WebDriverWait
except ImportError as error:
    print(f"skipped: {error}; the packages python3-selenium and python3-pil are needed")
    sys.exit(SKIPPED)
for program in ("chromium", "chromedriver"):
    if not shutil.which(program):
        print(f"skipped: there is no {program}; the packages chromium and chromium-driver are needed")
        sys.exit(SKIPPED)

PROGRAM = os.path.abspath(sys.argv.pop(1))
HOSTILE = '</script><img src=x onerror="window.isHacked=1">%{x}{{style}}'
WIDTHS = {"laptop": 1280, "phone": 360}
PATIENCE = 60  # seconds that a page has for each of its changes, on a busy machine

# A configuration that is simulated in milliseconds.
TINY = """
[detector]
pupil_pixels = 16
window = 2
[reconstruction]
window = 4
[simulation]
pupil_samples = 32
[screens]
count = 2
[verify]
screens = 4
[search]
budget = 8
"""

# Commands that make no folder of their own.
NO_FOLDER = {"completion", "manual", "report"}

# Command, what follows it; in an order in which each finds the runs that it needs.
RUNS = [
    ("evaluate", ["--detector.photons", "1e6"]),
    ("reconstruct", ["--detector.photons", "1e6", "--frames", "evaluate/typical-images.fits",
                     "--sensor.planes=-180km,180km,-47km,47km"]),
    ("convergence", []),
    ("response", ["--response.frequencies", "2,4,6", "--response.distances", "20km,50km,120km",
                  "--detector.photons", "1e6"]),
    ("screens", []),
    ("scale", ["--scale.diameter", "2m"]),
    ("sweep", ["--sweep.z_near", "20km:60km:4:log", "--sweep.z_far", "80km:200km:4",
               "--sweep.relaxation", "0,0.3"]),
    ("optimize", ["--search.budget", "20"]),
    ("trade", ["--trade.budget", "48", "--trade.population", "16"]),
    ("advise", ["--verify"]),
    ("law", ["--law.d_over_r0", "2,3,4,5"]),
    ("benchmark", []),
    ("reproduce", ["--figure", "scaling"]),
]

# Commands that take the folders of other runs.
FROM_RUNS = [("compare", ["sweep", "optimize"]), ("export", ["optimize"])]
ALL = [command for command, _ in RUNS + FROM_RUNS]


def run_program(*arguments):
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"nlcwfs {' '.join(arguments)}: {done.stderr}")


def make_runs():
    with open("tiny.cfg", "w", encoding="utf-8") as file:
        file.write(TINY)
    for command, more in RUNS:
        run_program(command, "--config", "tiny.cfg", "--quiet", "--output", command, *more)
    for command, runs in FROM_RUNS:
        run_program(command, *runs, "--quiet", "--output", command)


def start_browser():
    options = Options()
    for option in ("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic",
                   "--disable-dev-shm-usage",  # small in containers
                   "--no-first-run", "--disable-background-networking",
                   "--disable-component-update", "--disable-sync", "--hide-scrollbars",
                   f"--user-data-dir={os.path.abspath('profile')}"):
        options.add_argument(option)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    browser = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
    browser.set_script_timeout(PATIENCE)
    return browser


class PagesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.addClassCleanup(os.chdir, os.getcwd())
        # A browser that has just ended may still write to its profile.
        folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        cls.addClassCleanup(folder.cleanup)
        os.chdir(folder.name)
        make_runs()
        cls.browser = start_browser()
        cls.addClassCleanup(cls.browser.quit)

    # What the tests are written with ---------------------------------------------------------

    def devtools(self, command, **parameters):
        return self.browser.execute_cdp_cmd(command, parameters)

    def script(self, text, *arguments):
        return self.browser.execute_script(text, *arguments)

    def resize(self, device):
        self.devtools("Emulation.setDeviceMetricsOverride", width=WIDTHS[device], height=800,
                      deviceScaleFactor=1, mobile=device == "phone")

    def prefer(self, scheme):
        self.devtools("Emulation.setEmulatedMedia",
                      features=[{"name": "prefers-color-scheme", "value": scheme}])

    def misfits(self):
        """The charts that are not as wide as their places."""
        return self.script(
            "return [...document.querySelectorAll('.chart')].filter((chart) =>"
            " chart.clientWidth > 0 && Math.abs(chart._fullLayout.width - chart.clientWidth) > 1)"
            ".map((chart) => chart._fullLayout.width + ' in ' + chart.clientWidth)")

    def settle(self):
        """Waits for what the page draws when its size or its colours have changed, and until its
        charts are as wide as their places: Plotly follows a new size only after a while."""
        self.browser.execute_async_script(
            "const done = arguments[0];"
            "requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 0)))")
        end = time.monotonic() + PATIENCE
        while (misfits := self.misfits()) and time.monotonic() < end:
            time.sleep(0.05)
        self.assertEqual(misfits, [])

    def screenshot(self):
        """The page from its start, at most two screens of it."""
        self.settle()
        height = min(self.script("return document.documentElement.scrollHeight"), 1600)
        width = self.script("return innerWidth")
        shot = self.devtools("Page.captureScreenshot", captureBeyondViewport=True,
                             clip={"x": 0, "y": 0, "width": width, "height": height,
                                   "scale": 0.5})
        return Image.open(io.BytesIO(base64.b64decode(shot["data"]))).convert("RGB")

    def open(self, folder):
        """Opens a page, which must load without a word on the console and without a request."""
        self.resize("laptop")
        self.prefer("light")
        for log in ("browser", "performance"):
            self.browser.get_log(log)
        url = f"file://{os.path.abspath(folder)}/report.html"
        self.browser.get(url)
        self.settle()
        return url

    def assert_quiet(self, url):
        self.assertEqual([entry["message"] for entry in self.browser.get_log("browser")], [])
        requested = [
            message["params"]["request"]["url"]
            for message in (json_of(entry) for entry in self.browser.get_log("performance"))
            if message["method"] == "Network.requestWillBeSent"]
        self.assertEqual([one for one in requested if not one.startswith(("data:", "blob:"))], [url])
        self.assertEqual([one.text for one in self.browser.find_elements(By.CSS_SELECTOR, ".failed")],
                         [])

    def assert_not_blank(self, image, ground):
        drawn = ImageChops.difference(image, Image.new("RGB", image.size, ground)).convert("L")
        share = 1 - drawn.histogram()[0] / (image.width * image.height)
        self.assertGreater(share, 0.02)
        self.assertIsNone(image.getcolors(50))  # none are named where there are more

    def assert_fits(self):
        self.assertLessEqual(self.script("return document.documentElement.scrollWidth"),
                             self.script("return document.documentElement.clientWidth"))

    # Tests -----------------------------------------------------------------------------------

    def test_every_command_has_a_page(self):
        """All commands that make a folder, by what the program says of itself."""
        described = subprocess.run([PROGRAM, "--help"], capture_output=True, text=True, check=True)
        listed = described.stdout.split("\nOptions:")[0]
        commands = set(re.findall(r"^  ([a-z]+)  ", listed, re.MULTILINE))
        self.assertIn("evaluate", commands)
        self.assertEqual(commands - NO_FOLDER, set(ALL))

    def test_pages_show_what_they_have(self):
        for command in ALL:
            with self.subTest(command):
                url = self.open(command)
                light = self.screenshot()
                self.assert_not_blank(light, (255, 255, 255))
                self.assert_fits()
                self.prefer("dark")  # while the page is open
                dark = self.screenshot()
                self.assert_not_blank(dark, (20, 24, 29))
                self.assertEqual(light.getpixel((1, 1)), (255, 255, 255))
                self.assertEqual(dark.getpixel((1, 1)), (20, 24, 29))
                self.resize("phone")
                self.assert_not_blank(self.screenshot(), (20, 24, 29))
                self.assert_fits()
                self.assert_quiet(url)

    def test_a_page_prints_in_light_colours_on_its_paper(self):
        self.open("optimize")
        self.prefer("dark")
        self.settle()
        # What the print itself sees.
        self.script("addEventListener('beforeprint', () => setTimeout(() => 0));"
                    "window.seen = []; addEventListener('beforeprint', () => document"
                    ".querySelectorAll('.chart').forEach((chart) => seen.push("
                    "[chart._fullLayout.paper_bgcolor, chart._fullLayout.width])))")
        printed = base64.b64decode(self.devtools("Page.printToPDF")["data"])
        self.assertTrue(printed.startswith(b"%PDF"))
        seen = self.script("return seen")
        self.assertGreater(len(seen), 1)
        for ground, width in seen:
            self.assertEqual(ground, "#ffffff")
            self.assertLess(width, 700)  # A4 and letter, in CSS pixels
        self.settle()
        self.assertEqual(self.script(
            "return document.querySelector('.chart')._fullLayout.paper_bgcolor"), "#14181d")

    def test_the_switch_wins_over_the_system(self):
        self.open("evaluate")
        ground = lambda: self.script("return getComputedStyle(document.body).backgroundColor")
        switch = self.browser.find_element(By.ID, "theme")
        self.prefer("dark")
        self.settle()
        self.assertEqual(ground(), "rgb(20, 24, 29)")
        switch.click()
        self.assertEqual(ground(), "rgb(255, 255, 255)")
        self.prefer("light")
        switch.click()
        self.assertEqual(ground(), "rgb(20, 24, 29)")
        switch.click()
        self.assertEqual(ground(), "rgb(255, 255, 255)")

    def test_a_click_on_the_front_shows_the_design(self):
        self.open("trade")
        self.script("document.getElementById('front').scrollIntoView({block: 'center'})")
        self.settle()
        heading = lambda: self.browser.find_element(By.CSS_SELECTOR, "#design h3").text
        before = heading()
        # Where each design stands on the screen; the one that is farthest from all others.
        points = self.script("""
            const chart = document.getElementById("front");
            const {xaxis, yaxis} = chart._fullLayout;
            const place = chart.getBoundingClientRect();
            return chart.data.filter((trace) => trace.customdata).flatMap((trace) =>
              trace.x.map((x, i) => [trace.customdata[i],
                place.left + xaxis._offset + xaxis.d2p(x),
                place.top + yaxis._offset + yaxis.d2p(trace.y[i])]));""")
        alone = lambda point: min((point[1] - other[1]) ** 2 + (point[2] - other[2]) ** 2
                                  for other in points if other is not point)
        design, x, y = max((point for point in points if f"Design {point[0]}," not in before + ","),
                           key=alone)
        for kind in ("mouseMoved", "mousePressed", "mouseReleased"):
            self.devtools("Input.dispatchMouseEvent", type=kind, x=x, y=y, clickCount=1,
                          button="none" if kind == "mouseMoved" else "left")
            self.settle()
        WebDriverWait(self.browser, PATIENCE).until(lambda _: heading() != before)
        self.assertEqual(heading().split(",")[0], f"Design {design}")
        planes = self.script("return data.summary.front[arguments[0]].planes_m", design)
        text = self.browser.find_element(By.CSS_SELECTOR, "#design pre").text
        shown = [line for line in text.splitlines() if line.startswith("planes = ")][0]
        self.assertEqual([float(plane) for plane in shown.removeprefix("planes = ").split(",")],
                         planes)
        self.assertEqual(len(self.browser.find_elements(By.CSS_SELECTOR, "#design tbody tr td.number"
                                                        )) > len(planes), True)

    def test_the_front_is_filtered_and_its_axes_chosen(self):
        url = self.open("trade")
        shown = lambda: self.script("return document.getElementById('front').data.filter((trace) =>"
                                    " trace.customdata).reduce((sum, one) => sum + one.x.length, 0)")
        everything = shown()
        self.assertGreater(everything, 1)
        part = self.browser.find_element(By.ID, "front").find_element(By.XPATH, "ancestor::section")
        Select(part.find_element(By.TAG_NAME, "select")).select_by_value("loops")
        self.assertIn("loops", self.script(
            "return document.getElementById('front').layout.xaxis.title.text"))
        tick = part.find_elements(By.CSS_SELECTOR, ".tick")[-1]
        tick.click()
        self.assertLess(shown(), everything)
        tick.click()
        self.assertEqual(shown(), everything)
        part.find_element(By.TAG_NAME, "summary").click()
        part.find_element(By.CSS_SELECTOR, "input[placeholder='at most']").send_keys("0.001")
        self.assertEqual(shown(), 0)
        self.assert_quiet(url)

    def test_the_menu_of_a_sweep_changes_its_map(self):
        url = self.open("sweep")
        state = lambda: self.script("const {data, layout} = document.querySelector('.grid');"
                                    "return [data[0].z, layout.xaxis.title.text]")
        menus = lambda: [Select(one) for one in self.browser.find_elements(
            By.CSS_SELECTOR, "section:first-of-type .controls select")]
        cost = state()
        before = self.screenshot()
        menus()[0].select_by_value("total_wfe_nm")
        total = state()
        self.assertNotEqual(cost[0], total[0])
        self.assertIsNotNone(ImageChops.difference(before, self.screenshot()).getbbox())
        place = menus()[3]  # on the axis that is not drawn
        place.select_by_index(1 - place.options.index(place.first_selected_option))
        self.assertNotEqual(total[0], state()[0])
        menus()[1].select_by_visible_text("relaxation")
        self.assertEqual(state()[1], "relaxation")
        self.assert_quiet(url)

    def test_claims_are_filtered(self):
        self.open("reproduce")
        rows = lambda: len(self.browser.find_elements(By.CSS_SELECTOR,
                                                      "section:first-of-type tbody tr"))
        self.assertGreater(rows(), 0)
        menus = self.browser.find_elements(By.CSS_SELECTOR, "section:first-of-type select")
        verdict = Select(menus[2])
        counts = []
        for option in [one.get_attribute("value") for one in verdict.options][1:]:
            verdict.select_by_value(option)
            counts.append(rows())
        self.assertGreater(max(counts), 0)

    def test_hostile_texts_do_nothing(self):
        shutil.copytree("optimize", "hostile")
        with open("hostile/search.csv", encoding="utf-8") as file:
            lines = file.read().splitlines()
        columns = lines[0].split(",")
        quoted = '"' + HOSTILE.replace('"', '""') + '"'
        lines.append(",".join(quoted if name in ("planes_m", "failure") else "1" for name in columns))
        with open("hostile/search.csv", "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")
        with open("hostile/config.cfg", "a", encoding="utf-8") as file:
            file.write(f"# {HOSTILE}\n")
        with open("hostile/best.cfg", "a", encoding="utf-8") as file:
            file.write(f"[{HOSTILE}]\n")
        with open("hostile/summary.json", encoding="utf-8") as file:
            summary = file.read()
        version = HOSTILE.replace('"', '\\"')
        summary = summary.replace('"version": "', f'"version": "{version}', 1)
        summary = summary.replace('"name": "', f'"name": "{version}')
        with open("hostile/summary.json", "w", encoding="utf-8") as file:
            file.write(summary)
        run_program("report", "hostile")
        url = self.open("hostile")
        self.settle()
        self.assertIsNone(self.script("return window.isHacked ?? null"))
        self.assertEqual(self.script("return document.querySelectorAll('img').length"), 0)
        self.assertIn(HOSTILE, self.browser.find_element(By.ID, "head").text)
        self.assert_quiet(url)


def json_of(entry):
    return json.loads(entry["message"])["message"]


if __name__ == "__main__":
    unittest.main()
