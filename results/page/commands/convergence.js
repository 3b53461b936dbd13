// convergence: the residual after each loop.

function showConvergence(summary) {
  const columns = data.tables?.["convergence.csv"];
  if (columns?.loop) {
    section("Residual wavefront error", (part) => convergenceChart(part, columns,
      "After each loop, however long it goes on; bars are standard errors of the mean."));
  }
  section("Design", (part) => showDesign(part, summary.design));
  section("With the stopping rule", (part) => {
    part.append(performanceTable([["design", summary.design]]));
    showScreenMetrics(part);
  });
}

pages.convergence = {title: "From loop to loop", show: showConvergence};
