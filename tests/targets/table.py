"""The tables of a run of all targets: table.md, and the one in the README."""

from rows import ALL, ROWS
from tools import HERE, ROOT, Failure

BEGIN, END = "<!-- targets -->", "<!-- end of targets -->"


def number(value):
    """A number for people."""
    return f"{value:,}".replace(",", " ") if value is not None else "-"


def cell(results, row, name, key):
    found = [r.get(key) for r in results
             if r["row"] == row.name and r["format"] == name and r["profile"] != "debug"]
    return found[0] if found else None


def bits(results, row):
    """What a target's lines say of its bits."""
    mine = [r for r in results if r["row"] == row.name]
    if not mine or row.name == "refusal":
        return None
    builds = "debug and release" if any(r["profile"] == "debug" for r in mine) else "yes"
    if row.differs:
        return f"fixed point only ({builds})"
    return builds


def rows_of(results):
    return [row for row in ROWS if bits(results, row)]


def readme(results):
    lines = ["| target | same bits | instructions a pixel: `f32` | `f64` | `Q16` | `Q32` |",
             "| --- | --- | --- | --- | --- | --- |"]
    for row in rows_of(results):
        counts = [number(cell(results, row, name, "instructions")) for name in ALL]
        title = f"`{row.target}`, " if row.target else "the host, "
        lines.append(f"| {title}{row.machine} | {bits(results, row)} | {' | '.join(counts)} |")
    return "\n".join(lines)


def full(results):
    lines = ["# The same bits on every target", "",
             "What `tests/targets/run --write` measured. Every program computes the pictures of",
             "`tests/no_std/src/pictures` (the microbit only the first); flash, RAM (variables), stack (measured / bound) are in bytes.", "",
             "| row | target | format | bytes | light | instructions a pixel | flash | RAM | stack |",
             "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"]
    for result in results:
        row = next(row for row in ROWS if row.name == result["row"])
        if result["profile"] == "debug" or not result["picture"]:
            continue
        rgb8, light, _ = result["picture"]
        stack = "-"
        if result.get("stack") is not None:
            stack = f"{number(result['stack'])} / {number(result['bound'])}"
        figures = [number(result.get(key)) for key in ("instructions", "flash", "ram")]
        lines.append(f"| {row.name} | {row.target or '-'} | {result['format']} | {rgb8[:12]} | "
                     f"{light[:12]} | {' | '.join(figures)} | {stack} |")
    debug = sorted({r["row"] for r in results if r["profile"] == "debug"})
    lines += ["", f"In debug builds the digests are the same; run for: {', '.join(debug)}.", ""]
    return "\n".join(lines)


def parts():
    """The README before and after its table."""
    before, _, rest = (ROOT / "README.md").read_text().partition(BEGIN)
    _, found, after = rest.partition(END)
    if not found:
        raise Failure(f"README.md has no place for the table, between {BEGIN} and {END}")
    return before, after


def write(results):
    """Puts the results of a whole run into both files."""
    before, after = parts()
    (HERE / "table.md").write_text(full(results))
    (ROOT / "README.md").write_text(f"{before}{BEGIN}\n{readme(results)}\n{END}{after}")
