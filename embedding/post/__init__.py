"""Questions to an archive, answered from what is in it: nothing is solved again."""

from embedding.post.probe import line, probe, probe_shell
from embedding.post.table import PostError, Table

__all__ = ["PostError", "Table", "line", "probe", "probe_shell"]
