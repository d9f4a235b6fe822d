// A chart: Plotly redraws it in the same element, so that zoom and hidden lines stay.
//
// `data` is JSON in UTF-8: key, chart (data, layout, frames), config, alt, and Plotly's address.

const FAILED = "This chart could not be drawn: Plotly's script did not load. Reload the page.";
// How many charts are being drawn: sliders wait for them.
window.rotorcalcDrawing ??= 0;
// Charts by key, for the feed.
window.rotorcalcCharts ??= new Map();

let loading; // one script a page
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
  const chart = { element, wanted: null, busy: false };
  chart.follow = (figure) => {
    chart.followed = true;
    chart.wanted = { ...JSON.parse(chart.given), chart: figure };
    draw(chart);
  };
  chart.settle = () => {
    if (!chart.followed) return;
    chart.followed = false;
    chart.wanted = JSON.parse(chart.given);
    draw(chart);
  };
  chart.resizing = new ResizeObserver(() => {
    if (element.data && element.offsetParent) window.Plotly.Plots.resize(element);
  });
  chart.resizing.observe(parent);
  charts.set(parent, chart);
  return chart;
}

// Everything of a figure but its lines' and points' places.
function frameOf({ data, layout, frames }, config) {
  if (frames || data.some((trace) => trace.type !== "scatter" || trace.fill?.startsWith("ton"))) return null;
  return JSON.stringify([layout, config, data.map(({ x, y, ...rest }) => rest)]);
}

const AT_ONCE = { mode: "immediate", frame: { duration: 0, redraw: false }, transition: { duration: 0 } };

// Moves lines and points where nothing else has changed, a third of the work of a new drawing.
async function redraw(Plotly, chart, figure, config) {
  const frame = frameOf(figure, config);
  const places = figure.data.map(({ x, y }) => JSON.stringify([x, y]));
  if (frame && frame === chart.frame) {
    const traces = places.flatMap((place, i) => (place === chart.places[i] ? [] : [i]));
    if (traces.length > 0) {
      const data = traces.map((i) => ({ x: figure.data[i].x, y: figure.data[i].y }));
      await Plotly.animate(chart.element, { data, traces }, AT_ONCE);
    }
  } else {
    await Plotly.react(chart.element, { ...figure, config });
  }
  Object.assign(chart, { frame, places });
}

// Draws what is wanted last; what came while it drew is drawn next, and what lies between never.
async function draw(chart) {
  if (chart.busy) return;
  chart.busy = true;
  window.rotorcalcDrawing += 1;
  try {
    while (chart.wanted) {
      const { chart: figure, config, plotly: address } = chart.wanted;
      chart.wanted = null;
      const Plotly = await plotly(address);
      await redraw(Plotly, chart, figure, config);
      chart.element.dataset.drawn = Number(chart.element.dataset.drawn ?? 0) + 1;
    }
  } catch (error) {
    chart.element.setAttribute("role", "alert");
    chart.element.textContent = error.message;
  } finally {
    chart.busy = false;
    window.rotorcalcDrawing -= 1;
  }
}

export default function ({ data, parentElement }) {
  const chart = charts.get(parentElement) ?? made(parentElement);
  // As text: Plotly writes into what it is given, and would take its own writing for ours.
  chart.given = new TextDecoder().decode(data);
  chart.wanted = JSON.parse(chart.given);
  const { key, alt, chart: figure } = chart.wanted;
  window.rotorcalcCharts.set(key, chart);
  chart.element.setAttribute("aria-label", alt);
  chart.element.style.height = `${figure.layout.height}px`;
  draw(chart);
  return () => {
    if (window.rotorcalcCharts.get(key) === chart) window.rotorcalcCharts.delete(key);
    chart.resizing.disconnect();
    charts.delete(parentElement);
    window.Plotly?.purge(chart.element);
  };
}
