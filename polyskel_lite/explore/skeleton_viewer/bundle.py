"""The viewer's JavaScript as one module: a page read from disk may not import others, and a widget has one.

Only the standard library and nothing of this package is used here, because ``notebooks/conf.py`` runs this
file by its path: the book can be built where neither NumPy nor the library is installed.
"""

import re
from graphlib import TopologicalSorter
from pathlib import Path

# The only forms that the modules use; a test holds that nothing else is there.
_IMPORT = re.compile(r'^import \{ [\w, ]+ \} from "\./(\w+\.js)";\n', re.M)
_EXPORT = re.compile(r"^export (?!default )", re.M)


def one_module() -> str:
    """All modules of this folder in one text, each after those that it imports, so `page.js` is the last.

    Examples
    --------
    >>> text = one_module()
    >>> text.rstrip().endswith("export default { render };"), text.count("export "), "import {" in text
    (True, 1, False)
    """
    files = sorted(Path(__file__).parent.glob("*.js"))
    texts = {file.name: file.read_text(encoding="utf-8") for file in files}
    order = TopologicalSorter({name: _IMPORT.findall(text) for name, text in texts.items()}).static_order()
    return "\n".join(_EXPORT.sub("", _IMPORT.sub("", texts[name])) for name in order)
