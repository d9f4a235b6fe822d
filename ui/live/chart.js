// A chart: Plotly redraws it in the same element, which keeps zoom and hidden lines.
//
// `data` is JSON in UTF-8: key, chart (data, layout, frames), config, alt, and the
// addresses of Plotly and of move.js.

const FAILED = "This chart could not be drawn: Plotly's script did not load. Reload the page.";
// Milliseconds without a change after which Plotly draws a moved chart.
const WHILE = 300;
// Number of charts being drawn: sliders wait for them.
window.rotorcalcDrawing ??= 0;
// Charts by key, for the preview.
window.rotorcalcCharts ??= new Map();

let loading; // the script is loaded once per page
function plotly(address) {
  if (window.Plotly) return Promise.resolve(window.Plotly);
  loading ??= new Promise((resolve, reject) => {
    const script = document.createElement("script");
    script.src = address;
    script.onload = () => resolve(window.Plotly);
    script.onerror = () => {
      loading = undefined;
      script.remove();
      reject(new Error(FAILED));
    };
    document.head.append(script);
  });
  return loading;
}

const charts = new WeakMap();

function made(parent) {
  const element = document.createElement("div");
  element.className = "live-chart";
  element.setAttribute("role", "figure");
  parent.replaceChildren(element);
  const chart = { element, wanted: null, shown: null, drawing: null, ranges: [] };
  chart.preview = (figure) => draw(chart, { ...chart.given, chart: figure });
  chart.settle = () => chart.shown !== chart.given && draw(chart, chart.given);
  chart.resizing = new ResizeObserver(() => {
    if (element.data && element.offsetParent) window.Plotly.Plots.resize(element);
  });
  chart.resizing.observe(parent);
  charts.set(parent, chart);
  return chart;
}

function differ(a, b) {
  return JSON.stringify(a) !== JSON.stringify(b);
}

// Plotly keeps a zoom only if it is given the same range as before.
function keepZoom(chart, { layout }) {
  for (const [name, range] of chart.ranges) {
    if (layout[name] && differ(chart.element.layout[name]?.range, range)) layout[name].range = [...range];
  }
  const axes = Object.entries(layout).filter(([, axis]) => axis?.range);
  chart.ranges = axes.map(([name, { range }]) => [name, [...range]]);
}

async function redrawn(Plotly, chart, { chart: figure, config }) {
  const copy = structuredClone(figure); // Plotly writes into what it is given
  keepZoom(chart, copy);
  await Plotly.react(chart.element, { ...copy, config });
  delete chart.element.dataset.moved;
}

// Moves the existing SVG where possible, and lets Plotly draw the chart after a pause: hovering, zooming and
// saving use Plotly's own data, not the SVG.
async function redraw(chart, wanted) {
  const { shown } = chart;
  clearTimeout(chart.due);
  const [Plotly, { move }] = await Promise.all([plotly(wanted.plotly), import(location.origin + wanted.mover)]);
  chart.shown = wanted;
  if (wanted === shown || !shown || differ(shown.config, wanted.config) || !move(chart.element, shown.chart, wanted.chart)) {
    await redrawn(Plotly, chart, wanted);
  } else {
    chart.element.dataset.moved = "";
    chart.due = setTimeout(() => draw(chart, chart.shown), WHILE);
  }
}

// Draws the latest figure. Of those that arrive meanwhile only the last is drawn: a slow browser skips figures
// instead of falling behind.
function draw(chart, wanted) {
  chart.wanted = wanted;
  chart.drawing ??= drawn(chart).finally(() => {
    chart.drawing = null;
  });
  return chart.drawing;
}

async function drawn(chart) {
  window.rotorcalcDrawing += 1;
  try {
    while (chart.wanted) {
      const { wanted, shown } = chart;
      chart.wanted = null;
      await redraw(chart, wanted);
      if (wanted !== shown) chart.element.dataset.drawn = Number(chart.element.dataset.drawn ?? 0) + 1;
    }
  } catch (error) {
    chart.element.setAttribute("role", "alert");
    chart.element.textContent = error.message;
  } finally {
    window.rotorcalcDrawing -= 1;
  }
}

export default function ({ data, parentElement }) {
  const chart = charts.get(parentElement) ?? made(parentElement);
  chart.given = JSON.parse(new TextDecoder().decode(data));
  const { key, alt, chart: figure } = chart.given;
  window.rotorcalcCharts.set(key, chart);
  chart.element.setAttribute("aria-label", alt);
  chart.element.style.height = `${figure.layout.height}px`;
  draw(chart, chart.given);
  return () => {
    clearTimeout(chart.due);
    if (window.rotorcalcCharts.get(key) === chart) window.rotorcalcCharts.delete(key);
    chart.resizing.disconnect();
    charts.delete(parentElement);
    window.Plotly?.purge(chart.element);
  };
}
