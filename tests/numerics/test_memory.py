"""Memory of large arrays is kept for the next ones."""

import subprocess
import sys

# Sixteen arrays of 3 MB, each filled and freed, in a process that has freed nothing large before.
PROGRAM = """
import resource
import numpy as np
from rotorcalc.numerics.memory import keep_freed_memory

def faults():
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    for _ in range(16):
        np.ones(400_000)
    return resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before

keep_freed_memory()
np.ones(400_000), np.ones(500_000)
print(faults())
"""


def test_freed_arrays_give_their_memory_to_the_next():
    done = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, check=True)
    # Otherwise some 780, the pages of one array.
    assert int(done.stdout) < 100
