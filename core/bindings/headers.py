"""What the generators of bindings read: the comments of the public headers, and the library's tables in tables.json."""
import json
import re
import sys
from pathlib import Path

BINDINGS = Path(__file__).resolve().parent
INCLUDE = BINDINGS.parent / "include" / "tendril"


def stop(text):
    sys.exit(f"core/bindings: {text}")


def snake(name):
    """JacobianTranspose -> jacobian_transpose"""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


# ---- The public headers: comments, enumerators.

HEADERS = {path.relative_to(INCLUDE).as_posix(): path.read_text() for path in sorted(INCLUDE.rglob("*.hpp"))}


def first_sentence(comment):
    text = " ".join(line.strip().lstrip("/<").strip() for line in comment)
    text = re.split(r"(?<=[a-z0-9)])[.] (?=[A-Z0-9`])", text + " ")[0].strip().rstrip(".").replace("`", "")
    text = re.sub(r",? see \w+\.hpp$", "", re.sub(r"\bmax_magnitude\b", "1e9", text))
    return "" if re.search(r"[<(][)>]|<\w+>|\.hpp|glm::", text) else text


def find_body(kind, name):
    """The comment before a struct or enumeration and the lines of its body."""
    name = name.split("<")[0]
    short = re.escape(name.split("::")[-1])
    end = "^" if kind == "struct" else ""
    for text in HEADERS.values():
        found = re.search(rf"((?:^///.*\n)*)(?:^template.*\n)?^{kind} {short}\b[^;{{]*\{{([^\0]*?){end}\}};", text, re.M)
        space = name.rsplit("::", 1)[0] if "::" in name else ""
        if found and (not space or f"namespace tendril::{space} " in text):
            return found.group(1).splitlines(), found.group(2).splitlines()
    stop(f"no public header has {kind} {name}")


def enumerators(name):
    if name.count("::") > 1:  # within a struct: its enumerators, in one line
        _, body = find_body("struct", name.rsplit("::", 1)[0])
        found = re.search(rf"enum class {name.split('::')[-1]}\b[^{{]*\{{ (.*?) \}}", "\n".join(body)) or \
            stop(f"no public header has {name}")
        return "", [(value, "") for value in found[1].split(", ")]
    comment, body = find_body("enum class", name)
    values, help_text = [], {}
    for line in body:
        code, _, said = line.partition("///<")
        if code.lstrip().startswith("///"):
            continue
        values += re.findall(r"\b([A-Z]\w*)\b", code)
        if said and values:
            help_text.setdefault(values[-1], []).append(said)
    return first_sentence(comment), [(value, first_sentence(help_text.get(value, []))) for value in values]


def member_help(name):
    """Help of each member: its comment, or that before the line that declares it."""
    comment, body = find_body("struct", name)
    before, help_text, last = [], {}, []
    for line in body:
        code, _, after = line.partition("///<")
        if line.strip().startswith("///") and not line.strip().startswith("///<"):
            before.append(line)
            continue
        if line.strip().startswith(("//", "///<")):
            if after and last:
                for each in last:
                    help_text[each].append(after)
            continue
        declared = re.findall(r"(\w+)\s*(?:=[^,;]*|\{[^}]*\})?\s*(?=[,;])", re.sub(r"<[^;]*>(?=\s+\w)", "", code))
        if "(" in code.split("=")[0].split("{")[0] or not declared or "operator" in code:
            before = []
            continue
        last = declared
        for each in declared:
            help_text[each] = [after] if after else list(before)
        before = []
    return first_sentence(comment), {each: first_sentence(said) for each, said in help_text.items()}


# ---- The tables.

TABLES = {table["struct"]: table for table in json.loads((BINDINGS / "tables.json").read_text())}


def row_comment(row, said, output=False, null=""):
    """Unit, range and default, then help: "m, 0 to 1e9, unset. Pole target"."""
    unit = re.escape(row.get("unit") or "no unit")
    said = re.sub(rf",? ?(?:(?<!\w){unit}, )?(?:each coordinate )?(?:up to|[-\w]+ to) -?(?:max|min)_\w+(?: - 1)?", "", said)
    said = re.sub(rf"^{unit}(?:, |$)|, {unit}$", "", said)
    facts, said = row_facts(row, said, output, null)
    said = re.sub(r"^(?:Seconds|Metres)$", "", said)
    return ", ".join(facts) + (". " if facts and said else "") + (said[:1].upper() + said[1:] if facts else said)


def row_facts(row, said, output=False, null=""):
    """Unit, range and default; and the help without them."""
    def text(number):
        if number is None:
            return "unset"
        if number in (3.1415927, -3.1415927):
            return "pi" if number > 0 else "-pi"
        if abs(number) >= 1e4 and re.fullmatch(r"-?10+", f"{number:.0f}"):
            return f"{'-' if number < 0 else ''}1e{len(f'{abs(number):.0f}') - 1}"
        return f"{number:g}"
    facts = []
    if unit := row.get("unit"):
        facts.append(unit)
    if row["type"] in ("quatf", "quat"):
        facts.append("unit length")
    elif "range" in row and not output:
        low, high = row["range"]
        facts.append(("over " if row.get("over") else "") + f"{text(low)} to {text(high)}")
    elif row["type"] == "flag" and not output:
        facts.append("0 or 1")
    if output:
        pass
    elif "default" in row and not isinstance(row["default"], list):
        default = row["default"]
        facts.append("default " + row["choices"][default] if row["type"] == "choice" and default is not None else
                     "unset" if default is None else f"default {text(default)}")
    elif isinstance(row.get("default"), list):
        facts.append("default " + " ".join(text(each) for each in row["default"]))
    if null:
        facts.append(null)
    said = re.sub(r"^(?:Metres|Radians|Fraction of the reach)?,? ?(?:over )?-?[\d. ]+\d? to [\w.]+(?: \d+)*(?:[:;,] ?|$)",
                  "", re.sub(r"^Hz, ", "", said), flags=re.I)
    for fact in facts:  # said already
        said = re.sub(rf",? {re.escape(fact)}(?=[,:]|$)" if " to " in fact else rf"^{re.escape(fact)}$", "", said)
    return facts, said
