// Updates a drawn chart to another machine, in a tenth of the time that Plotly needs to redraw it.
//
// Lines, points, annotations and shapes are moved in the existing SVG. Where that is not possible Plotly redraws
// at once, otherwise after a pause.
//
// Written for plotly.js of the Python package plotly 7.1.0: it relies on _fullLayout and _fullData, on the classes
// of the SVG, their order and what is bound to them, and on uid, data-index and data-unformatted, none of which is
// part of Plotly's API.
// After an update run tests/browser/test_live.py, then change the number.

// Shown on hovering only, and the pointer is on a slider.
const HOVERED = new Set(["customdata", "hovertemplate"]);
const TRACE = new Set(["x", "y", "z", "base", "contours", "text", "name", "marker", ...HOVERED]);
const MARKER = new Set(["angle"]);
const NOTE = new Set(["x", "y", "ax", "ay", "text"]);
const SHAPE = new Set(["x0", "x1", "y0", "y1"]);
const SLIDER = new Set(["steps", "active"]);
const BAR = new Set(["x", "y", "base", ...HOVERED]);
const CONTOUR = new Set(["x", "y", "z", "contours", "name", ...HOVERED]);
const AXIS = /^[xy]axis\d*$/;
const INSET = 10; // of a slider's first and last stop from its ends, in pixels
// Only these parts of a layout may differ.
const LAYOUT = new Set(["annotations", "shapes", "sliders", "meta"]);
const TICKS = new Set(["ticktext"]);
const CONTOURS = new Set(["value"]);

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

// Calls `act` with each changed item, its index, and the names of its changed properties.
function each(before, now, known, act) {
  need((before?.length ?? 0) === (now?.length ?? 0));
  now?.forEach((item, i) => {
    const changed = changes(before[i], item, known);
    if (changed.length > 0) act(item, i, changed, before[i]);
  });
}

// An array as the server sends it: a list, or its numbers in base64.
export function numbers(array) {
  if (!array.bdata) return array.map((value) => value ?? NaN);
  const bytes = Uint8Array.from(atob(array.bdata), (letter) => letter.charCodeAt(0));
  return array.dtype === "f8" ? new Float64Array(bytes.buffer) : new Float32Array(bytes.buffer);
}

function axis(gd, name) {
  return gd._fullLayout[`${name[0]}axis${name.slice(1)}`];
}

// Pixel position of a value on an axis, or of a share of the plot.
function at(gd, letter, reference, value) {
  const { l, t, w, h } = gd._fullLayout._size;
  if (reference === "paper") return letter === "x" ? l + value * w : t + (1 - value) * h;
  const found = axis(gd, reference ?? letter);
  return found._offset + found.d2p(value);
}

// Overwrites a text piece by piece: its markup must be that of the text drawn.
function say(node, text) {
  const pieces = text.split(/<[^>]*>/).filter(Boolean);
  const texts = document.createTreeWalker(node, NodeFilter.SHOW_TEXT);
  const drawn = [];
  // Plotly returns from an index to the line by a text without width, and has an empty one before a tag.
  while (texts.nextNode()) if (!["\u200b", ""].includes(texts.currentNode.nodeValue)) drawn.push(texts.currentNode);
  need(drawn.length === pieces.length);
  drawn.forEach((place, k) => { place.nodeValue = pieces[k]; });
}

function path(points, end) {
  const pieces = [[]];
  for (const point of points) {
    if (point.every(Number.isFinite)) pieces.at(-1).push(point.map((value) => value.toFixed(2)).join());
    else if (pieces.at(-1).length > 0) pieces.push([]);
  }
  return pieces.filter((piece) => piece.length > 0).map((piece) => `M${piece.join("L")}${end}`).join("");
}

// A fill to zero goes from both ends of the line to the axis, and has no gaps.
function filled(points, fill, zero) {
  if (fill === "toself") return path(points, "Z");
  need(points.every((point) => point.every(Number.isFinite)));
  const [first, last] = [points[0], points.at(-1)];
  return path([[last[0], zero], [first[0], zero], ...points], "");
}

// The direction of each point from the one before, as seen, in degrees.
function headings(points) {
  return points.map(([x, y], k) => (k ? (Math.atan2(y - points[k - 1][1], x - points[k - 1][0]) * 180) / Math.PI : 0));
}

// By how many degrees each marker is turned from where Plotly drew it.
function turns({ marker }, trace, points, drawn) {
  const angles = ({ angle }) => (typeof angle === "object" ? numbers(angle) : points.map(() => angle ?? 0));
  const [now, then] = marker.angleref === "previous" ? [headings(points), headings(drawn)] : [angles(trace.marker ?? {}), angles(marker)];
  return points.map((_, k) => now[k] - then[k]);
}

const byTrace = (gd, layer, uid) => [...gd.querySelectorAll(layer)].find((group) => group.__data__[0].trace.uid === uid);

// A bar reaches from its base along its length; its number is what a pointer sees.
function moveBars(gd, trace, full) {
  const [xs, ys] = [numbers(trace.x), numbers(trace.y)];
  const isLevel = trace.orientation === "h";
  const [along, across] = [isLevel ? "x" : "y", isLevel ? "y" : "x"].map((letter) => axis(gd, full[`${letter}axis`]));
  const [lengths, places] = isLevel ? [xs, ys] : [ys, xs];
  const bases = trace.base ? numbers(trace.base) : lengths.map(() => 0);
  const bars = byTrace(gd, ".barlayer .trace", full.uid)?.querySelectorAll(".point > path");
  need(bars?.length === lengths.length && !trace.text);
  bars.forEach((bar, k) => {
    const [from, to] = [bases[k], bases[k] + lengths[k]].map((end) => along.d2p(end).toFixed(2));
    const [one, other] = [-0.5, 0.5].map((side) => across.d2p(places[k] + side * trace.width).toFixed(2));
    bar.setAttribute("d", isLevel ? `M${from},${one}V${other}H${to}V${one}Z` : `M${one},${from}V${to}H${other}V${from}Z`);
  });
}

// Rows of a grid, which the server sends as one array with its shape.
function grid({ shape, ...array }) {
  const width = Number(shape?.split(",")[1]);
  const heights = shape ? numbers(array) : null;
  return Array.from({ length: heights.length / width }, (_, r) => heights.subarray(r * width, (r + 1) * width));
}

// Fills and lines at the levels of a contour chart, or on one side of a level and along it.
function moveContour(gd, trace, before, full, { regions, outlines }) {
  const { type, operation, value } = trace.contours;
  if (differ(before.contours, trace.contours)) changes(before.contours, trace.contours, CONTOURS);
  const group = byTrace(gd, ".contourlayer .contour", full.uid);
  need(group && trace.z.shape);
  const below = operation === ">"; // Plotly fills where that is broken
  const rows = grid(trace.z).map((row) => (below ? row.map((one) => -one) : row));
  const [xs, ys] = ["x", "y"].map((letter) => Array.from(numbers(trace[letter]), (one) => axis(gd, full[`${letter}axis`]).d2p(one)));
  const between = (list, place) => list[Math.floor(place)] + (place % 1 && (place % 1) * (list[Math.ceil(place)] - list[Math.floor(place)]));
  const drawn = (loops, end) => loops.map((loop) => path(loop.map(({ point: [c, r] }) => [between(xs, c), between(ys, r)]), end)).join("");
  const put = (nodes, places) => {
    need(nodes.length > 0 || places === "");
    nodes.forEach((node, k) => node.setAttribute("d", k ? "" : places));
  };
  const fills = [...group.querySelectorAll(".contourfill path")];
  for (const line of group.querySelectorAll(".contourlevel")) {
    const { level } = line.__data__;
    const loops = regions(rows, type === "constraint" ? (below ? -value : value) : level);
    if (operation !== "=") put(fills.filter((one) => type === "constraint" || one.__data__.level === level), drawn(loops, "Z"));
    put(line.querySelectorAll("path"), trace.line?.width === 0 ? "" : drawn(outlines(loops), ""));
  }
  const clip = gd.querySelector(`#clip${full.uid} path`);
  clip?.setAttribute("d", drawn(regions(rows.map((row) => row.map((one) => (Number.isFinite(one) ? 1 : NaN))), 0, 0.5), "Z"));
}

// Words at an axis's ticks, where those stand still.
function moveTicks(gd, before, now) {
  for (const name of Object.keys(now).filter((key) => AXIS.test(key) && differ(before[key], now[key]))) {
    changes(before[name], now[name], TICKS);
    const ticks = [...gd.querySelectorAll(`.${name.replace("axis", "")}tick`)].filter((tick) => tick.querySelector("text"));
    numbers(now[name].tickvals).forEach((value, k) => {
      const tick = ticks.find(({ __data__ }) => __data__.x === value);
      need(tick);
      say(tick.querySelector("text"), now[name].ticktext[k]);
    });
  }
}

function moveTrace(gd, contour, trace, i, changed, before) {
  const { uid, visible, ...full } = gd._fullData[i];
  if (visible !== true) return;
  const label = changed.includes("name") && gd.querySelector(`.legendtext[data-unformatted="${full.name}"]`);
  if (label) say(label, trace.name);
  if (trace.type === "bar" && changed.every((name) => BAR.has(name))) return moveBars(gd, trace, { uid, ...full });
  if (trace.type === "contour" && changed.every((name) => CONTOUR.has(name))) return moveContour(gd, trace, before, { uid, ...full }, contour);
  need(!trace.meta?.envelope); // what is drawn is not what is given
  need(trace.type === "scatter" && ["toself", "tozeroy", undefined].includes(trace.fill) && trace.line?.shape !== "spline");
  if (changed.includes("marker")) changes(before.marker, trace.marker, MARKER);
  if (!changed.some((name) => !HOVERED.has(name) && name !== "name")) return;
  const [xs, ys, [x, y]] = [numbers(trace.x), numbers(trace.y), [axis(gd, full.xaxis), axis(gd, full.yaxis)]];
  const pixels = (across, up) => Array.from(across, (value, k) => [x.d2p(value), y.d2p(up[k])]);
  const points = pixels(xs, ys);
  const seen = points.filter((point) => point.every(Number.isFinite));
  const group = gd.querySelector(`.scatterlayer .trace${uid}`);
  if (full.mode.includes("lines")) {
    const [line, ...rest] = group.querySelectorAll(".js-line");
    need(line || seen.length === 0);
    line?.setAttribute("d", path(points, ""));
    rest.forEach((piece) => piece.setAttribute("d", ""));
    group.querySelector(".js-fill")?.setAttribute("d", filled(points, trace.fill, y.d2p(0)));
  }
  for (const [part, drawn] of [["markers", ".point"], ["text", ".textpoint text"]]) {
    if (!full.mode.includes(part)) continue;
    const nodes = group.querySelectorAll(drawn);
    need(nodes.length === seen.length && nodes.length === points.length);
    const turned = part === "markers" && turns(full, trace, points, pixels(full.x, full.y));
    nodes.forEach((node, k) => {
      const text = (node.getAttribute("transform") ?? "").replace(/translate\([^)]*\)/, "");
      node.setAttribute("transform", `translate(${points[k]})${turned ? `rotate(${turned[k]})` : text}`);
      if (part === "text" && changed.includes("text")) say(node, trace.text[k]);
    });
  }
}

// A note is drawn at its first position and translated from there. One whose text has changed is to be placed.
function moveNote(gd, note, i, changed, placed) {
  const group = gd.querySelector(`.annotation[data-index="${i}"]`);
  if (changed.includes("text")) {
    say(group.querySelector(".annotation-text"), note.text);
    placed.push([group, gd._fullLayout.annotations[i], note.text]);
  }
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

// Texts stand about their middle, as Plotly draws them. Where that is not their anchor, a text of another width is moved.
function placeNotes(notes) {
  const widths = notes.map(([group]) => group.querySelector(".annotation-text").getBBox().width);
  notes.forEach(([group, { text, xanchor, xref, x, showarrow, borderpad, borderwidth }, now], k) => {
    const auto = showarrow || xref !== "paper" ? 0 : x < 1 / 3 ? 1 : x > 2 / 3 ? -1 : 0;
    const side = now === text ? 0 : { left: 1, center: 0, right: -1, auto }[xanchor]; // 0: as Plotly drew it
    const drawn = group.querySelector(".bg").width.baseVal.value - borderwidth - 2 * borderpad;
    group.querySelector(".annotation-text").setAttribute("transform", `translate(${(side * (widths[k] - drawn)) / 2})`);
  });
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

// An animation's slider: its label and its grip. The chart drawn is the one at its active stop.
function moveSlider(gd, { active, steps, currentvalue }, i) {
  const group = gd.querySelectorAll(".slider-group")[i];
  const [label, grip] = ["label", "grip-rect"].map((part) => group?.querySelector(`.slider-${part}`));
  const length = gd._fullLayout.sliders[i]._dims?.inputAreaLength;
  need(label && grip && length);
  const { prefix = "", suffix = "" } = currentvalue;
  say(label, `${prefix}${steps[active].label}${suffix}`);
  const place = INSET + ((length - 2 * INSET) * active) / (steps.length - 1) - grip.getAttribute("width") / 2;
  grip.setAttribute("transform", grip.getAttribute("transform").replace(/\((-?[\d.]+)/, `(${place}`));
}

// Updates a chart from the figure that it shows to another; returns false where only Plotly can. `contour` are the
// functions of contour.js.
export function move(gd, before, { data, layout }, contour) {
  const notes = [];
  try {
    changes(before.layout, layout, { has: (name) => LAYOUT.has(name) || AXIS.test(name) });
    moveTicks(gd, before.layout, layout);
    each(before.data, data, TRACE, (...item) => moveTrace(gd, contour, ...item));
    each(before.layout.annotations, layout.annotations, NOTE, (note, i, changed) => moveNote(gd, note, i, changed, notes));
    each(before.layout.sliders, layout.sliders, SLIDER, (...item) => moveSlider(gd, ...item));
    each(before.layout.shapes, layout.shapes, SHAPE, (...item) => moveShape(gd, ...item));
    placeNotes(notes);
  } catch (error) {
    if (error instanceof Fixed) return false;
    throw error;
  }
  return true;
}
