"""What people look at: pictures and charts from an archive, drawn without a display, and the progress of a solve."""

from embedding.view.history import history_plot
from embedding.view.picture import picture
from embedding.view.rendering import RenderError, can_render

__all__ = ["RenderError", "can_render", "history_plot", "picture"]
