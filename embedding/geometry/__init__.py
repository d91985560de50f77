"""Mid-surfaces, the interface inside the ambient, its sides, and the dimensional reductions."""
