"""The error statement of every number a solve ends with, by source."""

from embedding.solving.estimate.estimate import Estimates, default_quantity, estimate_errors

__all__ = ["Estimates", "default_quantity", "estimate_errors"]
