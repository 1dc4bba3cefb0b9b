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
    "RS112": "a part of the model in the wrong place",
    "RS111": "nesting deeper than rebsync reads",
}

NAMES: dict[str, str] = {}

TYPES: dict[str, str] = {}

STRUCTURE: dict[str, str] = {}

WARNINGS: dict[str, str] = {}

ROBOTIC: dict[str, str] = {}

GENERATION: dict[str, str] = {}

FILES = {
    "RS801": "a file or directory that does not exist",
    "RS802": "a directory where a file is wanted, or the reverse",
    "RS803": "a file or directory that may not be read or written",
    "RS804": "a file that is not UTF-8 text",
    "RS805": "a disk that is full",
    "RS806": "a file operation that the operating system refuses",
    "RS807": "a configuration file that is not valid TOML",
    "RS808": "an unknown key in a configuration file",
    "RS809": "a value that a key of a configuration file cannot have",
    "RS810": "a missing key in a configuration file",
    "RS811": "a directory without anything to read",
    "RS812": "a file whose kind cannot be told from its name",
}

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
