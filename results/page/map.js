// Quantities over the axes of a grid: maps with contours, and lines.

/** An axis as it is drawn: places, title, and what one of its values is called. */
function drawnAxis({name, unit, values}) {
  const isWords = values.some((value) => typeof value === "string");
  if (isWords) {
    return {places: values.map((_, i) => i), title: shortLabel(name), isLog: false,
      text: (i) => String(values[i]), place: (value) => value,
      ticks: {tickvals: values.map((_, i) => i), ticktext: values.map(plain)}};
  }
  const [size, unitName] = unit === "m" ? lengthUnit(values) : [1, unit ?? ""];
  const suffix = unitName ? `, ${unitName}` : "";
  return {places: values.map((value) => value / size),
    title: (unitName ? shortLabel(name) : label(name)) + suffix, isLog: isLogarithmic(values),
    text: (i) => `${digits(values[i] / size)} ${unitName}`.trim(), place: (value) => value / size,
    ticks: {}};
}

function axisLayout(axis) {
  return {title: {text: plain(axis.title)}, ...scale(axis.isLog, axis.places), ...axis.ticks};
}

/**
 * A map in colours with contours; values over a wide range on a logarithmic scale.
 * @param values  of each y, of each x; null where there is none
 * @param errors  likewise, or null
 * @param marks   [{x, y, name}, ...] in the axes' drawn units
 */
function mapTraces(theme, {x, y, values, errors, title, marks = [], isShare = false}) {
  const finite = values.flat().filter((value) => value !== null);
  const isLog = !isShare && isWide(finite);
  const scaled = values.map((row) => row.map((value) =>
    (value === null ? null : isLog ? Math.log10(value) : value)));
  const least = Math.min(...finite);
  const greatest = Math.max(...finite);
  const numbers = isLog ? roundNumbers(least, greatest) : null;
  const hover = values.map((row, i) => row.map((value, j) => {
    const quantity = {mean: value, standard_error: errors?.[i]?.[j]};
    return value === null ? "" : plain(`${x.title}: ${x.text(j)}\n${y.title}: ${y.text(i)}\n${title}: ${
      withError(quantity)}`).replaceAll("\n", "<br>");
  }));
  const contours = isLog ? {start: Math.log10(numbers[0] ?? least),
    end: Math.log10(numbers.at(-1) ?? greatest), size: 0.2} : undefined;
  const traces = [{type: "heatmap", x: x.places, y: y.places, z: scaled, text: hover,
    colorscale: "Viridis", hoverongaps: false, hovertemplate: "%{text}<extra></extra>",
    zmin: isShare ? 0 : undefined, zmax: isShare ? Math.max(1, greatest) : undefined,
    colorbar: {title: {text: plain(title), side: "right"}, thickness: 14,
      ...(isLog ? {tickvals: numbers.map(Math.log10), ticktext: numbers.map((n) => digits(n, 2))} : {})}}];
  if (x.places.length > 2 && y.places.length > 2 && greatest > least) {
    traces.push({type: "contour", x: x.places, y: y.places, z: scaled, showscale: false, showlegend: false,
      autocontour: !isLog, ncontours: 12, hoverinfo: "skip",
      contours: {coloring: "none", ...contours}, line: {color: "#ffffff", width: 0.8},
      opacity: 0.7, connectgaps: false});
  }
  if (marks.length > 0) {
    traces.push({type: "scatter", mode: "markers", x: marks.map((mark) => mark.x),
      y: marks.map((mark) => mark.y), text: marks.map((mark) => plain(mark.name)),
      hovertemplate: "%{text}<extra></extra>", showlegend: false,
      marker: {symbol: "star", size: 15, color: "#d55e00", line: {color: "#ffffff", width: 1.5}}});
  }
  return traces;
}

/** Quantities that are shares of a whole, whose colours are even in the values. */
const shares = new Set(["recovered_share", "field_strehl", "captured_energy"]);

/** What of nested arrays stands at these places of all axes. */
function entry(matrix, places) {
  return places.reduce((rest, place) => rest?.[place] ?? null, matrix);
}

/**
 * A quantity of a grid over one or two of its axes, with menus for the quantity, the axes and the
 * places on the others.
 * @param grid  {axes: [{name, unit, values}], standard_error: {...}, quantities by their names}
 * @param best  {place: [value on each axis, or null], name}, or null
 */
function gridExplorer(part, grid, quantities, best) {
  const axes = grid.axes;
  const drawn = axes.map(drawnAxis);
  const long = axes.map((_, i) => i).filter((i) => axes[i].values.length > 1)
    .sort((a, b) => axes[b].values.length - axes[a].values.length || a - b);
  const nearest = (axis) => {
    const place = best?.place[axis];
    if (place === null || place === undefined) return 0;
    const distance = (i) => Math.abs((typeof axes[axis].values[i] === "string" ? i
      : axes[axis].values[i]) - place);
    return axes[axis].values.reduce((least, _, i) => (distance(i) < distance(least) ? i : least), 0);
  };
  const chosen = {quantity: quantities[0], x: Math.min(...long.slice(0, 2)),
    y: long.length > 1 ? Math.max(...long.slice(0, 2)) : null, at: axes.map((_, i) => nearest(i))};
  const controls = element("div", {className: "controls"});
  const place = element("div");
  part.append(controls, place);

  const valuesOf = (matrix) => {
    const at = [...chosen.at];
    const row = () => axes[chosen.x].values.map((_, i) => {
      at[chosen.x] = i;
      return entry(matrix, at);
    });
    if (chosen.y === null) return [row()];
    return axes[chosen.y].values.map((_, i) => {
      at[chosen.y] = i;
      return row();
    });
  };
  const build = (theme) => {
    const values = valuesOf(grid[chosen.quantity]);
    const errors = grid.standard_error?.[chosen.quantity]
      ? valuesOf(grid.standard_error[chosen.quantity]) : null;
    const x = drawn[chosen.x];
    const title = label(chosen.quantity);
    const bestAt = (axis) => (best?.place[axis] == null ? null : drawn[axis].place(best.place[axis]));
    if (chosen.y === null) {
      const marked = bestAt(chosen.x);
      return {
        data: [{type: "scatter", mode: "lines+markers", x: x.places, y: values[0],
          error_y: errors ? errorBars(errors[0]) : undefined, line: {color: theme.lines[0]},
          text: values[0].map((value, i) => plain(`${x.text(i)}: ${withError({mean: value,
            standard_error: errors?.[0][i]})}`)), hovertemplate: "%{text}<extra></extra>"}],
        layout: {xaxis: axisLayout(x),
          yaxis: {title: {text: plain(title)}, ...scale(isWide(values[0]), values[0])},
          shapes: marked === null ? [] : [{type: "line", x0: marked, x1: marked, yref: "paper", y0: 0,
            y1: 1, line: {color: theme.lines[1], dash: "dash"}}],
          annotations: marked === null ? [] : [{x: x.isLog ? Math.log10(marked) : marked, y: 1,
            yref: "paper", yanchor: "bottom", text: plain(best.name), showarrow: false}],
          margin: {l: 50, r: 16, t: 26, b: 44}},
      };
    }
    const y = drawn[chosen.y];
    const mark = {x: bestAt(chosen.x), y: bestAt(chosen.y), name: best?.name};
    return {
      data: mapTraces(theme, {x, y, values, errors, title, isShare: shares.has(chosen.quantity),
        marks: mark.x !== null && mark.y !== null ? [mark] : []}),
      layout: {xaxis: axisLayout(x), yaxis: axisLayout(y)},
    };
  };
  const made = chart(place, "", build, 460);
  made.node.classList.add("grid");

  const showControls = () => {
    const update = (change) => (value) => {
      change(value);
      showControls();
      made.redraw();
    };
    const axisOptions = (other) => long.filter((axis) => axis !== other)
      .map((axis) => [axis, shortLabel(axes[axis].name)]);
    controls.replaceChildren(menu("Quantity", quantities.map((name) => [name, label(name)]),
      chosen.quantity, update((value) => (chosen.quantity = value))));
    if (long.length > 2) {
      controls.append(
        menu("To the right", axisOptions(chosen.y), chosen.x, update((value) => (chosen.x = Number(value)))),
        menu("Upwards", axisOptions(chosen.x), chosen.y, update((value) => (chosen.y = Number(value)))));
    }
    for (const axis of long) {
      if (axis === chosen.x || axis === chosen.y) continue;
      controls.append(menu(shortLabel(axes[axis].name), axes[axis].values.map((_, i) =>
        [i, drawn[axis].text(i)]), chosen.at[axis], update((value) => (chosen.at[axis] = Number(value)))));
    }
  };
  showControls();
}
