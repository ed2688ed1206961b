"""What falling_particles doubts in the runs of a sweep, which nobody sees otherwise."""

import re

SAYS = "falling_particles: warning: "
VALUE = re.compile(r"""/\S+|"[^"]*"|(?<!\w)[-+]?\d[\d.]*(?:e[-+]?\d+)?""")  # a path, a name or a number


def warnings_of(sweep, store):
    """A line for each warning, whatever its names and numbers: in how many runs it is, and its text in the first of them."""
    first, counts, seen = {}, {}, set()
    for point in sweep.points:
        starts = [(store.start_key(point), f"the start of {point.describe()}")] if sweep.start else []
        for run, name in [*starts, (store.run_key(point), point.describe())]:
            if run in seen or not store.log(run).is_file():
                continue
            seen.add(run)
            for line in store.log(run).read_text(encoding="utf-8", errors="replace").splitlines():
                if line.startswith(SAYS):
                    kind = VALUE.sub("#", line)
                    first.setdefault(kind, f"{name}: {line.removeprefix(SAYS)}")
                    counts[kind] = counts.get(kind, 0) + 1
    return [f"warning in {counts[kind]} of {len(seen)} runs, here {text}" for kind, text in first.items()]
