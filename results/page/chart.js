// Charts that follow the page's colours, and the paper when the page is printed.

/** Distinct for the colour-blind (Okabe & Ito 2008), the first ones as clear as can be on each ground. */
const themes = {
  light: {back: "#ffffff", text: "#1b1f24", faint: "#8a939d", grid: "#e3e6ea",
    lines: ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"]},
  dark: {back: "#14181d", text: "#e6e9ed", faint: "#8a939d", grid: "#333a42",
    lines: ["#56b4e9", "#e69f00", "#009e73", "#cc79a7", "#d55e00", "#f0e442"]},
};

const darkness = matchMedia("(prefers-color-scheme: dark)");
let chosenTheme = "auto";
let isPrinting = false;

function themeName() {
  if (isPrinting) return "light";
  if (chosenTheme !== "auto") return chosenTheme;
  return darkness.matches ? "dark" : "light";
}

const charts = [];
/** What a sheet of A4 or letter has between its margins, in CSS pixels. */
const printedWidth = 680;

function axisStyle(theme, axis = {}) {
  return {color: theme.text, gridcolor: theme.grid, zerolinecolor: theme.grid, linecolor: theme.faint,
    automargin: true, ticks: "outside", tickcolor: theme.faint, exponentformat: "power",
    minexponent: 5, ...axis,
    title: {standoff: 8, ...axis.title}};
}

function layoutOf(chart, layout, theme) {
  const styled = {
    font: {family: "system-ui, sans-serif", size: 12, color: theme.text},
    paper_bgcolor: theme.back, plot_bgcolor: theme.back,
    margin: {l: 50, r: 16, t: 10, b: 44}, hovermode: "closest",
    // A finger on a chart moves the page.
    dragmode: matchMedia("(pointer: coarse)").matches ? false : "zoom",
    legend: {orientation: "h", x: 0, xanchor: "left", y: 1.02, yanchor: "bottom"},
    height: chart.height, autosize: true, ...layout,
  };
  for (const name of Object.keys(styled)) {
    if (/^[xy]axis\d*$/.test(name)) styled[name] = axisStyle(theme, styled[name]);
  }
  return styled;
}

function draw(chart) {
  const theme = themes[themeName()];
  const {data, layout} = chart.build(theme);
  const styled = layoutOf(chart, layout, theme);
  if (isPrinting) {
    const columns = chart.node.closest(".small") ? 3 : chart.node.closest(".side-by-side") ? 2 : 1;
    Object.assign(styled, {autosize: false, width: printedWidth / columns - 20,
      height: columns === 3 ? 260 : styled.height});
  }
  Plotly.react(chart.node, data, styled, {
    displaylogo: false, displayModeBar: matchMedia("(hover: hover)").matches ? "hover" : false,
    modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d"],
    toImageButtonOptions: {format: "svg"},
  });
}

/** Charts follow the room that they have, which others that come after them can change. */
const sizes = new ResizeObserver((entries) => {
  if (isPrinting) return;
  for (const {target} of entries) {
    if (target.clientWidth > 0 && target.clientWidth !== target._fullLayout?.width) {
      Plotly.Plots.resize(target);
    }
  }
});

/**
 * A chart with a caption.
 * @param build  gives {data, layout} for Plotly, in the colours of a theme
 * @return       {node, redraw}
 */
function chart(parent, caption, build, height = 380) {
  const made = {node: element("div", {className: "chart"}), build, height};
  made.redraw = () => draw(made);
  const figure = element("figure", {}, made.node);
  if (caption) figure.append(element("figcaption", {}, caption));
  parent.append(figure);
  charts.push(made);
  draw(made);
  sizes.observe(made.node);
  return made;
}

/** Forgets the charts of a part of the page that is removed. */
function clear(parent) {
  for (let i = charts.length; i-- > 0;) {
    if (!parent.contains(charts[i].node)) continue;
    sizes.unobserve(charts[i].node);
    Plotly.purge(charts[i].node);
    charts.splice(i, 1);
  }
  parent.replaceChildren();
}

function applyTheme() {
  document.documentElement.dataset.theme = themeName();
  for (const one of charts) draw(one);
}

darkness.addEventListener("change", applyTheme);
for (const [event, printing] of [["beforeprint", true], ["afterprint", false]]) {
  addEventListener(event, () => {
    isPrinting = printing;
    applyTheme();
  });
}

/** Follows the system, or is light or dark. */
function themeSwitch() {
  const button = element("button", {id: "theme", type: "button"});
  const names = {auto: "Colours: system", light: "Colours: light", dark: "Colours: dark"};
  const next = {auto: "light", light: "dark", dark: "auto"};
  const show = () => (button.textContent = names[chosenTheme]);
  button.addEventListener("click", () => {
    chosenTheme = next[chosenTheme];
    show();
    applyTheme();
  });
  show();
  return button;
}

// Scales --------------------------------------------------------------------------------------

/** Whether values reach so far that only a logarithmic scale shows all of them. */
function isWide(values) {
  const finite = values.filter((value) => Number.isFinite(value) && value !== null);
  const least = Math.min(...finite);
  return finite.length > 0 && least > 0 && Math.max(...finite) > 5 * least;
}

/** Whether an axis' values are evenly spaced in the logarithm rather than as they are. */
function isLogarithmic(values) {
  if (values.length < 3 || !values.every((value) => value > 0)) return false;
  const spread = (scaled) => {
    const steps = scaled.slice(1).map((value, i) => value - scaled[i]);
    const mean = steps.reduce((sum, step) => sum + step, 0) / steps.length;
    return Math.max(...steps.map((step) => Math.abs(step / mean - 1)));
  };
  return spread(values.map(Math.log)) < spread(values);
}

/** 1, 2, 5, 10, ... within a range, or other steps of each decade. */
function roundNumbers(least, greatest, steps = [1, 2, 5]) {
  const numbers = [];
  for (let power = Math.floor(Math.log10(least)); power <= Math.log10(greatest); ++power) {
    for (const step of steps) {
      const number = step * 10 ** power;
      if (number >= least * 0.999 && number <= greatest * 1.001) numbers.push(number);
    }
  }
  return numbers;
}

/** A linear axis, or a logarithmic one with round numbers on it. */
function scale(isLog, values) {
  const positive = values.filter((value) => value > 0);
  if (!isLog || positive.length === 0) return {type: isLog ? "log" : "linear"};
  const [least, greatest] = [Math.min(...positive), Math.max(...positive)];
  if (greatest < 3 * least) return {type: "log"};
  const decades = Math.log10(greatest / least);
  if (decades > 8) return {type: "log", dtick: Math.ceil(decades / 8)};
  // Beyond the values too: bars of errors may reach there.
  const numbers = roundNumbers(least / 10, 10 * greatest,
    decades > 2.5 ? [1] : decades > 1 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 7]);
  return {type: "log", tickvals: numbers, ticktext: numbers.map((number) => digits(number))};
}

/** An axis with its title, logarithmic where its values are given. */
function axis(title, values) {
  return {title: {text: title}, ...(values ? scale(true, values) : {})};
}

/** Error bars of a trace. */
function errorBars(errors) {
  return {type: "data", array: errors, thickness: 1.2, width: 3};
}
