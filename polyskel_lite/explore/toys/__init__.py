"""Explorers on a page without a kernel: the same pictures, computed by the reader's browser.

In the room: what Python hands to the page, and JavaScript of our own. `page.js` is the first module,
`plane.js` and `discs.js` have the geometry, and each explorer of `polyskel_lite.explore` has a module of the
same name. Colours, line patterns and sentences come from Python; a test holds that both say the same numbers.
"""

from .handed_over import as_script
