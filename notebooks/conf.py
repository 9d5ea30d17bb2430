"""Settings for Sphinx. The choices of the book stand in ../book.toml; the rest makes pages work offline."""

import json
import re
import runpy
import sys
import tomllib
from html import escape
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BOOK = tomllib.loads((ROOT / "book.toml").read_text(encoding="utf-8"))


def hosted_on(*hosts: str) -> bool:
    """Whether the book names a repository and one of these hosts has it."""
    return BOOK["book"].get("repository", "").startswith(tuple(f"https://{host}/" for host in hosts))


project = BOOK["book"]["title"]
author = ", ".join(BOOK["book"]["authors"])
copyright = BOOK["book"]["copyright"]  # Sphinx asks for this name

extensions = [
    "myst_nb",
    "sphinx_external_toc",
    "sphinx_design",
    "sphinx_copybutton",
    "sphinx_togglebutton",
    "sphinxcontrib.bibtex",
    "sphinx_proof",
    "sphinx_exercise",
    "sphinx.ext.mathjax",
    "sphinx-mathjax-offline",
    "check",
    "predict",
    "states",
]
sys.path.insert(0, str(Path(__file__).resolve().parent))  # the extensions of the book's own

# sphinx-external-toc reads YAML, and JSON is YAML.
external_toc_path = str(ROOT / "_build" / "toc.json")
Path(external_toc_path).parent.mkdir(exist_ok=True)
Path(external_toc_path).write_text(json.dumps(BOOK["toc"]), encoding="utf-8")

# The reference is read from the code, which is not run: the book needs no library to be built.
API = runpy.run_path(str(ROOT / "tools" / "api.py"))
toc_object_entries_show_parents = "hide"
default_role = "code"  # of docstrings: `name`

nb_execution_mode = "off"  # the pages are the notebooks as committed; `make test` runs them and compares
bibtex_bibfiles = ["references.bib"]
numfig = True
exclude_patterns = ["_build", "**.ipynb_checkpoints", "course/a[0-9]_*"]  # assignments are no pages
html_theme = "sphinx_book_theme"
html_title = project
html_static_path = ["_static"]
html_css_files = ["book.css", "predict.css", "check.css"]
html_favicon = "_static/icon.svg"
html_show_search_summary = False  # it fetches the pages found, which a page read from disk may not do
html_domain_indices = False  # sphinx-proof's index lists labels, which say nothing to a reader
html_context = {"default_mode": "auto"}  # light or dark as the reader's system says
templates_path = ["_templates"]
html_copy_source = False
html_theme_options = {"navbar_persistent": [], "show_toc_level": 2, "use_download_button": False}
if "repository" in BOOK["book"]:
    html_theme_options |= {
        "repository_url": BOOK["book"]["repository"],
        # Where a branch of working copies is named, the buttons open these: plain notebooks.
        "repository_branch": BOOK["book"].get("copies", BOOK["book"].get("branch", "main")),
        "repository_provider": BOOK["book"].get("provider", ""),
        "path_to_docs": "notebooks",
        "use_repository_button": True,
        "launch_buttons": {
            "notebook_interface": "jupyterlab",
            "binderhub_url": "https://mybinder.org" if hosted_on("github.com", "gitlab.com") else "",
            "colab_url": "https://colab.research.google.com" if hosted_on("github.com") else "",
            "jupyterlite_url": BOOK["book"].get("lite", ""),
        },
    }

# A widget is shown as the page's own HTML, and no script of a widget manager is fetched for it.
nb_mime_priority_overrides = [
    ("html", "application/vnd.jupyter.widget-view+json", None),
    ("html", "text/html", 0),
]
nb_ipywidgets_js = {}
# Formulas as text, and as MathML for who cannot see them; without the menu that most of MathJax is for.
mathjax3_config = {"loader": {"load": ["input/tex", "output/chtml", "a11y/assistive-mml"]}}
SLIDES = runpy.run_path(str(ROOT / "tools" / "slides.py"))
# By its path: the book needs no library to be built.
BUNDLE = runpy.run_path(str(ROOT / "polyskel_lite" / "explore" / "bundle.py"))
VIEWER = BUNDLE["one_module"]()
STYLE = BUNDLE["page_style"]()
#: A setting of Sphinx, so that pages are written again when what they hold of these has changed.
moving_parts = VIEWER + STYLE + "".join(f.read_text("utf-8") for f in sorted(BUNDLE["TOYS"].glob("*.js")))


def add_modules(app, pagename, templatename, context, doctree):
    """Put the modules into each page that asks for them: pages read from disk may not import modules."""
    body = context.get("body", "")
    if 'class="psl-viewer"' in body:
        app.add_js_file(None, body=VIEWER, type="module")
    if 'class="psl-toy"' in body or 'class="psl-predict"' in body:
        toys = BUNDLE["page_module"](set(re.findall(r'json">{"toy":"(\w+)"', body)))
        app.add_js_file(None, body=toys, type="module")
        context["metatags"] = context.get("metatags", "") + f"<style>{STYLE}</style>"


globals().update(BOOK.get("sphinx", {}).get("config", {}))


def references_as_list(app, pagename, templatename, context, doctree):
    """Give each reference the role that its list asks for; docutils writes one that has been withdrawn."""
    if "body" in context:
        context["body"] = context["body"].replace('role="doc-biblioentry"', 'role="listitem"')


def say_what_colab_needs(app, pagename, templatename, context, doctree):
    """Colab opens a chapter without the library: under the title stands the cell that brings it there."""
    if hosted_on("github.com") and "kernelspec" in app.env.metadata.get(pagename, {}):
        copy = f"{BOOK['book']['repository']}@{BOOK['book'].get('branch', 'main')}"
        library = f"polyskel-lite[graph,files,meshes] @ git+{copy}"
        cell = f'<code>%pip install -q "{escape(library)}" anywidget</code>'
        hint = f"<p>To run this chapter, use the rocket above. On Colab, run this first: {cell}</p>"
        context["body"] = context["body"].replace("</h1>", "</h1>" + hint, 1)


def link_claims_to_cells(app, pagename, templatename, context, doctree):
    """Give the cell that shows a claim an anchor, and cards, whose HTML says .ipynb, pages to link to."""
    if "body" not in context:
        return
    seen = set()

    def anchors(cell):
        names = [name for name in re.findall(r"tag_claim:([\w-]+)", cell[0]) if name not in seen]
        seen.update(names)
        return "".join(f'<span id="claim-{name}"></span>' for name in names) + cell[0]

    body = re.sub(r'<div class="cell [^"]*tag_claim:[^"]*"', anchors, context["body"])
    context["body"] = re.sub(r'(<a href="\w+)\.ipynb([#"])', r"\1.html\2", body)
    if 'class="claim"' in body:
        app.add_js_file("register.js")


def draw_the_house(app, docname, source):
    """Put the rooms and their arrows, read from the code, into the page that explains them."""
    if docname == "house":
        house = runpy.run_path(str(ROOT / "tools" / "house.py"))
        for name in ("picture", "table"):
            drawn = house[name](house["sources"]())
            source[0] = source[0].replace(f"```{{psl-house-{name}}}\n```", drawn)


def lay_out_the_contents(app, docname, source):
    """Put a card for each page into the page that lists them."""
    if docname == "contents":
        cards = runpy.run_path(str(ROOT / "tools" / "contents.py"))["contents"]()
        source[0] = source[0].replace("```{psl-contents}\n```", cards)


def fill_the_reference(app, docname, source):
    """Put what docstrings say into the reference, and links to its pages into the cards of chapters."""
    if docname.startswith("api"):

        def part(match):
            return (
                API["front"]()
                if match[1] == "front"
                else API["page" if match[1] in API["ROOMS"] else "beside"](match[1])
            )

        source[0] = re.sub(r"```\{psl-api\} (\w+)\n```", part, source[0])
    elif line := API["reference_line"](docname):
        code = r'(\n *)("- \*\*Code:\*\* )'
        source[0] = re.sub(
            code, lambda m: m[1] + json.dumps(line + "\n", ensure_ascii=False) + "," + m[1] + m[2], source[0]
        )


def changed_house(app, env, added, changed, removed):
    """Pages that are made of others are read again when these have changed: the house's code, all pages."""
    code = [ROOT / "tools" / "house.py", *(ROOT / "polyskel_lite").rglob("*.py")]
    code += {path.parent for path in code}  # a file that was taken away
    read = env.all_docs.get("house", 0) / 1e6  # kept in microseconds
    house = ["house"] if any(path.stat().st_mtime > read for path in code) else []
    return ["contents", "teaching_map", *house]


def fill_the_teachers_part(app, docname, source):
    """Put tables of the whole course, read from chapters and assignments, into the map for teachers."""
    if docname == "teaching_map":
        made = runpy.run_path(str(ROOT / "tools" / "teaching.py"))
        source[0] = re.sub(r"```\{psl-teaching\} (\w+)\n```", lambda match: made[match[1]](), source[0])


def mark_slides(app, docname, source):
    """Put comments around the texts that are slides (see tools/slides.py)."""
    if '"slide"' in source[0]:
        source[0] = json.dumps(SLIDES["mark"](json.loads(source[0])))


def make_light(app, error):
    """What a page does not show is not fetched with it (see tools/lighten.py); then slides of the pages."""
    if error is None and app.builder.name == "html":
        runpy.run_path(str(ROOT / "tools" / "lighten.py"))["lighten"](Path(app.outdir))
        SLIDES["write"](Path(app.outdir), BUNDLE["page_module"]())


def setup(app):
    app.add_config_value("moving_parts", "", "html", str)
    app.connect("source-read", draw_the_house)
    app.connect("source-read", lay_out_the_contents)
    app.connect("source-read", fill_the_reference)
    app.connect("source-read", fill_the_teachers_part)
    app.connect("source-read", mark_slides)
    app.connect("env-get-outdated", changed_house)
    app.connect("html-page-context", say_what_colab_needs)
    app.connect("html-page-context", references_as_list)
    app.connect("html-page-context", link_claims_to_cells)
    app.connect("html-page-context", add_modules)
    app.connect("build-finished", make_light, priority=900)  # after all who copy files
