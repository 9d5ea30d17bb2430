"""How fast explorers on pages are in headless Chromium without a graphics card, from an input to its picture.

    .venv/bin/python benchmarks/toys.py [--browser /usr/bin/chromium]

Prints a table: what an explorer adds to its page (kilobytes), the JavaScript of a page that has it alone, and
milliseconds from a key or a handle's move to the painted picture (median, 95th percentile).
"""

from __future__ import annotations

import argparse
import statistics
import tempfile
from pathlib import Path

import numpy as np
from playwright.sync_api import sync_playwright
from tables import write_table

from polyskel_lite import explore
from polyskel_lite.explore.bundle import page_module, page_style, whole_page

FLAGS = ["--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking"]
#: Explorer, how it comes, and what is moved: a slider by its keys, or the handle of this number.
CASES = (
    ("maximal_ball", "live", 0),
    ("sampling", "live", "n"),
    ("graphs", "live", 0),
    ("four_methods", "live", "n"),
    ("balls", "live", 0),
    ("refinement", "recorded", "step"),
    ("removals", "live", "step"),
)
# A picture is painted when, after the frame that shows it, the next task runs.
MOVES = """
async ([what, count]) => {
  const times = [], slider = typeof what === "string";
  const target = document.querySelector(slider ? `[data-control=${what}]` : `[data-handle="${what}"]`);
  const painted = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
  for (let k = 0; k < count; k++) {
    await painted();
    const start = performance.now();
    if (slider) {
      target.value = String(Number(target.value) + (k % 20 < 10 ? 1 : -1));
      target.dispatchEvent(new Event("input"));
    } else {
      const key = ["ArrowLeft", "ArrowUp", "ArrowRight", "ArrowDown"][k % 4];
      target.dispatchEvent(new KeyboardEvent("keydown", { key, shiftKey: k % 8 < 4, bubbles: true }));
    }
    await new Promise(requestAnimationFrame); // the board draws in the next frame
    await new Promise((done) => setTimeout(done));
    times.push(performance.now() - start);
  }
  return times;
}
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--browser", default="/usr/bin/chromium", help="Chromium to run")
    parser.add_argument("--out", type=Path, default=Path(__file__).resolve().parent / "toys.csv")
    options = parser.parse_args()
    rows = []
    print("explorer        way       data kB  module kB  median ms  95 % ms")
    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as folder:
        browser = playwright.chromium.launch(executable_path=options.browser, args=FLAGS)
        for name, way, moved in CASES:
            explorer = getattr(explore, name)()
            module, body = page_module([type(explorer).__name__]), explorer.stand_in()
            path = Path(folder) / f"{name}.html"
            path.write_text(whole_page(name, body, module, page_style()), encoding="utf-8")
            page = browser.new_page(viewport={"width": 1280, "height": 900})
            page.goto(path.as_uri())
            page.wait_for_selector(".psl-toy[data-ready]")
            times = page.evaluate(MOVES, [moved, 80])
            page.close()
            row = {
                "explorer": name,
                "way": way,
                "data_kb": round((len(body) - len(explorer.board.svg())) / 1e3, 1),
                "module_kb": round(len(module.encode()) / 1e3, 1),
                "median_ms": round(statistics.median(times), 1),
                "p95_ms": round(float(np.percentile(times, 95)), 1),
            }
            rows.append(row)
            print("{explorer:15} {way:9} {data_kb:7} {module_kb:10} {median_ms:10} {p95_ms:8}".format(**row))
        browser.close()
    write_table(options.out, rows)


if __name__ == "__main__":
    main()
