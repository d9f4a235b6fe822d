// The drawing of a bearing at another speed than the running speed, and its journal in motion.
//
// A figure's `layout.meta.cursor.drawing` has places and readings over speed, the pressure's shape, and the least damped
// mode (rotorcalc/figures/machine.py). The journal turns and whirls as the linear theory has it, slowed: the whirl's
// size is not given by that theory, and begins here at a share of the thinnest film.

// Turns or whirls a second at most; of the thinnest film the shares at which a whirl grows or decays from, and to.
const TURNS = 0.75;
const GROWS = [0.04, 0.9];
const DECAYS = [0.8, 0.02];
const TRAIL = 240; // points
const PATH_TURNS = 3; // drawn at once where a visitor wants no motion
const RESTS = { turn: 0, x: 0, y: 0, trail: [] };
const calm = matchMedia("(prefers-reduced-motion: reduce)");

// Places on the drawing: X, the load, points down, Y to the right.
const onCircle = (radius, angle) => [radius * Math.sin(angle), -radius * Math.cos(angle)];
const columns = (points) => ({ x: points.map(([x]) => x), y: points.map(([, y]) => y) });
const shifted = (list, by) => Array.from(list, (one) => one + by);

// A number to some digits, large and small ones with powers of ten.
function few(value, digits = 3) {
  const size = Math.abs(value);
  if (size === 0 || (size >= 1e-4 && size < 1e7)) return `${Number(value.toPrecision(digits))}`.replace("-", "−");
  const [mantissa, power] = value.toExponential(digits - 1).split("e");
  const raised = `${Number(power)}`.replace(/./g, (sign) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(sign)]);
  return `${Number(mantissa)}·10${raised}`.replace("-", "−");
}

// As the server writes readings: whole thousands, else four digits.
function worded(value) {
  const size = Math.abs(value);
  return size >= 1e3 && size < 1e7 ? value.toFixed(0).replace("-", "−") : few(value, 4);
}

// The largest of 1, 2, 5 times a power of ten that is not above a number.
function round(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return Math.max(...[1, 2, 5].map((one) => one * power).filter((one) => one <= value * (1 + 1e-9)));
}

export class Drawing {
  constructor(view, figure, { move, numbers, cursor: { placeIn, itemAt, nearest } }) {
    Object.assign(this, { view, figure, move, placeIn, itemAt, nearest });
    this.given = view.cursor.drawing;
    this.current = figure;
    const [journal, centre] = ["journal", "journal centre"].map((name) => {
      const { x, y } = figure.data.find((one) => one.name === name);
      return { x: numbers(x), y: numbers(y) };
    });
    Object.assign(this, { journal, centre: [centre.x[0], centre.y[0]], motion: RESTS });
    this.addControls();
  }

  get ends() {
    return [this.given.at[0], this.given.at.at(-1)];
  }

  show(value) {
    this.value = this.placeIn(this.given.at, value) === undefined ? undefined : value;
    if (this.value === undefined) this.view.unmark();
    else this.view.say(value, this.corner);
    this.draw();
  }

  // Below the readings, at the left edge.
  get corner() {
    const { l, t, h } = this.view.gd._fullLayout._size;
    return [l, t + 0.45 * h];
  }

  hide() {
    this.value = undefined;
    this.draw();
  }

  draw() {
    const next = this.value === undefined && this.motion === RESTS ? this.figure : this.moved();
    if (next !== this.current && this.move(this.view.gd, this.current, next)) this.current = next;
  }

  // The figure at the cursor's speed and with the journal in motion.
  moved() {
    const { given, motion, value, journal } = this;
    const place = value === undefined ? undefined : this.placeIn(given.at, value);
    const rest = place === undefined ? this.centre : [this.itemAt(given.x, place), this.itemAt(given.y, place)];
    const centre = [rest[0] + motion.x, rest[1] + motion.y];
    const by = [centre[0] - this.centre[0], centre[1] - this.centre[1]];
    const changes = {
      journal: { x: shifted(journal.x, by[0]), y: shifted(journal.y, by[1]) },
      "journal centre": { x: [centre[0]], y: [centre[1]] },
      key: columns([0.8, 1].map((share) => onCircle(share * given.journal, motion.turn).map((one, i) => one + centre[i]))),
      whirl: columns([...motion.trail.map(([x, y]) => [rest[0] + x, rest[1] + y]), centre]),
      ...(place === undefined ? {} : this.atSpeed(place)),
      ...this.ringKey(place),
    };
    const data = this.figure.data.map((trace) => (trace.name in changes ? { ...trace, ...changes[trace.name] } : trace));
    return { ...this.figure, data, layout: { ...this.figure.layout, annotations: this.notes(place, rest, by) } };
  }

  // Line of centres, attitude angle and pressure at a speed.
  atSpeed(place) {
    const { angle, arc, pressure } = this.given;
    const phi = this.itemAt(angle, place);
    const changes = {
      "line of centres": columns([[0, 0], onCircle(1, phi)]),
      "attitude angle": columns(Array.from({ length: 49 }, (_, i) => onCircle(arc, (phi * i) / 48))),
    };
    Object.assign(changes, this.parts(place));
    if (!pressure) return changes;
    const between = this.between(place);
    const [one, two] = [Math.floor, Math.ceil].map((side) => pressure.shares[side(between)]);
    const outer = pressure.angle.map((theta, i) => {
      const [x, y] = onCircle(one[i] + (two[i] - one[i]) * (between % 1), theta);
      return [pressure.x[i] + x, pressure.y[i] + y];
    });
    const wall = pressure.x.map((x, i) => [x, pressure.y[i]]).reverse();
    return { ...changes, pressure: columns([...outer, [null, null], ...wall]) };
  }

  // The place of a speed among the few that have a pressure and moving parts; beyond their ends, the end.
  between(place) {
    const { at, few } = this.given;
    return this.placeIn(few, Math.min(Math.max(this.itemAt(at, place), few[0]), few.at(-1)));
  }

  // Pads, ring or foil at a speed, between those at the speeds beside it.
  parts(place) {
    const between = this.between(place);
    const mixed = (lists) => {
      const [one, two] = [Math.floor, Math.ceil].map((side) => lists[side(between)]);
      return Array.from(one, (from, i) => (Number.isFinite(from) ? from + (two[i] - from) * (between % 1) : null));
    };
    return Object.fromEntries(Object.entries(this.given.moving).map(([name, { x, y }]) => [name, { x: mixed(x), y: mixed(y) }]));
  }

  // The mark on a floating ring, which turns at its share of the speed.
  ringKey(place) {
    const { ring, few } = this.given;
    if (!ring) return {};
    const at = place === undefined ? this.placeIn(few, this.view.cursor.now) : this.between(place);
    if (at === undefined) return {};
    const [x, y, ratio] = ["x", "y", "ratio"].map((name) => this.itemAt(ring[name], at));
    this.ratio = ratio;
    return { "ring key": columns(Array.from(ring.ends, (end) => onCircle(end, this.motion.ringTurn ?? 0).map((one, i) => one + [x, y][i]))) };
  }

  notes(place, rest, by) {
    const { notes, angle, name, readings } = this.given;
    const list = [...this.figure.layout.annotations];
    const change = (key, parts) => { if (notes[key] !== undefined) list[notes[key]] = { ...list[notes[key]], ...parts }; };
    for (const key of ["turn", "Ω"]) {
      const note = list[notes[key]];
      change(key, { x: note.x + by[0], y: note.y + by[1], ...(key === "turn" && { ax: note.ax + by[0], ay: note.ay + by[1] }) });
    }
    if (place === undefined) return list;
    const phi = this.itemAt(angle, place);
    const put = (key, [x, y]) => change(key, { x, y });
    put("φ", onCircle(name, phi / 2));
    put("h_min", onCircle(1, phi));
    put("e", rest.map((one) => one / 2));
    for (const { note, words, values, unit } of readings) {
      const value = this.itemAt(values, place);
      const text = `${worded(value)}${unit === "°" ? "" : " "}${unit}`;
      if (!Number.isFinite(value)) continue;
      change(note, { text: words + text });
      if (note === "p_max read") change("scale", { text });
    }
    return list;
  }

  // --- Motion ---

  addControls() {
    const { view } = this.view.chart;
    for (const old of view.querySelectorAll(".live-animate, .live-slowed")) old.remove();
    this.button = Object.assign(document.createElement("button"), { type: "button", className: "live-animate", textContent: "Animate" });
    this.button.addEventListener("click", () => (this.view.animated ? this.rest() : this.start()));
    this.words = Object.assign(document.createElement("div"), { className: "live-slowed", hidden: true });
    view.append(this.button, this.words);
    this.button.ariaPressed = "false";
    if (this.view.animated) this.start();
  }

  // The least damped mode at the cursor's speed or at the running speed, and by how much it is slowed.
  get mode() {
    const { whirl } = this.given;
    const i = this.nearest(whirl.at, this.value ?? this.view.cursor.now);
    const [speed, growth, frequency] = ["speed", "growth", "frequency"].map((name) => whirl[name][i]);
    const [x, y] = [whirl.x, whirl.y].map(([re, im]) => [re[i], im[i]]);
    return { speed, growth, frequency, x, y, factor: round(Math.max(speed, frequency) / (2 * Math.PI * TURNS)) };
  }

  // The thinnest film, in units of the drawing.
  get room() {
    const { at, room } = this.given;
    return room[this.nearest(at, this.value ?? this.view.cursor.now)];
  }

  start() {
    this.view.animated = true;
    this.button.ariaPressed = "true";
    this.begin();
    if (calm.matches) this.trace();
    else this.run();
  }

  run() {
    this.running = true;
    let before = performance.now();
    const step = (now) => {
      if (!this.running) return;
      this.advance(Math.min(now - before, 100) / 1000);
      this.tell();
      this.draw();
      before = now;
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  // As Plotly has drawn it, before Plotly or another script changes the chart.
  leave() {
    this.running = false;
    this.motion = RESTS;
    this.hide();
  }

  rest() {
    this.view.animated = false;
    this.button.ariaPressed = "false";
    this.words.hidden = true;
    this.running = false;
    this.motion = RESTS;
    this.draw();
  }

  begin() {
    const size = (this.mode.growth > 0 ? GROWS : DECAYS)[0];
    this.motion = { phase: 0, turn: this.motion.turn, ringTurn: this.motion.ringTurn ?? 0, x: 0, y: 0, trail: [], size };
    this.tell();
  }

  // Moves on by some seconds of the slowed motion; begins again where the whirl has grown or decayed.
  advance(seconds) {
    const { mode, room } = this;
    const time = seconds / mode.factor;
    const { turn, ringTurn, phase, size, trail } = this.motion;
    const turns = (angle, speed) => (angle + speed * time) % (2 * Math.PI);
    const next = { turn: turns(turn, mode.speed), ringTurn: turns(ringTurn, mode.speed * (this.ratio ?? 0)), phase: phase + mode.frequency * time, size: size * Math.exp(mode.growth * time) };
    const [x, y] = [mode.x, mode.y].map(([re, im]) => room * next.size * (re * Math.cos(next.phase) - im * Math.sin(next.phase)));
    this.motion = { ...next, x, y, trail: [...trail.slice(1 - TRAIL), [x, y]] };
    if (mode.growth > 0 ? next.size > GROWS[1] : next.size < DECAYS[1]) this.begin();
  }

  // Draws some turns of the whirl at once, for a visitor who wants no motion.
  trace() {
    const { frequency, speed, factor } = this.mode;
    const step = (PATH_TURNS * 2 * Math.PI * factor) / (frequency || speed) / TRAIL;
    let last = this.motion;
    for (let i = 0; i < TRAIL && this.motion.trail.length === i; i += 1) {
      last = this.motion;
      this.advance(step);
    }
    if (this.motion.trail.length === 0) this.motion = last; // it has begun again
    this.draw();
  }

  tell() {
    const { frequency, growth, factor } = this.mode;
    const { thicker } = this.given;
    const slowed = calm.matches ? `The path of ${PATH_TURNS} whirls` : `Slowed ${factor} ×`;
    const film = Math.abs(thicker - 1) < 0.01 ? "film to scale" : `film drawn ${few(thicker)} × thicker`;
    const whirl = frequency > 0 ? `${worded((frequency * 30) / Math.PI)} rpm` : "no whirl";
    const way = growth > 0 ? `grows from ${100 * GROWS[0]}` : `decays from ${100 * DECAYS[0]}`;
    const text = `${slowed}, ${film}. Least damped mode: ${whirl}, ${few(growth, 4)} 1/s; it ${way} % of the thinnest film. `
      + "The pressure is that at rest.";
    if (this.words.textContent !== text) this.words.textContent = text;
    this.words.hidden = false;
  }
}
