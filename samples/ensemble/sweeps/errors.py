"""The exception for mistakes in the user's input, and words near a misspelt one."""

import difflib


class InputError(Exception):
    """Its text is the whole message for the user: file, key, value and what is allowed."""


def did_you_mean(word, words):
    """`; did you mean "…"?`, or "" when no word is near."""
    near = difflib.get_close_matches(word, words, 1)
    return f'; did you mean "{near[0]}"?' if near else ""


def refuse_unknown_keys(table, allowed, where):
    """Raises InputError when `table` holds a key that is not `allowed`. `where`: file and section, for the message."""
    for key in table:
        if key not in allowed:
            raise InputError(f'{where}: unknown key "{key}"{did_you_mean(key, allowed)}; allowed: {", ".join(allowed)}')
