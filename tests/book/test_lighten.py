"""What makes the pages of the book light (tools/lighten.py), on a book of one page."""

import json
import runpy
import struct
import zlib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PYGMENTS = """
html[data-theme="light"] .highlight { background: #fefefe; color: #080808 }
html[data-theme="light"] .highlight .n { color: #080808 } /* Name */
html[data-theme="light"] .highlight .k { color: #7928a1 } /* Keyword */
"""
SHEET = """@charset "UTF-8";/* a { comment */ @import url("basic.css");
.here, .nowhere { color: red } .nowhere > a { content: "}" } p:not(.nowhere) { margin: 0 }
@media print { .nowhere { display: none } .here { color: black } } @media screen { .nowhere { top: 0 } }
@font-face { font-family: x } :is(.nowhere, p) a { color: blue } [href=".nowhere"] { color: green }"""
PAGE = """<html><head>
  <script defer src="_static/scripts/fontawesome.js?digest=1"></script>
  <link rel="stylesheet" type="text/css" href="_static/theme.css?v=1" />
  <script src="_static/searchtools.js"></script>
  <script src="searchindex.js"></script>
  <script defer="defer" src="_static/mathjax/tex-chtml.js"></script>
  <script type="module">// A comment.
const shown = 1;
</script></head>
<body class="here"><i class="theme-switch fa-solid fa-sun fa-lg" data-mode="light" title="Light"></i>
<button><span class="fa-solid fa-bars"></span></button>
<img alt="a" src="_images/a.png" /> <img alt="b" src="_images/b.svg" style="width: 85%;" />
<div class="highlight"><pre><span class="k">for</span> <span class="n">x</span></pre></div>
<div class="math notranslate">x</div>
<div class="psl-viewer"><script type="application/json">DATA</script>
<img src="data:image/png;base64,INPAGE"></div></body></html>"""


def png(width: int, height: int, said: bytes) -> bytes:
    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
    return b"\x89PNG\r\n\x1a\n" + head + chunk(b"tEXt", said) + chunk(b"IEND", b"")


@pytest.fixture(scope="module")
def tool():
    return runpy.run_path(str(ROOT / "tools" / "lighten.py"))


@pytest.fixture
def book(tmp_path):
    """A book of one page, as Sphinx leaves it."""
    for folder in ("_images", "_static/scripts"):
        (tmp_path / folder).mkdir(parents=True)
    (tmp_path / "_images" / "a.png").write_bytes(png(1680, 1000, b"page\0" + b"840 x 500"))
    (tmp_path / "_images" / "b.svg").write_text(
        '<?xml?>\n<svg xmlns="x"\n width="840" height="320">', "utf-8"
    )
    (tmp_path / "_static" / "pygments.css").write_text(PYGMENTS, "utf-8")
    (tmp_path / "_static" / "theme.css").write_text(SHEET, "utf-8")
    (tmp_path / "_static" / "basic.css").write_text("", "utf-8")
    (tmp_path / "_static" / "scripts" / "fontawesome.js").write_text("nowhere", "utf-8")
    data = json.dumps({"look": "x" * 3000})
    page = PAGE.replace("DATA", data).replace("INPAGE", "QUJD" * 600)
    (tmp_path / "index.html").write_text(page, "utf-8")
    return tmp_path


@pytest.fixture
def page(tool, book):
    tool["lighten"](book)
    return (book / "index.html").read_text("utf-8")


def test_icons_are_drawn_in_the_page_and_their_script_is_gone(page, book):
    assert 'class="svg-inline--fa theme-switch fa-solid fa-sun fa-lg" data-mode="light" title="Light"' in page
    assert '<path fill="currentColor" d="M' in page
    assert "<i " not in page
    assert '<button><svg class="svg-inline--fa fa-solid fa-bars"' in page
    assert "fontawesome" not in page
    assert not (book / "_static" / "scripts" / "fontawesome.js").exists()


def test_an_icon_that_the_theme_does_not_have_stays_with_its_script(tool, book):
    text = (book / "index.html").read_text("utf-8").replace("fa-sun", "fa-no-such-thing")
    (book / "index.html").write_text(text, "utf-8")
    tool["lighten"](book)
    page = (book / "index.html").read_text("utf-8")
    assert '<i class="theme-switch fa-solid fa-no-such-thing' in page
    assert "fontawesome.js" in page
    assert (book / "_static" / "scripts" / "fontawesome.js").exists()


def test_pictures_wait_and_keep_their_place(page):
    assert (
        '<img loading="lazy" decoding="async" width="840" height="500" alt="a" src="_images/a.png" />' in page
    )
    assert '<img loading="lazy" decoding="async" width="840" height="320" alt="b"' in page
    assert page.count("<img ") == page.count('loading="lazy"') == 3


def test_data_of_a_viewer_are_in_a_script_of_their_own(page, book):
    (script,) = (book / "_data").iterdir()
    name = script.stem
    (held,) = [line for line in page.splitlines() if "application/json" in line]
    assert 'data-from="_data/' in held
    assert len(held) < 300
    said = script.read_text("utf-8")
    assert said.startswith("(globalThis.pslData ??= {})[")
    assert json.loads(said[said.index("] = ") + 4 : -1]) == {"look": "x" * 3000}
    assert f'data-name="{said.split(chr(34))[1]}"' in held
    assert name in held


def test_pictures_in_the_page_become_files(page, book):
    (file,) = (path for path in (book / "_images").iterdir() if len(path.stem) == 32)
    assert file.read_bytes() == b"ABC" * 600
    assert f'src="_images/{file.name}"' in page
    assert "base64" not in page


def test_the_index_of_words_comes_with_the_page_that_searches(tool, book, page):
    assert "searchtools" not in page
    assert "searchindex" not in page
    text = '<html><div id="search-results"></div><script src="searchindex.js"></script></html>'
    assert tool["light"](text, book) == text


def test_mathjax_comes_without_its_menu(page):
    assert 'src="_static/mathjax/startup.js"' in page
    assert '<div tabindex="0" class="math notranslate">' in page


def test_rules_for_what_is_on_no_page_are_gone(page, book):
    sheet = (book / "_static" / "theme.light.css").read_text("utf-8")
    assert 'href="_static/theme.light.css"' in page
    assert sheet == (
        '@charset "UTF-8";@import url("basic.light.css");.here{ color: red }p:not(.nowhere){ margin: 0 }'
        "@media print{.here{ color: black }}@font-face{ font-family: x }"
        ':is(.nowhere, p) a{ color: blue }[href=".nowhere"]{ color: green }'
    )
    assert (book / "_static" / "theme.css").read_text("utf-8") == SHEET  # Sphinx will want to find it again


def test_code_of_no_colour_needs_no_markup(page):
    assert '<pre><span class="k">for</span> x</pre>' in page
    assert "A comment" not in page
    assert "const shown = 1;" in page


def test_a_light_page_stays_as_it_is(tool, book, page):
    tool["lighten"](book)
    assert (book / "index.html").read_text("utf-8") == page
