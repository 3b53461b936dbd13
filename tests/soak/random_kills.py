"""Kills runs at random instants, resumes them, and holds what they end with against an undisturbed run.

    random_kills.py NLCWFS --kills 100 [--seed 1] [--commands sweep,optimize]

After every kill no simulated screen may be lost or have been simulated again (a clock would give
another time); at the end summaries, tables and archives are those of the undisturbed run, but for what
a clock measured. Then a run of each command meets a full disk: it ends with the reason, and goes on.
"""

import argparse
import json
import pathlib
import random
import resource
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import time

SETTINGS = ["--detector.pupil_pixels", "16", "--detector.window", "2", "--reconstruction.window", "4",
            "--simulation.pupil_samples", "32", "--verify.screens", "8"]
COMMANDS = {
    "sweep": ["--screens.count", "8", "--sweep.z_near", "20km:60km:9", "--sweep.z_far", "80km:160km:9"],
    "optimize": ["--screens.count", "8", "--search.budget", "60", "--search.relaxation=-0.5:0.5"],
    "trade": ["--screens.count", "8", "--trade.budget", "64", "--trade.population", "8"],
    "law": ["--screens.count", "8", "--law.d_over_r0", "3,4,5,6", "--search.budget", "20"],
    "evaluate": ["--screens.count", "200"],
}
TIMES = {"seconds", "wall_seconds", "search_seconds", "timing"}


def without_times(value):
    if isinstance(value, dict):
        return {k: without_times(v) for k, v in value.items() if k not in TIMES}
    return [without_times(v) for v in value] if isinstance(value, list) else value


def trials(folder):
    """What the archive knows; nothing where the run was killed before it had one."""
    if not (folder / "archive.sqlite").exists():
        return {}
    database = sqlite3.connect(folder / "archive.sqlite")
    try:
        return {row[:2]: row[2:] for row in
                database.execute("SELECT trial, design, performances, failure FROM trials")}
    except sqlite3.OperationalError:
        return {}
    finally:
        database.close()


def trials_of_killed(folder):
    """Read in a copy, so that it is the resumed run that takes an unfinished commit back."""
    with tempfile.TemporaryDirectory() as copy:
        for path in folder.glob("archive.sqlite*"):
            shutil.copy(path, copy)
        return trials(pathlib.Path(copy))


def result(folder):
    """All that a run leaves and no clock has a say in."""
    database = sqlite3.connect(folder / "archive.sqlite")
    evaluations = [
        (stage, key, design, cost, failure, without_times(json.loads(performance or "null")))
        for stage, key, design, cost, failure, performance in database.execute(
            "SELECT stage, key, design, cost, failure, performance FROM evaluations ORDER BY id")]
    database.close()
    return {"summary": without_times(json.loads((folder / "summary.json").read_text())),
            "config": (folder / "config.cfg").read_text(),
            "files": sorted(path.name for path in folder.iterdir()),
            "evaluations": evaluations, "trials": sorted(trials(folder))}


def require(condition, what):
    if not condition:
        sys.exit(f"random_kills: {what}")


def run(program, command, folder, **options):
    if (folder / "config.cfg").exists():
        words = [command, "--resume", str(folder)]
    else:  # killed before there was anything to go on with
        shutil.rmtree(folder, ignore_errors=True)
        words = [command, *SETTINGS, *COMMANDS[command], "--output", str(folder)]
    return subprocess.Popen([program, *words, "--quiet"], stdout=subprocess.DEVNULL, **options)


def require_same(folder, whole, expected):
    got = result(folder)
    for part, value in expected.items():
        require(got[part] == value, f"{part} of {folder} is not that of {whole}")


def fill_disk_and_resume(program, command, root, whole, expected):
    folder = root / f"{command}-full"
    sizes = {name: (whole / name).stat().st_size for name in ("archive.sqlite", "config.cfg")}
    room = max(sizes["archive.sqlite"] // 2, sizes["config.cfg"])
    # As on a full disk, no file can grow any more; without the signal that would end the run at once.
    process = run(program, command, folder, stderr=subprocess.PIPE, text=True, restore_signals=False,
                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (room, room)))
    _, errors = process.communicate()
    require(process.returncode == 1 and "archive.sqlite" in errors,
            f"{command} on a full disk ends with {process.returncode}: {errors}")
    known = trials(folder)
    require(run(program, command, folder).wait() == 0, f"{command} failed in {folder}")
    now = trials(folder)
    require(all(now[key] == value for key, value in known.items()), f"{command} repeated an evaluation")
    require_same(folder, whole, expected)
    print(f"{command}: a full disk after {len(known)} designs, then like the undisturbed one")


def kill_and_resume(program, command, kills, dice, root):
    whole = root / f"{command}-whole"
    begun = time.monotonic()
    require(run(program, command, whole).wait() == 0, f"{command} failed undisturbed")
    seconds = time.monotonic() - begun
    expected = result(whole)
    killed, runs = 0, 0
    while killed < kills:
        folder = root / f"{command}-{runs}"
        runs += 1
        known = {}
        is_done = False
        while not is_done:
            process = run(program, command, folder)
            patience = dice.uniform(0.0, 0.5 * seconds) if killed < kills else None
            try:
                require(process.wait(patience) == 0, f"{command} failed in {folder}")
                is_done = True
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
                killed += 1
            now = trials_of_killed(folder)
            for key, value in known.items():
                require(now.get(key) is not None, f"{command} lost an evaluation in {folder}")
                # Of a race or an interrupt more screens may have followed.
                require(now[key] == value or len(now[key][0] or b"") > len(value[0] or b""),
                        f"{command} repeated an evaluation in {folder}")
            known = now
        require_same(folder, whole, expected)
        shutil.rmtree(folder)
    print(f"{command}: {killed} kills in {runs} runs, each like the undisturbed one")
    fill_disk_and_resume(program, command, root, whole, expected)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--commands", default="sweep,optimize")
    arguments = parser.parse_args()
    dice = random.Random(arguments.seed)
    root = pathlib.Path(tempfile.mkdtemp(prefix="random-kills-"))
    for command in arguments.commands.split(","):
        kill_and_resume(arguments.program, command, arguments.kills, dice, root)
    shutil.rmtree(root)


if __name__ == "__main__":
    main()
