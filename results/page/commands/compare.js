// compare: a search beside a sweep.

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

pages.compare = {title: "Sweep against search", show: showComparison};
