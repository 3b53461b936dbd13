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

/** A curve for each word that stands in a column. @param x, y, errors names of columns */
function curvesOf(columns, group, x, y, errors) {
  return [...new Set(columns[group])].map((name, i) => {
    const rows = rowsOf(columns, group, name);
    return {name, x: rows[x], y: rows[y], errors: rows[errors], colour: i};
  });
}

/** A chart of such lines. @param xAxis, yAxis of axis() */
function lineChart(parent, caption, curves, xAxis, yAxis, height) {
  chart(parent, caption, (theme) => ({data: lineTraces(theme, curves),
    layout: {xaxis: xAxis, yaxis: yAxis}}), height);
}

function convergenceChart(part, columns, caption) {
  const screens = Object.keys(columns).filter((name) => /^screen_\d+_nm$/.test(name));
  lineChart(part, caption, [
    ...screens.map((name, i) => ({name: i === 0 ? "each wavefront" : "", x: columns.loop,
      y: columns[name], isPale: true})),
    {name: "mean", x: columns.loop, y: columns.residual_wfe_nm, errors: columns.standard_error_nm,
      colour: 1}],
  axis("loops"), axis("residual WFE, nm", screens.flatMap((name) => columns[name])));
}

const responseQuantities = {recovered_share: "recovered share", residual_wfe_nm: "residual WFE, nm",
  fractional_loops: "fractional loops"};

function responseCharts(part, columns) {
  const design = rowsOf(columns, "planes", "design");
  const errorsOf = (name) => design[`${name}_standard_error`];
  const x = design.cycles_per_pupil;
  const xAxis = axis("cycles per pupil diameter", x);
  lineChart(part, "The share of each sinusoid that the design recovers, beside the contrast that a radian has in its images.", [
    {name: "recovered share", x, y: design.recovered_share, errors: errorsOf("recovered_share")},
    {name: "Talbot contrast, 1/rad", x, y: design.talbot_contrast_per_rad, colour: 2, isPoints: true},
    {name: "effective contrast, 1/rad", x, y: design.effective_contrast_per_rad, colour: 1,
      isDashed: true}],
  xAxis, {...axis("recovered share; contrast, 1/rad"), rangemode: "tozero"});
  const {amplitude_noise_nm: noise, predicted_amplitude_noise_nm: predicted} = design;
  if (noise?.some((value) => value !== null)) {
    lineChart(part, "Photon noise of the recovered amplitude.", [
      {name: "measured", x, y: noise, errors: errorsOf("amplitude_noise_nm")},
      {name: "predicted", x, y: predicted, colour: 1, isDashed: true}],
    xAxis, axis("noise of the amplitude, nm", [...noise, ...predicted]));
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
