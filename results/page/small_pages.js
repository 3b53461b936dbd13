"use strict";

// The pages of the smaller commands.

/** Lines with their standard errors or spreads. @param curves [{name, x, y, errors, colour, isPale, isDashed, isPoints}] */
function lineTraces(theme, curves) {
  return curves.map(({name, x, y, errors, colour = 0, isPale = false, isDashed = false,
    isPoints = false}) => ({type: "scatter",
    mode: isPoints ? "markers" : isPale || isDashed ? "lines" : "lines+markers", name: plain(name ?? ""),
    showlegend: Boolean(name), x, y, error_y: errors ? errorBars(errors) : undefined,
    opacity: isPale ? 0.5 : 1,
    line: {color: theme.lines[colour % theme.lines.length], width: isPale ? 1 : 2,
      dash: isDashed ? "dash" : "solid"},
    hovertemplate: `%{x:.5~g}: %{y:.5~g}<extra>${plain(name ?? "")}</extra>`}));
}

/** Columns of a table whose rows have this word in a column. */
function rowsOf(columns, name, word) {
  const chosen = columns[name].map((_, i) => i).filter((i) => columns[name][i] === word);
  return Object.fromEntries(Object.entries(columns).map(([key, values]) =>
    [key, chosen.map((i) => values[i])]));
}

// convergence ---------------------------------------------------------------------------------

function convergenceChart(part, columns, caption) {
  const screens = Object.keys(columns).filter((name) => /^screen_\d+_nm$/.test(name));
  chart(part, caption, (theme) => ({
    data: lineTraces(theme, [
      ...screens.map((name, i) => ({name: i === 0 ? "each wavefront" : "", x: columns.loop,
        y: columns[name], isPale: true})),
      {name: "mean", x: columns.loop, y: columns.residual_wfe_nm, errors: columns.standard_error_nm,
        colour: 1}]),
    layout: {xaxis: {title: {text: "loops"}}, yaxis: {...scale(true, screens.flatMap((name) => columns[name])),
      title: {text: "residual WFE, nm"}}},
  }));
}

function showConvergence(summary) {
  const columns = data.tables?.["convergence.csv"];
  if (columns?.loop) {
    section("Residual wavefront error", (part) => convergenceChart(part, columns,
      "After each loop, however long it goes on; bars are standard errors of the mean."));
  }
  section("Design", (part) => showDesign(part, summary.design));
  section("With the stopping rule", (part) => {
    part.append(performanceTable([["design", summary.design]]));
    showScreenMetrics(part);
  });
}

// response ------------------------------------------------------------------------------------

const responseQuantities = {recovered_share: "recovered share", residual_wfe_nm: "residual WFE, nm",
  fractional_loops: "fractional loops"};

function responseCharts(part, columns) {
  const design = rowsOf(columns, "planes", "design");
  const errorsOf = (name) => design[`${name}_standard_error`];
  chart(part, "The share of each sinusoid that the design recovers, beside the contrast that a radian has in its images.",
    (theme) => ({
      data: lineTraces(theme, [
        {name: "recovered share", x: design.cycles_per_pupil, y: design.recovered_share,
          errors: errorsOf("recovered_share")},
        {name: "Talbot contrast, 1/rad", x: design.cycles_per_pupil, y: design.talbot_contrast_per_rad,
          colour: 2, isPoints: true},
        {name: "effective contrast, 1/rad", x: design.cycles_per_pupil,
          y: design.effective_contrast_per_rad, colour: 1, isDashed: true}]),
      layout: {xaxis: {title: {text: "cycles per pupil diameter"}, ...scale(true, design.cycles_per_pupil)},
        yaxis: {title: {text: "recovered share; contrast, 1/rad"}, rangemode: "tozero"}},
    }));
  if (design.amplitude_noise_nm?.some((value) => value !== null)) {
    chart(part, "Photon noise of the recovered amplitude.", (theme) => ({
      data: lineTraces(theme, [
        {name: "measured", x: design.cycles_per_pupil, y: design.amplitude_noise_nm,
          errors: errorsOf("amplitude_noise_nm")},
        {name: "predicted", x: design.cycles_per_pupil, y: design.predicted_amplitude_noise_nm,
          colour: 1, isDashed: true}]),
      layout: {xaxis: {title: {text: "cycles per pupil diameter"}, ...scale(true, design.cycles_per_pupil)},
        yaxis: {title: {text: "noise of the amplitude, nm"}, ...scale(true,
          [...design.amplitude_noise_nm, ...design.predicted_amplitude_noise_nm])}},
    }));
  }
  part.append(folded("As a table", table(["cycles per pupil", "recovered share", "residual WFE, nm",
    "fractional loops", "effective contrast, 1/rad"], design.cycles_per_pupil.map((cycles, i) => [
    digits(cycles), ...["recovered_share", "residual_wfe_nm", "fractional_loops"].map((name) =>
      withError({mean: design[name][i], standard_error: errorsOf(name)[i]})),
    digits(design.effective_contrast_per_rad[i])]))));
}

/** Pairs of planes, over frequency and distance. */
function pairsExplorer(part, columns) {
  const pairs = rowsOf(columns, "planes", "pair");
  if (pairs.planes.length === 0) return;
  const distances = [...new Set(pairs.pair_distance_m)];
  const frequencies = [...new Set(pairs.cycles_per_pupil)];
  const matrix = (name) => frequencies.map((frequency) => distances.map((distance) =>
    pairs[name][pairs.pair_distance_m.findIndex((z, i) =>
      z === distance && pairs.cycles_per_pupil[i] === frequency)] ?? null));
  const grid = {axes: [{name: "cycles per pupil diameter", unit: "", values: frequencies},
    {name: "distance of the pair", unit: "m", values: distances}], standard_error: {}};
  for (const name of Object.keys(responseQuantities)) {
    grid[name] = matrix(name);
    grid.standard_error[name] = matrix(`${name}_standard_error`);
  }
  gridExplorer(part, grid, Object.keys(responseQuantities), null);
}

function showResponse(summary) {
  const columns = data.tables?.["response.csv"];
  if (columns?.planes) {
    section("Response of the design", (part) => {
      part.append(element("p", {}, `Sinusoids of ${length(summary.amplitude_m)} (peak) in
        ${summary.wavefronts} orientations and phases.`));
      responseCharts(part, columns);
    });
    if (columns.planes.includes("pair")) {
      section("Single pairs of planes", (part) => pairsExplorer(part, columns));
    }
  }
  section("Design", (part) => showDesign(part, summary.design));
}

// compare, law, advise, scale, screens, benchmark ---------------------------------------------

function showComparison(summary) {
  section("Both best designs on the same fresh screens", (part) => {
    part.append(performanceTable([["sweep", summary.sweep], ["optimizer", summary.optimize]]));
    const {cost} = summary;
    part.append(table(["what finding it took", "sweep", "optimizer", "ratio"],
      ["designs", "reconstructions", "seconds"].map((name) => [name, digits(cost.sweep[name]),
        digits(cost.optimize[name]), digits(cost.sweep_per_optimize[name], 3)])));
  });
  const picture = data.pictures?.["path.svg"];
  if (picture) {
    section("The search over the sweep's map", (part) => {
      const image = element("img", {className: "picture",
        alt: "The designs of the search in their order, over the map of the sweep's cost"});
      image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(picture)}`;
      part.append(image);
    });
  }
  section("Best of the sweep", (part) => showDesign(part, summary.sweep));
  section("Best of the optimizer", (part) => showDesign(part, summary.optimize));
}

const lawQuantities = {z_near_talbot: "near pair, Talbot distances of r0",
  far_fresnel_number: "far pair, Fresnel number", residual_wfe_wavelengths: "residual WFE, wavelengths",
  fractional_loops: "fractional loops"};

/** What search.order calls planes 1 to 4. */
function planeName(number) {
  return ["−near", "near", "−far", "far"][number - 1];
}

/** A line of the law, in the logarithms of D/r0 and of the quantity. */
function lawLine(law, name, ratios) {
  return ratios.map((ratio) => Math.exp(law[name].intercept + law[name].slope * Math.log(ratio)));
}

function showLaw(summary) {
  const columns = data.tables?.["law.csv"];
  const law = summary.law;
  section("Law", (part) => {
    const grid = element("div", {className: "side-by-side"});
    part.append(element("p", {}, `The best designs that were found at each D/r0, and the lines that are
      fitted to them. Planes are visited in the order ${law.order.map(planeName).join(", ")}.`),
    table(["law", ""], Object.entries(lawQuantities).map(([name, title]) => [title,
      `${digits(Math.exp(law[name].intercept), 3)} (D/r0)^${digits(law[name].slope, 3)}`])), grid);
    const steps = Array.from({length: 60}, (_, i) =>
      law.least_d_over_r0 * (law.greatest_d_over_r0 / law.least_d_over_r0) ** (i / 59));
    for (const [name, title] of Object.entries(lawQuantities)) {
      chart(grid, "", (theme) => ({
        data: lineTraces(theme, [
          ...(columns?.[name] ? [{name: "searches", x: columns.d_over_r0, y: columns[name],
            errors: columns[`${name}_standard_error`], isPoints: true}] : []),
          {name: "law", x: steps, y: lawLine(law, name, steps), colour: 1, isDashed: true}]),
        layout: {xaxis: {title: {text: "D/r<sub>0</sub>"}, ...scale(true, steps)},
          yaxis: {title: {text: title},
            ...scale(true, [...lawLine(law, name, steps), ...(columns?.[name] ?? [])])}},
      }), 320);
    }
  });
  section("Designs", (part) => part.append(performanceTable(summary.designs.map((design, i) =>
    [columns?.d_over_r0?.[i] ? `D/r0 = ${digits(columns.d_over_r0[i])}` : `search ${i + 1}`, design]))));
}

function showAdvice(summary) {
  const {predicted, difference, design} = summary;
  section("Design", (part) => showDesign(part, design));
  section("What the law predicts", (part) => {
    const heads = ["", "predicted"];
    if (difference) heads.push("simulated", "simulated − predicted", "in standard errors");
    part.append(table(heads, ["residual_wfe_nm", "fractional_loops"].map((name) => {
      const row = [label(name), withError(predicted[name])];
      if (difference) {
        row.push(withError(design.performance[name]), withError(difference[name]),
          digits(difference[name].standard_errors, 2));
      }
      return row;
    })));
  });
  if (design.performance) {
    section("Simulated on fresh screens", (part) =>
      part.append(performanceTable([["advised design", design]])));
    showCloserLook(design);
  }
}

function showScaling(summary) {
  section("From", (part) => showDesign(part, summary.design));
  section("To", (part) => {
    const telescope = summary.scaled_telescope;
    part.append(element("p", {}, `A pupil of ${length(telescope.diameter_m)} at
      ${length(telescope.wavelength_m)}, r0 = ${length(telescope.fried_parameter_m)}.`),
    planesTable(summary.scaled), folded("Detector and reconstruction", settingsTable(summary.scaled)));
  });
}

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

// export --------------------------------------------------------------------------------------

function showExport(summary) {
  section("Files", (part) => part.append(
    element("p", {}, `Of ${summary.source}, in ${summary.files.join(", ")}.`),
    table(["stage", "evaluations"], Object.entries(summary.stages ?? {}))));
  const columns = data.tables?.["evaluations.csv"];
  if (!columns?.evaluation) return;
  section("Evaluations", (part) => {
    const names = Object.keys(columns).filter((name) =>
      columns[name].some((value) => typeof value === "number"));
    const chosen = {x: "evaluation", y: "cost"};
    const place = element("div");
    const update = (axis) => (name) => {
      chosen[axis] = name;
      made.redraw();
    };
    const options = names.map((name) => [name, label(name)]);
    part.append(element("div", {className: "controls"}, menu("To the right", options, chosen.x, update("x")),
      menu("Upwards", options, chosen.y, update("y"))), place);
    const stages = [...new Set(columns.stage)];
    const made = chart(place, "Every evaluation in the archive.", (theme) => ({
      data: stages.map((stage, i) => {
        const rows = rowsOf(columns, "stage", stage);
        return {type: "scatter", mode: "markers", name: plain(stage), x: rows[chosen.x],
          y: rows[chosen.y], marker: {color: theme.lines[i % theme.lines.length], size: 6},
          text: rows.evaluation.map((number) => `evaluation ${plain(number)}`),
          hovertemplate: "%{text}<br>%{x:.5~g}, %{y:.5~g}<extra></extra>"};
      }),
      layout: {xaxis: {title: {text: plain(label(chosen.x))}}, yaxis: {title: {text: plain(label(chosen.y))},
        ...scale(isWide(columns[chosen.y]), columns[chosen.y])}},
    }), 420);
  });
}

// reconstruct ---------------------------------------------------------------------------------

function showReconstruction(summary) {
  const {design} = summary;
  const phase = data.images?.["phase.fits"];
  const width = data.diameter_m ?? 1;
  if (phase) {
    section("Phase", (part) => {
      part.append(element("p", {}, `Without piston, at the telescope's wavelength;
        ${phase.count === 1 ? "one set of frames" : `${phase.slices.length} of ${phase.count} sets of frames`}.${binnedNote(phase)}`));
      const grid = element("div", {className: "side-by-side small"});
      part.append(grid);
      phase.slices.forEach((image, i) => {
        const rows = pixelRows(image);
        imageChart(grid, `Set ${i + 1}, RMS ${digits(rootMeanSquare(rows), 3)} rad`, {rows,
          places: pixelPlaces(image, width, phase.samples), quantity: `phase, ${phase.unit}`,
          colours: "Cividis", range: [quantile(rows, 0), quantile(rows, 1)]});
      });
    });
  }
  if (data.images?.["frames.fits"] && data.images?.["predicted.fits"]) {
    section("Measured and predicted intensities", (part) =>
      showPredictions(part, design, data.images["frames.fits"], data.images["predicted.fits"]));
  }
  const consistency = data.tables?.["consistency.csv"];
  if (consistency?.plane) {
    section("Consistency", (part) => {
      const share = (value) => (value === null ? "not known" : `${digits(100 * value, 3)} %`);
      part.append(table(["set", "plane", "distance", "measured − predicted, RMS", "noise alone",
        "beyond noise", "correlation", "light captured", "stands off, pixels", "bad pixels"],
      consistency.plane.map((plane, i) => [consistency.set[i], plane,
        length(consistency.distance_m[i]), share(consistency.relative_rms[i]),
        share(consistency.noise_relative_rms[i]), share(consistency.misfit[i]),
        digits(consistency.correlation[i]), share(consistency.captured_energy[i]),
        `${digits(consistency.displacement_x_pixels[i], 2)}, ${
          digits(consistency.displacement_y_pixels[i], 2)}`, consistency.bad_pixels[i]])));
    });
  }
  section("Design", (part) => showDesign(part, design));
}

/** Measured, predicted and their difference in each plane of the first set of frames. */
function showPredictions(part, design, frames, predicted) {
  part.append(element("p", {}, `The first set: the frames as the reconstruction got them (bad pixels
    are left out), what the phase that it found makes of each, and the difference, relative to the intensity of
    the unaberrated pupil.${binnedNote(frames)}`));
  design.planes_m.slice(0, frames.slices.length).forEach((plane, i) => {
    part.append(element("h3", {}, `Plane ${i + 1}, ${length(plane)}`));
    const grid = element("div", {className: "side-by-side small"});
    part.append(grid);
    const measured = pixelRows(frames.slices[i]);
    const expected = pixelRows(predicted.slices[i]);
    const difference = measured.map((row, k) => row.map((value, j) =>
      (value === null || expected[k][j] === null ? null : value - expected[k][j])));
    const brightest = quantile(measured, 0.995);
    const greatest = Math.max(Math.abs(quantile(difference, 0.0025)), Math.abs(quantile(difference, 0.9975)));
    const places = pixelPlaces(frames.slices[i], design.detector_window * (data.diameter_m ?? 1),
      frames.samples);
    for (const [caption, rows, colours, range] of [
      ["Measured", measured, "Viridis", [0, brightest]],
      ["Predicted", expected, "Viridis", [0, brightest]],
      ["Measured − predicted", difference, "Cividis", [-greatest, greatest]]]) {
      imageChart(grid, caption, {rows, places, quantity: intensityTitle(frames), colours, range});
    }
  });
}
