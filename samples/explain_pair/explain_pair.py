"""Draws a pair of bodies with its common normal, and how the solvers find it on the sphere of normals."""

import argparse
import io
import os
import pathlib
import re
import sys
import tempfile

try:
    import matplotlib  # noqa: F401
    import supernormal as sn
except ImportError as missing:
    sys.exit(f"explain_pair: {missing} (samples/explain_pair/packages.txt has the Debian packages that it takes)")

from pairs import KINDS, InputError, Pair, data, described_body, did_you_mean, hard_case, recorded_pair
from picture import length_text, picture_of
from solvers import explain, literature_paths

DONE, FAILED, BAD_INPUT = 0, 1, 2


class Parser(argparse.ArgumentParser):
    def print_help(self, file=None):
        """As argparse's, but a full stdout is an error."""
        print(self.format_help(), end="", file=file or sys.stdout, flush=True)


class ListCases(argparse.Action):
    def __call__(self, parser, *_):
        for name, reason in data("list"):
            print(f"{name}\n    {reason}")
        sys.stdout.flush()
        parser.exit()


def number_in(kind, low, high):
    """A type of argparse: a number in a closed interval."""

    def convert(text):
        value = kind(text)
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"{text} is out of range; allowed: {low:g} to {high:g}")
        return value

    convert.__name__ = "number"  # in the message for what is no number
    return convert


def parser():
    kinds = "".join(f"  {name} {usage}\n" for name, (_, usage, _) in KINDS.items())
    options = Parser(
        prog="explain_pair",
        description=__doc__,
        epilog=f"Kinds of bodies:\n{kinds}Exit code: 0 done; 1 failed (disk full, say); 2 bad input, nothing written.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    options._negative_number_matcher = re.compile(r"-[\d.]")  # argparse takes -1e-3 for an option
    for number in "12":
        group = options.add_argument_group(f"Body {number}")
        group.add_argument(f"--body{number}", metavar="TEXT", default="", help="kind and parameters, in quotes")
        group.add_argument(
            f"--rounding{number}", metavar="M", type=float, default=0, help="m; radius of a sphere that sweeps the body"
        )
        group.add_argument(
            f"--position{number}", metavar=("X", "Y", "Z"), nargs=3, type=float, default=(0, 0, 0), help="of its centre, m"
        )
        group.add_argument(
            f"--quaternion{number}",
            metavar=tuple("WXYZ"),
            nargs=4,
            type=float,
            default=(1, 0, 0, 0),
            help="its orientation, of unit length",
        )
    options.add_argument(
        "--title", default="One pair of bodies", help="of the picture of two described bodies (default: %(default)s)"
    )
    group = options.add_argument_group("Hard case")
    group.add_argument("--case", metavar="NAME", help="a hard case by its name")
    group.add_argument("--list", nargs=0, action=ListCases, help="print the names of the hard cases, and why they are hard")
    group = options.add_argument_group("Two grains of a run")
    group.add_argument("--scene", metavar="FILE", help="scene file")
    group.add_argument(
        "--set", metavar="KEY=VALUE", action="append", default=[], help="what the run was given with --set, once for each"
    )
    group.add_argument("--trajectory", metavar="FILE", help="trajectory.csv that its run has left")
    group.add_argument("--time", metavar="S", type=float, default=0, help="s, of a frame")
    group.add_argument(
        "--bodies", metavar="INDEX", nargs="+", type=number_in(int, 0, 1e15), help="one or two; one alone: with its neighbour"
    )
    options.add_argument(
        "-o", "--out", metavar="FILE", default="pair.svg", help="the picture: .svg, .png or .pdf (default: %(default)s)"
    )
    options.add_argument(
        "--tolerance", metavar="T", type=number_in(float, 1e-15, 1), default=sn.Settings().tolerance,
        help="of the gap, relative to the smallest half-extent, 1e-15 to 1 (default: %(default)g)",
    )  # fmt: skip
    options.add_argument(
        "--max-evaluations", metavar="N", type=number_in(int, 1, 1000), default=sn.Settings().max_evaluations,
        help="of the gap function, for each solver, 1 to 1000 (default: %(default)d)",
    )  # fmt: skip
    options.add_argument("--certify", action="store_true", help="let the hybrid prove that the depth is the smallest")
    options.add_argument(
        "--literature", metavar="NAME", nargs="?", const="",
        help="draw the methods of the literature too, or the one of this name, if both bodies are superellipsoids",
    )  # fmt: skip
    return options


def chosen_pair(options):
    is_described = bool(options.body1 or options.body2)
    is_recorded = bool(options.scene or options.trajectory)
    choices = is_described + is_recorded + bool(options.case)
    if choices != 1:
        ways = "by --body1 and --body2, by --scene and --trajectory, or by --case"
        raise InputError(f"{choices} pairs are named; allowed: one, {ways}")
    if options.case:
        return hard_case(options.case)
    if is_described:
        bodies = [
            described_body(n, *(getattr(options, name + n) for name in ("body", "rounding", "position", "quaternion")))
            for n in "12"
        ]
        return Pair(options.title, *bodies)
    for name in ("scene", "trajectory", "bodies"):
        if not getattr(options, name):
            raise InputError(f"a pair of a run takes --scene, --trajectory, --time and --bodies; missing: --{name}")
    if len(options.bodies) > 2:
        raise InputError(f"--bodies has {len(options.bodies)} numbers; allowed: one or two")
    return recorded_pair(options.scene, options.trajectory, options.time, options.bodies, options.set)


def chosen_literature(options, pair):
    if options.literature is None:
        return []
    paths = literature_paths(pair, options.tolerance)
    if not options.literature or not paths:
        return paths
    chosen = [path for path in paths if path.name == options.literature]
    if not chosen:
        names = [path.name for path in paths]
        near = did_you_mean(options.literature, names)
        raise InputError(
            f'--literature: "{options.literature}" is no method of the literature; allowed: {", ".join(names)}{near}'
        )
    return chosen


def replace_file(path, content):
    """Writes a file that the user has named. If it fails, the earlier content stays.

    What is no regular file, such as a pipe or a device, is written in place and never removed.
    """
    if path.exists() and not path.is_file():
        path.write_bytes(content)
        return
    target = path.resolve()  # a link stays a link
    mask = os.umask(0)
    os.umask(mask)
    mode = target.stat().st_mode & 0o777 if target.exists() else 0o666 & ~mask
    file, beside = tempfile.mkstemp(prefix=target.name + ".", dir=target.parent)
    try:
        with open(file, "wb") as stream:
            stream.write(content)
            stream.flush()
            os.fchmod(stream.fileno(), mode)
            os.fsync(stream.fileno())
        os.replace(beside, target)
    except BaseException:
        os.unlink(beside)
        raise


def run(arguments):
    options = parser().parse_args(arguments)
    pair = chosen_pair(options)
    settings = sn.Settings(tolerance=options.tolerance, max_evaluations=options.max_evaluations, certify_depth=options.certify)
    explanation = explain(pair, settings, chosen_literature(options, pair))
    out = pathlib.Path(options.out)
    kind = out.suffix[1:].lower()
    content = io.BytesIO()
    picture_of(explanation).save(content, kind if kind in ("png", "pdf") else "svg", pair.title)
    try:
        replace_file(out, content.getvalue())
    except OSError as error:
        raise RuntimeError(f'explain_pair: cannot write "{out}": {error.strerror}') from None
    for path in explanation.paths:
        proved = ", proved" if path.is_global else ""
        print(f"{path.name:<32} gap {length_text(path.gap, 10)}, {path.evaluations} evaluations, {path.status}{proved}")
    return DONE


def main():
    code = FAILED
    try:
        if sys.stdout is None:
            raise OSError  # it is closed
        code = run(sys.argv[1:])
        sys.stdout.flush()
    except SystemExit as end:
        code = end.code
    except InputError as error:
        print(error, file=sys.stderr)
        code = BAD_INPUT
    except RuntimeError as error:
        print(error, file=sys.stderr)
    except OSError:
        print("explain_pair: cannot write to stdout (is it closed, or the disk full?)", file=sys.stderr)
        os._exit(code or FAILED)  # Python would try to write once more, and say so
    sys.exit(code)


if __name__ == "__main__":
    main()
