"""How fast the skeleton viewer is in headless Chromium, without a graphics card.

    .venv/bin/python benchmarks/viewer.py [--polygons 5000 50000] [--browser /usr/bin/chromium]

Prints a table: size of the page, milliseconds from opening it to the first picture, and from one picture to
the next (median, longest) while the reader turns it, moves the threshold, or simplifies the shape.
"""

from __future__ import annotations

import argparse
import statistics
import tempfile
from pathlib import Path

import inputs
import numpy as np
from playwright.sync_api import sync_playwright
from tables import write_table

import polyskel_lite as psl
from polyskel_lite import explore

FLAGS = [
    *("--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"),
    *("--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"),
]

# One step after the other, each as soon as the last picture is there; reading a pixel waits for the renderer.
STEPS = """
async ([selector, keys, count]) => {
  const root = document.querySelector(".psl-viewer"), target = root.querySelector(selector);
  const canvas = root.querySelector("canvas"), times = [];
  const turn = (key) => target.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
  const slide = (k) => { target.value = String(k); target.dispatchEvent(new Event("input")); };
  for (let k = 0; k < count; k++) {
    const frames = root.dataset.frames, start = performance.now();
    if (keys) turn(keys); else slide(Math.round((target.max * (k + 1)) / (count + 1)));
    while (root.dataset.frames === frames) await new Promise(requestAnimationFrame);
    canvas.getContext("2d").getImageData(0, 0, 1, 1);
    times.push(performance.now() - start);
  }
  return times;
}
"""


def solid(polygons: int) -> psl.Hierarchy:
    """The surface hierarchy of a bumpy sphere whose skeleton has about this many polygons."""
    n = polygons // 3
    for _ in range(4):
        tessellation = psl.delaunay(inputs.bumpy_samples(n))
        P = psl.DelaunayShape(tessellation, inputs.bumpy_inside(tessellation))
        found = len(psl.sk0(P).polygons)
        if abs(found - polygons) < 0.02 * polygons:
            break
        n = round(n * polygons / found)
    return psl.hierarchy(P, "surface")


def measure(browser, path: Path) -> dict[str, list[float]]:
    """Times in milliseconds: of opening a saved viewer, and between its pictures."""
    page = browser.new_page(viewport={"width": 900, "height": 900})
    page.goto(path.as_uri())
    page.wait_for_selector(".psl-viewer[data-frames]", timeout=60_000)
    root = page.locator(".psl-viewer")
    found = {"first": [float(root.get_attribute("data-first-picture"))]}
    found["turn"] = page.evaluate(STEPS, ["canvas", "ArrowRight", 40])
    found["threshold"] = page.evaluate(STEPS, ["[data-control=threshold]", "", 40])
    page.evaluate(STEPS, ["[data-control=threshold]", "", 1])
    found["simplify"] = page.evaluate(STEPS, ["[data-control=simplified]", "", 20])
    page.close()
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--polygons", type=int, nargs="+", default=[5_000, 50_000])
    parser.add_argument("--browser", default="/usr/bin/chromium", help="Chromium to run")
    parser.add_argument("--out", type=Path, default=Path(__file__).resolve().parent / "viewer.csv")
    options = parser.parse_args()
    rows = []
    print("polygons  page kB  first ms  turn ms (max)  threshold ms (max)  simplify ms (max)")
    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as folder:
        browser = playwright.chromium.launch(executable_path=options.browser, args=FLAGS)
        for polygons in options.polygons:
            path = Path(folder) / f"{polygons}.html"
            picture = explore.viewer(solid(polygons), threshold=-np.inf)
            picture.strip = "<p>no still pictures here</p>"
            picture.save(path)
            times = measure(browser, path)
            shown = picture.counts()["polygons"]
            moves = "  ".join(
                f"{statistics.median(times[name]):6.1f} ({max(times[name]):.1f})"
                for name in ("turn", "threshold", "simplify")
            )
            print(f"{shown:8,}  {path.stat().st_size / 1e3:7.0f}  {times['first'][0]:8.0f}  {moves}")
            rows.append(
                {"polygons": shown, "page_kb": round(path.stat().st_size / 1e3), "first": times["first"][0]}
                | {
                    name: round(statistics.median(times[name]), 1)
                    for name in ("turn", "threshold", "simplify")
                }
            )
        browser.close()
    write_table(options.out, rows)


if __name__ == "__main__":
    main()
