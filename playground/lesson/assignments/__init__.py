"""The assignments, by the number of their lesson: the module that declares each.

A new one is a module with an ``ASSIGNMENT``, a row here, and a stub in ``lessons/assignments``.
"""

ASSIGNMENTS = {
    7: "playground.lesson.assignments.phong",
    13: "playground.lesson.assignments.refract",
    14: "playground.lesson.assignments.form_factor",
}
