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

/** The data of a picture: those in the page, or those of a script that the page names and that is fetched now. */
async function dataOf(root) {
  const { textContent, dataset: { from, name } } = root.querySelector("script[type='application/json']");
  if (!from) return JSON.parse(textContent);
  await new Promise((fetched, failed) => {
    const script = make("script", { src: from });
    script.onload = fetched;
    script.onerror = () => failed(new Error(`${from} is not there`));
    document.head.append(script);
  });
  return globalThis.pslData[name];
}

/** Call with each of these parts of a page and its data, once the reader comes near. */
export function whenNear(roots, call) {
  const near = new IntersectionObserver((entries) => entries.forEach(({ isIntersecting, target }) => {
    if (!isIntersecting) return;
    near.unobserve(target);
    dataOf(target).then((data) => call(target, data)).catch((error) => {
      target.dataset.error = String(error);
      console.warn("picture of this page:", error);
    });
  }), { rootMargin: "600px" });
  for (const root of roots) near.observe(root);
}

/** Set an attribute; if it is so already the browser need not look at the styles again. */
export function say(node, name, value) { if (node.getAttribute(name) !== value) node.setAttribute(name, value); }
