"""Long computations: queues, worker processes, and the cache of results."""
