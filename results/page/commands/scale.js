// scale: a design before and after.

function showScaling(summary) {
  section("From", (part) => showDesign(part, summary.design));
  section("To", (part) => {
    const telescope = summary.scaled_telescope;
    part.append(element("p", {}, `A pupil of ${length(telescope.diameter_m)} at
      ${length(telescope.wavelength_m)}, r0 = ${length(telescope.fried_parameter_m)}.`),
    planesTable(summary.scaled), folded("Detector and reconstruction", settingsTable(summary.scaled)));
  });
}

pages.scale = {title: "Moved design", end: "the moved design", show: showScaling};
