// The feed: values that are let go, and what follows a held thumb, past Streamlit's running and drawing.
//
// A slider that is let go sends by the feed, for what runs then is the part of the page that holds the feed,
// and not the sidebar; the answer has every slider's value.
//
// A held slider asks the server what a value would give: charts, redrawn, and numbers, overwritten
// where they stand; all that does not follow is dimmed. When the thumb has been let go and the
// page has run, what it says holds again.

const STYLE = `
.rotorcalc-held :is([data-testid=stAlert], [data-testid=stMetricDelta], .katex-display, [data-testid=stTable]) {
  opacity: 0.35;}
`;

const MARK = "\u200b"; // takes no room

function textOf(element) {
  const walker = document.createTreeWalker(element, NodeFilter.SHOW_TEXT);
  return walker.nextNode();
}

class Feed {
  constructor() {
    this.written = new Map(); // text nodes: what the page said, and what is written over it
  }

  update(common, values, send) {
    Object.assign(this, common, { values, send });
    for (const { slider } of document.querySelectorAll(".live-slider")) slider.rest();
  }

  // Ends when the answer is drawn; false where there is none to be had.
  async follow(name, value) {
    if (!this.follows) return false;
    const asked = new URLSearchParams({ name, value });
    let answer;
    try {
      answer = await fetch(`${this.address}?${asked}`, { headers: { "X-Rotorcalc-Page": this.token } });
    } catch {
      return false;
    }
    if (answer.status !== 200) {
      this.follows = false; // not known there: sliders send through Streamlit
      return false;
    }
    const { charts, rows } = await answer.json();
    document.body.classList.add("rotorcalc-held");
    for (const [key, texts] of Object.entries(rows)) {
      const values = document.querySelectorAll(`.st-key-${key} [data-testid="stMetricValue"]`);
      texts.forEach((text, i) => this.write(values[i] && textOf(values[i]), text));
    }
    const drawings = Object.entries(charts).map(([key, figure]) => window.rotorcalcCharts?.get(key)?.follow(figure));
    await Promise.all(drawings);
    return true;
  }

  // Marked as ours: the page may come to say the same itself.
  write(node, words) {
    const text = `${words}${MARK}`;
    if (!node || node.nodeValue === text) return;
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
  window.rotorcalcFeed = feed;
  feed.update(...data, setTriggerValue);
  return () => {
    if (window.rotorcalcFeed === feed) window.rotorcalcFeed = undefined;
  };
}
