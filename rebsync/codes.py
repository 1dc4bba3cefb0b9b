"""The table of diagnostic codes: what each stands for, in one line.

RS1xx syntax, RS2xx names, RS3xx types, RS4xx declarations and structure, RS5xx warnings about a
model that is accepted, RS6xx warnings about robotic models (thesis, section 3.2), RS7xx what
cannot be generated, RS8xx files, options and configuration, RS9xx properties.
"""

from __future__ import annotations

SYNTAX = {
    "RS101": "a token that the grammar does not allow here",
    "RS102": "a character that belongs to no token",
    "RS103": "a comment or string that does not end",
    "RS104": "a keyword or section name that is misspelled",
    "RS105": "a missing token, such as `;`",
    "RS106": "a brace too many, or one missing",
    "RS107": "a nondeterministic expression written with `<` and `>`",
    "RS108": "a parameter without a type",
    "RS109": "the end of the file comes too early",
    "RS110": "a part of the language that rebsync recognises and refuses",
    "RS111": "nesting deeper than rebsync reads",
}

NAMES: dict[str, str] = {}

TYPES: dict[str, str] = {}

STRUCTURE: dict[str, str] = {}

WARNINGS: dict[str, str] = {}

ROBOTIC: dict[str, str] = {}

GENERATION: dict[str, str] = {}

FILES: dict[str, str] = {}

PROPERTIES: dict[str, str] = {}

CODES: dict[str, str] = {
    **SYNTAX,
    **NAMES,
    **TYPES,
    **STRUCTURE,
    **WARNINGS,
    **ROBOTIC,
    **GENERATION,
    **FILES,
    **PROPERTIES,
}
