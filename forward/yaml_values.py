"""Constants and names of a package in YAML."""

from __future__ import annotations

from rebsync.package import Value

_YAML_WORDS = frozenset({"false", "n", "no", "null", "off", "on", "true", "y", "yes"})


def is_yaml_word(name: str) -> bool:
    """Whether YAML takes the name for a truth value, or for nothing."""
    return name.lower() in _YAML_WORDS


def yaml_value(value: Value) -> str:
    """A constant in YAML."""
    match value:
        case bool():
            return "true" if value else "false"
        case tuple():
            return f"[{', '.join(yaml_value(v) for v in value)}]"
        case float():
            text = repr(value)  # 1e-07 would be text in YAML 1.1
            return text if "." in text or "e" not in text else text.replace("e", ".0e")
        case _:
            return str(value)


def yaml_name(name: str) -> str:
    """A name in YAML: in quotes where it would be a truth value."""
    return f'"{name}"' if is_yaml_word(name) else name
