// The connection to the server: fast reconnection, and the state kept here for a server without the session.
//
// A server that was restarted, or that replaces another, has no session of this page. The session's state beside the
// address bar is kept here. When the connection is lost it becomes this component's state in Streamlit, which sends
// it with the first run after reconnection. A page that is reloaded gets another session too: the tab's own storage
// keeps the state meanwhile, and the new session is sent it once, where its address is the same.
//
// Streamlit tries a lost server every four seconds at most, waits fifteen for a silent one, and does not notice a
// connection that was cut without a close. So this script asks too: if the server answers while Streamlit has no
// connection, Streamlit is told to open one at once; an open connection must answer a heartbeat. Streamlit accepts
// both messages from a page that embeds it (ui/serving/own_origin.py makes this page count as one).

// Milliseconds: between two requests to a lost server, and the longest that one may take; for a new connection to
// open; for a heartbeat's answer, and during a run, whose messages are sent before it.
const LOOK = 1000;
const BEGIN = 3000;
const PATIENCE = 4000;
const BUSY = 15000;
// Between two looks whether a page that was reloaded is drawn.
const REST = 100;

const STORE = "rotorcalc";
const address = () => location.pathname + location.search;

const app = () => document.querySelector('[data-testid="stApp"]');
const state = () => app()?.dataset.testConnectionState;
const running = () => app()?.dataset.testScriptState !== "notRunning";

function tell(type, more = {}) {
  window.postMessage({ stCommVersion: 1, type, ...more }, location.origin);
}

// The state that this tab kept of the page at this address; a browser may refuse its storage.
function stored() {
  try {
    const page = JSON.parse(sessionStorage.getItem(STORE));
    return page?.address === address() ? page.kept : undefined;
  } catch {
    return undefined;
  }
}

function store(kept) {
  try {
    sessionStorage.setItem(STORE, JSON.stringify({ address: address(), kept }));
  } catch { /* without it a reload begins anew */ }
}

class Connection {
  constructor() {
    this.kept = this.stored = stored();
    window.addEventListener("pagehide", () => this.kept && store(this.kept));
    this.wake = () => {};
    new MutationObserver(() => this.changed()).observe(app(), {
      attributes: true, attributeFilter: ["data-test-connection-state"],
    });
    for (const event of ["online", "focus", "pageshow"]) window.addEventListener(event, () => this.wake());
    this.watch();
  }

  update(health, keep, send) {
    Object.assign(this, { health, keep });
    if (this.stored && !this.sent) this.restore(send);
    this.sent = true;
  }

  // Once the whole page is drawn: what is sent before has not all of its fields, and these would lose their values.
  restore(send) {
    if (running()) setTimeout(() => this.restore(send), REST);
    else send("reloaded", this.stored);
  }

  // What a session sends before it has taken over the last one's state is not to be kept.
  take(kept) {
    if (kept.recalled || !this.stored) this.kept = kept;
  }

  changed() {
    const lost = state() !== "CONNECTED";
    if (lost && !this.lost && this.kept) this.keep("kept", this.kept);
    if (lost !== this.lost) this.wake();
    this.lost = lost;
  }

  pause(milliseconds) {
    return new Promise((resolve) => {
      this.wake = resolve;
      setTimeout(resolve, milliseconds);
    });
  }

  async watch() {
    for (;;) {
      if (state() === "CONNECTED") {
        const ackTimeoutMilliseconds = running() ? BUSY : PATIENCE;
        tell("SEND_APP_HEARTBEAT", { ackTimeoutMilliseconds });
        await this.pause(ackTimeoutMilliseconds + LOOK);
      } else {
        const next = this.pause(LOOK);
        if ((await this.answers()) && !["CONNECTED", "CONNECTING"].includes(state())) {
          tell("TERMINATE_WEBSOCKET_CONNECTION");
          tell("RESTART_WEBSOCKET_CONNECTION");
          await this.pause(BEGIN);
        }
        await next;
      }
    }
  }

  async answers() {
    const look = new AbortController();
    setTimeout(() => look.abort(), LOOK);
    try {
      return (await fetch(this.health, { cache: "no-store", signal: look.signal })).ok;
    } catch {
      return false;
    }
  }
}

export default function ({ data: { health, kept }, parentElement, setStateValue, setTriggerValue }) {
  const connection = (window.rotorcalcConnection ??= new Connection());
  if (kept) connection.take(kept);
  else connection.update(health, setStateValue, setTriggerValue);
  if (!parentElement.querySelector(".live-connection")) {
    parentElement.append(Object.assign(document.createElement("div"), { className: "live-connection", hidden: true }));
  }
}
