// export: every evaluation, as points.

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
    const redraw = () => made.redraw();
    const options = names.map((name) => [name, label(name)]);
    part.append(element("div", {className: "controls"}, 
      choice("To the right", options, chosen, "x", redraw),
      choice("Upwards", options, chosen, "y", redraw)), place);
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

pages.export = {title: "Evaluations of a run", show: showExport};
