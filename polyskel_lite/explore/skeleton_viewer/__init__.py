"""The skeleton viewer: a widget in JupyterLab and, with the same JavaScript, a picture on a plain page.

`widget` is what Python holds, `scene` and `pack` say what the browser gets, `outlook` finds from where a
solid is seen well, `strip` draws the still pictures for readers without scripts; the JavaScript begins with
`page.js`.
"""

from .widget import SkeletonViewer, viewer

__all__ = ["SkeletonViewer", "viewer"]
