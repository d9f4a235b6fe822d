"""Long computations: their lines, their processes, the results that are kept."""
