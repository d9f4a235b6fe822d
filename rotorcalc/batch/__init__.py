"""Many machines from a file: reading them, computing each, writing the results.

`read_machines(text)` gives machines and problems, `results(file.cases)` what is computed of each,
`table(...)` both as columns, and `to_csv`, `to_json` and `to_report` write these. The same from a
terminal: `python -m rotorcalc FILE`.
"""

from rotorcalc.batch.reading import Case, MachineFile, Problem, read_machines
from rotorcalc.batch.results import CaseResult, results, table
from rotorcalc.batch.writing import to_csv, to_json, to_report

__all__ = [
    "Case",
    "CaseResult",
    "MachineFile",
    "Problem",
    "read_machines",
    "results",
    "table",
    "to_csv",
    "to_json",
    "to_report",
]
