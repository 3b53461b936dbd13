// optimize: the best design, and how it was found.

function showOptimization(summary) {
  section("Best design", (part) => {
    showDesign(part, summary.best);
    part.append(conditionsTable(summary.best) ?? "");
  });
  section("Verification", (part) => {
    part.append(performanceTable([["best design", summary.best], ["baseline", summary.baseline]],
      "Both on the same fresh screens, which the search has not seen"));
    const gain = {mean: summary.improvement.cost, standard_error: summary.improvement.standard_error};
    part.append(element("p", {}, `The baseline costs ${withError(gain)} more than the best design, screen
      by screen.`));
    part.append(folded("The baseline's planes", planesTable(summary.baseline)));
    showRanking(part, summary.ranking, "search");
  });
  showCloserLook(summary.best);
  if (data.tables?.["search.csv"]?.evaluation) {
    section("History of the search", (part) => showHistory(part, summary));
  }
  section("Sensitivity", (part) => showSensitivity(part, summary));
}

/** Every design that was tried, in order. */
function showHistory(part, summary) {
  const search = data.tables["search.csv"];
  const count = search.evaluation.length;
  const isGivenUp = (i) => search.given_up?.[i] === 1;
  const keepsLimits = (i) => !(search.violation?.[i] > 0);
  const lowest = [];
  for (let i = 0; i < count; ++i) {
    const before = lowest[i - 1] ?? null;
    const counts = search.cost[i] !== null && !isGivenUp(i) && keepsLimits(i);
    lowest.push(counts && (before === null || search.cost[i] < before) ? search.cost[i] : before);
  }
  // With room above the points for the names of the stages.
  const costs = search.cost.filter((cost) => cost !== null);
  const isLog = isWide(costs);
  const [least, greatest] = [Math.min(...costs), Math.max(...costs)]
    .map((cost) => (isLog ? Math.log10(cost) : cost));
  const range = [least - 0.06 * (greatest - least), greatest + 0.35 * (greatest - least)];
  const planesOf = (i) => search.planes_m[i].split(",").map((z) => length(Number(z))).join(", ");
  const points = (name, chosen, marker) => {
    const those = search.evaluation.map((_, i) => i).filter((i) => search.cost[i] !== null && chosen(i));
    return {type: "scatter", mode: "markers", name, marker, x: those.map((i) => search.evaluation[i]),
      y: those.map((i) => search.cost[i]), text: those.map((i) => plain(planesOf(i))),
      hovertemplate: "design %{x}: cost %{y:.4~g}<br>%{text}<extra></extra>"};
  };
  chart(part, "The cost of every design that was tried, on the search's own screens, and the lowest so far.",
    (theme) => {
      let first = 0.5;
      const starts = (summary.stages ?? []).map((stage) => {
        const start = {name: stage.name, x: first, share: stage.evaluations / count};
        first += stage.evaluations;
        return start;
      });
      return {
        data: [
          points("tried", (i) => !isGivenUp(i) && keepsLimits(i), {color: theme.lines[0], size: 6}),
          points("given up early", (i) => isGivenUp(i), {color: theme.faint, size: 6, symbol: "x"}),
          points("breaks a limit", (i) => !isGivenUp(i) && !keepsLimits(i),
            {color: theme.lines[3], size: 6, symbol: "diamond-open"}),
          {type: "scatter", mode: "lines", name: "lowest so far", x: search.evaluation, y: lowest,
            line: {color: theme.lines[1], shape: "hv"}, hoverinfo: "skip"},
        ].filter((trace) => trace.x.length > 0),
        layout: {
          xaxis: {title: {text: "designs tried"}},
          yaxis: {...scale(isLog, costs), ...(greatest > least ? {range} : {}), title: {text: "cost"}},
          shapes: starts.slice(1).map(({x}) => ({type: "line", x0: x, x1: x, yref: "paper", y0: 0,
            y1: 1, line: {color: theme.faint, width: 1, dash: "dot"}})),
          annotations: starts.filter((start) => start.share > 0.065).map(({name, x}) => ({x, y: 1, yref: "paper", xanchor: "left",
            yanchor: "top", text: plain(name), textangle: 90, showarrow: false,
            font: {size: 10, color: theme.faint}})),
        },
      };
    });
  part.append(element("p", {className: "faint"}, `${summary.evaluations} designs,
    ${summary.given_up} given up after their first screens, ${summary.failures} failed;
    ${digits(summary.wall_seconds, 3)} s in all, ended by: ${summary.termination.replaceAll("_", " ")}.`));
}

/** How the cost changes where one variable is moved alone, and how far it may move. */
function showSensitivity(part, summary) {
  const ranges = Object.entries(summary.indistinguishable ?? {});
  const moved = data.tables?.["sensitivity.csv"];
  const isLength = (name) => /^z/.test(name) || name === "tolerance";
  const shown = (name, value) => (isLength(name) ? length(value) : digits(value));
  if (ranges.length === 0) {
    part.append(element("p", {}, "How far each variable may move was not tried."));
  } else {
    part.append(element("p", {}, `Moved alone, each variable is as good as the best within these limits
      (Student's t test at 5 %).`),
    table(["variable", "best", "from", "to", ""], ranges.map(([name, range]) => [shortLabel(name),
      shown(name, range.best), shown(name, range.least), shown(name, range.greatest),
      range.least_is_bound && range.greatest_is_bound ? "all that was searched"
        : range.least_is_bound ? "the least is the end of what was searched"
          : range.greatest_is_bound ? "the greatest is the end of what was searched" : ""])));
  }
  if (!moved?.variable) return;
  const grid = part.appendChild(element("div", {className: "side-by-side"}));
  for (const name of new Set(moved.variable)) {
    const rows = moved.variable.map((_, i) => i).filter((i) => moved.variable[i] === name)
      .sort((a, b) => moved.value[a] - moved.value[b]);
    const values = rows.map((i) => moved.value[i]);
    const unit = moved.unit?.[rows[0]] ?? "";
    const [size, unitName] = unit === "m" ? lengthUnit(values) : [1, unit];
    const range = summary.indistinguishable?.[name];
    chart(grid, "", (theme) => ({
      data: [{type: "scatter", mode: "lines+markers", x: values.map((value) => value / size),
        y: rows.map((i) => moved.cost_difference[i]),
        error_y: errorBars(rows.map((i) => moved.cost_difference_standard_error[i])),
        line: {color: theme.faint, width: 1},
        marker: {size: 8, color: rows.map((i) => theme.lines[moved.is_worse[i] === 1 ? 1 : 0])},
        hovertemplate: `%{x:.4~g}${unitName && " "}${plain(unitName)}: %{y:.3~g} more<extra></extra>`}],
      layout: {
        xaxis: {title: {text: plain(shortLabel(name) + (unitName ? `, ${unitName}` : ""))}},
        yaxis: {title: {text: "cost above the best"}, zeroline: true, zerolinecolor: theme.text},
        shapes: range ? [{type: "rect", x0: range.least / size, x1: range.greatest / size,
          yref: "paper", y0: 0, y1: 1, fillcolor: theme.lines[2], opacity: 0.15, line: {width: 0},
          layer: "below"}] : []},
    }), 280);
  }
  part.append(element("p", {className: "faint"}, `Bars are standard errors of the difference, screen by
    screen; shaded is what cannot be told from the best; orange or red points are clearly worse.`));
}

pages.optimize = {title: "Best design", end: "the best design", show: showOptimization};
