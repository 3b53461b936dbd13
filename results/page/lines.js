"use strict";

// Lines, and the curves that several commands draw.

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
