"""What a scene requires: reduction, theory, field, interface and mesh, each with its reason."""

from embedding.plan.decisions import Decision, Plan
from embedding.plan.planner import explain

__all__ = ["Decision", "Plan", "explain"]
