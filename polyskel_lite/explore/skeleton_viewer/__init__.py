"""The skeleton viewer."""

from .widget import SkeletonViewer, viewer
