"""axe's rules on a page, with nothing excluded."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from playwright.sync_api import Page

# Folded text is read too, once its reader has opened it.
UNFOLD = """() => {
    document.querySelectorAll("details").forEach((box) => (box.open = true));
    document.querySelectorAll("button.toggle-button-hidden").forEach((button) => button.click());
}"""
# preload would fetch the style sheets again, for one rule on turned screens; a page on disk may not do that.
OPTIONS = {"preload": False, "resultTypes": ["violations"]}
COLOURS = {"runOnly": ["color-contrast"]}
STRUCTURE = {"rules": {"color-contrast": {"enabled": False}}}


def findings(page: "Page", part: dict[str, object] | None = None, context: str | None = None) -> list[str]:
    """Each rule that is broken on the page as it stands, of any weight, with the first places where."""
    from axe_playwright_python.sync_playwright import Axe

    page.evaluate(UNFOLD)
    broken = Axe().run(page, context, OPTIONS | (part or {})).response["violations"]
    return [
        f"{rule['id']} ({rule['impact']}): {rule['help']}; {len(rule['nodes'])} times: "
        + ", ".join(str(node["target"][0]) for node in rule["nodes"][:5])
        for rule in broken
    ]
