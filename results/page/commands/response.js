// response: single spatial frequencies.

function showResponse(summary) {
  const columns = data.tables?.["response.csv"];
  if (columns?.planes) {
    section("Response of the design", (part) => {
      part.append(element("p", {}, `Sinusoids of ${length(summary.amplitude_m)} (peak) in
        ${summary.wavefronts} orientations and phases.`));
      responseCharts(part, columns);
    });
    if (columns.planes.includes("pair")) {
      section("Single pairs of planes", (part) => pairsExplorer(part, columns));
    }
  }
  section("Design", (part) => showDesign(part, summary.design));
}

pages.response = {title: "Response to single spatial frequencies", show: showResponse};
