// Slides: light or dark as the book is, formulas first (they need room to be measured), then pages to turn.
const chosen = localStorage.getItem("theme") ?? "auto";
const dark = matchMedia("(prefers-color-scheme: dark)").matches;
const paper = new URLSearchParams(location.search).has("print-pdf"); // which is white
document.documentElement.dataset.theme = paper ? "light" : chosen === "auto" ? (dark ? "dark" : "light") : chosen;

start();

async function start() {
  await window.MathJax?.startup?.promise;
  await Reveal.initialize({
    width: 1280, height: 720, margin: 0.03, center: false, display: "flex", hash: true, slideNumber: "c/t", transition: "none",
    // A key that works a button, a link or a folded answer does not turn the page as well.
    keyboardCondition: (event) => !(["Enter", " "].includes(event.key) && event.target.closest("summary, button, a")),
  });
  document.documentElement.dataset.ready = "true";
}
