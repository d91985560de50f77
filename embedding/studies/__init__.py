"""Studies: many cases of one scene, each solved in a process of its own, gathered in one table with units."""

from embedding.studies.cases import Case, cases_of
from embedding.studies.errors import StudyError
from embedding.studies.files import load_study
from embedding.studies.quantities import Quantity
from embedding.studies.result import Row, StudyResult, open_study
from embedding.studies.running import run_study
from embedding.studies.study import Grid, LatinHypercube, Limits, Rows, Study

__all__ = [
    "Case",
    "Grid",
    "LatinHypercube",
    "Limits",
    "Quantity",
    "Row",
    "Rows",
    "Study",
    "StudyError",
    "StudyResult",
    "cases_of",
    "load_study",
    "open_study",
    "run_study",
]
