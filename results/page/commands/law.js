// law: fits and searches.

const lawQuantities = {z_near_talbot: "near pair, Talbot distances of r0",
  far_fresnel_number: "far pair, Fresnel number", residual_wfe_wavelengths: "residual WFE, wavelengths",
  fractional_loops: "fractional loops"};

/** What search.order calls planes 1 to 4. */
function planeName(number) {
  return ["−near", "near", "−far", "far"][number - 1];
}

/** A line of the law, in the logarithms of D/r0 and of the quantity. */
function lawLine(law, name, ratios) {
  return ratios.map((ratio) => Math.exp(law[name].intercept + law[name].slope * Math.log(ratio)));
}

function showLaw(summary) {
  const columns = data.tables?.["law.csv"];
  const law = summary.law;
  section("Law", (part) => {
    const grid = element("div", {className: "side-by-side"});
    part.append(element("p", {}, `The best designs that were found at each D/r0, and the lines that are
      fitted to them. Planes are visited in the order ${law.order.map(planeName).join(", ")}.`),
    table(["law", ""], Object.entries(lawQuantities).map(([name, title]) => [title,
      `${digits(Math.exp(law[name].intercept), 3)} (D/r0)^${digits(law[name].slope, 3)}`])), grid);
    const steps = Array.from({length: 60}, (_, i) =>
      law.least_d_over_r0 * (law.greatest_d_over_r0 / law.least_d_over_r0) ** (i / 59));
    for (const [name, title] of Object.entries(lawQuantities)) {
      const line = lawLine(law, name, steps);
      lineChart(grid, "", [
        ...(columns?.[name] ? [{name: "searches", x: columns.d_over_r0, y: columns[name],
          errors: columns[`${name}_standard_error`], isPoints: true}] : []),
        {name: "law", x: steps, y: line, colour: 1, isDashed: true}],
      axis("D/r<sub>0</sub>", steps), axis(title, [...line, ...(columns?.[name] ?? [])]), 320);
    }
  });
  section("Designs", (part) => part.append(performanceTable(summary.designs.map((design, i) =>
    [columns?.d_over_r0?.[i] ? `D/r0 = ${digits(columns.d_over_r0[i])}` : `search ${i + 1}`, design]))));
}

pages.law = {title: "Scaling law", show: showLaw};
