"""Values as TOML, which the standard library reads but does not write."""

WHOLE_NUMBERS = range(-(2**63), 2**63)  # those of TOML


def toml_text(value):
    """One value as TOML, the shortest text of ASCII that reads back as the same value. Raises ValueError for a value that no key of a
    scene takes.
    """
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int) and value not in WHOLE_NUMBERS:
        raise ValueError("a whole number beyond 64 bits")
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, list):
        return "[" + ", ".join(toml_text(element) for element in value) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_quoted(key)} = {toml_text(element)}" for key, element in value.items()) + "}"
    raise ValueError("a date or time")


def _quoted(text):
    return '"' + "".join(map(_escaped, text)) + '"'


def _escaped(character):
    code = ord(character)
    if character in '"\\':
        return "\\" + character
    if " " <= character <= "~":
        return character
    return f"\\u{code:04x}" if code <= 0xFFFF else f"\\U{code:08x}"
