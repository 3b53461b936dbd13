// advise: a design of the law, predicted and simulated.

function showAdvice(summary) {
  const {predicted, difference, design} = summary;
  section("Design", (part) => showDesign(part, design));
  section("What the law predicts", (part) => {
    if (predicted.reasons_for_none?.length) {
      part.append(element("p", {},
        `Nothing of what it reaches: ${predicted.reasons_for_none.join("; ")}.`));
      return;
    }
    const heads = ["", "predicted"];
    if (difference) heads.push("simulated", "simulated − predicted", "in standard errors");
    part.append(table(heads, ["residual_wfe_nm", "fractional_loops"].map((name) => {
      const row = [label(name), withError(predicted[name])];
      if (difference) {
        row.push(withError(design.performance[name]), withError(difference[name]),
          digits(difference[name].standard_errors, 2));
      }
      return row;
    })));
  });
  if (design.performance) {
    section("Simulated on fresh screens", (part) =>
      part.append(performanceTable([["advised design", design]])));
    showCloserLook(design);
  }
}

pages.advise = {title: "Advised design", end: "the advised design", show: showAdvice};
