// A design: its planes along the beam, and tables of what it is and does.

/** The planes to scale along the beam, with the order in which they are visited. */
function designDrawing(parent, design, caption = "") {
  const planes = design.planes_m;
  const diameter = data.diameter_m ?? 1;
  const farthest = Math.max(...planes.map(Math.abs));
  const [size, unit] = lengthUnit([farthest || 1]);
  const talbot = data.talbot_m;
  const showsTalbot = talbot !== undefined && talbot < 3 * Math.max(farthest, 1e-9);
  const reach = 1.08 * Math.max(farthest, showsTalbot ? talbot : 0);
  const half = design.detector_window * diameter / 2;
  // From the pupil at the top through the planes back to the pupil.
  const level = (visit) => half * (0.86 - 1.72 * visit / (planes.length + 1));
  const stops = [0, ...planes, 0];
  const captured = design.performance?.captured_energy;
  const telling = (plane, i) => [
    `plane ${i + 1}: ${length(plane)}`,
    `${digits(design.planes_talbot[i])} Talbot distances`,
    `Fresnel number ${digits(design.fresnel_numbers[i], 3)}`,
    captured ? `${digits(100 * captured[i])} % of the light captured` : null,
  ].filter((line) => line !== null).join("<br>");

  const told = showsTalbot || talbot === undefined ? ""
    : ` The Talbot distance of r0, ${length(talbot)}, lies outside.`;
  chart(parent, `${caption} Distances are to scale; heights are those of the beam (shaded) and of
    the detector windows. The numbers say in which order the loop visits the planes, from the pupil
    and back to it.${told}`.trim(), (theme) => {
    const vertical = (x, height, line) => ({type: "line", x0: x / size, x1: x / size, y0: -height,
      y1: height, line, layer: "between"});
    const shapes = [
      {type: "rect", x0: -reach / size, x1: reach / size, y0: -diameter / 2, y1: diameter / 2,
        fillcolor: theme.lines[0], opacity: 0.15, line: {width: 0}, layer: "below"},
      vertical(0, diameter / 2, {color: theme.text, width: 5}),
      ...planes.map((plane) => vertical(plane, half, {color: theme.lines[0], width: 2})),
    ];
    const annotations = [{x: 0, y: -half, yanchor: "top", text: "pupil", showarrow: false}];
    if (showsTalbot) {
      for (const sign of [-1, 1]) {
        shapes.push(vertical(sign * talbot, half, {color: theme.lines[1], width: 1.5, dash: "dash"}));
        annotations.push({x: sign * talbot / size, y: half, yanchor: "bottom", showarrow: false,
          text: `${sign < 0 ? "−" : ""}Z<sub>T</sub>(r<sub>0</sub>)`, font: {color: theme.lines[1]}});
      }
    }
    return {
      data: [
        {type: "scatter", mode: "lines", x: stops.map((z) => z / size),
          y: stops.map((_, visit) => level(visit)), line: {color: theme.faint, width: 1},
          hoverinfo: "skip"},
        {type: "scatter", mode: "markers+text", x: planes.map((z) => z / size),
          y: planes.map((_, i) => level(i + 1)), text: planes.map((_, i) => String(i + 1)),
          customdata: planes.map(telling), hovertemplate: "%{customdata}<extra></extra>",
          cliponaxis: false, marker: {size: 24, color: theme.back, line: {color: theme.lines[0], width: 2}},
          textfont: {color: theme.text, size: 13}},
      ],
      layout: {showlegend: false, shapes, annotations, margin: {l: 50, r: 16, t: 24, b: 44},
        xaxis: {title: {text: `distance along the beam, ${unit}`},
          range: [-reach / size, reach / size]},
        yaxis: {title: {text: "height, m"}, range: [-1.3 * half, 1.15 * half]}},
    };
  }, 300);
}

function planesTable(design) {
  const captured = design.performance?.captured_energy;
  const bench = design.planes_bench_m;
  const heads = ["visited", "distance", "Talbot distances", "Fresnel number"];
  if (bench) heads.push("on the bench");
  if (captured) heads.push("light captured");
  return table(heads, design.planes_m.map((plane, i) => {
    const row = [i + 1, length(plane), digits(design.planes_talbot[i]),
      digits(design.fresnel_numbers[i], 3)];
    if (bench) row.push(length(bench[i]));
    if (captured) row.push(`${digits(100 * captured[i], 3)} %`);
    return row;
  }));
}

const shownMetrics = ["residual_wfe_nm", "wrapped_wfe_nm", "total_wfe_nm", "field_strehl", "loops",
  "fractional_loops", "seconds"];

/** Designs side by side. @param columns [[heading, design], ...] */
function performanceTable(columns, caption = "") {
  const rows = shownMetrics.map((metric) => [label(metric),
    ...columns.map(([, design]) => withError(design.performance[metric]))]);
  rows.push(["converged", ...columns.map(([, design]) =>
    `${digits(100 * design.performance.converged_fraction)} %`)]);
  rows.push(["screens", ...columns.map(([, design]) => String(design.performance.screens))]);
  if (columns.every(([, design]) => design.cost)) {
    rows.push(["cost", ...columns.map(([, design]) => withError(design.cost))]);
  }
  return table(["mean ± standard error", ...columns.map(([heading]) => heading)], rows, caption);
}

/** Where a design was tried under several seeings or lights; null where it was not. */
function conditionsTable(design) {
  if (!design.conditions) return null;
  return table(["under each condition", ...["residual_wfe_nm", "total_wfe_nm",
    "fractional_loops"].map(label)],
  design.conditions.map((condition) => [typeset(condition.name),
    ...["residual_wfe_nm", "total_wfe_nm", "fractional_loops"].map((metric) =>
      withError(condition.performance[metric]))]));
}

const settingNames = {pupil_pixels: "pixels across the pupil",
  detector_window: "detector window, pupil diameters", photons: "photons per frame",
  photon_rate: "photons per second", exposure_s: "exposure, s",
  read_noise: "read noise, electrons RMS", max_loops: "loops at most",
  tolerance_m: "tolerance", stopping: "stopping rule", relaxation: "relaxation, start to end",
  initial_guess: "first estimate", reconstruction_window: "reconstruction window, pupil diameters",
  outside: "outside the detector", oversampling: "reconstruction samples per pixel",
  unwrapping: "unwrapping"};

/** Detector and reconstruction. */
function settingsTable(design) {
  const shown = (name, value) => (name === "tolerance_m" ? length(value)
    : Array.isArray(value) ? value.map((one) => digits(one)).join(" to ")
      : typeof value === "number" ? digits(value, 6) : String(value));
  return table(["detector and reconstruction", ""],
    Object.entries(settingNames).filter(([name]) => name in design)
      .map(([name, title]) => [title, shown(name, design[name])]));
}

/** A design by all of these. */
function showDesign(section, design, caption = "") {
  designDrawing(section, design, caption);
  section.append(planesTable(design), folded("Detector and reconstruction", settingsTable(design)));
}

/** The metrics of every screen. */
function showScreenMetrics(part) {
  const screens = data.tables?.["screens.csv"];
  if (!screens?.screen || screens.screen.length < 2) return;
  const chosen = {metric: "residual_wfe_nm"};
  const metrics = shownMetrics.filter((metric) => metric in screens);
  const place = element("div");
  part.append(element("div", {className: "controls"},
    choice("Every screen's", metrics.map((metric) => [metric, label(metric)]), chosen, "metric",
      () => made.redraw())), place);
  const made = chart(place, "", (theme) => ({
    data: [{type: "bar", x: screens.screen, y: screens[chosen.metric],
      marker: {color: screens.converged.map((converged) => theme.lines[converged ? 0 : 1])},
      hovertemplate: "screen %{x}: %{y:.5~g}<extra></extra>"}],
    layout: {xaxis: {title: {text: "screen"}}, yaxis: {title: {text: plain(label(chosen.metric))}}},
  }), 280);
  if (screens.converged.some((converged) => !converged)) {
    part.append(element("p", {className: "faint"}, `Orange or red: the loop had not converged when it
      reached the most loops that it may take.`));
  }
}

/** The best few designs, on fresh screens. */
function showRanking(part, ranking, of) {
  if (!ranking || ranking.length < 2) return;
  part.append(table(["cost", "planes", "against the best"], ranking.map((design, i) => [
    withError(design.cost), design.planes_m.map(length).join(", "),
    i === 0 ? "the best" : verdictOf(design)]),
  `The best ${ranking.length} designs of the ${of}, on the fresh screens`));
}

function verdictOf(design) {
  const more = design.cost_above_best ? ` ${withError(design.cost_above_best)} more` : "";
  return `${design.verdict === "tied" ? "a tie" : design.verdict ?? ""}${more && ":"}${more}`;
}
