"""What people look at: pictures and charts from an archive, drawn without a display."""

from embedding.view.animation import animation
from embedding.view.curves import probe_plot
from embedding.view.faces import faces_plot
from embedding.view.history import history_plot
from embedding.view.interactive import interactive_page
from embedding.view.picture import picture
from embedding.view.rendering import RenderError, can_render
from embedding.view.response import response_plot
from embedding.view.slice import slice_plot

__all__ = [
    "RenderError",
    "animation",
    "can_render",
    "faces_plot",
    "history_plot",
    "interactive_page",
    "picture",
    "probe_plot",
    "response_plot",
    "slice_plot",
]
