"""axe's rules on a page, with nothing excluded."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from playwright.sync_api import Page

# Folded text is read too, once its reader has opened it.
UNFOLD = """() => {
    document.querySelectorAll("details").forEach((box) => (box.open = true));
    document.querySelectorAll("button.toggle-button-hidden").forEach((button) => button.click());
}"""
# Of the words of code that look alike on a page one is enough.
ALIKE = """() => {
    const seen = new Set();
    for (const word of document.querySelectorAll("div.highlight pre span[class]")) {
        const look = `${word.className} in ${word.closest("div.highlight").parentNode.className}`;
        if (seen.has(look)) word.dataset.alike = "";
        seen.add(look);
    }
}"""
# The rule on contrast takes most of the time. It looks at the first of all texts of one colour, size, name
# and ground; how faded they and what is around them are, counts too.
FIRST = """() => {
    const seen = new Set(), words = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (const one of document.querySelectorAll("[data-first]")) delete one.dataset.first;
    for (const one of document.querySelectorAll("input, textarea, select")) one.dataset.first = "";
    while (words.nextNode()) {
        if (!words.currentNode.data.trim()) continue;
        const own = words.currentNode.parentElement, style = getComputedStyle(own);
        const look = [style.color, style.fontSize, style.fontWeight, style.textShadow];
        for (let at = own; at && at.parentElement; at = at.parentElement) {
            const { backgroundColor, backgroundImage, opacity, filter } = getComputedStyle(at);
            look.push([backgroundColor, backgroundImage.slice(0, 40), opacity, filter]);
        }
        look.push(own.tagName, own.className, own.parentElement.className);
        if (!seen.has(look.join())) own.dataset.first = "";
        seen.add(look.join());
    }
}"""
# preload would fetch the style sheets again, for one rule on turned screens; a page on disk may not do that.
OPTIONS = {"preload": False, "resultTypes": ["violations", "incomplete"]}
COLOURS = {"runOnly": ["color-contrast"]}
STRUCTURE = {"rules": {"color-contrast": {"enabled": False}}}


def findings(page: "Page", part: dict[str, object] | None = None, context: str | None = None) -> list[str]:
    """Each rule that is broken on the page as it stands, of any weight, with the first places where."""
    from axe_playwright_python.sync_playwright import Axe

    if part is None and context is None:
        return findings(page, STRUCTURE) + findings(page, COLOURS)
    page.evaluate(UNFOLD)
    page.evaluate(FIRST if part is COLOURS else ALIKE)
    context = context or ({"include": ["[data-first]"]} if part is COLOURS else {"exclude": ["[data-alike]"]})
    results = Axe().run(page, context, OPTIONS | (part or {})).response
    broken = [(rule, rule["nodes"]) for rule in results["violations"]]
    # Text in the very colour of what is behind it might be meant, says axe; here it never is.
    broken += [
        (rule, unseen) for rule in results["incomplete"] if (unseen := list(filter(is_unseen, rule["nodes"])))
    ]
    return [
        f"{rule['id']} ({rule['impact']}): {rule['help']}; {len(nodes)} times: "
        + ", ".join(str(node["target"][0]) for node in nodes[:5])
        for rule, nodes in broken
    ]


def is_unseen(node: dict) -> bool:
    return any((check["data"] or {}).get("messageKey") == "equalRatio" for check in node["any"])
