"""Tests benchmarks/run on made-up times; runs no benchmark. Argument: the build folder."""

from __future__ import annotations

import importlib.machinery
import importlib.util
import subprocess
import sys
import unittest
from pathlib import Path
from typing import Any

BUILD = Path(sys.argv.pop())


def load_script() -> Any:
    path = Path(__file__).resolve().parents[2] / "benchmarks/run"
    loader = importlib.machinery.SourceFileLoader("run", str(path))
    spec = importlib.util.spec_from_loader("run", loader)
    assert spec
    module = importlib.util.module_from_spec(spec)
    sys.modules["run"] = module  # where dataclasses look their module up
    loader.exec_module(module)
    return module


run = load_script()


def listed_names(program: str) -> list[str]:
    command = [str(BUILD / "benchmarks" / program), "--benchmark_list_tests"]
    output = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    return [run.plain_name(line) for line in output.splitlines()]


def made_up_numbers() -> dict[str, float]:
    names = [name for program in run.REPETITIONS for name in listed_names(program)]
    names += [f"{name} reconstruction_ms" for name in names if name.startswith("design/")]
    return dict.fromkeys([*names, "search_default evaluations"], 2.0)


class Recorder(dict[str, float]):
    """Remembers what was asked for."""

    def __init__(self, numbers: dict[str, float]) -> None:
        super().__init__(numbers)
        self.asked: set[str] = set()

    def __getitem__(self, name: str) -> float:
        self.asked.add(name)
        return super().__getitem__(name)


MACHINE = {
    "processor": "Abacus",
    "cores": "2",
    "compiler": "GNU 12",
    "commit": "abc",
    "date": "2000-01-01",
}

REPORT = {
    "benchmarks": [
        {"run_type": "iteration", "name": "a", "run_name": "a/grid:8/real_time/repeats:2",
         "real_time": 3e6, "time_unit": "ns"},
        {"run_type": "iteration", "name": "a", "run_name": "a/grid:8/real_time/repeats:2",
         "real_time": 2e6, "time_unit": "ns"},
        {"run_type": "aggregate", "name": "a", "run_name": "a/grid:8/real_time/repeats:2",
         "real_time": 1e6, "time_unit": "ns"},
        {"run_type": "iteration", "name": "b", "run_name": "b", "real_time": 0.5, "time_unit": "s",
         "evaluations": 150.0},
    ]
}


class RunTest(unittest.TestCase):
    def test_every_program_lists_its_benchmarks(self) -> None:
        for program in run.REPETITIONS:
            self.assertTrue(listed_names(program), program)

    def test_the_tables_show_every_benchmark_and_want_no_other(self) -> None:
        numbers = Recorder(made_up_numbers())
        run.markdown(run.Run(MACHINE, numbers), None)
        unshown = set(numbers) - numbers.asked
        self.assertEqual(unshown, {"design/%s/threads:2 reconstruction_ms" % name
                                   for name in ("extended_double", "extended_single",
                                                "matched_double", "matched_single")})

    def test_times_become_milliseconds_and_the_shortest_counts(self) -> None:
        samples = run.samples_of(REPORT)
        self.assertEqual(samples, {"a/grid:8": [3.0, 2.0], "b": [500.0], "b evaluations": [150.0]})
        self.assertEqual(run.shortest(samples)["a/grid:8"], 2.0)
        self.assertIn("25.0 %", run.spread_text(samples))

    def test_a_failed_benchmark_is_reported(self) -> None:
        failed = {"run_type": "iteration", "name": "a", "error_occurred": True,
                  "error_message": "no memory"}
        with self.assertRaisesRegex(run.Failure, "a failed: no memory"):
            run.samples_of({"benchmarks": [failed]})

    def test_a_demand_is_met_or_not(self) -> None:
        figures = run.Figures({"slow": 4.0, "fast": 2.0}, None)
        self.assertEqual(figures.judged(run.ratio("fast", "slow"), "<=", 0.5),
                         ["0.5000", "<= 0.5", "yes"])
        self.assertEqual(figures.judged(run.ratio("fast", "slow"), ">=", 1.9),
                         ["0.5000", ">= 1.9", "**no**"])

    def test_the_baseline_stands_beside_each_figure(self) -> None:
        figures = run.Figures({"a": 12.0, "b": 1.0}, {"a": 10.0})
        self.assertEqual(figures(run.value("a")), "12.0 (10.0, x 1.20)")
        self.assertEqual(figures(run.value("b")), "1.000 (new)")
        numbers = made_up_numbers()
        text = run.markdown(run.Run(MACHINE, numbers), run.Run(MACHINE, numbers))
        self.assertIn("the baseline of Abacus, GNU 12, abc, 2000-01-01", text)
        self.assertIn("2.000 (2.000, x 1.00)", text)

    def test_the_section_between_the_markers_is_replaced(self) -> None:
        start, end = run.MARKERS
        readme = f"before\n{start}old\n{end}after\n"
        self.assertEqual(run.with_section(readme, "new\n"), f"before\n{start}\nnew\n\n{end}after\n")
        with self.assertRaisesRegex(run.Failure, "lacks the lines"):
            run.with_section("before\n", "new\n")

    def test_the_readme_has_the_markers(self) -> None:
        self.assertIn("new", run.with_section(run.README.read_text(), "new\n"))

    def test_a_folder_without_programs_is_refused(self) -> None:
        with self.assertRaisesRegex(run.Failure, "loop_benchmark is not built"):
            run.measure(Path("/nonexistent"))


if __name__ == "__main__":
    unittest.main()
