// The feed: what follows a held thumb, in one message, past Streamlit's other elements.
//
// A held slider sends through it {name, value, number}; back comes {number, charts, rows}. Charts are
// redrawn and numbers overwritten where they stand; all that does not follow is dimmed. When the thumb
// has been let go and the whole page has run, what the page says holds again.

const STYLE = `
.rotorcalc-held :is([data-testid=stAlert], [data-testid=stMetricDelta], .katex-display, [data-testid=stTable]) {
  opacity: 0.35;}
`;

function textOf(element) {
  const walker = document.createTreeWalker(element, NodeFilter.SHOW_TEXT);
  return walker.nextNode();
}

class Feed {
  constructor() {
    this.echo = null;
    this.written = new Map(); // text nodes: what the page said, and what is written over it
  }

  send(message) {
    this.trigger("moved", message);
  }

  apply({ number, charts, rows }) {
    document.body.classList.add("rotorcalc-held");
    for (const [key, figure] of Object.entries(charts ?? {})) window.rotorcalcCharts?.get(key)?.follow(figure);
    for (const [key, texts] of Object.entries(rows ?? {})) {
      const values = document.querySelectorAll(`.st-key-${key} [data-testid="stMetricValue"]`);
      texts.forEach((text, i) => this.write(values[i] && textOf(values[i]), text));
    }
    this.echo = number;
  }

  write(node, text) {
    if (!node) return;
    const said = this.written.get(node)?.said ?? node.nodeValue;
    node.nodeValue = text;
    this.written.set(node, { said, text });
  }

  // The page knows only what it said itself: where it has said nothing new, that holds again.
  settle() {
    for (const [node, { said, text }] of this.written) if (node.nodeValue === text) node.nodeValue = said;
    this.written.clear();
    window.rotorcalcCharts?.forEach((chart) => chart.settle());
    document.body.classList.remove("rotorcalc-held");
  }
}

const feeds = new WeakMap();

export default function ({ data, parentElement, setTriggerValue }) {
  if (!document.getElementById("live-feed-style")) {
    const style = Object.assign(document.createElement("style"), { id: "live-feed-style" });
    style.textContent = STYLE;
    document.head.append(style);
  }
  if (!feeds.has(parentElement)) {
    feeds.set(parentElement, new Feed());
    const place = Object.assign(document.createElement("div"), { className: "live-feed", hidden: true });
    parentElement.replaceChildren(place);
  }
  const feed = feeds.get(parentElement);
  feed.trigger = setTriggerValue;
  window.rotorcalcFeed = feed;
  const message = JSON.parse(new TextDecoder().decode(data));
  if (message.number !== undefined) feed.apply(message);
  return () => {
    if (window.rotorcalcFeed === feed) window.rotorcalcFeed = undefined;
  };
}
