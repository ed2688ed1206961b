"""Sweep files: which runs of a scene there are, and what of each is collected."""

import dataclasses
import itertools
import math
import pathlib
import tomllib

from .errors import InputError, refuse_unknown_keys
from .latin_hypercube import latin_hypercube
from .quantity import read_quantities
from .toml_text import WHOLE_NUMBERS, toml_text

FIGURE_LABELS = ["x_label", "y_label", "lines_label"]
KEYS = ["scene", "seeds", "arguments", "keep", "confidence", "set", "grid", "list", "latin_hypercube", "start", "collect", "figure", "slurm"]
MOST_POINTS = 1_000_000
LEAST_DIGITS = 6  # of the numbers of a Latin hypercube
MOST_DIGITS = 15  # that every double keeps


@dataclasses.dataclass(frozen=True)
class Point:
    """One run: a value for each parameter of the sweep, and a seed (None: the scene's)."""

    index: int
    values: dict
    seed: int | None

    def describe(self):
        parts = [f"{key}={toml_text(value)}" for key, value in self.values.items()]
        if self.seed is not None:
            parts.append(f"seed={self.seed}")
        return f"point {self.index}" + (f" ({' '.join(parts)})" if parts else "")


@dataclasses.dataclass(frozen=True)
class Start:
    """A run before the points with the same seed, which start from its end."""

    scene: pathlib.Path
    settings: dict


@dataclasses.dataclass(frozen=True)
class Sweep:
    path: pathlib.Path
    scene: pathlib.Path
    arguments: list  # of falling_particles, besides those that every run has
    keep: bool  # whether the files of a run stay when its result is there
    confidence: float
    settings: dict  # of all runs
    parameters: list  # keys that differ from run to run
    seeds: int  # runs with the same parameters, one after the other in `points`
    has_seeds: bool  # whether they are the sweep's, and not the scene's one
    points: list
    start: Start | None
    quantities: list
    figure: dict | None
    slurm_options: list

    def assignments(self, point):
        """What falling_particles is to --set for this run."""
        return _assignments({**self.settings, **point.values}, point.seed)

    def start_assignments(self, point):
        """The same for the run from whose end this run starts."""
        return _assignments(self.start.settings, point.seed)


def _assignments(values, seed):
    seeds = {} if seed is None else {"seed": seed}
    return [f"{key}={toml_text(value)}" for key, value in {**values, **seeds}.items()]


def load_sweep(path):
    """Raises InputError."""
    path = pathlib.Path(path)
    if path.exists() and not path.is_file():
        raise InputError(f"sweep file {path} is a folder, a pipe or a device; allowed: a file")
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"cannot read sweep file {path}: {error.strerror}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: {error} (allowed: valid TOML 1.0)") from None
    except RecursionError:
        raise InputError(f"{path}: tables or arrays are nested too deeply; allowed: fewer levels") from None
    refuse_unknown_keys(table, KEYS, str(path))
    scene = _scene(table, "scene", path)
    settings = _read(table, "set", dict, "a table of keys of the scene and values", path, {})
    _check_values(settings, f"{path}: [set]")
    axes = [_grid(table, path), _list(table, path), _latin_hypercube(table, path)]
    seeds = _seeds(table, path)
    parameters = _parameters(settings, axes, seeds, path)
    _refuse_too_many(math.prod(map(len, [*axes, seeds])), path)
    points = []
    for *parts, seed in itertools.product(*axes, seeds):
        points.append(Point(len(points), {key: value for part in parts for key, value in part.items()}, seed))
    confidence = _read(table, "confidence", (int, float), "a number in (0, 1)", path, 0.95)
    if not 0 < confidence < 1:
        raise InputError(f"{path}: confidence is {confidence}; allowed: a number in (0, 1)")
    quantities = read_quantities(table.get("collect"), path)
    slurm = _read(table, "slurm", dict, "a table with options", path, {})
    refuse_unknown_keys(slurm, ["options"], f"{path}: [slurm]")
    return Sweep(
        path=path,
        scene=scene,
        arguments=_texts(table, "arguments", path),
        keep=_read(table, "keep", bool, "true or false", path, False),
        confidence=confidence,
        settings=settings,
        parameters=parameters,
        seeds=len(seeds),
        has_seeds=seeds != [None],
        points=points,
        start=_start(table, parameters, settings, scene, path),
        quantities=quantities,
        figure=_figure(table, parameters, quantities, path),
        slurm_options=_texts(slurm, "options", path),
    )


def _read(table, key, kind, allowed, path, default=None):
    value = table.get(key, default)
    if value is None:
        raise InputError(f"{path}: {key} is missing; allowed: {allowed}")
    if not isinstance(value, kind) or (isinstance(value, bool) and kind is not bool):
        raise InputError(f"{path}: {key} is {value!r}; allowed: {allowed}")
    return value


def _scene(table, name, path):
    allowed = "a scene file, its path relative to the sweep file"
    scene = path.parent / _read(table, "scene", str, allowed, path)
    if not scene.is_file():
        raise InputError(f"{path}: {name}: there is no file {scene}; allowed: {allowed}")
    return scene


def _start(table, parameters, settings, scene, path):
    """Its scene is the sweep's where it names none; its values are its own."""
    if "start" not in table:
        return None
    where = f"{path}: [start]"
    section = _read(table, "start", dict, "a table with scene and set", path)
    refuse_unknown_keys(section, ["scene", "set"], where)
    for key in [*parameters, *settings]:
        if key == "start" or key == "start.file":
            raise InputError(f'{path}: "{key}" is set besides [start]; allowed: one of them')
    values = _read(section, "set", dict, "a table of keys of the scene and values", where, {})
    _check_values(values, f"{where} set")
    if "seed" in values:
        raise InputError(f"{where} set has seed; allowed: seeds of the sweep, which its start has too")
    return Start(_scene(section, "[start] scene", path) if "scene" in section else scene, values)


def _refuse_too_many(points, path):
    if points > MOST_POINTS:
        raise InputError(f"{path}: the sweep has {points} points; allowed: up to {MOST_POINTS}")


def _refuse_repeated(texts, where, what):
    """A point that is there twice would be two lines of one run."""
    seen = set()
    for text in texts:
        if text in seen:
            raise InputError(f"{where} has {text} twice; allowed: {what} that differ")
        seen.add(text)


def _check_values(values, where):
    """Refuses keys and values that cannot be given to --set."""
    for key, value in values.items():
        if not key or "=" in key or not key.isprintable():
            raise InputError(f"{where} has the key {key!r}; allowed: a key of the scene, without = and control characters")
        try:
            toml_text(value)
        except ValueError as error:
            raise InputError(f'{where} "{key}" is or holds {error}; allowed: numbers, texts, true, false, arrays and tables of these') from None


def _texts(table, key, path):
    texts = _read(table, key, list, "an array of texts", path, [])
    if not all(isinstance(text, str) for text in texts):
        raise InputError(f"{path}: {key} is {texts!r}; allowed: an array of texts")
    if any("\0" in text for text in texts):
        raise InputError(f"{path}: {key} is {texts!r}; allowed: texts without a zero character")
    return texts


def _seeds(table, path):
    allowed = "a number of seeds from 1, which are 1, 2, 3 and so on, or an array of different seeds, whole numbers from 0"
    seeds = table.get("seeds")
    if seeds is None:
        return [None]
    if isinstance(seeds, int) and not isinstance(seeds, bool) and 1 <= seeds <= MOST_POINTS:
        return list(range(1, seeds + 1))
    if isinstance(seeds, list) and seeds and all(type(seed) is int and seed >= 0 for seed in seeds) and len(set(seeds)) == len(seeds):
        return seeds
    raise InputError(f"{path}: seeds is {seeds!r}; allowed: {allowed}")


def _grid(table, path):
    """Every combination of the values of all keys, the last key's changing fastest."""
    grid = _read(table, "grid", dict, "a table of keys of the scene, each with an array of values", path, {})
    for key, values in grid.items():
        if not isinstance(values, list) or not values:
            raise InputError(f'{path}: [grid] "{key}" is {values!r}; allowed: an array of values, not empty')
        for value in values:
            _check_values({key: value}, f"{path}: [grid]")
        _refuse_repeated(map(toml_text, values), f'{path}: [grid] "{key}"', "values")
    _refuse_too_many(math.prod(map(len, grid.values())), path)
    return [dict(zip(grid, values)) for values in itertools.product(*grid.values())]


def _list(table, path):
    """The entries one after the other, which all set the same keys."""
    allowed = "one or more [[list]], each with a value for the same keys"
    entries = _read(table, "list", list, allowed, path, [{}])
    if not entries or not all(isinstance(entry, dict) and set(entry) == set(entries[0]) for entry in entries):
        raise InputError(f"{path}: [[list]]: its entries have different keys, or it has none; allowed: {allowed}")
    for entry in entries:
        _check_values(entry, f"{path}: [[list]]")
    _refuse_repeated((", ".join(f"{key} = {toml_text(entry[key])}" for key in entries[0]) for entry in entries), f"{path}: [[list]]", "entries")
    return [{key: entry[key] for key in entries[0]} for entry in entries]


def _latin_hypercube(table, path):
    if "latin_hypercube" not in table:
        return [{}]
    where = f"{path}: [latin_hypercube]"
    section = _read(table, "latin_hypercube", dict, "a table with points, seed and ranges", path)
    refuse_unknown_keys(section, ["points", "seed", "ranges"], where)
    points = _read(section, "points", int, "a whole number from 1", where)
    if not 1 <= points <= MOST_POINTS:
        raise InputError(f"{where}: points is {points}; allowed: a whole number from 1 to {MOST_POINTS}")
    seed = _read(section, "seed", int, "a whole number", where)
    ranges = _read(section, "ranges", dict, 'keys of the scene, each {from = 0.1, to = 0.5}', where)
    _check_values(dict.fromkeys(ranges, 0), f"{where} ranges")
    scales = [_scale(f'{where} ranges "{key}"', limits, points) for key, limits in ranges.items()]
    sample = latin_hypercube(points, len(ranges), seed)
    return [{key: scale(share) for key, scale, share in zip(ranges, scales, shares)} for shares in sample]


def _scale(where, limits, points):
    """The function that takes [0, 1), of which each of the points has an interval of its own, to the range."""
    allowed = 'allowed: {from = 0.1, to = 0.5}, with scale = "log" if from is above 0, and with whole = true for whole numbers'
    if not isinstance(limits, dict):
        raise InputError(f"{where} is {limits!r}; {allowed}")
    refuse_unknown_keys(limits, ["from", "to", "scale", "whole"], where)
    lower, upper = limits.get("from"), limits.get("to")
    kind, whole = limits.get("scale", "linear"), limits.get("whole", False)
    if not _is_range(lower, upper):
        raise InputError(f"{where} goes from {lower!r} to {upper!r}; {allowed}")
    if kind not in ("linear", "log") or not isinstance(whole, bool) or (kind == "log" and not (lower > 0 and math.isfinite(upper / lower))):
        raise InputError(f"{where} has scale = {kind!r}, whole = {whole!r} from {lower!r}; {allowed}")
    # A range of whole numbers includes both ends, each with the same share of [0, 1).
    low, high = (math.ceil(lower), math.floor(upper) + 1) if whole else (lower, upper)
    if whole and not low < high:
        raise InputError(f"{where} goes from {lower!r} to {upper!r}, between which there is no whole number; {allowed}")

    def exact(share):
        return low * (high / low) ** share if kind == "log" else low + (high - low) * share

    if whole:
        return lambda share: min(int(exact(share)), high - 1)
    digits = _digits([exact(k / points) for k in (0, 1, points - 1)] + [upper])
    if digits > MOST_DIGITS:
        raise InputError(f"{where} goes from {lower!r} to {upper!r}, too narrow for {points} different numbers; allowed: a wider range, or fewer points")

    def scaled(share):
        value = exact(share)
        short = float(f"{value:.{digits}g}")  # digits that people can type again
        return short if lower <= short <= upper else min(max(value, lower), upper)  # beyond an end by rounding alone

    return scaled


def _is_range(lower, upper):
    if not all(type(limit) in (int, float) and -1e300 < limit < 1e300 for limit in (lower, upper)):
        return False
    return lower < upper and not any(type(limit) is int and limit not in WHOLE_NUMBERS for limit in (lower, upper))


def _digits(ends):
    """How many significant digits tell numbers apart that are an interval away from each other; at least LEAST_DIGITS. `ends`: of the
    first and of the last interval of a range.
    """
    digits = LEAST_DIGITS
    for lower, upper in (ends[:2], ends[2:]):
        width, largest = upper - lower, max(abs(lower), abs(upper))
        if not width > 0:
            return MOST_DIGITS + 1
        digits = max(digits, math.ceil(math.log10(largest / width) + 1))
    return digits


def _parameters(settings, axes, seeds, path):
    keys = [key for axis in axes for key in axis[0]]
    everywhere = [*settings, *keys, *(["seed"] if seeds != [None] else [])]
    for key in everywhere:
        if everywhere.count(key) > 1:
            raise InputError(f'{path}: "{key}" is set {everywhere.count(key)} times; allowed: once, in set, grid, list, latin_hypercube or by seeds')
    return keys


def _figure(table, parameters, quantities, path):
    """x and lines: parameters; y: quantities, one figure each."""
    if "figure" not in table:
        return None
    where = f"{path}: [figure]"
    figure = _read(table, "figure", dict, "a table with x, y, lines, scale and labels", path)
    refuse_unknown_keys(figure, ["x", "y", "lines", "scale", *FIGURE_LABELS], where)
    for key in filter(figure.__contains__, FIGURE_LABELS):
        _read(figure, key, str, "a text, such as \"time, s\"", where)
    names = [quantity.name for quantity in quantities]
    for key, words in (("x", parameters), ("y", names), ("lines", [*parameters, None]), ("scale", ["linear", "log", None])):
        if figure.get(key) not in words:
            raise InputError(f"{where}: {key} is {figure.get(key)!r}; allowed: {', '.join(filter(None, words))}")
    return figure
