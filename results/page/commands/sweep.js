// sweep: the map, and the best of it.

function showSweep(summary) {
  const grid = summary.grid;
  const isQuantity = (name) => !["axes", "orders", "standard_error"].includes(name);
  section("Map", (part) => {
    if (!grid.axes.some((axis) => axis.values.length > 1)) {
      part.append(element("p", {}, "The grid has one value on each axis: there is nothing to draw."));
      return;
    }
    gridExplorer(part, grid, Object.keys(grid).filter(isQuantity),
      data.best_place ? {place: data.best_place, name: "best of the sweep"} : null);
    part.append(element("p", {className: "faint"}, `Means on the sweep's own screens. The star is the
      design that is best on fresh ones; other axes stand at it at first.`));
  });
  section("Best design", (part) => {
    showDesign(part, summary.best);
    part.append(conditionsTable(summary.best) ?? "");
  });
  section("Verification", (part) => {
    part.append(performanceTable([["sweep's screens", summary.best_on_search_screens],
      ["fresh screens", summary.best]], "The best design"));
    showRanking(part, summary.ranking, "sweep");
  });
  showCloserLook(summary.best);
}

pages.sweep = {title: "Sweep of a grid", end: "the best design", show: showSweep};
