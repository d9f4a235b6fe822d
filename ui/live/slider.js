// Sliders that send while they are dragged, each with a field for typing its value.
//
// While a slider is dragged its values go to the page's preview, if there is one. Otherwise, and on release, the
// slider sends {name, value, dragging, number}, and the server returns `number` as `echo`. It sends through the
// preview's component; where there is none yet, or the page is running, it sends itself, which ends that run and
// starts one of the whole page.
//
// The next value is sent only when the answer to the last one is drawn: a slow server makes fewer updates, never a
// queue. The final value is always sent, with dragging = false.

const STYLE = `
.live-slider {display: grid; grid-template-columns: 1fr 4.6rem; gap: 0.2rem 0.6rem; align-items: center;
  font-family: var(--st-font); font-size: 0.875rem; color: var(--st-text-color);}
.live-slider + .live-slider {margin-top: 1rem;}
.live-slider label {grid-column: 1 / -1;}
.live-slider input[type=text] {width: 100%; padding: 0.1rem 0.35rem; text-align: right; font: inherit;
  color: inherit; background: var(--st-background-color); border: 1px solid var(--st-border-color);
  border-radius: var(--st-base-radius); box-sizing: border-box;}
.live-slider input[type=range] {width: 100%; margin: 0; height: 1.25rem;
  accent-color: var(--st-primary-color); cursor: pointer;}
.live-slider input:focus-visible {outline: 2px solid var(--st-primary-color); outline-offset: 2px;}
.live-slider input:disabled {opacity: 0.5;}
`;

// Conversion between a value and a position of the range input.
function scale({ low, high, step, log, beyond }) {
  if (log) {
    const last = Math.round(Math.log10(high / low) * step);
    const at = (place) => Number((low * (high / low) ** (place / last)).toPrecision(3));
    return {
      min: 0, max: beyond ? last + 1 : last, step: 1,
      value: (place) => (place > last ? beyond : Math.min(Math.max(at(place), low), high)),
      place: (value) => (value === beyond ? last + 1
        : Math.round((Math.log10(value / low) / Math.log10(high / low)) * last)),
      text: (value) => (typeof value === "string" ? value
        : value >= 1e5 || value < 1e-3 ? value.toExponential(2).replace(/\.?0+e\+?/, "e")
        : String(Number(value.toPrecision(4)))),
    };
  }
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  return {
    min: low, max: high, step,
    value: (place) => Math.min(Number(Number(place).toFixed(decimals)), high),
    place: (value) => value,
    text: (value) => String(Number(value.toPrecision(6))),
  };
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
    this.range = Object.assign(document.createElement("input"), { type: "range", id });
    this.root.append(this.label, this.range, this.field);
    // A step by key fires input and change together: one of them is enough.
    this.range.addEventListener("keydown", () => { this.keyed = true; });
    this.range.addEventListener("pointerdown", () => { this.keyed = false; });
    this.range.addEventListener("input", () => this.keyed || this.moved(true));
    this.range.addEventListener("change", () => this.moved(false));
    // The browser fires no change event for a slider that is released at its old value.
    for (const end of ["pointerup", "pointercancel"])
      this.range.addEventListener(end, () => setTimeout(() => this.grasped && this.moved(false)));
    this.field.addEventListener("change", () => this.typed());
    // While typing, Ctrl+Z takes back what was typed, not the machine's last change.
    this.field.addEventListener("keydown", (event) => event.key.toLowerCase() === "z" && event.stopPropagation());
    this.waiting = null; // the next message to send
    this.previewed = null; // the last value previewed
    this.out = false; // whether a message is on its way or its answer being drawn
  }

  update(data, send) {
    this.data = data;
    this.send = send;
    this.scale = scale(data);
    const { min, max, step } = this.scale;
    // The bounds first, as the input clips its value to them.
    Object.assign(this.range, { min, max, step });
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
    if (!this.out && !this.grasped) this.show(this.value);
  }

  show(value) {
    this.range.value = this.scale.place(value);
    const text = this.scale.text(value);
    this.range.ariaValueText = text;
    this.root.dataset.shown = text;
    if (document.activeElement !== this.field) this.field.value = text;
  }

  moved(dragging) {
    this.grasped = dragging;
    const value = this.scale.value(Number(this.range.value));
    const text = this.scale.text(value);
    this.range.ariaValueText = text;
    this.field.value = text;
    if (!dragging || this.data.whileDragging) this.want({ value, dragging });
  }

  typed() {
    const text = this.field.value.trim();
    const value = text !== "" && text === this.data.beyond ? text : Number(text.replace(",", "."));
    this.want({ value: text === "" || Number.isNaN(value) ? text : value, dragging: false });
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
      if (!previewed || !message.dragging) await this.ask(message);
      this.out = false;
      if (!message.dragging && this.waiting === null) window.rotorcalcPreview?.settle();
    }
    delete this.root.dataset.busy;
    this.rest();
  }

  // While dragging, and on release if the value differs from the last one previewed.
  async preview({ value, dragging }) {
    const preview = window.rotorcalcPreview;
    const due = dragging || (this.previewed !== null && this.previewed !== value);
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
