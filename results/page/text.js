/** What each command's script says of its page: {title, end (the design that its configuration file holds), show(summary)}. */
const pages = {};

// Elements, numbers and tables. A text of the data is only ever set as text, never read as HTML.

/** A new element with properties or attributes and children; those that are null are left out. */
function element(tag, properties = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in node) node[name] = value;
    else node.setAttribute(name, value);
  }
  node.append(...children.filter((child) => child !== null && child !== undefined));
  return node;
}

/** A text as Plotly shows it, which reads tags and entities, and %{...} in templates. */
function plain(text) {
  return String(text).replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;")
    .replaceAll("%{", "%&#123;");
}

/** With so many significant digits, without zeros behind them; with 4 or more, to the unit at least. */
function digits(value, count = 4) {
  if (value === null || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e7)) {
    return value.toExponential(count - 1).replace(/\.?0+e/, "e").replace("e+", "e")
      .replaceAll("-", "−");
  }
  const shown = count >= 4 && size >= 10 ** count ? Math.round(value)
    : Number(value.toPrecision(count));
  return String(shown).replace("-", "−");
}

/** With so many decimals; halves go to the even digit, as in the program's own numbers. */
function fixed(value, decimals) {
  const scaled = value * 10 ** decimals;
  const isHalf = Number.isInteger(value * 2 ** (decimals + 1)) && Math.abs(scaled % 1) === 0.5;
  return (isHalf ? 2 * Math.round(scaled / 2) / 10 ** decimals : value).toFixed(decimals);
}

/** "0.52 ± 0.03": a mean with its standard error, to the error's second digit. */
function withError(quantity) {
  if (!quantity || quantity.mean === null) return "–";
  const error = quantity.standard_error;
  if (!(error > 0)) return digits(quantity.mean, 6);
  const decimals = Math.min(Math.max(1 - Math.floor(Math.log10(error)), 0), 9);
  return `${fixed(quantity.mean, decimals)} ± ${fixed(error, decimals)}`.replace("-", "−");
}

/** A sentence of the program with its signs as print has them. */
function typeset(sentence) {
  return sentence.replaceAll(" +- ", " ± ").replaceAll("^2", "²")
    .replace(/(\d)e\+0*(\d)/g, "$1e$2").replace(/(\d)e-0*(\d)/g, "$1e−$2");
}

const lengthUnits = [[1e3, "km"], [1, "m"], [1e-2, "cm"], [1e-3, "mm"], [1e-6, "µm"], [1e-9, "nm"]];

/** A length in m for people, "47 km". */
function length(metres) {
  if (metres === null || !Number.isFinite(metres)) return "–";
  const [size, unit] = lengthUnits.find(([size]) => Math.abs(metres) >= size) ?? [1, "m"];
  return `${digits(metres / size)}\u00a0${unit}`;
}

/** The unit that lengths of an axis are shown in: [its size in m, its name]. */
function lengthUnit(values) {
  const greatest = Math.max(...values.map(Math.abs));
  return lengthUnits.find(([size, unit]) => unit !== "cm" && greatest >= size) ?? [1, "m"];
}

const labels = {
  residual_wfe_nm: "residual WFE, nm",
  wrapped_wfe_nm: "wrapped WFE, nm",
  total_wfe_nm: "total WFE, nm",
  field_strehl: "field-estimated Strehl",
  fft_count: "Fourier transforms",
  seconds: "seconds per wavefront",
  model_seconds: "model time, s",
  latency_seconds: "latency, s",
  servo_wfe_nm: "servo lag, nm",
  error_budget_nm: "error budget, nm",
  plane_count: "planes",
  captured_energy: "least light captured",
  violation: "violation of the limits",
  z_near: "distance of the near pair",
  z_far: "distance of the far pair",
  z_third: "distance of the third pair",
  order: "visiting order",
  pupil_pixels: "pixels across the pupil",
  detector_window: "detector window, pupil diameters",
  reconstruction_window: "reconstruction window, pupil diameters",
};

/** A name of the summaries for people, with its unit behind a comma. */
function label(name) {
  return labels[name] ?? (/^z\d$/.test(name) ? `distance of plane ${name[1]}`
    : name.replaceAll("_", " "));
}

/** Without the unit. */
function shortLabel(name) {
  return label(name).replace(/, [^,]*$/, "");
}

/**
 * A table that scrolls within itself.
 * @param heads  texts
 * @param rows   of texts, numbers (which stand to the right) or elements
 */
function table(heads, rows, caption = "") {
  const isNumber = (column) => rows.length > 0 && rows.every((row) =>
    typeof row[column] === "number" || /^[−+\d–][\d.e−+ ±%]*$/.test(row[column] ?? "–"));
  const kinds = heads.map((_, column) => (isNumber(column) ? "number" : ""));
  const widthOf = (content) => (content instanceof Node ? "wide" : typeof content !== "string" ? ""
    : content.length < 20 ? "short" : content.length > 40 ? "wide" : "");
  const kindOf = (content, column) => kinds[column] || widthOf(content);
  const cell = (content, column) => element("td", {className: kindOf(content, column)},
    typeof content === "number" ? digits(content, 6) : content ?? "–");
  return element("div", {className: "scroll", tabIndex: 0, role: "region",
    ariaLabel: caption || heads.join(", ")},
  element("table", {}, caption ? element("caption", {}, caption) : null,
    element("thead", {}, element("tr", {},
      ...heads.map((head, i) => element("th", {className: kinds[i], scope: "col"}, head)))),
    element("tbody", {}, ...rows.map((row) => element("tr", {}, ...row.map(cell))))));
}

/** A menu: calls `chosen(value)` when another value is chosen. @param options [[value, text], ...] */
function menu(title, options, value, chosen) {
  const select = element("select", {},
    ...options.map(([option, text]) => element("option", {value: option}, text)));
  select.value = value;
  select.addEventListener("change", () => chosen(select.value));
  return element("label", {}, title, select);
}

/** A menu that sets a member of `chosen` and then redraws. */
function choice(title, options, chosen, key, redraw) {
  return menu(title, options, chosen[key], (value) => {
    chosen[key] = value;
    redraw();
  });
}

/** A text that can be copied, with a button for it. */
function copyable(text) {
  const block = element("pre", {tabIndex: 0}, text);
  const button = element("button", {type: "button"}, "Copy");
  button.addEventListener("click", async () => {
    // Pages that are opened from a file may have no clipboard: then the text is selected.
    getSelection().selectAllChildren(block);
    let isCopied = document.execCommand("copy");
    if (!isCopied) isCopied = await navigator.clipboard?.writeText(text).then(() => true, () => false);
    button.textContent = isCopied ? "Copied" : "Selected: copy it with the keyboard";
    setTimeout(() => (button.textContent = "Copy"), 2000);
  });
  return element("div", {className: "copyable"}, button, block);
}

/** A part that is folded up at first. */
function folded(title, ...content) {
  return element("details", {}, element("summary", {}, title), ...content);
}
