// Moves a drawn chart to another machine's, in a tenth of the time that Plotly needs to draw it anew.
//
// Lines, points, notes and shapes go to their new places in the picture as it stands. Where that cannot
// be done Plotly draws at once, and elsewhere when nothing has moved for a while.
//
// Written for plotly.js of the Python package plotly 7.1.0: it reads _fullLayout and _fullData, the names
// and the order of the classes in the SVG, and where uid, data-index and data-unformatted stand, none of
// which Plotly promises to keep. After an update run tests/browser/test_live.py, then change the number.

// Seen only under a pointer, and that is on a thumb.
const HOVERED = new Set(["customdata", "hovertemplate"]);
const TRACE = new Set(["x", "y", "text", "name", ...HOVERED]);
const NOTE = new Set(["x", "y", "ax", "ay", "text"]);
const SHAPE = new Set(["x0", "x1", "y0", "y1"]);
// Beside these a layout may differ in its notes and shapes alone.
const LAYOUT = new Set(["annotations", "shapes", "sliders"]);

class Fixed extends Error {}

function need(condition) {
  if (!condition) throw new Fixed();
}

function differ(a, b) {
  return a !== b && JSON.stringify(a) !== JSON.stringify(b);
}

function changes(before, now, known) {
  const names = [...new Set([...Object.keys(before), ...Object.keys(now)])];
  const changed = names.filter((name) => differ(before[name], now[name]));
  need(changed.every((name) => known.has(name)));
  return changed;
}

// Calls `act` with each item that has changed, its place, and what has changed of it.
function each(before, now, known, act) {
  need((before?.length ?? 0) === (now?.length ?? 0));
  now?.forEach((item, i) => {
    const changed = changes(before[i], item, known);
    if (changed.length > 0) act(item, i, changed);
  });
}

// An array as it travels: itself, or its numbers' bytes.
function numbers(array) {
  if (!array.bdata) return array.map((value) => value ?? NaN);
  const bytes = Uint8Array.from(atob(array.bdata), (letter) => letter.charCodeAt(0));
  return array.dtype === "f8" ? new Float64Array(bytes.buffer) : new Float32Array(bytes.buffer);
}

function axis(gd, name) {
  return gd._fullLayout[`${name[0]}axis${name.slice(1)}`];
}

// Where a value of an axis, or a share of the plot, stands in the picture.
function at(gd, letter, reference, value) {
  const { l, t, w, h } = gd._fullLayout._size;
  if (reference === "paper") return letter === "x" ? l + value * w : t + (1 - value) * h;
  const found = axis(gd, reference ?? letter);
  return found._offset + found.d2p(value);
}

// Overwrites words that are all plain or all bold.
function say(node, text) {
  const [, bold, words] = text.match(/^(<b>)?([^<&]*)(?:<\/b>)?$/) ?? [];
  const place = bold ? node.querySelector("tspan") : node;
  need(words !== undefined && place && place.children.length === 0);
  place.textContent = words;
}

function path(points, end) {
  const pieces = [[]];
  for (const point of points) {
    if (point.every(Number.isFinite)) pieces.at(-1).push(point.map((value) => value.toFixed(2)).join());
    else if (pieces.at(-1).length > 0) pieces.push([]);
  }
  return pieces.filter((piece) => piece.length > 0).map((piece) => `M${piece.join("L")}${end}`).join("");
}

function moveTrace(gd, trace, i, changed) {
  const { uid, visible, ...full } = gd._fullData[i];
  if (visible !== true) return;
  need(trace.type === "scatter" && (!trace.fill || trace.fill === "toself") && trace.line?.shape !== "spline");
  const label = changed.includes("name") && gd.querySelector(`.legendtext[data-unformatted="${full.name}"]`);
  if (label) say(label, trace.name);
  if (!changed.some((name) => !HOVERED.has(name) && name !== "name")) return;
  const [xs, ys, [x, y]] = [numbers(trace.x), numbers(trace.y), [axis(gd, full.xaxis), axis(gd, full.yaxis)]];
  const points = Array.from(xs, (value, k) => [x.d2p(value), y.d2p(ys[k])]);
  const seen = points.filter((point) => point.every(Number.isFinite));
  const group = gd.querySelector(`.scatterlayer .trace${uid}`);
  if (full.mode.includes("lines")) {
    const [line, ...rest] = group.querySelectorAll(".js-line");
    need(line || seen.length === 0);
    line?.setAttribute("d", path(points, ""));
    rest.forEach((piece) => piece.setAttribute("d", ""));
    group.querySelector(".js-fill")?.setAttribute("d", path(points, "Z"));
  }
  for (const [part, drawn] of [["markers", ".point"], ["text", ".textpoint text"]]) {
    if (!full.mode.includes(part)) continue;
    const nodes = group.querySelectorAll(drawn);
    need(nodes.length === seen.length && nodes.length === points.length);
    nodes.forEach((node, k) => {
      const turned = (node.getAttribute("transform") ?? "").replace(/translate\([^)]*\)/, "");
      node.setAttribute("transform", `translate(${points[k]})${turned}`);
      if (part === "text" && changed.includes("text")) say(node, trace.text[k]);
    });
  }
}

// A note is drawn where it first stood, and carried from there.
function moveNote(gd, note, i, changed) {
  const group = gd.querySelector(`.annotation[data-index="${i}"]`);
  if (changed.includes("text")) say(group.querySelector(".annotation-text"), note.text);
  const shift = ["x", "y"].map((letter) => {
    const reference = note[`${letter}ref`];
    const way = (end, axis) => at(gd, letter, axis, note[end]) - at(gd, letter, axis, gd.layout.annotations[i][end]);
    const here = way(letter, reference);
    if (changed.includes(`a${letter}`)) need(Math.abs(way(`a${letter}`, note[`a${letter}ref`]) - here) < 0.1);
    return here;
  });
  need(shift.every(Number.isFinite));
  group.setAttribute("transform", `translate(${shift})`);
}

function moveShape(gd, shape, i) {
  const node = gd.querySelector(`.shapelayer path[data-index="${i}"]`);
  const places = (from) => ["x0", "y0", "x1", "y1"].map((end) => at(gd, end[0], shape[`${end[0]}ref`], from[end]));
  const [x0, y0, x1, y1] = places(shape);
  need(node && Number.isFinite(x0 + y0 + x1 + y1));
  if (shape.type === "rect") node.setAttribute("d", `M${x0},${y0}H${x1}V${y1}H${x0}Z`);
  else if (shape.type === "line") node.setAttribute("d", `M${x0},${y0}L${x1},${y1}`);
  else {
    const [left, top, right, bottom] = places(gd.layout.shapes[i]);
    need(Math.abs(x0 - left - x1 + right) < 0.1 && Math.abs(y0 - top - y1 + bottom) < 0.1);
    node.setAttribute("transform", `translate(${x0 - left},${y0 - top})`);
  }
}

// Moves a chart from the figure that it shows to another, or returns false.
export function move(gd, before, { data, layout }) {
  try {
    changes(before.layout, layout, LAYOUT);
    each(before.data, data, TRACE, (...item) => moveTrace(gd, ...item));
    each(before.layout.annotations, layout.annotations, NOTE, (...item) => moveNote(gd, ...item));
    each(before.layout.shapes, layout.shapes, SHAPE, (...item) => moveShape(gd, ...item));
  } catch (error) {
    if (error instanceof Fixed) return false;
    throw error;
  }
  return true;
}
