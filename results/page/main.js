const data = JSON.parse(document.getElementById("data").textContent);
const sections = document.getElementById("sections");

/** Does what fills a part of the page; where it fails, the part says so, and the others stand. */
function attempt(part, action) {
  try {
    action();
  } catch (error) {
    part.append(element("p", {className: "failed"},
      `This part cannot be shown: ${error.message}. The files of the run have its numbers.`));
    console.error(error);
  }
}

/** A part of the page. */
function section(title, fill) {
  const part = element("section", {}, element("h2", {}, title));
  sections.append(part);
  attempt(part, () => fill(part));
}

const page = pages[data.command];

function showHead() {
  const head = document.getElementById("head");
  head.append(themeSwitch(), element("h1", {}, page.title));
  if (data.telescope) head.append(element("p", {}, data.telescope));
  if (data.verdict) head.append(element("p", {className: "verdict"}, typeset(data.verdict)));
  head.append(element("p", {className: "faint"},
    `nlcwfs ${data.command}, version ${data.version}; the run's summary is of ${data.written}.`));
  if (data.summary.interrupted) {
    head.append(element("p", {className: "note"},
      "The run was interrupted: the results are of what was done by then."));
  }
  for (const note of data.notes) head.append(element("p", {className: "note"}, note));
}

function showConfigurations() {
  const design = data.design_configuration;
  if (design) {
    section(`Configuration of ${page.end}`, (part) => part.append(
      element("p", {}, `As it is in ${design.file}: `,
        element("code", {}, `nlcwfs evaluate --config ${design.file}`), " tries it."),
      copyable(withoutComments(design.text))));
  }
  if (data.configuration) {
    section("Configuration of the run", (part) => part.append(
      element("p", {}, "Every key with its value: ", element("code", {}, "--config config.cfg"),
        " repeats the run."),
      folded("config.cfg", copyable(data.configuration))));
  }
}

/** Without comments and the sections that have nothing else. */
function withoutComments(text) {
  const lines = text.split("\n").filter((line) => line && !line.startsWith("#"));
  const isHead = (line) => line === undefined || line.startsWith("[");
  return lines.filter((line, i) => !(isHead(line) && isHead(lines[i + 1])))
    .map((line, i) => (isHead(line) && i > 0 ? `\n${line}` : line)).join("\n") + "\n";
}

document.documentElement.dataset.theme = themeName();
showHead();
attempt(sections, () => page.show(data.summary));
showConfigurations();
