// reproduce: the paper's claims and figures.

const setupTitles = {paper: "the paper's set-up", extended: "extended truth, rule difference"};

/** The parts of the page: title, how the names of its tables begin, and what shows these. */
const reproducedParts = [
  ["Claims", "claims.csv", showFirst(showClaims)],
  ["Figure 3: four planes", "figure-3-", showPaperMaps],
  ["Figure 4: three planes", "figure-4-", showPaperMaps],
  ["Figure 5: a fifth plane", "figure-5-", showEach(fifthPlane)],
  ["Figure 6: sampling", "figure-6-", showEach(sampling)],
  ["Figure 7: loops with a medium band", "figure-7-", showEach(convergenceChart)],
  ["Figure 8: bands", "figure-8-", showEach(bands)],
  ["Response to single spatial frequencies", "response.csv", showFirst((part, response) => {
    responseCharts(part, response);
    pairsExplorer(part, response);
  })],
  ["The same with photon noise", "response-photons.csv", showFirst(responseCharts)],
  ["What the numerics decide", "numerics.csv", showFirst(showNumerics)],
];

function showReproduction() {
  for (const [title, start, show] of reproducedParts) {
    const tables = Object.entries(data.tables ?? {})
      .filter(([name, columns]) => name.startsWith(start) && Object.keys(columns).length > 0)
      .map(([name, columns]) => [name.slice(start.length, -".csv".length), columns]);
    if (tables.length > 0) section(title, (part) => show(part, tables));
  }
}

/** Shows the only table of a part. */
function showFirst(show) {
  return (part, [[, columns]]) => show(part, columns);
}

/** Draws each table of a part beside the others, that of the paper's set-up first. */
function showEach(draw) {
  return (part, tables) => {
    const grid = part.appendChild(element("div", {className: "side-by-side"}));
    for (const [name, columns] of tables.reverse()) draw(grid, columns, paperTitle(name));
  };
}

/** Every claim of the paper, with filters. */
function showClaims(part, claims) {
  const all = claims.claim.map((_, i) => i);
  const chosen = {figure: "", setup: "", verdict: ""};
  const place = element("div");
  const verdict = (setup, i) => element("div", {},
    element("span", {className: claims[`${setup}_verdict`][i].replaceAll("reproduced in trend", "in-trend")
      .replaceAll(" ", "-")}, claims[`${setup}_verdict`][i]),
    element("div", {}, typeset(claims[`${setup}_number`][i])),
    element("div", {className: "faint"}, typeset(claims[`${setup}_why`][i])));
  const show = () => {
    const setups = chosen.setup ? [chosen.setup] : Object.keys(setupTitles);
    const kept = all.filter((i) => (!chosen.figure || String(claims.figure[i]) === chosen.figure) &&
      (!chosen.verdict || setups.some((setup) => claims[`${setup}_verdict`][i] === chosen.verdict)));
    place.replaceChildren(
      element("p", {className: "faint", role: "status"}, `${kept.length} of ${all.length} claims.`),
      table(["figure", "the paper says", ...setups.map((setup) => setupTitles[setup]),
        "counts as reproduced"],
      kept.map((i) => [String(claims.figure[i]),
        element("div", {}, claims.claim[i], element("div", {className: "faint"}, claims.papers_number[i])),
        ...setups.map((setup) => verdict(setup, i)), claims.rule[i]])));
  };
  const figures = [...new Set(claims.figure.map(String))];
  const verdicts = [...new Set([...claims.paper_verdict, ...claims.extended_verdict])].sort();
  part.append(element("div", {className: "controls"},
    choice("Figure", [["", "all"], ...figures.map((one) => [one, one])], chosen, "figure", show),
    choice("Set-up", [["", "both"], ...Object.entries(setupTitles)], chosen, "setup", show),
    choice("Verdict", [["", "all"], ...verdicts.map((one) => [one, one])], chosen, "verdict", show)), place);
  show();
}

/** "paper-4" in words. */
function paperTitle(name) {
  const [setup, ...rest] = name.split("-");
  const what = rest.join(" ").replace(/^(\d+)$/, "D/r0 = $1").replace(/ p(\d)$/, " P$1");
  return [setupTitles[setup] ?? setup, what].filter(Boolean).join(", ");
}

/** Maps over the distances of two pairs, as the paper draws them: Z_far to the right. */
function showPaperMaps(part, tables) {
  const chosen = {name: tables.find(([name]) => name.startsWith("paper"))?.[0] ?? tables[0][0]};
  const grid = element("div", {className: "side-by-side"});
  const quantities = {residual_wfe: "residual WFE, nm", loops: "loops"};
  const made = [];
  part.append(element("div", {className: "controls"}, choice("Map", tables.map(([name]) =>
    [name, paperTitle(name)]), chosen, "name", () => made.forEach((one) => one.redraw()))), grid);
  for (const [quantity, quantityTitle] of Object.entries(quantities)) {
    made.push(chart(grid, "", (theme) => {
      const columns = tables.find(([name]) => name === chosen.name)[1];
      const axis = (name) => [...new Set(columns[name])].sort((a, b) => a - b);
      const near = axis("z_near_m");
      const far = axis("z_far_m");
      const matrix = (column) => {
        const values = near.map(() => far.map(() => null));
        columns[column].forEach((value, i) => {
          values[near.indexOf(columns.z_near_m[i])][far.indexOf(columns.z_far_m[i])] = value;
        });
        return values;
      };
      const column = quantity === "residual_wfe" ? "residual_wfe_nm" : "loops";
      const errors = quantity === "residual_wfe" ? "residual_wfe_standard_error_nm"
        : "loops_standard_error";
      const x = {...drawnAxis({name: "Z far", unit: "m", values: far}), isLog: false};
      const y = {...drawnAxis({name: "Z near", unit: "m", values: near}), isLog: false};
      return {data: mapTraces(theme, {x, y, values: matrix(column), errors: matrix(errors),
        title: quantityTitle}), layout: {xaxis: axisLayout(x), yaxis: axisLayout(y)}};
    }, 400));
  }
}

function fifthPlane(part, columns, caption) {
  for (const [name, errors, title] of [
    ["residual_wfe_nm", "residual_wfe_standard_error_nm", "residual WFE, nm"],
    ["loops", "loops_standard_error", "loops"]]) {
    lineChart(part, `${caption}: ${title}`, [{x: columns.z5_m.map((z) => z / 1e3), y: columns[name],
      errors: columns[errors]}], axis("Z of the fifth plane, km"), axis(title), 320);
  }
}

function sampling(part, columns, caption) {
  const curves = curvesOf(columns, "d_over_r0", "pixels_per_r0", "field_strehl",
    "field_strehl_standard_error");
  lineChart(part, caption, curves.map((curve) => ({...curve, name: `D/r0 = ${curve.name}`})),
    axis("pixels per r<sub>0</sub>", columns.pixels_per_r0), axis("field-estimated Strehl"), 340);
}

function bands(part, columns, caption) {
  lineChart(part, `${caption}; bars are standard deviations, as in the paper.`,
    curvesOf(columns, "band", "loop", "residual_wfe_nm", "standard_deviation_nm"),
    axis("loops"), axis("residual WFE, nm", columns.residual_wfe_nm), 340);
}

function showNumerics(part, numerics) {
  const quantity = (name, errors, i) =>
    withError({mean: numerics[name][i], standard_error: numerics[errors][i]});
  part.append(element("p", {}, "The paper's set-up with one thing changed at a time."),
    table(["variant", "probe", "residual WFE, nm", "loops", "field-estimated Strehl", "converged"],
      numerics.variant.map((variant, i) => [variant, numerics.probe[i],
        quantity("residual_wfe_nm", "residual_wfe_standard_error_nm", i),
        quantity("loops", "loops_standard_error", i),
        quantity("field_strehl", "field_strehl_standard_error", i),
        numerics.converged_fraction[i] === null ? "–"
          : `${digits(100 * numerics.converged_fraction[i])} %`])));
}

pages.reproduce = {title: "Letchev, Crass, Crepp & Potier 2022, claim by claim", show: showReproduction};
