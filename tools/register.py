"""The register of claims as cards for its page, and as the table claims.csv: ``python tools/register.py``."""

from __future__ import annotations

import csv
import io
import re
import tomllib
from collections.abc import Iterable
from pathlib import Path

NOTEBOOKS = Path(__file__).resolve().parent.parent / "notebooks"
#: Every verdict has a sign beside its word, so that nobody needs a colour.
SIGNS = {
    "holds": "✔",
    "holds under": "◐",
    "does not hold": "✘",
    "transcript": "✎",
    "definition": "≝",
    "seen on our own data": "◉",
}
ASKED = ("id", "section", "place", "statement", "verdict", "condition", "reading", "tolerance")
COLUMNS = (*ASKED, "why", "proof", "notebook", "cell", "test")


def load() -> list[dict[str, str]]:
    """The claims in the order of the paper."""
    claims = tomllib.loads((NOTEBOOKS / "claims.toml").read_text(encoding="utf-8"))["claim"]
    return sorted(claims, key=lambda claim: claim["section"].replace("A", "6").replace("B", "7"))


def where(claim: dict[str, str]) -> str:
    """The address of the cell that shows a claim."""
    return f"{Path(claim['notebook']).name}#claim-{claim['id']}"


def proof(claim: dict[str, str]) -> str:
    """Where a proof stands, as MyST."""
    place = claim.get("proof", "")
    if place.startswith("cite:"):
        return f" Proved by {source(place.removeprefix('cite:'))}."
    return f' <a href="{place}">A proof</a> is in the book.' if place else ""


def source(key: str) -> str:
    """First author and year of an entry of the bibliography, linked to the list of all."""
    text = (NOTEBOOKS / "references.bib").read_text(encoding="utf-8")
    entry = re.search(rf"@\w+\{{{key},\n(.*?)\n\}}", text, re.S)[1]
    authors = re.search(r"author\s*= \{(.*)\}", entry)[1].split(" and ")
    names = [author.split(",")[0].strip("{}") for author in authors]
    year = re.search(r"year\s*= \{(\d+)\}", entry)[1]
    others = {1: "", 2: f" and {names[-1]}"}.get(len(names), " and others")
    return f'<a href="references.html">{names[0]}{others}, {year}</a>'


def linked(text: str) -> str:
    """Names of other claims in a text become links to their cards, citations links to the sources."""
    text = re.sub(r"\{cite\}`(\w+)`", lambda key: f"({source(key[1])})", text)
    return re.sub(r"\bsee ([a-z0-9]+(?:-[a-z0-9]+)+)\b", r'see <a href="#row-\1">\1</a>', text)


def card(claim: dict[str, str]) -> str:
    """One claim as a card: verdict, statement, reading, and where it is shown, checked and proved."""
    verdict = claim["verdict"]
    condition = f" {claim['condition']}" if "condition" in claim else ""
    reading = "" if claim["reading"] == "as it stands" else f"\n\n*Reading:* {linked(claim['reading'])}."
    data = f'id="row-{claim["id"]}" data-verdict="{verdict}" data-section="{claim["section"]}"'
    return (
        f'<div class="claim" {data}>\n\n'
        f"{SIGNS[verdict]} **{verdict}**{condition} · section {claim['section']}, {claim['place']}\n\n"
        f"{claim['statement']}{reading}\n\n"
        f'<a href="{where(claim)}">Shown here</a>, checked as `{claim["id"]}`.{proof(claim)}\n\n</div>\n'
    )


def cards(claims: Iterable[dict[str, str]]) -> str:
    """All claims of some sections, as MyST."""
    return "\n".join(map(card, claims))


def short(claims: Iterable[dict[str, str]], field: str) -> str:
    """A list of links to cards, each with its statement and one more field."""
    lines = []
    for claim in claims:
        more = claim[field][0].upper() + claim[field][1:]
        link = f'<a href="#row-{claim["id"]}">{claim["section"]}</a>'
        lines.append(f"- {link}: {claim['statement']} *{more}.*")
    return "\n".join(lines)


def table(claims: Iterable[dict[str, str]]) -> str:
    """The register as comma-separated values."""
    text = io.StringIO()
    writer = csv.DictWriter(text, COLUMNS, restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows(claims)
    return text.getvalue()


if __name__ == "__main__":
    (NOTEBOOKS / "claims.csv").write_text(table(load()), encoding="utf-8")
