"""What a run costs and where: one scene solved in a process of its own, its time told part by part."""

from embedding.bench.spending import BenchError, Part, Spending, measure_spending

__all__ = ["BenchError", "Part", "Spending", "measure_spending"]
