// A chart: Plotly redraws it in the same element, so that zoom and hidden lines stay.
//
// `data` is JSON in UTF-8: key, chart (data, layout, frames), config, alt, and the
// addresses of Plotly and of move.js.

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
  const chart = { element, wanted: null, drawing: null, ranges: [] };
  chart.follow = (figure) => {
    chart.followed = true;
    chart.wanted = { ...chart.given, chart: figure };
    return draw(chart);
  };
  chart.settle = () => {
    if (!chart.followed) return;
    chart.followed = false;
    chart.wanted = chart.given;
    draw(chart);
  };
  chart.resizing = new ResizeObserver(() => {
    if (element.data && element.offsetParent) window.Plotly.Plots.resize(element);
  });
  chart.resizing.observe(parent);
  charts.set(parent, chart);
  return chart;
}

// Plotly keeps a zoom only where it is given the range that stood before.
function keepZoom(chart, { layout }) {
  for (const [name, range] of chart.ranges) {
    const zoomed = JSON.stringify(chart.element.layout[name]?.range) !== JSON.stringify(range);
    if (zoomed && layout[name]) layout[name].range = [...range];
  }
  const axes = Object.entries(layout).filter(([, axis]) => axis?.range);
  chart.ranges = axes.map(([name, { range }]) => [name, [...range]]);
}

// While it follows a held thumb a picture is moved, where it can be.
async function redraw(Plotly, chart, figure, { config, mover }) {
  const { move } = await import(location.origin + mover);
  const moved = chart.followed && chart.shown && move(chart.element, chart.shown, figure);
  if (!moved) {
    const copy = structuredClone(figure); // Plotly writes into what it is given
    keepZoom(chart, copy);
    await Plotly.react(chart.element, { ...copy, config });
  }
  chart.shown = figure;
}

// Draws what is wanted last; what came while it drew is drawn next, and what lies between never.
function draw(chart) {
  chart.drawing ??= drawn(chart).finally(() => {
    chart.drawing = null;
  });
  return chart.drawing;
}

async function drawn(chart) {
  window.rotorcalcDrawing += 1;
  try {
    while (chart.wanted) {
      const { chart: figure, ...settings } = chart.wanted;
      chart.wanted = null;
      await redraw(await plotly(settings.plotly), chart, figure, settings);
      chart.element.dataset.drawn = Number(chart.element.dataset.drawn ?? 0) + 1;
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
  chart.wanted = chart.given;
  const { key, alt, chart: figure } = chart.given;
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
