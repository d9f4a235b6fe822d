// The preview: what a page shows, at the value to which a slider is being moved, by the thumb or by a key.
//
// While a slider is moved, charts, numbers and texts are requested from the server without a run of the page by
// Streamlit. Charts are redrawn, numbers overwritten in place, and a text is shown in a copy of its element, which
// React does not know and so does not touch. What the machine does not give is dimmed. When the page has run, on
// release, its own content applies again. A value that makes no machine is reported in the verdict's place.
// cursor.js asks here for charts at the running speed that is marked.
//
// A released slider sends its value through this component, because Streamlit then runs only the fragment that
// contains the component, and not the sidebar; the answer has the value of every slider.

const STYLE = `
.live-unknown {opacity: 0.35;}
.live-unknown .live-unknown {opacity: 1;}
.live-overwritten > :not(.live-said) {display: none;}
.live-refused :is(.live-chart, .stMetric, [class*="st-key-said_"]:not(.st-key-said_verdict)) {opacity: 0.35;}
.live-alert {padding: 1rem; border-radius: 0.5rem;}
`;
const COLOURS = ["green", "blue", "yellow", "orange", "red"];
const LEVELS = { success: "green", info: "blue", warning: "yellow", error: "red" };

// Milliseconds to wait, as a connection can be lost without an error. Sliders then send through Streamlit.
const PATIENCE = 5000;
const MARK = "\u200b"; // of zero width

function textOf(element) {
  const walker = document.createTreeWalker(element, NodeFilter.SHOW_TEXT);
  return walker.nextNode();
}

class Preview {
  constructor() {
    this.written = new Map(); // text nodes: the page's own text, and the one written over it
  }

  update(common, values, send) {
    Object.assign(this, common, { values, send });
    for (const { slider } of document.querySelectorAll(".live-slider")) slider.rest();
  }

  // Resolves when the answer is drawn; false where there is none.
  async show(name, value) {
    const answer = await this.ask(new URLSearchParams({ name, value }));
    if (!answer) return false;
    const { charts, rows, texts, refused } = answer;
    // A value that makes no machine: the reason stands in the verdict's place, and the rest is dimmed.
    document.body.classList.toggle("live-refused", refused !== undefined);
    if (refused !== undefined) texts.said_verdict = { words: refused, kind: "error" };
    await this.load(JSON.stringify(texts).includes("$"));
    document.body.classList.add("rotorcalc-dragging");
    for (const [key, cells] of Object.entries(rows)) this.result(document.querySelector(`.st-key-${key}`), cells);
    for (const [key, text] of Object.entries(texts)) {
      for (const place of document.querySelectorAll(`.st-key-${CSS.escape(key)}`)) this.say(place, text);
    }
    const drawings = Object.entries(charts).map(([key, figure]) => {
      const chart = window.rotorcalcCharts?.get(key);
      chart?.element.classList.toggle("live-unknown", figure === null);
      return figure && chart?.preview(figure);
    });
    await Promise.all(drawings);
    return true;
  }

  // Resolves to some charts alone, at a value of an input; undefined where there is no answer.
  async charts(name, value, keys) {
    const answer = await this.ask(new URLSearchParams([["name", name], ["value", value], ...keys.map((key) => ["chart", key])]));
    return answer?.charts;
  }

  // One request at a time: the server refuses a page's second one.
  ask(query) {
    this.asked = (this.asked ?? Promise.resolve()).then(() => this.answered(query));
    return this.asked;
  }

  async answered(query) {
    if (!this.available) return undefined;
    try {
      const answer = await fetch(`${this.address}?${query}`,
        { headers: { "X-Rotorcalc-Page": this.token }, signal: AbortSignal.timeout(PATIENCE) });
      if (answer.status === 200) return await answer.json();
      this.available = false; // the server does not know this page: sliders send through Streamlit
    } catch {
      // no answer in time
    }
    return undefined;
  }

  // Loads what writes texts, KaTeX only for those with equations.
  async load(withEquations) {
    this.markdown ??= await import(location.origin + this.scripts.markdown);
    if (withEquations) this.katex ??= (await import(location.origin + this.scripts.katex)).default;
  }

  // Overwrites a row of results: of each its number, its change from the first case, and its source.
  result(row, cells) {
    const metrics = row?.querySelectorAll(".stMetric") ?? [];
    const sources = row?.querySelectorAll(".stPopover button") ?? [];
    metrics.forEach((metric, i) => {
      metric.classList.toggle("live-unknown", cells[i] === null);
      const places = ["stMetricValue", "stMetricDelta"].map((name) => metric.querySelector(`[data-testid=${name}]`));
      [...places, sources[i]].forEach((place, j) => cells[i] && place && this.write(textOf(place), cells[i][j]));
    });
  }

  // Shows a text in a copy of the page's own element.
  say(place, text) {
    place.classList.toggle("live-unknown", text === null);
    const said = JSON.stringify(text);
    if (text === null) return;
    const copy = place.querySelector(":scope > .live-said") ?? place.firstElementChild.cloneNode(true);
    if (copy.dataset.said === said) return;
    copy.classList.add("live-said");
    copy.dataset.said = said;
    copy.hidden = text.words === "";
    this.fill(copy, text);
    place.append(copy);
    place.classList.add("live-overwritten");
  }

  fill(copy, { words, kind }) {
    if (kind === "html") {
      copy.innerHTML = words;
      return;
    }
    let frame = copy;
    if (LEVELS[kind]) {
      frame = copy.querySelector("[data-testid=stAlertContainer], .live-alert");
      if (!frame) copy.replaceChildren(frame = Object.assign(document.createElement("div"), { className: "live-alert" }));
      for (const colour of COLOURS) frame.classList.toggle(`live-${colour}`, colour === LEVELS[kind]);
    }
    const own = frame.querySelector("[data-testid=stMarkdownContainer], [data-testid=stCaptionContainer]");
    (own ?? frame).innerHTML = this.markdown.html(words, this.katex);
  }

  // Marked, to tell it from the same text written by the page.
  write(node, words) {
    const text = `${words}${MARK}`;
    if (!node || node.nodeValue === text) return;
    const said = this.written.get(node)?.said ?? node.nodeValue;
    node.nodeValue = text;
    this.written.set(node, { said, text });
  }

  // Streamlit updates only the texts that differ from its own last ones; the others are restored here.
  settle() {
    for (const [node, { said, text }] of this.written) if (node.nodeValue === text) node.nodeValue = said;
    this.written.clear();
    document.querySelectorAll(".live-said").forEach((copy) => copy.remove());
    for (const name of ["live-overwritten", "live-unknown", "live-refused"])
      document.querySelectorAll(`.${name}`).forEach((place) => place.classList.remove(name));
    window.rotorcalcCharts?.forEach((chart) => chart.settle());
    document.body.classList.remove("rotorcalc-dragging");
  }
}

// The theme's colours, which Streamlit gives to components alone.
function style(parent) {
  const theme = getComputedStyle(parent);
  const rules = COLOURS.map((colour) => {
    const [back, text] = ["background", "text"].map((part) => theme.getPropertyValue(`--st-${colour}-${part}-color`));
    return `.live-${colour} {background-color: ${back} !important; color: ${text} !important;}
      .live-${colour} :not(.stMarkdownBadge) {color: inherit !important;}`;
  });
  return STYLE + rules.join("");
}

const previews = new WeakMap();

export default function ({ data, parentElement, setTriggerValue }) {
  const id = "live-preview-style";
  const rules = document.getElementById(id) ?? Object.assign(document.createElement("style"), { id });
  const wanted = style(parentElement);
  if (rules.textContent !== wanted) rules.textContent = wanted;
  if (!rules.isConnected) document.head.append(rules);
  if (!previews.has(parentElement)) {
    previews.set(parentElement, new Preview());
    const place = Object.assign(document.createElement("div"), { className: "live-preview", hidden: true });
    parentElement.replaceChildren(place);
  }
  const preview = previews.get(parentElement);
  window.rotorcalcPreview = preview;
  preview.update(...data, setTriggerValue);
  return () => {
    if (window.rotorcalcPreview === preview) window.rotorcalcPreview = undefined;
  };
}
