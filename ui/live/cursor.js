// The cursor: one value, of the running speed or of a motion's time, marked in every chart of the page that knows it.
//
// It is the value under the pointer, at the stop of an animation's slider, or that of a play button or an arrow key. A
// chart's `layout.meta.cursor` says how the chart shows a value: by a line across an axis, by a point on a line, by
// the nearest frame of its animation, by drawing its drawing anew, or by another chart that is asked of the server
// (rotorcalc/figures/cursor.py). Else the server takes no part.

const STYLE = `
.live-cursor {position: absolute; inset: 0; z-index: 2; pointer-events: none;}
.live-cursor > .mark {position: absolute; left: 0; top: 0; visibility: hidden; background: var(--st-text-color);}
.live-cursor > .dot {width: 12px; height: 12px; margin: -6px; border-radius: 50%; outline: 2px solid var(--st-background-color);}
.live-cursor > .label {padding: 0 0.35em; border-radius: 0.25em; line-height: 1.3; white-space: nowrap;
  color: var(--st-background-color);}
.live-cursor > .keys {position: absolute;}
.live-cursor > .keys:focus-visible {outline: 2px solid var(--st-primary-color); outline-offset: 2px;}
.live-view > .live-play {right: 1.9rem;}
.live-view > .live-animate {top: 2rem; width: auto; padding: 0 0.5rem; font-size: 0.875rem;
  border: 1px solid color-mix(in srgb, var(--st-text-color) 25%, transparent);}
.live-view > .live-animate[aria-pressed=true] {background: var(--st-secondary-background-color);}
.live-slowed {font-size: 0.875rem; line-height: 1.3;}
.live-view:has(> .live-play:not([hidden])) .modebar {right: 4rem !important;}
`;
// Milliseconds in which a play button goes through all values; an arrow key's steps through them, and with Shift.
const PLAYED = 8000;
const [STEPS, FINE] = [100, 1000];
const BELOW_BUTTONS = 28; // pixels from the top of a chart
const [PLAY, STOP] = ["M4 2v12l9-6z", "M4 2h3v12H4zM9 2h3v12H9z"].map(
  (path) => `<svg viewBox="0 0 16 16" width="14" height="14" fill="currentColor"><path d="${path}"/></svg>`);
const STILL = { mode: "immediate", frame: { duration: 0, redraw: false }, transition: { duration: 0 } };

const views = new Map();
let marked = null; // the value: its quantity, number, and the view that it comes from
let playing = null; // the view whose play button runs
let due = 0;

// An array as the server sends it, decoded: nested lists and objects too.
export function decoded(item, numbers) {
  if (item?.bdata) return Array.from(numbers(item));
  if (Array.isArray(item)) return item.map((one) => decoded(one, numbers));
  if (item === null || typeof item !== "object") return item;
  return Object.fromEntries(Object.entries(item).map(([key, one]) => [key, decoded(one, numbers)]));
}

// Of a rising list, the place of a value as an index with a fraction; undefined outside.
export function placeIn(list, value) {
  const after = list.findIndex((one) => one >= value);
  if (after < 0 || list[0] > value) return undefined;
  return after && after - (list[after] - value) / (list[after] - list[after - 1]);
}

// The item of a list at such a place.
export function itemAt(list, place) {
  const low = Math.floor(place);
  return low === place ? list[low] : list[low] + (list[low + 1] - list[low]) * (place - low);
}

export function nearest(list, value) {
  return list.reduce((best, one, i) => (Math.abs(one - value) < Math.abs(list[best] - value) ? i : best), 0);
}

function draw() {
  due = 0;
  for (const view of views.values()) {
    if (marked && view.cursor?.quantity === marked.quantity && view.isStill) view.show(marked.value);
    else view.hide();
  }
}

function mark(view, value) {
  marked = { quantity: view.cursor.quantity, value, view };
  due ||= requestAnimationFrame(draw);
}

// Marks nothing any more, or nothing that came from a view.
function clear(view) {
  if (!marked || (view && marked.view !== view) || playing) return;
  marked = null;
  due ||= requestAnimationFrame(draw);
}

function stop() {
  const view = playing;
  playing = null;
  view?.name();
  if (view && !view.isHeld) clear();
}

function play(view) {
  stop();
  playing = view;
  const [low, high] = view.ends;
  const from = view.value < high && marked ? Math.max(view.value, low) : low;
  const start = performance.now() - (PLAYED * (from - low)) / (high - low);
  const step = (now) => {
    if (playing !== view) return;
    const share = Math.min(Math.max((now - start) / PLAYED, 0), 1);
    mark(view, low + (high - low) * share);
    if (share < 1) requestAnimationFrame(step);
    else stop();
  };
  view.name();
  requestAnimationFrame(step);
}

// A finger elsewhere, or Escape, ends what it marked.
document.addEventListener("pointerdown", (event) => event.target.closest?.(".live-view") || clear());
document.addEventListener("keydown", (event) => event.key === "Escape" && (stop(), clear()));

// How a chart shows a value: each has its smallest and largest value, shows one, and hides it.
class Line {
  constructor(view) {
    const { axis, at, to } = view.cursor;
    Object.assign(this, { view, letter: axis, at, to });
  }

  get axis() {
    return this.view.gd._fullLayout[`${this.letter}axis`];
  }

  get ends() {
    return this.at ? [this.at[0], this.at.at(-1)] : [...this.axis.range].map(this.axis.r2d).sort((a, b) => a - b);
  }

  // The value at a point of the screen, undefined outside the plot.
  valueAt({ clientX, clientY }) {
    const box = this.view.gd.getBoundingClientRect();
    const { l, t, w, h } = this.view.gd._fullLayout._size;
    const [x, y] = [clientX - box.left, clientY - box.top];
    if (x < l || x > l + w || y < t || y > t + h) return undefined;
    const place = this.axis.p2d((this.letter === "x" ? x : y) - this.axis._offset);
    return this.at ? this.at[nearest(this.to, place)] : place;
  }

  show(value) {
    const { view, axis, letter } = this;
    const { l, t, w, h } = view.gd._fullLayout._size;
    const where = this.at ? placeIn(this.at, value) : undefined;
    const place = axis.d2p(this.at ? (where === undefined ? NaN : itemAt(this.to, where)) : value);
    if (!(place >= 0 && place <= axis._length)) return view.unmark();
    const pixel = axis._offset + place;
    const across = letter === "x" ? [1.5, h, pixel - 0.75, t] : [w, 1.5, l, pixel - 0.75];
    view.put("line", ...across);
    view.say(value, letter === "x" ? [pixel, Math.max(t + 2, BELOW_BUTTONS)] : [l + w, pixel]);
  }
}

// A point on a line of the chart, whose points have their value.
class Along {
  constructor(view) {
    const line = view.gd._fullData.find(({ name, customdata }) => name === view.cursor.along && customdata);
    Object.assign(this, { view, line });
    this.values = Array.from(line?.customdata ?? [], (one) => one.length ? one[0] : one);
  }

  get ends() {
    return [this.values[0], this.values.at(-1)];
  }

  show(value) {
    const { view, line } = this;
    const place = placeIn(this.values, value);
    const axes = ["x", "y"].map((letter) => view.gd._fullLayout[`${letter}axis`]);
    if (place === undefined) return view.unmark();
    const [x, y] = axes.map((axis, i) => axis._offset + axis.d2p(itemAt(line[i ? "y" : "x"], place)));
    view.put("dot", 12, 12, x, y);
    view.say(value, [x + 8, y - 24]);
  }
}

// The nearest frame of an animation, whose own slider marks a value too.
class Frames {
  constructor(view) {
    Object.assign(this, { view, at: view.cursor.frames, busy: false });
    this.own = this.stop; // where its own slider was left
  }

  get stop() {
    return this.view.gd.layout?.sliders[0].active;
  }

  get ends() {
    return [this.at[0], this.at.at(-1)];
  }

  show(value) {
    const stop = nearest(this.at, value);
    if (marked.view === this.view) this.own = stop;
    this.move(stop);
  }

  hide() {
    this.move(this.own);
  }

  // Of stops that follow each other faster than Plotly draws, the last is drawn.
  async move(stop) {
    this.wanted = stop;
    if (this.busy || stop === this.stop) return;
    this.busy = true;
    for (let sent; this.view.gd.isConnected && this.wanted !== this.stop && this.wanted !== sent;) {
      sent = this.wanted;
      await window.Plotly.animate(this.view.gd, [`${sent}`], STILL).catch(() => {});
    }
    this.busy = false;
  }
}

// Another chart, from the server.
class Asked {
  constructor(view) {
    this.view = view;
  }

  get ends() {
    return this.view.cursor.asked.ends;
  }

  show() {
    const { view } = this;
    const { l, t } = view.gd._fullLayout._size;
    if (view.shown === undefined) view.unmark();
    else view.say(view.shown, [l, Math.max(t, BELOW_BUTTONS)]);
    ask();
  }

  // While a slider is dragged its preview is shown, and on release the page's own chart.
  hide() {
    const { view } = this;
    if (view.shown === undefined) return;
    view.shown = undefined;
    view.gd.classList.remove("live-unknown");
    if (!isDragging()) view.chart.settle();
  }

  leave() {} // the chart is changed by what was asked
}

const isDragging = () => document.body.classList.contains("rotorcalc-dragging");
let asking = false;

// Asks for the charts of all views that need it, of values that follow each other faster than the answers for the last.
async function ask() {
  if (asking) return;
  asking = true;
  for (let asked; marked && marked.value !== asked && !isDragging();) {
    asked = marked.value;
    const those = [...views.values()].filter((view) => view.cursor?.asked && view.shown !== asked);
    const charts = those.length > 0 && await window.rotorcalcPreview?.charts(
      those[0].cursor.asked.input, Number(asked.toPrecision(6)), those.map(({ chart }) => chart.given.key));
    if (!charts || !marked || isDragging()) break;
    await Promise.all(those.map((view) => view.take(asked, charts[view.chart.given.key])));
    draw();
  }
  asking = false;
}

class View {
  constructor(chart) {
    this.chart = chart;
    this.gd = chart.element;
    this.layer = this.add(chart.view, "live-cursor");
    this.marks = Object.fromEntries(["line", "dot", "label"].map((kind) => [kind, this.add(this.layer, `mark ${kind}`)]));
    this.keys = Object.assign(this.add(this.layer, "keys"), { role: "slider", tabIndex: 0 });
    this.button = Object.assign(document.createElement("button"), { type: "button", className: "live-play" });
    chart.view.append(this.button);
    this.listen();
  }

  add(holder, className) {
    return holder.appendChild(Object.assign(document.createElement("div"), { className }));
  }

  listen() {
    const { view } = this.chart;
    this.button.addEventListener("click", () => (playing === this ? stop() : play(this)));
    view.addEventListener("pointermove", (event) => this.pointed(event));
    view.addEventListener("pointerdown", (event) => event.pointerType !== "mouse" && this.pointed(event));
    view.addEventListener("pointerleave", ({ pointerType }) => pointerType === "mouse" && clear(this));
    this.keys.addEventListener("keydown", (event) => this.pressed(event));
    this.keys.addEventListener("blur", () => clear(this));
    this.gd.on("plotly_hover", ({ points: [point] }) => this.hovered(point));
    this.gd.on("plotly_unhover", () => this.cursor?.along && clear(this));
    this.gd.on("plotly_sliderchange", ({ slider }) => this.scrubbed(slider.active));
    this.gd.on("plotly_buttonclicked", ({ active }) => { if (active === 0) playing = this; });
    for (const end of ["plotly_animated", "plotly_animationinterrupted"])
      this.gd.on(end, () => playing === this && this.button.hidden && stop());
  }

  // Takes over what Plotly has drawn, of a figure.
  drawn(figure, tools) {
    this.cursor = figure.layout.meta?.cursor && decoded(figure.layout.meta.cursor, tools.numbers);
    const { cursor } = this;
    this.ways = [];
    if (cursor?.axis) this.ways.push(new Line(this));
    if (cursor?.frames) this.ways.push(new Frames(this));
    else if (cursor?.along) this.ways.push(new Along(this));
    if (cursor?.drawing) this.ways.push(new tools.drawing.Drawing(this, figure, tools));
    if (cursor?.asked) this.ways.push(new Asked(this));
    if (figure === this.chart.given.chart) this.shown = undefined;
    this.layer.hidden = !cursor;
    this.button.hidden = !cursor || Boolean(this.gd.layout.updatemenus) || Boolean(cursor.frames);
    if (!cursor) return;
    this.place();
    this.name();
    if (marked) due ||= requestAnimationFrame(draw);
  }

  // Puts the layer over the chart, and the keys' outline round its plot.
  place() {
    if (!this.cursor) return;
    const { l, t, w, h } = this.gd._fullLayout._size;
    const { offsetLeft, offsetTop } = this.gd;
    Object.assign(this.layer.style, { left: `${offsetLeft}px`, top: `${offsetTop}px`, fontSize: `${this.gd._fullLayout.font.size}px` });
    Object.assign(this.keys.style, { left: `${l}px`, top: `${t}px`, width: `${w}px`, height: `${h}px` });
  }

  name() {
    const { quantity } = this.cursor;
    const label = playing === this ? `Stop at this ${quantity}` : `Play: ${quantity}, in all charts`;
    const icon = playing === this ? STOP : PLAY;
    if (this.icon !== icon) this.button.innerHTML = this.icon = icon;
    this.button.ariaLabel = this.button.title = label;
    const [low, high] = this.ends;
    Object.assign(this.keys, {
      ariaLabel: `Cursor, ${quantity}`, ariaValueMin: low, ariaValueMax: high, ariaValueNow: this.value,
      ariaValueText: this.text(this.value),
    });
  }

  get ends() {
    return this.ways[0].ends;
  }

  // Where the chart stands: at the cursor, or at its own value.
  get value() {
    return marked?.quantity === this.cursor.quantity ? marked.value : this.cursor.now;
  }

  // Whether the chart is as Plotly has drawn it, or drawn for the cursor: while a slider is dragged it is neither.
  get isStill() {
    return (this.gd.dataset.moved === undefined || this.cursor.asked) && !isDragging();
  }

  // Shows the chart that was asked for at a value; dims its own where the machine gives none.
  async take(value, figure) {
    this.shown = value;
    this.gd.classList.toggle("live-unknown", !figure);
    if (figure) await this.chart.preview(figure);
  }

  get isHeld() {
    return this.chart.view.matches(":hover, :focus-within");
  }

  text(value) {
    const [low, high] = this.ends;
    const digits = Math.max(0, 2 - Math.floor(Math.log10(high - low)));
    return `${value.toFixed(digits)} ${this.cursor.unit}`;
  }

  show(value) {
    for (const way of this.ways) way.show(value);
    this.name();
  }

  hide() {
    for (const way of this.ways ?? []) way.hide?.();
    this.unmark();
  }

  // Plotly's own animation ends unheard where the chart is drawn anew.
  leave() {
    if (playing === this && this.cursor.frames) playing = null;
    for (const way of this.ways ?? []) (way.leave ?? way.hide)?.call(way);
    this.unmark();
  }

  unmark() {
    for (const one of Object.values(this.marks)) one.style.visibility = "hidden";
  }

  put(kind, width, height, x, y) {
    Object.assign(this.marks[kind].style, { visibility: "visible", width: `${width}px`, height: `${height}px`, transform: `translate(${x}px, ${y}px)` });
  }

  // Names the value beside a pixel, on its left where there is no room on its right.
  say(value, [x, y]) {
    const { label } = this.marks;
    label.textContent = this.text(value);
    const left = x + label.offsetWidth + 4 > this.gd.clientWidth;
    Object.assign(label.style, { visibility: "visible", transform: `translate(${left ? x - label.offsetWidth - 4 : x + 4}px, ${y}px)` });
  }

  pointed(event) {
    if (playing || !this.cursor?.axis || !this.isStill) return;
    const value = this.ways[0].valueAt(event);
    if (value === undefined) clear(this);
    else mark(this, value);
  }

  hovered({ data, customdata }) {
    if (playing || !this.cursor?.along || data.name !== this.cursor.along) return;
    mark(this, Number(Array.isArray(customdata) || ArrayBuffer.isView(customdata) ? customdata[0] : customdata));
  }

  // By the chart's own slider, its play button, or by this script.
  scrubbed(stop) {
    const frames = this.ways?.find((way) => way instanceof Frames);
    if (!frames || frames.busy || !this.isStill) return;
    frames.own = stop;
    mark(this, frames.at[stop]);
  }

  pressed(event) {
    const [low, high] = this.ends;
    const by = this.cursor.frames ? 1 : (high - low) / (event.shiftKey ? FINE : STEPS);
    const way = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10 }[event.key];
    const end = { Home: low, End: high }[event.key];
    if (way === undefined && end === undefined) return;
    if (event.key.startsWith("Page") && document.querySelector(".st-key-lecture_heading")) return; // to the next step
    event.preventDefault();
    event.stopPropagation();
    stop();
    mark(this, end ?? this.stepped(way * by));
  }

  stepped(by) {
    const { frames } = this.cursor;
    if (!frames) return Math.min(Math.max(this.value + by, this.ends[0]), this.ends[1]);
    return frames[Math.min(Math.max(nearest(frames, this.value) + by, 0), frames.length - 1)];
  }
}

// Called when Plotly has drawn a chart's figure.
export function drawn(chart, figure, tools) {
  if (!document.getElementById("live-cursor-style")) {
    document.head.append(Object.assign(document.createElement("style"), { id: "live-cursor-style", textContent: STYLE }));
  }
  if (!views.has(chart)) views.set(chart, new View(chart));
  views.get(chart).drawn(figure, tools);
}

// Called when a chart has another size.
export function placed(chart) {
  views.get(chart)?.place();
}

// Called before a chart is changed: it is as Plotly has drawn it.
export function rested(chart) {
  views.get(chart)?.leave();
}

export function removed(chart) {
  const view = views.get(chart);
  for (const way of view?.ways ?? []) way.leave?.();
  if (playing === view) playing = null;
  views.delete(chart);
  if (marked?.view === view) clear(); // on the other charts too
}
