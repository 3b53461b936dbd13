// evaluate: a design on its screens.

function showEvaluation(summary) {
  section("Design", (part) => showDesign(part, summary.design));
  section("Performance", (part) => {
    part.append(performanceTable([["design", summary.design]]));
    part.append(conditionsTable(summary.design) ?? "");
    showScreenMetrics(part);
  });
  showCloserLook(summary.design);
}

pages.evaluate = {title: "Performance of a design", show: showEvaluation};
