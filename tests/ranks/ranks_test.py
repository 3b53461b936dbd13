"""Holds runs of several ranks against those of one process: ranks_test.py NLCWFS MPIRUN

What they leave is the same to the last bit but for what a clock measured, bad input is refused once,
and a run whose rank was killed is resumed to the same end.
"""

import csv
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "soak"))
from random_kills import require, result as archived, trials  # noqa: E402

PROGRAM, MPIRUN = sys.argv[1:]
NO_MPIRUN = 77
CLOCKS = ("seconds", "data_seconds")  # columns of tables
SETTINGS = ["--detector.pupil_pixels", "16", "--detector.window", "2", "--reconstruction.window", "4",
            "--simulation.pupil_samples", "32", "--verify.screens", "8", "--threads", "1", "--quiet"]
SWEEP = ["sweep", "--sweep.z_near", "20km:60km:9", "--sweep.z_far", "80km:160km:9"]
SCREENS = ["--screens.count", "8"]
RUNS = {
    "sweep": [*SWEEP, *SCREENS],
    "conditions": [*SWEEP, *SCREENS, "--seeing.d_over_r0", "4,6", "--detector.photons", "1e4,1e5"],
    "optimize": ["optimize", "--search.budget", "40", "--search.relaxation=-0.5:0.5", *SCREENS],
    "race": ["optimize", "--search.budget", "40", "--search.race", "0.05", "--screens.count", "24"],
    "trade": ["trade", "--trade.budget", "32", "--trade.population", "8", *SCREENS],
    "evaluate": ["evaluate", "--screens.count", "64"],
    "law": ["law", "--law.d_over_r0", "3,4,5,6", "--search.budget", "8", *SCREENS],
    "reproduce": ["reproduce", "--figure", "scaling", "--screens.count", "2"],
}


def result(folder):
    """All that a run leaves and no clock has a say in, its tables too."""
    tables = {}
    for path in folder.glob("*.csv"):
        with path.open() as file:
            tables[path.name] = [{name: value for name, value in row.items() if not name.startswith(CLOCKS)}
                                 for row in csv.DictReader(file)]
    return {**archived(folder), "tables": tables}


def environment_of_ranks():
    """Open MPI's leave to run as root, on more ranks than cores and, with sanitizers, to leak memory;
    others do not read it."""
    return {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
            "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none",
            "ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "") + ":detect_leaks=0"}


def start(ranks, *words):
    launcher = [MPIRUN, "-n", str(ranks)] if ranks else []
    return subprocess.Popen([*launcher, PROGRAM, *map(str, words)], text=True,
                            env=environment_of_ranks() if ranks else None,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def run(ranks, *words):
    process = start(ranks, *words)
    output, errors = process.communicate(timeout=300)
    return process.returncode, output, errors


def require_same(got, expected, what):
    for part, value in expected.items():
        require(got[part] == value, f"{what}: {part} is not that of one process")


def pid_of(mpirun, rank):
    """A process that mpirun has started."""
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            parent = folder.joinpath("stat").read_text().rsplit(")", 1)[1].split()[1]
            variables = folder.joinpath("environ").read_bytes().split(b"\0")
        except OSError:
            continue
        if int(parent) == mpirun and f"OMPI_COMM_WORLD_RANK={rank}".encode() in variables:
            return int(folder.name)
    return None


def test_same_results(root):
    for name, words in RUNS.items():
        expected = None
        for ranks in (0, 1, 2, 3) if name == "sweep" else (0, 3):
            folder = root / f"{name}-{ranks}"
            code, output, errors = run(ranks, *words, *SETTINGS, "--output", folder)
            require(code == 0 and errors == "", f"{name} on {ranks} ranks: {code} {errors}")
            require(output.count("Results are in") == 1, f"{name} prints more than once")
            expected = expected or result(folder)
            require_same(result(folder), expected, f"{name} on {ranks} ranks")
    print(", ".join(RUNS), "on several ranks are as on one process")


def test_bad_input(root):
    for words in (["sweep", "--detector.pupil_pixels", "0"], ["swep"],
                  ["evaluate", "--detector.pupil_pixels", "48", "--output", root / "bad"]):
        _, _, alone = run(0, *words)
        code, output, errors = run(3, *words)
        require(code == 2 and output == "", f"bad input ends with {code} and {output}")
        # The launcher adds what it thinks of the exit code.
        lines = [line for line in errors.splitlines() if line.startswith("nlcwfs: ")]
        require(lines == alone.splitlines(), f"bad input is not refused once: {errors}")
    code, output, errors = run(3, "--version")
    require(code == 0 and output.count("nlcwfs") == 1 and errors == "", "the version is told once")
    print("bad input is refused once")


def test_failures(root):
    """Where every design fails, no more are tried than are in flight: not the whole batch."""
    folder = root / "failures"
    code, _, errors = run(2, "sweep", "--sweep.z_near", "20km:60km:40", "--sweep.z_far", "80km:160km:40",
                          *SETTINGS[:-3], "--screens.count", "1", "--simulation.time_limit", "1us",
                          "--threads", "13", "--quiet", "--output", folder)
    require(code == 1 and "20 of 1600 designs failed one after the other" in errors, f"{code} {errors}")
    tried = len(trials(folder))
    require(20 <= tried < 800, f"{tried} designs were tried, the first 20 failed")
    print(f"designs that all fail end a sweep after {tried} of 1600")


def test_killed_rank(root):
    words = [*RUNS["sweep"], *SETTINGS]
    folder = root / "killed"
    process = start(3, *words, "--output", folder)
    while not trials(folder) and process.poll() is None:
        time.sleep(0.01)
    rank = pid_of(process.pid, 1)
    require(rank is not None, "rank 1 is not there to be killed")
    os.kill(rank, signal.SIGKILL)
    process.communicate(timeout=60)
    require(process.returncode != 0, "a job without one of its ranks goes on")
    known = trials(folder)
    code, _, errors = run(2, "sweep", "--resume", folder, "--quiet")
    require(code == 0, f"the resumed sweep: {errors}")
    now = trials(folder)
    require(all(now[key] == value for key, value in known.items()), "a design was tried twice")
    require_same(result(folder), result(root / "sweep-0"), "a resumed sweep")
    print(f"a killed rank ends the job, which goes on from {len(known)} designs to the same end")


def main():
    if run(1, "--version")[0] != 0:
        print(f"{MPIRUN} cannot start a program here")
        sys.exit(NO_MPIRUN)
    root = pathlib.Path(tempfile.mkdtemp(prefix="ranks-"))
    for test in (test_same_results, test_bad_input, test_failures, test_killed_rank):
        test(root)
    shutil.rmtree(root)


if __name__ == "__main__":
    main()
