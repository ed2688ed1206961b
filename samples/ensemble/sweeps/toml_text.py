"""Values as TOML, which the standard library reads but does not write."""

import json


def toml_text(value):
    """One value as TOML, the shortest text that reads back as the same value."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return json.dumps(value)  # a JSON string is a basic string of TOML
    if isinstance(value, list):
        return "[" + ", ".join(toml_text(element) for element in value) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(key)} = {toml_text(element)}" for key, element in value.items()) + "}"
    raise TypeError(f"no scene has a value like {value!r}")
