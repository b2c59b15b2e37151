"""Numeric cases with known answers, and how the project's formulas meet each kind.

`case_file` reads them, `rule` judges an answer, `systems` says which function solves
which kind of case, and which kinds wait for code that does not exist yet. The solvers are
written once, for NumPy and for the GPU, see `formulas`.
"""
