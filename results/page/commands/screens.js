"use strict";

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
    const directions = [...new Set(columns.direction)];
    chart(part, "Structure function: measured along four directions, and theory.", (theme) => ({
      data: lineTraces(theme, [
        ...directions.map((direction, i) => {
          const rows = rowsOf(columns, "direction", direction);
          return {name: direction, x: rows.separation_m, y: rows.structure_function_rad2,
            errors: rows.standard_error_rad2, colour: i};
        }),
        {name: "theory", x: rowsOf(columns, "direction", directions[0]).separation_m,
          y: rowsOf(columns, "direction", directions[0]).expected_rad2, colour: 4, isDashed: true}]),
      layout: {xaxis: {title: {text: "separation, m"}, ...scale(true, columns.separation_m)},
        yaxis: {title: {text: "structure function, rad²"},
          ...scale(true, columns.structure_function_rad2)}},
    }));
  });
  const images = data.images?.["screens.fits"];
  if (!images) return;
  section("Screens", (part) => {
    part.append(element("p", {}, `${images.slices.length} of ${images.count}, in ${images.unit}, without
      piston over the pupil.${binnedNote(images)}`));
    const grid = element("div", {className: "side-by-side small"});
    part.append(grid);
    images.slices.forEach((image, i) => {
      const rows = pixelRows(image);
      imageChart(grid, `Screen ${i}`, {rows,
        places: pixelPlaces(image, data.diameter_m ?? 1, images.samples),
        quantity: `phase, ${images.unit}`, colours: "Cividis", range: [quantile(rows, 0), quantile(rows, 1)]});
    });
  });
}

pages.screens = {title: "Phase screens", show: showScreens};
