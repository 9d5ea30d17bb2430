"""The gallery has a card and a viewer for every data set, and says whose it is."""

import json
import re
from html import unescape
from pathlib import Path

from polyskel_lite import datasets

GALLERY = Path(__file__).resolve().parents[2] / "notebooks" / "gallery.ipynb"


def test_every_data_set_has_a_card_that_leads_to_its_viewer():
    cells = json.loads(GALLERY.read_text(encoding="utf-8"))["cells"]
    pages = ["".join(o["data"]["text/html"]) for c in cells for o in c.get("outputs", [])]
    (cards,) = (page for page in pages if 'class="psl-gallery"' in page)
    found = dict(re.findall(r'<li .*?<a href="#(\w+)">(.*?)</li>', unescape(cards)))
    prose = "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")
    assert sorted(found) == sorted(re.findall(r"^### (\w+)$", prose, re.M)) == datasets.names(None)
    assert sum('class="psl-viewer"' in page for page in pages) == len(found)
    for name, card in found.items():
        about, source, licence = datasets.info(name).splitlines()
        said = [about.split(": ", 1)[1].split(" (")[0], source, licence]
        said += [f"{len(datasets.load(name).points):,} samples", "data:image/png;base64,"]
        assert [words for words in said if words.lower() not in card.lower()] == [], name
