// The preview: a page's charts and numbers at the value to which a slider is being dragged.
//
// While a slider is dragged, charts and numbers are requested from the server without a run of the page by Streamlit.
// Charts are redrawn, numbers overwritten in place, and parts without a preview dimmed. After release, when the page
// has run, its own content applies again.
//
// A released slider sends its value through this component, because Streamlit then runs only the fragment that
// contains the component, and not the sidebar; the answer has the value of every slider.

const STYLE = `
.rotorcalc-dragging :is([data-testid=stAlert], [data-testid=stMetricDelta], .katex-display, [data-testid=stTable]) {
  opacity: 0.35;}
`;

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
    if (!this.available) return false;
    const asked = new URLSearchParams({ name, value });
    let answer;
    try {
      answer = await fetch(`${this.address}?${asked}`,
        { headers: { "X-Rotorcalc-Page": this.token }, signal: AbortSignal.timeout(PATIENCE) });
    } catch {
      return false;
    }
    if (answer.status !== 200) {
      this.available = false; // the server does not know this page: sliders send through Streamlit
      return false;
    }
    const { charts, rows } = await answer.json();
    document.body.classList.add("rotorcalc-dragging");
    for (const [key, texts] of Object.entries(rows)) {
      const values = document.querySelectorAll(`.st-key-${key} [data-testid="stMetricValue"]`);
      texts.forEach((text, i) => this.write(values[i] && textOf(values[i]), text));
    }
    const drawings = Object.entries(charts).map(([key, figure]) => window.rotorcalcCharts?.get(key)?.preview(figure));
    await Promise.all(drawings);
    return true;
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
    window.rotorcalcCharts?.forEach((chart) => chart.settle());
    document.body.classList.remove("rotorcalc-dragging");
  }
}

const previews = new WeakMap();

export default function ({ data, parentElement, setTriggerValue }) {
  if (!document.getElementById("live-preview-style")) {
    const style = Object.assign(document.createElement("style"), { id: "live-preview-style" });
    style.textContent = STYLE;
    document.head.append(style);
  }
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
