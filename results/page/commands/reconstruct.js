// reconstruct: phases, and how well they predict the frames.

function showReconstruction(summary) {
  const {design} = summary;
  const phase = data.images?.["phase.fits"];
  if (phase) {
    section("Phase", (part) => {
      part.append(element("p", {}, `Without piston, at the telescope's wavelength;
        ${phase.count === 1 ? "one set of frames" : `${phase.slices.length} of ${phase.count} sets of frames`}.${binnedNote(phase)}`));
      showPhases(part, phase, (i, rms) => `Set ${i + 1}, RMS ${rms} rad`);
    });
  }
  if (data.images?.["frames.fits"] && data.images?.["predicted.fits"]) {
    section("Measured and predicted intensities", (part) =>
      showPredictions(part, design, data.images["frames.fits"], data.images["predicted.fits"]));
  }
  const consistency = data.tables?.["consistency.csv"];
  if (consistency?.plane) {
    section("Consistency", (part) => {
      const share = (value) => (value === null ? "not known" : `${digits(100 * value, 3)} %`);
      part.append(table(["set", "plane", "distance", "measured − predicted, RMS", "noise alone",
        "beyond noise", "correlation", "light captured", "stands off, pixels", "bad pixels"],
      consistency.plane.map((plane, i) => [consistency.set[i], plane,
        length(consistency.distance_m[i]), share(consistency.relative_rms[i]),
        share(consistency.noise_relative_rms[i]), share(consistency.misfit[i]),
        digits(consistency.correlation[i]), share(consistency.captured_energy[i]),
        `${digits(consistency.displacement_x_pixels[i], 2)}, ${
          digits(consistency.displacement_y_pixels[i], 2)}`, consistency.bad_pixels[i]])));
    });
  }
  section("Design", (part) => showDesign(part, design));
}

/** Measured, predicted and their difference in each plane of the first set of frames. */
function showPredictions(part, design, frames, predicted) {
  part.append(element("p", {}, `The first set: the frames as the reconstruction got them (bad pixels
    are left out), what the phase that it found makes of each, and the difference, relative to the intensity of
    the unaberrated pupil.${binnedNote(frames)}`));
  design.planes_m.slice(0, frames.slices.length).forEach((plane, i) => {
    part.append(element("h3", {}, `Plane ${i + 1}, ${length(plane)}`));
    const grid = part.appendChild(element("div", {className: "side-by-side small"}));
    const measured = pixelRows(frames.slices[i]);
    const expected = pixelRows(predicted.slices[i]);
    const difference = measured.map((row, k) => row.map((value, j) =>
      (value === null || expected[k][j] === null ? null : value - expected[k][j])));
    const brightest = quantile(measured, 0.995);
    const greatest = Math.max(Math.abs(quantile(difference, 0.0025)), Math.abs(quantile(difference, 0.9975)));
    const places = pixelPlaces(frames.slices[i], design.detector_window * (data.diameter_m ?? 1),
      frames.samples);
    for (const [caption, rows, colours, range] of [
      ["Measured", measured, "Viridis", [0, brightest]],
      ["Predicted", expected, "Viridis", [0, brightest]],
      ["Measured − predicted", difference, "Cividis", [-greatest, greatest]]]) {
      imageChart(grid, caption, {rows, places, quantity: intensityTitle(frames), colours, range});
    }
  });
}

pages.reconstruct = {title: "Reconstructed wavefront", show: showReconstruction};
