"""Force coefficients of a bearing from the user's own files: tables over speed, and of handbooks.

`read_coefficients` reads text tables, CSV and Excel and says what it took for what; `written`
writes a table that it reads back to the last digit. A file is read as data: no formula is run, and
its size, its cells and the time for it are bounded. What cannot be read is refused by its line and
column.
"""

from rotorcalc.coefficient_files.axes import Axes
from rotorcalc.coefficient_files.handbooks import Scale
from rotorcalc.coefficient_files.reading import ReadColumn, ReadTable, read_coefficients
from rotorcalc.coefficient_files.writing import written

__all__ = ["Axes", "ReadColumn", "ReadTable", "Scale", "read_coefficients", "written"]
