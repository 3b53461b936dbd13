// Detector images and phases of single screens.

/** The values of an image as rows of numbers; null where there is none. */
function pixelRows(image) {
  const bytes = Uint8Array.from(atob(image.values), (character) => character.charCodeAt(0));
  const values = new DataView(bytes.buffer);
  return Array.from({length: image.rows}, (_, row) =>
    Array.from({length: image.columns}, (_, column) => {
      const value = values.getFloat32(4 * (row * image.columns + column), true);
      return Number.isFinite(value) ? value : null;
    }));
}

/** The middles of an image's pixels, m from the middle. @param width of the image in m, samples in all */
function pixelPlaces(image, width, samples) {
  return Array.from({length: image.columns}, (_, i) =>
    ((i + 0.5) * image.samples_per_pixel - samples / 2) * width / samples);
}

/** The value that so large a share of all values is below. */
function quantile(rows, share) {
  const sorted = rows.flat().filter((value) => value !== null).sort((a, b) => a - b);
  return sorted[Math.min(Math.floor(share * sorted.length), sorted.length - 1)];
}

/** An image of what is `width` m wide. @param range of the colours, [least, greatest] */
function imageChart(parent, caption, {rows, places, quantity, colours, range}) {
  chart(parent, caption, () => ({
    data: [{type: "heatmap", z: rows, x: places, y: places, colorscale: colours, zmin: range[0],
      zmax: range[1], zsmooth: false, hoverongaps: false,
      hovertemplate: `x %{x:.4~g} m, y %{y:.4~g} m<br>${plain(quantity)} %{z:.4~g}<extra></extra>`,
      colorbar: {orientation: "h", thickness: 9, y: -0.16, yanchor: "top", len: 0.95, nticks: 5, tickangle: 0,
        title: {text: plain(quantity), side: "bottom", font: {size: 11}}}}],
    layout: {margin: {l: 44, r: 8, t: 6, b: 70},
      xaxis: {constrain: "domain", showgrid: false, zeroline: false, nticks: 5, title: {text: "x, m"}},
      yaxis: {scaleanchor: "x", constrain: "domain", showgrid: false, zeroline: false, nticks: 5,
        title: {text: "y, m"}}},
  }), 340);
}

function binnedNote(images) {
  const size = images.slices[0].samples_per_pixel;
  return size > 1 ? ` Each pixel here is the mean of ${size} x ${size}.` : "";
}

/** What the detector saw, one image for each plane. */
function showImages(part, images, width, title) {
  const grid = part.appendChild(element("div", {className: "side-by-side small"}));
  images.slices.forEach((image, i) => {
    const rows = pixelRows(image);
    imageChart(grid, title(i), {rows, places: pixelPlaces(image, width, images.samples),
      quantity: intensityTitle(images), colours: "Viridis", range: [0, quantile(rows, 0.995)]});
  });
}

/** What intensities are counted in: where they have no unit, in the unaberrated pupil's. */
function intensityTitle(images) {
  return images.unit === "1" || images.unit === "" ? "relative intensity"
    : `intensity, ${images.unit}`;
}

function rootMeanSquare(rows) {
  const values = rows.flat().filter((value) => value !== null);
  return Math.sqrt(values.reduce((sum, value) => sum + value * value, 0) / values.length);
}

/** Phases across the pupil. @param title of an index and an RMS @param alike how many of the first have the same colours */
function showPhases(part, phases, title, alike = 0) {
  const grid = part.appendChild(element("div", {className: "side-by-side small"}));
  const all = phases.slices.map(pixelRows);
  all.forEach((rows, i) => {
    const shown = i < alike ? all.slice(0, alike).flat() : rows;
    imageChart(grid, title(i, digits(rootMeanSquare(rows), 3)), {rows,
      places: pixelPlaces(phases.slices[i], data.diameter_m ?? 1, phases.samples),
      quantity: `phase, ${phases.unit}`, colours: "Cividis",
      range: [quantile(shown, 0), quantile(shown, 1)]});
  });
}

/** The screens that a design did typically and worst on, as far as their files are there. */
function showCloserLook(design) {
  const look = data.summary.closer_look;
  for (const kind of ["typical", "worst"]) {
    const images = data.images?.[`${kind}-images.fits`];
    const phases = data.images?.[`${kind}-phases.fits`];
    if (!images && !phases) continue;
    section(kind === "typical" ? "A typical screen" : "The worst screen", (part) => {
      if (look?.[kind]) {
        const under = look[kind].condition ? ` under ${typeset(look[kind].condition)}` : "";
        part.append(element("p", {}, `Screen ${look[kind].screen}${under}: residual WFE
          ${digits(look[kind].residual_wfe_nm)} nm after ${look[kind].loops} loops
          (${kind === "typical" ? "the median of the screens" : "the greatest of all screens"}).`));
      }
      if (phases) {
        part.append(element("p", {}, `Phases at the telescope's wavelength, without piston; true and
          reconstructed have the same colours.${binnedNote(phases)}`));
        const names = ["True phase", "Reconstructed phase", "Residual phase"];
        showPhases(part, phases, (i, rms) => `${names[i]}, RMS ${rms} rad`, 2);
      }
      if (images) {
        part.append(element("p", {}, `Detector images in the order in which they are visited, with
          their noise, relative to the unaberrated pupil's intensity. The brightest 0.5 % have the last colour.${binnedNote(images)}`));
        showImages(part, images, design.detector_window * (data.diameter_m ?? 1),
          (i) => `Plane ${i + 1}, ${length(design.planes_m[i])}`);
      }
    });
  }
  if (data.tables?.["loops.csv"]?.loop) section("From loop to loop", showLoops);
}

function showLoops(part) {
  const loops = data.tables["loops.csv"];
  chart(part, "Residual wavefront error after each loop, until the loop stopped.", (theme) => ({
    data: ["typical", "worst"].map((kind, i) => ({type: "scatter", mode: "lines+markers",
      name: `${kind} screen`, x: loops.loop, y: loops[`${kind}_residual_wfe_nm`],
      line: {color: theme.lines[i]}, hovertemplate: "loop %{x}: %{y:.4~g} nm"})),
    layout: {xaxis: axis("loops"), yaxis: axis("residual WFE, nm",
      [...loops.typical_residual_wfe_nm, ...loops.worst_residual_wfe_nm])},
  }));
}
