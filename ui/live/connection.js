// The connection to the server: how soon it is back, and what the browser keeps for a server that knows nothing.
//
// A server that was restarted, or stands in for another, has no session of this page. What a session holds beside
// the address bar is kept here, and given to Streamlit as this component's state when the connection is lost: it
// goes out with the run that Streamlit asks for when the connection is back.
//
// Streamlit looks for a lost server up to four seconds apart, waits fifteen for one that is silent, and does not
// notice a connection that has died without a word. So the server is asked here too. Where it answers and Streamlit
// has no connection, Streamlit begins a new one at once; where it has one, that must answer a heartbeat. Both are
// messages that Streamlit takes from a page around it (ui/serving/own_origin.py lets this page be that).

// Milliseconds: between two looks at a server that is gone, and as long as a look may take; what a new connection
// gets to come about; for a heartbeat's answer, which stands behind what a run sends.
const LOOK = 1000;
const BEGIN = 3000;
const PATIENCE = 4000;
const BUSY = 15000;

const app = () => document.querySelector('[data-testid="stApp"]');
const state = () => app()?.dataset.testConnectionState;
const running = () => app()?.dataset.testScriptState !== "notRunning";

function tell(type, more = {}) {
  window.postMessage({ stCommVersion: 1, type, ...more }, location.origin);
}

class Connection {
  constructor() {
    this.wake = () => {};
    new MutationObserver(() => this.changed()).observe(app(), {
      attributes: true, attributeFilter: ["data-test-connection-state"],
    });
    for (const event of ["online", "focus", "pageshow"]) window.addEventListener(event, () => this.wake());
    this.watch();
  }

  update({ kept, health }, keep) {
    this.kept = kept ?? this.kept; // a server that knew nothing of the session has nothing to tell
    this.health = health;
    this.keep = keep;
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

export default function ({ data, parentElement, setStateValue }) {
  window.rotorcalcConnection ??= new Connection();
  window.rotorcalcConnection.update(data, setStateValue);
  if (!parentElement.querySelector(".live-connection")) {
    parentElement.append(Object.assign(document.createElement("div"), { className: "live-connection", hidden: true }));
  }
}
