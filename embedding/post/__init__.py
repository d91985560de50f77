"""Questions to an archive, answered from what is in it: nothing is solved again."""

from embedding.post.balance import energy_balance
from embedding.post.compare import Comparison, compare
from embedding.post.flux import flux
from embedding.post.integrals import integrals
from embedding.post.probe import line, opened, probe, probe_shell
from embedding.post.table import PostError, Table

__all__ = [
    "Comparison",
    "PostError",
    "Table",
    "compare",
    "energy_balance",
    "flux",
    "integrals",
    "line",
    "opened",
    "probe",
    "probe_shell",
]
