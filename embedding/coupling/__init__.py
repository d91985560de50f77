"""Shell and field as one Lagrangian: unknowns, forms, face tractions."""
