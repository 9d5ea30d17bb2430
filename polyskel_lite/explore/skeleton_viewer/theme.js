// Colours on a light and on a dark ground: all lines and dots have a contrast of at least 3 : 1 to what is behind them.

const VIRIDIS = { // made for all kinds of colour vision: what is larger is brighter
  light: ["#440154", "#48186a", "#472e7c", "#414287", "#39558c", "#31678e", "#2a778e", "#24878e", "#1f978b"],
  dark: ["#27808e", "#21918c", "#1fa187", "#2db27d", "#4cc26c", "#73d056", "#a0da39", "#d0e11c", "#fde725"],
};
const DARK = {
  shape: "#c9d1d9", fill: "#23292f", glass: "#9fb0bd", ghost: "#7a8794", removed: "#191e23",
  samples: "#ffffff", skeleton: "#ff9a4d", vertices: "#e6edf3",
};
const DARK_BALLS = { shape: "#d8c95a", fill: "#2f2c14", glass: "#cdbf5b" };
const NAMES = ["data-theme", "data-jp-theme-light"]; // of the book, and of JupyterLab

/** The colours for the theme of the page around an element; those on a light ground come with the data. */
export function palette(element, light, balls) {
  const dark = Boolean(element.closest("[data-theme='dark'], [data-jp-theme-light='false']"));
  return dark
    ? { name: "dark", ground: "#14181d", ink: "#e6edf3", ramp: VIRIDIS.dark, colors: { ...DARK, ...(balls && DARK_BALLS) } }
    : { name: "light", ground: "#ffffff", ink: "#222222", ramp: VIRIDIS.light, colors: light };
}

/** Call when the reader changes the theme; returns how to stop that. */
export function followTheme(changed) {
  const observer = new MutationObserver(changed);
  for (const node of [document.documentElement, document.body]) observer.observe(node, { attributeFilter: NAMES });
  return () => observer.disconnect();
}
