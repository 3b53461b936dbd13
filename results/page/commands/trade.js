// trade: an explorer of the front.

/** What a design of the front may be shown and filtered by: {name: quantity of a design}. */
function frontQuantities(summary) {
  const quantities = {};
  for (const name of summary.objectives) quantities[name] = (design) => design.objectives[name];
  for (const name of Object.keys(summary.front[0].performance)) {
    if (summary.front[0].performance[name]?.mean === undefined || name in quantities) continue;
    quantities[name] = (design) => design.performance[name];
  }
  quantities.plane_count ??= (design) => ({mean: design.planes_m.length, standard_error: 0});
  quantities.pupil_pixels = (design) => ({mean: design.pupil_pixels, standard_error: 0});
  quantities.cost = (design) => design.cost;
  return quantities;
}

function showTrade(summary) {
  if (summary.front.length === 0) {
    section("Front", (part) => part.append(element("p", {}, "No design was verified.")));
    return;
  }
  section("Front", (part) => showFront(part, summary));
  section("Best within limits", (part) => showBests(part, summary));
  section("Quality of the front", (part) => part.append(element("p", {},
    `The front dominates ${digits(100 * summary.hypervolume_fraction, 3)} % of the room between the best
    conceivable values and the reference point (${Object.entries(summary.reference_point)
      .map(([name, value]) => `${label(name)}: ${digits(value)}`).join("; ")}).`)));
  if (summary.knee !== null) showCloserLook(summary.front[summary.knee]);
}

function showFront(part, summary) {
  const front = summary.front;
  const quantities = frontQuantities(summary);
  const names = Object.keys(quantities);
  const planeCounts = [...new Set(front.map((design) => design.planes_m.length))].sort((a, b) => a - b);
  const chosen = {x: summary.objectives[1] ?? names[0], y: summary.objectives[0], isLogX: true,
    isLogY: true, planes: new Set(planeCounts), limits: {}};
  const controls = element("div", {className: "controls"});
  const limits = folded("Limits");
  const count = element("p", {className: "faint", role: "status"});
  const place = element("div");
  const shown = element("div", {id: "design"});
  part.append(element("p", {}, `Each point is a design, verified on fresh screens. A click or tap on one
    shows it below.`), controls, limits, place, count, shown);

  const keeps = (design) => chosen.planes.has(design.planes_m.length) && names.every((name) => {
    const {least, greatest} = chosen.limits[name] ?? {};
    const value = quantities[name](design).mean;
    return !(least !== undefined && value < least) && !(greatest !== undefined && value > greatest);
  });
  const stands = (design) => !design.dominated && design.violation === 0;
  const build = (theme) => {
    const symbols = ["circle", "square", "diamond", "triangle-up", "triangle-down", "star"];
    const symbolOf = (pixels) => symbols[pixelCounts.indexOf(pixels) % symbols.length];
    const pixelCounts = [...new Set(front.map((design) => design.pupil_pixels))].sort((a, b) => a - b);
    const indices = front.map((_, i) => i).filter((i) => keeps(front[i]));
    const quantity = (name, i) => quantities[name](front[i]);
    const points = (those, name, marker, opacity) => ({type: "scatter", mode: "markers", name, opacity,
      x: those.map((i) => quantity(chosen.x, i).mean), y: those.map((i) => quantity(chosen.y, i).mean),
      error_x: {...errorBars(those.map((i) => quantity(chosen.x, i).standard_error)), color: theme.faint},
      error_y: {...errorBars(those.map((i) => quantity(chosen.y, i).standard_error)), color: theme.faint},
      customdata: those,
      text: those.map((i) => plain(`design ${i}${i === summary.knee ? ", the knee" : ""}: ${
        front[i].planes_m.map(length).join(", ")}\n${front[i].pupil_pixels} pixels\n${
        label(chosen.x)}: ${withError(quantity(chosen.x, i))}\n${
        label(chosen.y)}: ${withError(quantity(chosen.y, i))}${
        stands(front[i]) ? "" : "\nbettered or out of limits on the fresh screens"}`)
        .replaceAll("\n", "<br>")),
      hovertemplate: "%{text}<extra></extra>", marker});
    const traces = planeCounts.flatMap((planes, k) => {
      const those = indices.filter((i) => front[i].planes_m.length === planes);
      const marker = (subset) => ({size: 11, color: theme.lines[k % theme.lines.length],
        symbol: subset.map((i) => symbolOf(front[i].pupil_pixels)),
        line: {color: theme.back, width: 1}});
      const standing = those.filter((i) => stands(front[i]));
      const others = those.filter((i) => !stands(front[i]));
      const dominated = points(others, `${planes} planes, bettered`, marker(others), 0.4);
      return [points(standing, `${planes} planes`, marker(standing), 1), {...dominated, showlegend: false}];
    }).filter((trace) => trace.x.length > 0);
    const ring = (i, name, symbol, size) => ({type: "scatter", mode: "markers", name, hoverinfo: "skip",
      x: [quantity(chosen.x, i).mean], y: [quantity(chosen.y, i).mean],
      marker: {symbol, size, color: theme.text, line: {color: theme.text, width: 2}}});
    if (summary.knee !== null && keeps(front[summary.knee])) {
      traces.unshift(ring(summary.knee, "knee", "circle-open", 22));
    }
    if (chosen.design !== undefined && keeps(front[chosen.design])) {
      traces.unshift({...ring(chosen.design, "shown", "square-open", 27), showlegend: false});
    }
    count.textContent = `${indices.length} of ${front.length} designs shown. Colours: planes; symbols:
      pixels across the pupil (${pixelCounts.map((pixels) =>
      `${symbolOf(pixels).replace("-", " ")} ${pixels}`).join(", ")}); pale: bettered on the fresh screens.`;
    const axis = (name, isLog) => ({title: {text: plain(label(name))},
      ...scale(isLog, indices.map((i) => quantity(name, i).mean))});
    return {data: traces, layout: {xaxis: axis(chosen.x, chosen.isLogX),
      yaxis: axis(chosen.y, chosen.isLogY)}};
  };
  const made = chart(place, "", build, 480);
  made.node.id = "front";

  const choose = (i) => {
    chosen.design = i;
    made.redraw();
    clear(shown);
    const design = front[i];
    shown.append(element("h3", {}, `Design ${i}${i === summary.knee ? ", the knee" : ""}${
      design.dominated ? ", bettered on the fresh screens" : ""}`));
    showDesign(shown, design);
    shown.append(performanceTable([["this design", design]]),
      table(["objective", ""], summary.objectives.map((name) =>
        [label(name), withError(design.objectives[name])])));
    const configuration = data.front_configurations?.[i];
    if (configuration) {
      shown.append(element("p", {}, "Its configuration, to be saved as a file for --config:"),
        copyable(configuration));
    }
  };
  made.node.on("plotly_click", (event) => {
    const i = event.points.map((point) => point.customdata).find((one) => one !== undefined);
    if (i !== undefined) choose(i);
  });

  const tick = (title, isOn, changed) => {
    const input = element("input", {type: "checkbox", checked: isOn});
    input.addEventListener("change", () => changed(input.checked));
    return element("label", {className: "tick"}, input, title);
  };
  const options = names.map((name) => [name, label(name)]);
  const set = (key) => (value) => {
    chosen[key] = value;
    made.redraw();
  };
  controls.append(choice("To the right", options, chosen, "x", made.redraw),
    tick("logarithmic", chosen.isLogX, set("isLogX")), choice("Upwards", options, chosen, "y", made.redraw),
    tick("logarithmic", chosen.isLogY, set("isLogY")),
    ...planeCounts.map((planes) => tick(`${planes} planes`, true, (isOn) => {
      chosen.planes[isOn ? "add" : "delete"](planes);
      made.redraw();
    })));
  limits.append(...names.map((name) => {
    const bound = (side, title) => {
      const input = element("input", {type: "number", step: "any", placeholder: title,
        ariaLabel: `${label(name)}, ${title}`});
      input.addEventListener("input", () => {
        chosen.limits[name] = {...chosen.limits[name],
          [side]: Number.isNaN(input.valueAsNumber) ? undefined : input.valueAsNumber};
        made.redraw();
      });
      return input;
    };
    return element("div", {className: "controls"}, element("label", {}, label(name),
      element("span", {}, bound("least", "at least"), " ", bound("greatest", "at most"))));
  }));
  choose(summary.knee ?? 0);
}

/** The best in the first objective that each bound on another lets stand. */
function showBests(part, summary) {
  const first = summary.objectives[0];
  for (const [name, bests] of Object.entries(summary.best_within)) {
    part.append(table([`limit on ${label(name)}`, label(first), "planes", "pixels", "design"],
      bests.map(({bound, design}) => {
        const best = summary.front[design];
        return [digits(bound), withError(best.objectives[first]), best.planes_m.length,
          best.pupil_pixels, design];
      }), `Best ${shortLabel(first)} within a limit on ${shortLabel(name)}`));
  }
}

pages.trade = {title: "Front of the best compromises", end: "the knee", show: showTrade};
