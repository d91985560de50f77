"""The error statement of every number a solve ends with, by source."""

from embedding.solving.estimate.ending import Ending
from embedding.solving.estimate.estimate import Estimates, default_quantity, estimate_errors

__all__ = ["Ending", "Estimates", "default_quantity", "estimate_errors"]
