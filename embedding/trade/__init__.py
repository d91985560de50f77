"""The trade of speed for accuracy, measured: what each choice of model and mesh costs a scene, and what it buys."""

from embedding.trade.ladder import Rung, ladder
from embedding.trade.measuring import Trade, measure_trade
from embedding.trade.rows import Row

__all__ = ["Row", "Rung", "Trade", "ladder", "measure_trade"]
