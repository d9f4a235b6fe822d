// A chart: Plotly redraws it in the same element, which keeps zoom and hidden lines.
//
// `data` is JSON in UTF-8: key, chart (data, layout, frames), config, alt, presenting, and the
// addresses of the scripts: Plotly, move.js, contour.js, cursor.js, drawing.js.
//
// A trace whose `meta.envelope` is a number is a long signal: see `envelop`.
//
// The chart is as high as the window allows. A button shows it alone on the whole screen. There, and in a
// presentation, type and lines are larger. `layout.meta.whole` has what an overview leaves out, and the screen shows;
// `layout.meta.cursor` is for cursor.js.

const STYLE = `
.live-view {position: relative; background: var(--st-background-color);}
.live-view > button {position: absolute; z-index: 3; top: 0; right: 0; width: 1.75rem; height: 1.75rem; padding: 0; border: 0;
  border-radius: var(--st-base-radius); background: none; color: var(--st-text-color); font-size: 1rem; cursor: pointer;}
.live-view > button:is(:hover, :focus-visible) {background: var(--st-secondary-background-color);}
.live-view > button:focus-visible {outline: 2px solid var(--st-primary-color);}
.live-view:fullscreen {padding: 1rem 1.5rem;}
.live-view:fullscreen .live-chart {height: calc(100vh - 2rem) !important;}
.live-view .modebar {right: 2rem !important;}
/* On a phone it would lie over the legend: a double tap ends a zoom, and the full screen has it. */
@media (max-width: 640px) {.live-view:not(:fullscreen) .modebar {display: none;}}
.live-view :is(.annotation-text, .textpoint text) {paint-order: stroke; stroke: var(--st-background-color); stroke-width: 4px;
  stroke-linejoin: round;}
`;
const CORNERS = `<svg viewBox="0 0 16 16" width="16" height="16" fill="none" stroke="currentColor" stroke-width="1.6">
  <path d="M2 6V2h4M10 2h4v4M14 10v4h-4M6 14H2v-4"/></svg>`;
// Type for the last row of a lecture hall, over type for a desk: 20 px in a window of 1440 × 900, in proportion
// in others, as a projector shows them at one size, and 16 px at least.
const large = () => Math.min(2, Math.max(8 / 7, Math.min(innerWidth / 1008, innerHeight / 630)));

// Height of a window [px] in which a presentation's legend would leave no room for the plot: the full screen has it.
const LOW = 700;

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

// Plotly measures texts as it draws them: in another font than they end in, they stand beside their place.
let lettering; // the fonts are asked for once per page: a held slider draws many charts
function fonts(view) {
  const load = (style) => document.fonts.load(`${style}1em ${getComputedStyle(view).fontFamily}`);
  lettering ??= Promise.allSettled(["", "italic "].map(load));
  return lettering;
}

async function tools(scripts) {
  const [{ move, numbers }, contour, cursor, drawing] = await Promise.all(
    ["move", "contour", "cursor", "drawing"].map((name) => import(location.origin + scripts[name])));
  return { move: (gd, before, now) => move(gd, before, now, contour), numbers, cursor, drawing };
}

const charts = new WeakMap();

function screenButton(view) {
  const button = Object.assign(document.createElement("button"), { type: "button", innerHTML: CORNERS });
  button.ariaLabel = button.title = "Full screen";
  button.addEventListener("click", () => (document.fullscreenElement ? document.exitFullscreen() : view.requestFullscreen()));
  return button;
}

function made(parent) {
  const view = document.createElement("div");
  const element = document.createElement("div");
  view.className = "live-view";
  element.className = "live-chart";
  element.setAttribute("role", "figure");
  view.append(element);
  parent.replaceChildren(view);
  const chart = { view, element, wanted: null, shown: null, drawing: null, ranges: [] };
  if (document.fullscreenEnabled) view.prepend(screenButton(view));
  view.addEventListener("fullscreenchange", () => draw(chart, chart.shown));
  chart.preview = (figure) => draw(chart, { ...chart.given, chart: unfolded(figure, chart.given.presenting) });
  chart.settle = () => chart.shown !== chart.given && draw(chart, chart.given);
  chart.resizing = new ResizeObserver(() => {
    if (!element.data || !element.offsetParent) return;
    if (chart.type && chart.type !== large()) {
      draw(chart, chart.shown);
      return;
    }
    window.rotorcalcDrawing += 1; // Plotly waits a tenth of a second
    window.Plotly.Plots.resize(element).catch(() => {}).finally(() => {
      chart.tools?.cursor.placed(chart);
      window.rotorcalcDrawing -= 1;
    });
  });
  chart.resizing.observe(element);
  charts.set(parent, chart);
  return chart;
}

function differ(a, b) {
  return JSON.stringify(a) !== JSON.stringify(b);
}

// Plotly keeps a zoom only if it is given the same range as before.
function keepZoom(chart, { layout }) {
  for (const [name, range] of chart.ranges) {
    if (!layout[name] || !differ(chart.element.layout[name]?.range, range)) continue;
    Object.assign(layout[name], { range: [...range], tickmode: "auto" });
    for (const ticks of ["dtick", "tick0", "tickvals", "ticktext"]) delete layout[name][ticks];
  }
  const axes = Object.entries(layout).filter(([, axis]) => axis?.range);
  chart.ranges = axes.map(([name, { range }]) => [name, [...range]]);
}

function times(factor, holder, names) {
  for (const name of names) {
    if (typeof holder?.[name] === "number") holder[name] *= factor;
    else if (Array.isArray(holder?.[name])) holder[name] = holder[name].map((one) => factor * one);
  }
}

// Enlarges type by a factor, to 16 px at least.
function type(factor, font) {
  times(factor, font, ["size"]);
  if (typeof font?.size === "number") font.size = Math.max(16, font.size);
  else if (Array.isArray(font?.size)) font.size = font.size.map((one) => Math.max(16, one));
}

// Enlarges type by a factor, with what must have room for it, and lines and marks by half of that.
function enlarge({ data, layout }, factor) {
  const half = (1 + factor) / 2;
  type(factor, layout.font);
  times(factor, layout.margin, ["l", "r"]);
  times(half, layout.margin, ["t"]);
  times(layout.sliders ? 1 : factor, layout.margin, ["b"]); // Plotly makes room for what a slider needs
  times(factor, layout.legend, ["itemwidth"]);
  if (layout.legend?.entrywidthmode !== "fraction") times(factor, layout.legend, ["entrywidth"]);
  for (const note of layout.annotations ?? []) {
    type(factor, note.font);
    times(factor, note, ["xshift", "yshift"]);
    times(half, note, ["arrowwidth"]);
  }
  for (const control of [...(layout.sliders ?? []), ...(layout.updatemenus ?? [])]) {
    times(factor, control.pad, ["b", "l", "r"]);
    times(half, control.pad, ["t"]); // ticks and title of an axis
    type(factor, control.font);
    type(factor, control.currentvalue?.font);
  }
  for (const [name, axis] of Object.entries(layout)) {
    if (!name.includes("axis") || !axis.title) continue;
    type(factor, axis.tickfont);
    axis.title.font = { size: layout.font.size }; // Plotly's own is larger still, and longer than a low axis
    times(factor, axis.title, ["standoff"]);
  }
  for (const trace of data) {
    type(factor, trace.textfont);
    times(half, trace.line, ["width"]);
    times(half, trace.marker, ["size"]);
    times(half, trace.marker?.line, ["width"]);
    times(half, trace.marker?.colorbar ?? trace.colorbar, ["thickness"]);
  }
}

// The part of the x axis that is seen, where it is zoomed, else all of it.
function visible(chart, { xaxis }) {
  const given = new Map(chart.ranges).get("xaxis");
  const now = chart.element.layout?.xaxis?.range;
  return given && now && differ(now, given) ? now : xaxis?.range;
}

// Draws a long signal as its envelope, where one of its swings would take less than six pixels: the band between
// the least and the largest value of each swing. Zoomed in it is drawn itself. It names how many points a swing has.
function envelop(trace, [low, high], width, { numbers }) {
  const swing = trace.meta?.envelope;
  if (!swing) return;
  const [xs, ys] = [numbers(trace.x), numbers(trace.y)];
  const inside = xs.filter((x) => x >= low && x <= high).length;
  if (6 * inside <= swing * width) return;
  const columns = Array.from({ length: Math.min(Math.floor(inside / swing), Math.ceil(width)) }, () => [Infinity, -Infinity]);
  xs.forEach((x, k) => {
    const column = columns[Math.min(Math.floor(((x - low) / (high - low)) * columns.length), columns.length - 1)];
    if (!column || !Number.isFinite(ys[k])) return;
    column[0] = Math.min(column[0], ys[k]);
    column[1] = Math.max(column[1], ys[k]);
  });
  const places = columns.map((column, k) => [low + ((k + 0.5) / columns.length) * (high - low), ...column]).filter(([, least]) => least < Infinity);
  const back = [...places].reverse();
  Object.assign(trace, {
    x: [...places, ...back].map(([x]) => x),
    y: [...places.map(([, least]) => least), ...back.map(([, , largest]) => largest)],
    fill: "toself", fillcolor: `${trace.line.color}66`, line: { ...trace.line, width: 1, dash: "solid" },
  });
}

async function redrawn(Plotly, chart, { chart: figure, config, presenting }) {
  const whole = document.fullscreenElement === chart.view;
  const copy = structuredClone(unfolded(figure, whole)); // Plotly writes into what it is given
  chart.type = whole || presenting ? large() : null; // in another window it is drawn anew
  if (chart.type) enlarge(copy, chart.type);
  if (presenting && !whole && innerHeight < LOW) copy.layout.showlegend = false;
  delete copy.layout.height; // the element's
  delete copy.layout.meta; // not Plotly's
  const seen = visible(chart, copy.layout);
  if (seen) for (const trace of copy.data) envelop(trace, seen, chart.element.clientWidth, chart.tools);
  keepZoom(chart, copy);
  fit(chart); // what stands above has its fonts by now
  await Plotly.react(chart.element, { ...copy, config });
  if (!chart.listens) chart.element.on("plotly_relayout", (changed) => zoomed(chart, changed));
  chart.listens = true;
  delete chart.element.dataset.moved;
  chart.tools.cursor.drawn(chart, figure, chart.tools);
}

// Draws the ticks that suit a zoom, or those of the whole axis again.
function zoomed(chart, changed) {
  if (Object.keys(changed).some((name) => /axis\d*\.(auto)?range/.test(name))) draw(chart, chart.shown);
}

// Returns a figure with what an overview leaves out, where that is shown.
function unfolded(figure, whole) {
  return whole ? { ...figure, layout: { ...figure.layout, ...figure.layout.meta?.whole } } : figure;
}

// High as the window allows: in a presentation it fills what lies below its place, but for a line of words. At a desk
// one that begins in the upper half ends above the fold, where it keeps most of its height.
function fitted(view, { data, layout: { height, yaxis, showlegend } }, presenting) {
  const main = view.closest('[data-testid="stMain"]');
  const top = Math.ceil(view.getBoundingClientRect().top + (main?.scrollTop ?? 0));
  const room = `100vh - ${top}px`;
  // Of words at ticks each needs its row.
  const rows = 22 * large() * (yaxis?.ticktext?.length ?? 0) + 150;
  // So does each name of a legend on a phone, below or above a plot that can be read.
  const names = showlegend === false || view.clientWidth > 480 ? 0 : data.filter((trace) => trace.showlegend !== false).length;
  const least = names > 3 ? 23 * names + 330 : 0;
  // At a lecture's desk too.
  if (presenting || view.closest(".st-key-lecture_view"))
    return `max(${least}px, var(--chart-least, max(340px, ${rows}px)), ${room} - var(--below-chart, 2.4rem))`;
  const usual = `clamp(${0.8 * height}px, calc((100vh - 306px) * ${height / 600}), ${1.5 * height}px)`;
  return top > innerHeight / 2 ? usual : `min(${usual}, max(${0.7 * height}px, ${room} - 0.5rem))`;
}

function fit({ element, view, given: { chart, presenting } }) {
  element.style.height = fitted(view, chart, presenting);
}

// Moves the existing SVG where possible, and lets Plotly draw the chart after a pause: hovering, zooming and
// saving use Plotly's own data, not the SVG.
async function redraw(chart, wanted) {
  const { shown } = chart;
  clearTimeout(chart.due);
  const [Plotly] = await Promise.all([plotly(wanted.plotly), fonts(chart.view)]);
  chart.tools ??= await tools(wanted.scripts);
  const { cursor, move } = chart.tools;
  cursor.rested(chart);
  chart.shown = wanted;
  if (wanted === shown || !shown || differ(shown.config, wanted.config) || shown.presenting !== wanted.presenting || !move(chart.element, shown.chart, wanted.chart)) {
    await redrawn(Plotly, chart, wanted);
  } else {
    chart.element.dataset.moved = "";
    finish(chart);
  }
}

// Draws a moved chart after a pause: while a slider waits for its answer, Plotly would delay that.
function finish(chart) {
  chart.due = setTimeout(() => (document.querySelector(".live-slider[data-busy]") ? finish(chart) : draw(chart, chart.shown)), WHILE);
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
  if (!document.getElementById("live-chart-style")) {
    const style = Object.assign(document.createElement("style"), { id: "live-chart-style" });
    style.textContent = STYLE;
    document.head.append(style);
  }
  const chart = charts.get(parentElement) ?? made(parentElement);
  chart.given = JSON.parse(new TextDecoder().decode(data));
  const { key, alt, presenting } = chart.given;
  chart.given.chart = unfolded(chart.given.chart, presenting);
  window.rotorcalcCharts.set(key, chart);
  chart.element.setAttribute("aria-label", alt);
  fit(chart);
  draw(chart, chart.given);
  return () => {
    clearTimeout(chart.due);
    if (window.rotorcalcCharts.get(key) === chart) window.rotorcalcCharts.delete(key);
    chart.resizing.disconnect();
    chart.tools?.cursor.removed(chart);
    charts.delete(parentElement);
    window.Plotly?.purge(chart.element);
  };
}
