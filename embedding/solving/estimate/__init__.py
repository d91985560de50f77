"""The error statement of every number a solve ends with, by source."""

from embedding.solving.estimate.estimate import default_quantity, estimate_errors

__all__ = ["default_quantity", "estimate_errors"]
