"""What is collected of a run: a number of its summary, or the mean of a column of one of its tables."""

import csv
import dataclasses
import math
import tomllib

from .errors import InputError, did_you_mean, refuse_unknown_keys


class NoValue(Exception):
    """A run has no such number; the text says what it has."""


@dataclasses.dataclass(frozen=True)
class Quantity:
    name: str
    summary: str | None = None  # key of summary.toml: "packing.volume_fraction"
    table: str | None = None  # CSV file in the folder of the results, its first column the time
    column: str | None = None
    last: float = 1.0  # share of the table's time, up to its end, of which the mean is taken
    where: tuple = ()  # columns and values of the lines that count

    def value(self, results):
        """The number, an int or a float, from the folder of a run's results. Raises NoValue."""
        return self._of_summary(results) if self.summary else self._of_table(results)

    def _of_summary(self, results):
        try:
            node = tomllib.loads((results / "summary.toml").read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            raise NoValue(f"cannot read summary.toml: {error}") from None
        for key in self.summary.split("."):
            if not isinstance(node, dict) or key not in node:
                keys = list(node) if isinstance(node, dict) else []
                raise NoValue(f'summary.toml has no {self.summary}{did_you_mean(key, keys)}; there are: {", ".join(keys)}')
            node = node[key]
        if isinstance(node, bool):
            return int(node)
        if not isinstance(node, (int, float)):
            raise NoValue(f"{self.summary} of summary.toml is {node!r}, and no number")
        return node

    def _of_table(self, results):
        try:
            with open(results / self.table, newline="", encoding="utf-8") as file:
                head, *lines = csv.reader(file)
        except (OSError, ValueError) as error:
            raise NoValue(f"cannot read {self.table}: {error}") from None
        self._refuse_other_columns(head)
        chosen = [line for line in lines if all(_is(line[head.index(name)], value) for name, value in self.where)]
        if not chosen:
            raise NoValue(f"{self.table} has no line" + "".join(f", {name} = {value}" for name, value in self.where))
        column = head.index(self.column)
        try:
            first, end = float(chosen[0][0]), float(chosen[-1][0])
            numbers = [float(line[column]) for line in chosen if float(line[0]) >= end - self.last * (end - first)]
        except (ValueError, IndexError) as error:
            raise NoValue(f"{self.table}, {self.column}, has a line without a number: {error}") from None
        return math.fsum(numbers) / len(numbers)

    def refuse_other_tables(self, tables):
        """Raises NoValue where a run does not write what is collected. `tables`: the columns of its tables, by name."""
        if self.table is None:
            return
        if self.table not in tables:
            raise NoValue(f'there is no {self.table}{did_you_mean(self.table, tables)}; there are: {", ".join(tables)}')
        self._refuse_other_columns(tables[self.table])

    def _refuse_other_columns(self, columns):
        for column in (self.column, *(name for name, _ in self.where)):
            if column not in columns:
                raise NoValue(f'{self.table} has no column {column}{did_you_mean(column, columns)}; there are: {", ".join(columns)}')


def _is(text, value):
    if isinstance(value, str):
        return text == value
    try:
        return float(text) == value
    except ValueError:
        return False


def read_quantities(entries, path):
    """The [[collect]] of a sweep file. Raises InputError."""
    if not isinstance(entries, list) or not entries:
        raise InputError(f"{path}: collect is {entries!r}; allowed: one or more [[collect]], each with name, and summary or table and column")
    quantities = []
    for entry in entries:
        where = f"{path}: [[collect]]"
        if not isinstance(entry, dict):
            raise InputError(f"{where} holds {entry!r}; allowed: tables")
        refuse_unknown_keys(entry, ["name", "summary", "table", "column", "last", "where"], where)
        texts = {key: entry[key] for key in ("name", "summary", "table", "column") if key in entry}
        for key, text in texts.items():
            if not isinstance(text, str) or not text:
                raise InputError(f"{where}: {key} is {text!r}; allowed: a text, not empty")
        if "name" not in texts or ("summary" in texts) == ("table" in texts) or ("table" in texts) != ("column" in texts):
            raise InputError(f"{where} has {', '.join(entry)}; allowed: name and summary, or name, table and column")
        if "summary" in texts and ("last" in entry or "where" in entry):
            raise InputError(f"{where} {entry['name']}: last and where are of a table; allowed: with table and column")
        last = entry.get("last", 1)
        if type(last) not in (int, float) or not 0 <= last <= 1:
            raise InputError(f"{where} {entry['name']}: last is {last!r}; allowed: a number in [0, 1], a share of the table's time")
        lines = entry.get("where", {})
        if not isinstance(lines, dict):
            raise InputError(f"{where} {entry['name']}: where is {lines!r}; allowed: a table of columns and values")
        quantities.append(Quantity(**texts, last=float(last), where=tuple(lines.items())))
    names = [quantity.name for quantity in quantities]
    if len(set(names)) < len(names):
        raise InputError(f"{path}: [[collect]] has names {', '.join(names)}; allowed: different ones")
    return quantities
