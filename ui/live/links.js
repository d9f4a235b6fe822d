// Links between pages, each to the machine as it is now, which the address bar has.
//
// Streamlit draws them without it, once for all runs of a page. So a link is completed when a visitor comes to it,
// for a new tab or to be copied; a plain click goes to its page in the same session. That is done as a browser goes
// forward in its history, for which Streamlit listens: it shows the page that then stands in the address bar.

let names = []; // of choices, which belong to the page that is left

// Milliseconds in which a field that is left by the click sends what was typed into it, still to its own page. A tap
// leaves no time between press and click.
const A_MOMENT = 60;

const STREAMLITS = '[data-testid="stPageLink-NavLink"]';
const connected = () => document.querySelector('[data-testid="stApp"]')?.dataset.testConnectionState === "CONNECTED";

// Returns the link to a page at which something happened, with the machine; undefined where there is none.
function completed({ target }) {
  const link = target.closest?.(STREAMLITS);
  if (!link || link.target) return undefined; // those that open a tab lead elsewhere
  const to = new URL(link.getAttribute("href") || ".", location.href); // the home page's is empty
  const query = new URLSearchParams(location.search);
  names.forEach((name) => query.delete(name));
  to.search = query;
  const address = to.pathname + to.search;
  if (link.getAttribute("href") !== address) link.setAttribute("href", address);
  return link;
}

function follow(event) {
  const link = completed(event);
  if (!link) return;
  event.stopPropagation(); // Streamlit would go there without the machine
  if (event.ctrlKey || event.metaKey || event.shiftKey || event.altKey) return; // the browser opens or saves it
  event.preventDefault();
  const { href, pathname } = link;
  setTimeout(() => go(href, pathname), A_MOMENT);
}

function go(href, pathname) {
  if (!connected()) return;
  history[pathname === location.pathname ? "replaceState" : "pushState"]({}, "", href);
  window.dispatchEvent(new PopStateEvent("popstate"));
}

function listen() {
  for (const event of ["pointerover", "focusin", "pointerdown"]) document.addEventListener(event, completed, true);
  document.addEventListener("click", follow, true);
}

export default function ({ data, parentElement }) {
  if (!names.length) listen();
  names = data;
  if (!parentElement.querySelector(".live-links")) {
    parentElement.append(Object.assign(document.createElement("div"), { className: "live-links", hidden: true }));
  }
}
