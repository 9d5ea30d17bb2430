// Elements of a page.

/** A name that no other element of the page has: in JupyterLab each viewer brings its own copy of this module. */
export function ownName() {
  const key = Symbol.for("polyskel_lite.viewer.count");
  globalThis[key] = (globalThis[key] ?? 0) + 1;
  return `psl-${globalThis[key]}`;
}

export function make(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) node.addEventListener(key.slice(2), value);
    else if (key in node && typeof value !== "string") node[key] = value;
    else if (value !== null && value !== undefined) node.setAttribute(key, value);
  }
  node.append(...children);
  return node;
}

/** Set an attribute; if it is so already the browser need not look at the styles again. */
export function say(node, name, value) { if (node.getAttribute(name) !== value) node.setAttribute(name, value); }
