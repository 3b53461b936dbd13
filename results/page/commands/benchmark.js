// benchmark: speeds.

function showBenchmark(summary) {
  const {timing} = summary;
  section("Speed", (part) => {
    part.append(element("p", {}, `${summary.plane_count} planes of ${summary.detector_pixels} x
      ${summary.detector_pixels} pixels, reconstruction grid ${summary.grid_samples} x
      ${summary.grid_samples}; ${summary.screens} screens, ${timing.threads} ${
      timing.threads === 1 ? "thread" : "threads"}; medians of
      ${timing.repetitions} evaluations, peak memory ${digits(timing.peak_memory_mib, 3)} MiB. Timings on
      a machine at work hold two digits.`),
    table(["precision of the reconstruction", "double", "single"], Object.entries({
      loops_per_second_one_thread: "loops per second, one thread alone",
      loops_per_second: "loops per second, all threads together",
      data_seconds: "seconds to make one screen's images",
      reconstruction_seconds: "seconds to reconstruct from them",
      design_seconds: "seconds per design",
      designs_per_minute: "designs per minute",
      search_seconds: "seconds of the configured search",
      fft_rate: "objective.fft_rate, 1/s",
    }).map(([name, title]) => [title, digits(timing.double[name], 2), digits(timing.single[name], 2)])));
  });
}

pages.benchmark = {title: "Speed of this machine", show: showBenchmark};
