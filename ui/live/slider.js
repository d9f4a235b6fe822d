// Sliders that send while they are dragged, each with a field for typing its value.
//
// A track is a window on an input's range, logarithmic and four times wide, or linear where the quantity's zero is
// arbitrary. Dropped near its end, or at a value from elsewhere, the slider begins a window about the value; dragged
// past the end and held there, it moves its window on. So a pixel changes a value by half of one per cent at most, over
// any range. A window that is given stays as it is. A track of an input that may be zero begins with a stop at zero; one with a word for infinity ends with it.
//
// A slider's values go to the page's preview first, if there is one. While it is dragged that is all; on release and
// by key, the slider then sends {name, value, dragging, number}, and the server returns `number` as `echo`. It sends through the
// preview's component; where there is none yet, or the page is running, it sends itself, which ends that run and
// starts one of the whole page. What is typed goes as text: the server reads it.
//
// The next value is sent only when the answer to the last one is drawn: a slow server makes fewer updates, never a
// queue. The final value is always sent, with dragging = false.

const STYLE = `
.live-slider {display: grid; grid-template-columns: 1fr 5.2rem; gap: 0 0.6rem; align-items: center;
  font-family: var(--st-font); font-size: 0.875rem; color: var(--st-text-color);}
.live-slider + .live-slider {margin-top: 0.45rem;}
.live-slider label {grid-area: 1 / 1;}
.live-slider input[type=text] {grid-area: 1 / 2; width: 100%; padding: 0.1rem 0.35rem; text-align: right; font: inherit;
  color: inherit; background: var(--st-background-color); border: 1px solid var(--st-border-color);
  border-radius: var(--st-base-radius); box-sizing: border-box;}
.live-slider input[type=range] {grid-area: 2 / 1 / auto / -1; width: 100%; margin: 0.15rem 0 0; height: 1.1rem;
  accent-color: var(--st-primary-color); cursor: pointer;}
.live-slider div {grid-area: 3 / 1 / auto / -1; display: flex; justify-content: space-between; font-size: 0.75rem;
  line-height: 1; opacity: 0.8;}
.live-slider input:focus-visible {outline: 2px solid var(--st-primary-color); outline-offset: 2px;}
.live-slider input:disabled {opacity: 0.5;}
`;

const PLACES = 100000; // of the range input, finer than pixels
const WIDTH = 4; // of a logarithmic window: its high end over its low one
const ROOM = 0.03; // share of a track that belongs to a stop at its end
const MARGIN = 0.15; // share of a track, at either end, in which a dropped slider begins another window
const GRID = 0.0003; // a dragged value is rounded to less than this share of itself
const STEP = 0.01; // a step by key is no more than this share of the value
const SPEED = 0.5; // windows a second, held past a track's end
const PATIENCE = 300; // milliseconds to hold there first

const STEPS = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10 };

const between = (value, low, high) => Math.min(Math.max(value, low), high);

// The largest of 1, 2, 5 times a power of ten that is not above a size.
function roundStep(size) {
  const power = 10 ** Math.floor(Math.log10(size) + 1e-9);
  return power * [5, 2, 1].find((factor) => factor * power <= size * (1 + 1e-9));
}

// A multiple of a step, without the rounding of the multiplication.
const multiple = (count, step) => Number((count * step).toPrecision(12));

function textOf(value) {
  if (typeof value === "string") return value;
  const size = Math.abs(value);
  if (size >= 1e6 || (size < 1e-3 && size > 0)) return value.toExponential(5).replace(/\.?0*e\+?/, "e");
  return String(Number(value.toPrecision(6)));
}

// A window on the range of an input, and the values at the places along it, from 0 to 1.
class Track {
  constructor(data, centre) {
    const { low, high, least, span, beyond, window } = data;
    Object.assign(this, { data, log: !span, first: least ? ROOM : 0, last: beyond ? 1 - ROOM : 1 });
    if (window.length) {
      [this.low, this.high] = window;
      [this.first, this.last] = [0, 1]; // it ends where the window does
      return;
    }
    const start = least || low;
    const width = this.log ? Math.min(WIDTH, high / start) : Math.min(span, high - low);
    const middle = centre === beyond || (least && centre === 0) ? data.usual : centre;
    this.low = this.log ? between(middle / Math.sqrt(width), start, high / width)
      : between(middle - width / 2, low, high - width);
    this.high = this.log ? this.low * width : this.low + width;
  }

  // The window moved on by a share of its width.
  shifted(share) {
    const { low, high } = this;
    return new Track(this.data, this.log ? Math.sqrt(low * high) * (high / low) ** share
      : (low + high) / 2 + share * (high - low));
  }

  place(value) {
    const { least, beyond } = this.data;
    if (value === beyond) return 1;
    if (least && value <= 0) return 0;
    const { low, high } = this;
    const share = this.log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
    return this.first + between(share, 0, 1) * (this.last - this.first);
  }

  value(place) {
    const { low, high } = this;
    if (place < this.first) return 0;
    if (place > this.last) return this.data.beyond;
    const share = (place - this.first) / (this.last - this.first);
    const value = this.log ? low * (high / low) ** share : low + share * (high - low);
    const grid = this.log ? roundStep(GRID * value) : this.data.step / 10;
    return this.admitted(multiple(Math.round(value / grid), grid));
  }

  admitted(value) {
    const [low, high] = this.data.window.length ? this.data.window : [this.data.low, this.data.high];
    return between(value, low, high);
  }

  holds(value) {
    return value >= this.low && value <= this.high;
  }

  // Whether a slider that rests at a value needs another window.
  isLeft(value) {
    const place = this.place(value);
    const isStop = value === this.data.beyond || (this.data.least && value === 0);
    return !isStop && !this.data.window.length && (place < MARGIN || place > 1 - MARGIN);
  }

  // What a key leads to: a round number, the preset's value, or an end; undefined for other keys.
  stepped(value, key, fine) {
    const { least, step, beyond, preset } = this.data;
    const low = least ? 0 : this.admitted(-Infinity);
    const high = this.admitted(Infinity);
    if (key === "Home") return low;
    if (key === "End") return beyond || high;
    const count = STEPS[key];
    if (count === undefined) return undefined;
    if (value === beyond) return count < 0 ? this.high : value;
    if (least && value === 0) return count > 0 ? this.low : 0;
    // Downwards the step of the values below: a step back leads to where it came from.
    const size = this.log ? roundStep(STEP * value * (count < 0 ? 1 - 1e-6 : 1)) : step;
    const by = (size * Math.abs(count)) / (fine ? 10 : 1);
    const next = multiple(count > 0 ? Math.floor(value / by + 1e-6) + 1 : Math.ceil(value / by - 1e-6) - 1, by);
    if (preset !== null && (preset - value) * (next - preset) > 0) return preset;
    if (next > high && beyond) return beyond;
    return next < least ? low : this.admitted(next);
  }
}

function running() {
  const app = document.querySelector('[data-testid="stApp"]');
  return (app?.dataset.testScriptState ?? "notRunning") !== "notRunning";
}

function connected() {
  return document.querySelector('[data-testid="stApp"]')?.dataset.testConnectionState === "CONNECTED";
}

// Session and number of the frame that is shown.
function drawing() {
  const preview = window.rotorcalcPreview;
  return preview && `${preview.token} ${preview.frame}`;
}

class Slider {
  constructor() {
    const id = `live-slider-${crypto.randomUUID?.() ?? Math.random()}`;
    this.root = document.createElement("div");
    this.root.className = "live-slider";
    this.root.slider = this;
    this.label = Object.assign(document.createElement("label"), { htmlFor: id });
    this.field = Object.assign(document.createElement("input"),
      { type: "text", inputMode: "decimal", autocomplete: "off" });
    this.range = Object.assign(document.createElement("input"), { type: "range", id, min: 0, max: PLACES, step: 1 });
    this.ends = Object.assign(document.createElement("div"), { ariaHidden: "true" });
    this.ends.append(document.createElement("span"), document.createElement("span"));
    this.root.append(this.label, this.range, this.field, this.ends);
    this.range.addEventListener("keydown", (event) => this.pressed(event));
    this.range.addEventListener("pointerdown", () => this.hold());
    this.range.addEventListener("input", () => this.dragged());
    this.range.addEventListener("change", () => this.dropped());
    // The browser fires no change event for a slider that is released at its old value.
    for (const end of ["pointerup", "pointercancel"])
      this.range.addEventListener(end, () => setTimeout(() => this.released()));
    this.field.addEventListener("change", () => this.typed());
    // While typing, Ctrl+Z takes back what was typed, not the machine's last change.
    this.field.addEventListener("keydown", (event) => event.key.toLowerCase() === "z" && event.stopPropagation());
    this.waiting = null; // the next message to send
    this.previewed = null; // the last value previewed
    this.out = false; // whether a message is on its way or its answer being drawn
    this.past = 0; // -1 or 1 while the thumb is held past an end of its track
  }

  update(data, send) {
    if (String(data.window) !== String(this.data?.window)) this.shown = undefined;
    this.data = data;
    this.send = send;
    this.label.textContent = data.label;
    this.label.title = data.help;
    this.range.ariaLabel = data.label;
    this.range.ariaDescription = data.help;
    this.field.ariaLabel = `${data.label}, typed`;
    this.rest();
  }

  // The server's value: a preview is sent after the sliders of the same frame, so it is the newer.
  get value() {
    const preview = window.rotorcalcPreview;
    return preview?.frame === this.data.frame ? preview.values[this.data.name] : this.data.value;
  }

  rest() {
    if (this.out || this.grasped) return;
    const { value } = this;
    // A change of unit and back changes a number's last digits.
    const same = value === this.shown || Math.abs(value - this.shown) <= 1e-9 * Math.abs(value);
    if (!same || !this.fits()) this.track = new Track(this.data, value);
    this.show(value);
    this.root.dataset.shown = textOf(value);
  }

  // Whether the window lies on the range as it is now, which another input may have changed.
  fits() {
    const { data, track } = this;
    const start = data.least || data.low;
    const isAlike = ["least", "beyond", "span"].every((key) => track.data[key] === data[key]);
    const rounding = 1e-9 * (Math.abs(start) + Math.abs(data.high));
    if (!isAlike || track.low < start - rounding || track.high > data.high + rounding) return false;
    track.data = data;
    return true;
  }

  show(value) {
    if (this.track.isLeft(value)) this.track = new Track(this.data, value);
    this.range.value = PLACES * this.track.place(value);
    this.write(value);
  }

  write(value) {
    this.shown = value;
    const text = textOf(value);
    this.range.ariaValueText = text;
    if (document.activeElement !== this.field) this.field.value = text;
    const { low, high, data } = this.track;
    const ends = [data.least ? 0 : low, data.beyond || high];
    [...this.ends.children].forEach((end, i) => {
      end.textContent = typeof ends[i] === "string" ? ends[i] : textOf(Number(ends[i].toPrecision(3)));
    });
  }

  // In a lecture the keys, which a presenter's clicker sends, are the page's again.
  released() {
    if (this.grasped) this.dropped();
    if (document.querySelector(".st-key-lecture_heading")) this.range.blur();
  }

  pressed(event) {
    const value = this.track.stepped(this.shown, event.key, event.shiftKey);
    if (value === undefined || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    if (value === this.shown) return;
    this.show(value);
    this.want({ value, dragging: false });
  }

  // The value under the thumb.
  get held() {
    return this.track.value(Number(this.range.value) / PLACES);
  }

  // The value to rest at: the preset's where the thumb is dropped on its pixel.
  get rested() {
    const { track, range, data: { preset } } = this;
    const pixel = 1 / (range.clientWidth || 1);
    const isThere = track.holds(preset) && Math.abs(track.place(preset) - range.value / PLACES) <= pixel / 2;
    return isThere ? preset : this.held;
  }

  hold() {
    const follow = (event) => this.follow(event);
    const leave = () => {
      this.past = 0;
      removeEventListener("pointermove", follow);
    };
    addEventListener("pointermove", follow);
    for (const end of ["pointerup", "pointercancel"]) addEventListener(end, leave, { once: true });
  }

  // Held past an end of its track that is no stop, the slider moves its window on.
  follow({ clientX }) {
    const { left, right } = this.range.getBoundingClientRect();
    const past = clientX > right && !this.data.beyond ? 1 : clientX < left && !this.data.least ? -1 : 0;
    if (past && !this.past) this.run(performance.now() + PATIENCE);
    this.past = past;
  }

  run(then) {
    requestAnimationFrame((now) => {
      if (!this.past) return;
      if (now > then) {
        this.track = this.track.shifted((this.past * SPEED * (now - then)) / 1000);
        this.dragged();
      }
      this.run(Math.max(now, then));
    });
  }

  dragged() {
    this.grasped = true;
    const value = this.held;
    this.write(value);
    if (this.data.whileDragging) this.want({ value, dragging: true });
  }

  dropped() {
    this.grasped = false;
    const value = this.rested;
    this.show(value);
    this.want({ value, dragging: false });
  }

  typed() {
    this.want({ value: this.field.value.trim(), typed: true, dragging: false });
    this.field.blur();
  }

  want(message) {
    this.waiting = message;
    this.root.dataset.busy = "";
    if (!this.out) this.go();
  }

  // One message at a time. Those that come meanwhile replace each other: only the last is sent next.
  async go() {
    while (this.waiting !== null) {
      const message = this.waiting;
      this.waiting = null;
      this.out = true;
      const previewed = await this.preview(message);
      if (!previewed || (!message.dragging && this.waiting === null)) await this.ask(message);
      this.out = false;
      if (!message.dragging && this.waiting === null) window.rotorcalcPreview?.settle();
    }
    delete this.root.dataset.busy;
    this.rest();
  }

  // While dragging, and on release or by key if the value differs from the last one previewed. What is typed the
  // server may not understand.
  async preview({ value, typed, dragging }) {
    const preview = window.rotorcalcPreview;
    const due = dragging || (!typed && this.previewed !== value);
    const previewed = due && preview !== undefined && (await preview.show(this.data.name, value));
    this.previewed = dragging && previewed ? value : null;
    return previewed;
  }

  // Resolves when Streamlit's answer is drawn. A message that was lost with its connection is sent again once the
  // page has run on the new one; so is one without an answer after ten seconds, unless a newer one waits.
  async ask(message) {
    for (let lost = true; lost && this.root.isConnected; lost &&= this.waiting === null) {
      const number = performance.now();
      const send = running() ? this.send : (window.rotorcalcPreview?.send ?? this.send);
      send("moved", { ...message, name: this.data.name, number });
      lost = await this.lost(number, drawing());
    }
  }

  // Resolves to whether a message was lost; false where its answer is drawn or the slider has been removed.
  async lost(number, before) {
    for (let cut = false; this.root.isConnected; await new Promise(requestAnimationFrame)) {
      cut ||= !connected();
      if (!connected() || running() || window.rotorcalcDrawing) continue;
      if (this.data.echo === number || window.rotorcalcPreview?.echo === number) return false;
      if (cut ? drawing() !== before : performance.now() - number > 10000) return true;
    }
    return false;
  }
}

// In a lecture the keys that a presenter's clicker sends, and the letters of its buttons, are the page's wherever the
// focus is. To the page a key in a field is typing: it is sent again from outside the field.
function lead(event) {
  const { target, key, code, ctrlKey, altKey, metaKey } = event;
  const isLetter = target.type === "range" && /^[a-z]$/i.test(key);
  const isLeading = key === "PageUp" || key === "PageDown" || isLetter;
  if (!isLeading || ctrlKey || altKey || metaKey || !target.matches?.("input, textarea")) return;
  if (!document.querySelector(".st-key-lecture_heading")) return;
  event.preventDefault();
  event.stopImmediatePropagation();
  target.blur();
  document.body.dispatchEvent(new KeyboardEvent("keydown", { key, code, bubbles: true, cancelable: true }));
}

addEventListener("keydown", lead, true);

const groups = new WeakMap();

export default function ({ data, parentElement, setTriggerValue }) {
  if (!document.getElementById("live-slider-style")) {
    const style = Object.assign(document.createElement("style"), { id: "live-slider-style" });
    style.textContent = STYLE;
    document.head.append(style);
  }
  const [sliders, common] = data;
  const known = groups.get(parentElement) ?? new Map();
  const group = new Map(sliders.map(({ name }) => [name, known.get(name) ?? new Slider()]));
  for (const slider of sliders) group.get(slider.name).update({ ...slider, ...common }, setTriggerValue);
  const roots = [...group.values()].map(({ root }) => root);
  // A slider that stays in the document keeps the keyboard focus.
  if (roots.some((root, i) => root !== parentElement.children[i])) parentElement.replaceChildren(...roots);
  groups.set(parentElement, group);
}
