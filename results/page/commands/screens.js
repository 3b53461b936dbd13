// screens: statistics and the first screens.

function showScreens(summary) {
  section("Statistics", (part) => {
    part.append(table(["variance over the pupil, rad²", "these screens", "Kolmogorov, clear, no L0"],
      [["piston removed", withError(summary.piston_removed_variance_rad2),
        digits(summary.kolmogorov_piston_removed_variance_rad2)],
      ["piston, tip and tilt removed", withError(summary.tilt_removed_variance_rad2),
        digits(summary.kolmogorov_tilt_removed_variance_rad2)]]));
    const columns = data.tables?.["structure_function.csv"];
    if (!columns?.direction) return;
    const first = rowsOf(columns, "direction", columns.direction[0]);
    lineChart(part, "Structure function: measured along four directions, and theory.", [
      ...curvesOf(columns, "direction", "separation_m", "structure_function_rad2",
        "standard_error_rad2"),
      {name: "theory", x: first.separation_m, y: first.expected_rad2, colour: 4, isDashed: true}],
      axis("separation, m", columns.separation_m),
      axis("structure function, rad²", columns.structure_function_rad2));
  });
  const images = data.images?.["screens.fits"];
  if (!images) return;
  section("Screens", (part) => {
    part.append(element("p", {}, `${images.slices.length} of ${images.count}, in ${images.unit}, without
      piston over the pupil.${binnedNote(images)}`));
    showPhases(part, images, (i) => `Screen ${i}`);
  });
}

pages.screens = {title: "Phase screens", show: showScreens};
